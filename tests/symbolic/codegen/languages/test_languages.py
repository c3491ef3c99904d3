"""Every language, compiled and run: no warning, the same bits in all of them, near the exact polynomial."""

from __future__ import annotations

import hashlib
import math
import subprocess
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from flint import arb, ctx

from ridgeback.compare.binding.generated_code import check, tool_of, write_files
from ridgeback.symbolic.codegen import LANGUAGES, form_of, generate, packaged
from ridgeback.symbolic.codegen.evaluation import value_at
from ridgeback.symbolic.codegen.formulas.closed_forms import mean_form
from ridgeback.symbolic.codegen.program import Form, Mode
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.expansion import Expansion
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator
from tests.symbolic.codegen.languages.drivers import DRIVERS, POINTS, STEP

ORDERS = (10, 40, 100, 260)
"""At the last one polynomials are loops over tables."""
END = Fraction("2.9")
RUNNING = [language for language in LANGUAGES if language not in ("c-header", "latex")]


@cache
def pendulum(order: int) -> Expansion:
    return energy_integral(find("pendulum"), order)


@cache
def all_orders(mode: Mode) -> Form:
    """One file with the pendulum's omega0 at every order, so that each language is compiled once."""
    forms = {n: form_of(pendulum(n), up_to=END, mode=mode, name="clock") for n in ORDERS}
    functions = tuple(replace(form.functions[0], name=f"order{n}") for n, form in forms.items())
    return replace(forms[ORDERS[0]], functions=functions)


@cache
def pendulum_form(order: int) -> Form:
    return form_of(pendulum(order), up_to=END)


@cache
def mean() -> Form:
    return form_of(mean_form(find("pendulum")), up_to=END)


def bits(language: str, form: Form, folder: Path) -> str:
    """The bits of all values over the grid, by a program in the language."""
    driver, flags = DRIVERS[language]
    tool = tool_of(language)
    assert tool is not None
    write_files(folder, {**packaged(form, language), **driver(form)})
    sources = {
        "c": ("bits.c", "clock.c", "-lm"),
        "cpp": ("bits.cpp",),
        "fortran": ("src/clock.f90", "bits.f90"),
    }.get(language, ())
    runs = {"matlab": (tool, "--quiet", "--norc", "bits.m"), "javascript": (tool, "bits.mjs")}
    if flags:
        done = subprocess.run([tool, *flags, *sources], cwd=folder, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        command = (str(folder / "bits"),)
    else:
        command = runs.get(language, (tool, "bits.py"))
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True).stdout.lower()


@cache
def expected(mode: Mode) -> str:
    form = all_orders(mode)
    values = (value_at(form, f, (i * float(STEP), 1.0)) for i in range(POINTS) for f in form.functions)
    return "".join(f"{hexadecimal(v)}\n" for v in values)


def hexadecimal(value: float) -> str:
    import struct

    return struct.pack(">d", value).hex()


@pytest.mark.parametrize("mode", ["strict", "fma", "accurate"])
@pytest.mark.parametrize("language", DRIVERS)
def test_all_languages_give_one_hash(language: str, mode: Mode, tmp_path: Path) -> None:
    """Optimised for this processor, where fused operations would be at hand; without a warning."""
    if tool_of(language) is None:
        pytest.skip(f"nothing runs {language} here")
    if mode == "accurate" and language in ("numba", "rust", "cpp", "array-api"):
        pytest.skip("the same operations as in strict; seen in the others")
    form = all_orders(mode)
    if mode == "fma" and language in ("numba", "array-api"):
        pytest.skip(f"{language} has no fused operation")
    found, wanted = bits(language, form, tmp_path), expected(mode)
    ours = [line.replace("fff8000000000000", "7ff8000000000000") for line in found.split()]  # the sign of nan
    assert (
        hashlib.sha256("\n".join(ours).encode()).hexdigest()
        == hashlib.sha256("\n".join(wanted.split()).encode()).hexdigest()
    )


@pytest.mark.parametrize("language", RUNNING)
def test_every_self_test_passes(language: str) -> None:
    """A limit cycle's motion with sines, a slow flow whose symbols are words of the languages, a cube root, the agm."""
    if tool_of(language) is None:
        pytest.skip(f"nothing runs {language} here")
    words = "u'' + lambda*u' + double*u**2 + u + nullptr*u**3 + asm*u**5 = 0"
    flow = form_of(multiple_scales(Oscillator.from_equation(words), 4))
    cycle = form_of(lindstedt(find("van-der-pol"), 3), motion=language != "numba")
    root = form_of(energy_on_each_side(find("cube-root"), 2))
    forms = ((flow, "flow"), (cycle, "cycle"), (root, "root"), (mean(), "mean"))
    functions = tuple(replace(f, name=f"{f.name}_{tail}") for form, tail in forms for f in form.functions)
    found = check(replace(flow, functions=functions), language)
    assert found.state == "passed", found


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_language_writes_every_operation(language: str) -> None:
    """Loops, roots, sines and means, whether or not the language's tools are on this machine."""
    cycle = form_of(lindstedt(find("van-der-pol"), 3), motion=language != "numba")
    forms = (pendulum_form(260), cycle, form_of(energy_on_each_side(find("cube-root"), 2)), mean())
    for form in forms:
        text = "".join(packaged(form, language).values())
        assert all(function.name in text or language == "latex" for function in form.functions)
    if language == "latex":
        sines, root, means = ("".join(packaged(form, "latex").values()) for form in forms[1:])
        assert r"\gets \left\lfloor" in sines
        assert r"\sqrt[3]{A}" in root
        assert r"\gets \sqrt{\mathit{area}}" in means


def test_a_changed_constant_fails_the_self_test(tmp_path: Path) -> None:
    form = form_of(pendulum(10), up_to=END, name="clock")
    source = packaged(form, "python")["clock/__init__.py"]
    assert "0.0625" in source
    (tmp_path / "clock.py").write_text(source.replace("0.0625", "0.06250000000000001", 1), encoding="utf-8")
    from tests.symbolic.generated import load

    assert load((tmp_path / "clock.py").read_text(encoding="utf-8"), tmp_path).self_test() > 0


@pytest.mark.parametrize(("mode", "most"), [("strict", 1.3), ("fma", 1.0), ("accurate", 0.505)])
def test_units_in_the_last_place_against_balls(mode: Mode, most: float) -> None:
    """The worst of a grid is below the proved bound, and that is not far from it."""
    series, form = pendulum(12), form_of(pendulum(12), up_to=Fraction("2.36"), mode=mode)
    made, worst = form.functions[0], 0.0
    with ctx.workprec(200):
        for i in range(2000):
            x = 2.36 * i / 2000
            exact = series.in_balls(arb(x))
            worst = max(worst, float(abs(arb(value_at(form, made, (x, 1.0))) - exact) / math.ulp(float(exact))))
    proved = float(made.notes[0].split("(")[1].split()[0])
    assert worst <= proved <= 2 * worst
    assert worst <= most


def test_single_precision_in_c_and_rust() -> None:
    form = form_of(pendulum(12), up_to=Fraction(2), real="float32")
    relative = float(form.functions[0].notes[0].split("at most ")[1].split()[0])
    assert 2.0**-24 <= relative <= 4 * 2.0**-24
    for language in ("c", "rust"):
        if tool_of(language) is not None:
            assert check(form, language).state == "passed"
    assert "f;" in generate(pendulum(4), "c", real="float32")


def test_regeneration_is_byte_identical_and_the_hash_is_of_the_input() -> None:
    one, two, other = (generate(pendulum(n), "c", up_to=END) for n in (10, 10, 12))
    assert one == two
    digest = one.split("from input ")[1].split(".")[0]
    assert digest not in other
    assert "None" not in one


def test_fast_mathematics_is_refused_by_the_compiler(tmp_path: Path) -> None:
    tool = tool_of("c")
    if tool is None:
        pytest.skip("no C compiler here")
    (tmp_path / "x.c").write_text(generate(pendulum(4), "c"), encoding="utf-8")
    command = [tool, "-std=c99", "-O2", "-ffast-math", "-c", "x.c"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode != 0
    assert "ffast-math" in done.stderr


def test_two_files_under_two_names_link_together(tmp_path: Path) -> None:
    tool = tool_of("c")
    if tool is None:
        pytest.skip("no C compiler here")
    for name in ("one", "two"):
        (tmp_path / f"{name}.c").write_text(generate(pendulum(4), "c", name=name), encoding="utf-8")
        (tmp_path / f"{name}.h").write_text(generate(pendulum(4), "c-header", name=name), encoding="utf-8")
    main = '#include "one.h"\n#include "two.h"\nint main(void) { return one_omega0(0, 1) != two_omega0(0, 1); }\n'
    (tmp_path / "main.c").write_text(main, encoding="utf-8")
    command = [tool, "-std=c99", "-Wall", "-Wextra", "-Werror", "main.c", "one.c", "two.c", "-o", "both", "-lm"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    subprocess.run([str(tmp_path / "both")], check=True)


def test_whole_numbers_lists_and_ends() -> None:
    import tempfile

    from tests.symbolic.generated import load

    with tempfile.TemporaryDirectory() as folder:
        module = load(generate(pendulum(200), up_to=END), Path(folder))
        for kind in (np.uint8, np.int64, np.float32, int):
            assert module.omega0(kind(2)) == module.omega0(2.0)
        assert module.omega0([0, 1, 2]).tolist() == [module.omega0(x) for x in (0.0, 1.0, 2.0)]
        assert module.omega0(np.array([2, 3], dtype=np.uint8))[0] == module.omega0(2.0)
        for outside in (3.0, -3.0, math.inf, -math.inf, math.nan, 10):
            assert math.isnan(module.omega0(outside))
            assert math.isnan(module.omega0([outside])[0])
        out = np.linspace(0, 2.5, 5000)
        plain = module.omega0(out.copy())
        module.omega0_array(out, out)
        assert out.tolist() == plain.tolist()
        with pytest.raises(ValueError, match="give float64"):
            module.omega0_array(out, out[:3])


def test_lines_of_fortran_are_short_and_nothing_is_nested() -> None:
    for language in ("fortran", "c", "python", "julia", "rust", "javascript", "matlab"):
        source = generate(pendulum(200), language, up_to=END)
        assert max(map(len, source.splitlines())) <= (132 if language == "fortran" else 300)
        assert max(line.count("(") for line in source.splitlines() if "points" not in line) < 12


def test_arrays_of_a_strict_library_keep_their_kind(tmp_path: Path) -> None:
    """Nothing but the standard is used, and whole numbers become floating-point ones."""
    xp = pytest.importorskip("array_api_strict")
    from tests.symbolic.generated import load

    module = load(generate(pendulum(40), "array-api", up_to=END), tmp_path)
    for values in (xp.asarray([1.0, 2.0, 5.0]), xp.asarray([1, 2, 5])):
        found = module.omega0(values)
        assert isinstance(found, type(values))
        assert [float(found[i]) for i in (0, 1)] == [module.omega0(np.asarray([v]))[0] for v in (1.0, 2.0)]
        assert math.isnan(float(found[2]))
