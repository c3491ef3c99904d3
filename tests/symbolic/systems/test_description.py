"""Oscillators from text and from TOML files, about any equilibrium."""

from pathlib import Path

import pytest
import sympy

from ridgeback.common.errors import InputError
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.description import from_text, read_description

GOOD = """
[oscillator]
equation = "theta'' + 2*mu*theta' + k**2*sin(theta) = 0"
title = "Mine"
potential = "k**2*(1 - cos(theta))"
initial = [1.5, 0]
unit = "rad"
[oscillator.parameters]
k = "2.5"
mu = 0
"""


def written(folder: Path, text: str) -> Path:
    file = folder / "mine.toml"
    file.write_text(text, encoding="utf-8")
    return file


def test_a_file_says_what_the_catalogue_would(tmp_path: Path) -> None:
    own = read_description(written(tmp_path, GOOD))
    assert (own.name, own.title, own.unit, own.initial) == ("mine", "Mine", "rad", (1.5, 0.0))
    assert lindstedt(own, 6).frequency == lindstedt(find("pendulum").with_parameters({"k": "2.5"}), 6).frequency


def test_the_double_well_about_one_of_its_wells() -> None:
    # u'' - u + u^3 about 1, measured from there: w'' + 2 w + 3 w^2 + w^3 = 0.
    moved = from_text("u'' - u + u**3 = 0", about="1")
    plain = from_text("w'' + 2*w + 3*w**2 + w**3 = 0")
    assert moved.stiffness == 2
    assert lindstedt(moved, 6).frequency == lindstedt(plain, 6).frequency == energy_integral(moved, 6).frequency


@pytest.mark.parametrize(("equation", "about"), [("x'' + sin(x)", "2*pi"), ("x'' - sin(x) = 0", "pi")])
def test_irrational_equilibria_are_exact(equation: str, about: str) -> None:
    assert lindstedt(from_text(equation, about=about), 6).frequency == lindstedt(find("pendulum"), 6).frequency


def test_velocities_do_not_move() -> None:
    moved = from_text("u'' + (u - 3) + (u - 3)*u'**2 = 0", about="3")
    assert lindstedt(moved, 4).frequency == lindstedt(from_text("u'' + u + u*u'**2"), 4).frequency


@pytest.mark.parametrize(
    ("equation", "about", "words"),
    [
        ("u'' - u + u**3 = 0", "0.5", "not an equilibrium"),
        ("u'' - u + u**3 = 0", "x", "not a number"),
        ("u'' + sin(u) = 0", "pi", "saddle"),
        ("u'' + u", "1+", "column"),
    ],
)
def test_places_that_are_no_centre_are_refused(equation: str, about: str, words: str) -> None:
    with pytest.raises(InputError, match=words) as caught:
        from_text(equation, about=about)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda t: t.replace("[oscillator]", "[other]"), "no .oscillator. table"),
        (lambda t: t.replace("initial", "start"), "unknown key 'start'"),
        (lambda t: t.replace("[1.5, 0]", "[1.5, nan]"), "finite"),
        (lambda t: t.replace("[1.5, 0]", "1.5"), "pair"),
        (lambda t: t.replace('title = "Mine"', "title = 3"), "not text"),
        (lambda t: t.replace("mu = 0", "mu = true"), "not a number"),
        (lambda t: t.replace("mu = 0", "nu = 0"), "nu"),
        (lambda t: t.replace('"k**2*(1 - cos(theta))"', '"k**2*theta**2/2"'), "potential"),
        (lambda t: t.replace("sin(theta)", "sin(theta"), "column"),
        (lambda t: t + "=", "not TOML"),
        (lambda t: t.replace("[oscillator]", "[oscillator]\nabout = '2*pi'"), "potential cannot be given together"),
    ],
)
def test_faulty_files_are_named_with_their_fault(tmp_path: Path, change, words: str) -> None:  # type: ignore[no-untyped-def]
    file = written(tmp_path, change(GOOD))
    with pytest.raises(InputError, match=words) as caught:
        read_description(file)
    assert str(file) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_missing_file_is_an_operating_system_error(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="none"):
        read_description(tmp_path / "none.toml")


def test_parameters_stay_symbolic_when_they_are_given_no_value() -> None:
    own = from_text("u'' + u + c*u**3")
    assert lindstedt(own, 2).frequency[2] == sympy.Rational(3, 8) * sympy.Symbol("c", real=True)


@pytest.mark.parametrize("opened", ["[", "{a="])
def test_values_nested_beyond_measure_are_one_line(tmp_path: Path, opened: str) -> None:
    file = tmp_path / "deep.toml"
    file.write_text("[oscillator]\nequation = " + opened * 20_000)
    with pytest.raises(InputError, match=r"too deeply|is not TOML"):
        read_description(file)


def test_a_description_is_a_file_of_bounded_size(tmp_path: Path) -> None:
    (tmp_path / "large.toml").write_bytes(b"#" * 100_001)
    (tmp_path / "endless.toml").symlink_to("/dev/zero")
    with pytest.raises(InputError, match=r"over 0.1 MB"):
        read_description(tmp_path / "large.toml")
    with pytest.raises(InputError, match="is a device, not a file"):
        read_description(tmp_path / "endless.toml")
