"""The worked example of ``docs/extension``: oscillator, estimator, language and section from outside.

It is put on the path as an installer would: its module, and a folder of metadata with its entry points.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import pytest

import ridgeback
from ridgeback.cli import main
from ridgeback.compare.benchmark.ways.outsiders import outsiders
from ridgeback.console.surroundings import parts
from ridgeback.reports.outside_sections import outside_sections
from ridgeback.symbolic.codegen.languages.registry import languages
from ridgeback.symbolic.systems.catalogue import catalogue

EXAMPLE = Path(__file__).parents[3] / "docs" / "extension"
GROUPS = ("ridgeback.systems", "ridgeback.estimators", "ridgeback.languages", "ridgeback.sections")


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[object]:
    """A function that puts a distribution with these entry points and modules on the path."""

    def put(name: str, points: Mapping[str, Mapping[str, str]], modules: Mapping[str, str]) -> None:
        site = tmp_path / name
        info = site / f"{name.replace('-', '_')}-1.0.dist-info"
        info.mkdir(parents=True)
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
        lines = [
            line for group, own in points.items() for line in (f"[{group}]", *(f"{k} = {v}" for k, v in own.items()))
        ]
        (info / "entry_points.txt").write_text("\n".join(lines) + "\n")
        for module, text in modules.items():
            (site / f"{module}.py").write_text(text)
        monkeypatch.syspath_prepend(site)
        forget()

    def forget() -> None:
        languages.cache_clear()
        catalogue.cache_clear()

    yield put
    monkeypatch.undo()
    sys.modules.pop("ridgeback_cable", None)
    forget()


@pytest.fixture
def cable(install: object) -> None:
    project = tomllib.loads((EXAMPLE / "pyproject.toml").read_text())["project"]
    source = (EXAMPLE / "ridgeback_cable.py").read_text()
    assert source.count("\n") < 60
    install(project["name"], project["entry-points"], {"ridgeback_cable": source})  # type: ignore[operator]


@pytest.mark.usefixtures("cable")
def test_the_oscillator_is_derived_by_name(capsys: pytest.CaptureFixture[str]) -> None:
    found = ridgeback.derive("sagging_cable", 4)
    assert found.system == "sagging-cable"
    assert found.frequency == ridgeback.derive("u'' + u'/100 + u + u**2/4 + u**3/10 = 0", 4).frequency
    assert main(["systems"]) == 0
    assert "sagging-cable" in capsys.readouterr().out
    assert main(["derive", "sagging-cables", "--order", "2"]) == 2
    assert "did you mean sagging-cable" in capsys.readouterr().err


@pytest.mark.usefixtures("cable")
def test_the_estimator_takes_part() -> None:
    time = np.arange(400) / 8.0
    track = outsiders()["teager"](np.cos(1.3 * time), 8.0)
    np.testing.assert_allclose(track.omega, 1.3, rtol=1e-9)
    assert track.time[0] == time[2]


@pytest.mark.skipif(shutil.which("awk") is None, reason="no awk")
@pytest.mark.usefixtures("cable")
@pytest.mark.parametrize("order", [4, 24])
def test_the_language_gives_the_same_values(order: int) -> None:
    peaks = [0.1, 1.0, 2.5]
    calls = "; ".join(f'printf "%.17g\\n", omega0({peak!r}, 1.0)' for peak in peaks)
    program = ridgeback.generate("pendulum", "awk", order=order) + f"BEGIN {{ {calls} }}"
    done = subprocess.run(["awk", program], capture_output=True, text=True, check=True)
    names: dict[str, object] = {}
    exec(compile(ridgeback.generate("pendulum", "python", order=order), "pendulum", "exec"), names)  # noqa: S102
    assert [float(line) for line in done.stdout.split()] == [names["omega0_unchecked"](peak, 1.0) for peak in peaks]  # type: ignore[operator]


@pytest.mark.usefixtures("cable")
def test_the_section_stands_on_the_page_and_doctor_sees_all() -> None:
    class Decay:
        frequency_ends = (1.0, 1.25)

    class Report:
        decay = Decay()

    (found,) = outside_sections(Report())  # type: ignore[arg-type]
    assert (found.key, found.name) == ("plugin-change", "Change")
    assert found.parts[0].value == "omega0 goes from 1 to 1.25."
    seen = [part for part in parts() if part.kind == "plugin"]
    assert {part.name for part in seen} == {"sagging-cable", "teager", "awk", "change"}
    assert {part.found for part in seen} == {"ridgeback-cable 1.0"}


def test_a_broken_plugin_is_one_line_and_breaks_nothing_else(
    install: object, capsys: pytest.CaptureFixture[str]
) -> None:
    points = {group: {"wreck": "no_such_module:thing"} for group in GROUPS}
    install("wreck", points, {})  # type: ignore[operator]
    why = "the plugin 'wreck' (no_such_module:thing) of wreck 1.0 raised ModuleNotFoundError"
    for arguments in (["derive", "wreck"], ["generate", "pendulum", "--language", "wreck"]):
        assert main(arguments) == 2
        said = capsys.readouterr()
        assert why in said.err
        assert said.err.count("\n") == 1
        assert not said.out
    assert main(["systems"]) == 0
    assert why in capsys.readouterr().out
    assert main(["generate", "pendulum", "--order", "2", "--language", "c"]) == 0
    (section,) = outside_sections(object())  # type: ignore[arg-type]
    assert why in str(section.parts[0].value)
    with pytest.raises(ridgeback.InputError, match="ModuleNotFoundError"):
        outsiders()["wreck"](np.zeros(9), 1.0)
    assert any(system.name == "pendulum" for system in catalogue())


def test_a_plugin_of_the_wrong_kind_says_so(install: object) -> None:
    install("odd", {"ridgeback.systems": {"odd": "math:pi"}}, {})  # type: ignore[operator]
    with pytest.raises(ridgeback.InputError, match="gives a float, not a Oscillator"):
        ridgeback.oscillator("odd")
