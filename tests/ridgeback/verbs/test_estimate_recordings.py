"""``ridgeback estimate`` on recordings as they are: several channels and runs, gaps, clipping, formats, a picture."""

from __future__ import annotations

import csv
import io
import json
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

from ridgeback.cli import main
from ridgeback.common.errors import InputError
from ridgeback.numeric.recording.recording import Recording
from tests.ridgeback.conftest import Ridgeback

RATE = 20.0
T = np.arange(500) / RATE
QUICK = ("--method", "pseudo-wigner")
BAND = (*QUICK, "--band", "6,10")
"""In noise too, where the band is no matter of the signal."""


def decay(size: float = 1.0) -> np.ndarray:
    """omega0 = 8 - 0.3 a^2, a'/a = -0.05."""
    a = size * np.exp(-0.05 * T)
    return a * np.cos(8.0 * T - 0.3 * size**2 * (1 - np.exp(-0.1 * T)) / 0.1)


def written(path: Path, **columns: np.ndarray) -> str:
    rows = zip(*columns.values(), strict=True)
    lines = [",".join("" if np.isnan(value) else repr(float(value)) for value in row) for row in rows]
    path.write_text(",".join(columns) + "\n" + "\n".join(lines) + "\n", encoding="utf-8")
    return str(path)


def table(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_a_track_has_amplitude_and_damping_beside_frequency(ridgeback: Ridgeback, tmp_path: Path) -> None:
    done = ridgeback("estimate", written(tmp_path / "a.csv", t=T, u=decay()), *QUICK, "--format", "csv")
    assert done.code == 0
    assert "mean of the samples" in done.err
    rows = [row for row in table(done.out) if row["amplitude"] and row["valid"] == "true"]
    assert len(rows) > 200
    for row in rows:
        a = np.exp(-0.05 * float(row["time_s"]))
        assert float(row["amplitude"]) == pytest.approx(a, rel=2e-3)
        assert float(row["growth_rate_per_s"]) == pytest.approx(-0.05, abs=2e-3)
        assert float(row["omega_rad_s"]) == pytest.approx(8.0 - 0.3 * a**2, rel=1e-3)


def test_the_terminal_is_given_thirty_short_rows_and_all_only_when_asked(ridgeback: Ridgeback, tmp_path: Path) -> None:
    path = written(tmp_path / "a.csv", t=T, u=decay())
    brief = ridgeback("estimate", path, *QUICK).out.splitlines()
    head = next(i for i, line in enumerate(brief) if line.lstrip().startswith("time, s"))
    assert brief[head].split("  ") != [brief[head]]
    rows = brief[head + 1 : head + 31]
    assert all(row.endswith(("true", "false")) for row in rows)
    assert max(map(len, [brief[head], *rows])) <= 110
    assert brief[head + 31].startswith("30 of 500 rows")
    time, omega = 2.0 * T[-1] / 29, 2.0 * np.pi * float(rows[2].split()[4])
    assert float(rows[2].split()[0]) == pytest.approx(time, abs=1.0 / RATE)
    assert omega == pytest.approx(8.0 - 0.3 * np.exp(-0.1 * time), rel=1e-3)
    full = ridgeback("estimate", path, *QUICK, "--all").out
    assert "omega_rad_s" in full
    assert full.count("\n") > 500


def test_a_slow_record_is_told_in_its_own_unit_of_time(ridgeback: Ridgeback, tmp_path: Path) -> None:
    days = np.arange(500) / 20.0
    path = written(tmp_path / "a.csv", **{"t [d]": days, "u": np.exp(-0.05 * days) * np.cos(3.0 * np.pi * days)})
    lines = ridgeback("estimate", path, *QUICK).out.splitlines()
    assert lines[0].endswith("at 0.000231481 per second (20 per day)")
    head = next(i for i, line in enumerate(lines) if line.lstrip().startswith("time, d"))
    assert "frequency, 1/d" in lines[head]
    assert float(lines[head + 30].split()[0]) == pytest.approx(24.95, abs=1e-4)
    said = next(line for line in lines if line.startswith("frequency: "))
    assert "(1.5 per day) at t = " in said
    assert said.endswith(" per day")
    row = json.loads(ridgeback("estimate", path, *QUICK, "--format", "json").out)["track"][-1]
    assert row["time_s"] == pytest.approx(24.95 * 86400.0)


def test_one_missing_value_leaves_two_stretches_and_a_common_backbone(ridgeback: Ridgeback, tmp_path: Path) -> None:
    x = decay()
    x[250] = np.nan
    path = written(tmp_path / "a.csv", t=T, u=x)
    public = json.loads(ridgeback("estimate", path, *QUICK, "--format", "json").out)
    assert [signal["recording"]["stretch"] for signal in public["signals"]] == [1, 2]
    assert all(np.isfinite(row["omega_rad_s"]) for signal in public["signals"] for row in signal["track"])
    assert "1 gap: t = 12.45 to 12.55 (1 missing)" in " ".join(public["signals"][0]["notes"])
    (combined,) = public["combined"]
    assert (combined["channel"], combined["amplitude"]) == ("u", "fundamental")
    for row in combined["backbone"]:
        assert row["frequency_hz"] * 2 * np.pi == pytest.approx(8.0 - 0.3 * row["amplitude"] ** 2, rel=3e-3)
    filled = json.loads(ridgeback("estimate", path, *QUICK, "--fill", "0.11", "--format", "json").out)
    assert filled["recording"]["filled"] == 1
    said = ridgeback("estimate", path, *QUICK, "--backbone", "--format", "csv")
    assert "ridgeback: a.csv, u, stretch 1: 1 gap: t = 12.45" in said.err
    rows = table(said.out)
    assert {row["run"] for row in rows} == {"a.csv", "combined"}
    assert {row["stretch"] for row in rows} == {"1", "2", ""}


def test_runs_in_files_and_channels_by_name(ridgeback: Ridgeback, tmp_path: Path) -> None:
    files = [written(tmp_path / f"{i}.csv", t=T, u=decay(s), w=3 * decay(s)) for i, s in enumerate((1.0, 0.8))]
    done = ridgeback("estimate", *files, "--column", "u,w", *QUICK, "--backbone")
    assert (done.code, done.err) == (0, "")
    assert done.out.count("combined backbone of") == 2
    assert "combined backbone of w: 0.csv, w; 1.csv, w" in done.out
    assert "omega_between_runs_rad_s" in done.out
    together = json.loads(
        ridgeback("estimate", *files, "--column", "all", *QUICK, "--combine", "all", "--format", "json").out
    )
    (combined,) = together["combined"]
    assert len(combined["runs"]) == 4
    alone = json.loads(
        ridgeback("estimate", *files, "--column", "u", *QUICK, "--combine", "none", "--format", "json").out
    )
    assert alone["combined"] == []


def test_units_are_not_mixed(ridgeback: Ridgeback, tmp_path: Path) -> None:
    path = written(tmp_path / "a.csv", **{"t": T, "u [mm]": decay(), "w [V]": decay()})
    done = ridgeback("estimate", path, "--column", "all", "--backbone", "--combine", "all", *QUICK)
    assert done.code == 2
    assert "backbones in V and mm cannot be combined" in done.err


def test_a_channel_without_an_oscillation_is_owned_up_to(ridgeback: Ridgeback, tmp_path: Path) -> None:
    short = np.where(np.arange(500) < 20, decay(), np.nan)
    path = written(tmp_path / "a.csv", t=T, u=decay(), w=short)
    done = ridgeback("estimate", path, "--column", "u,w", *QUICK, "--format", "json")
    assert done.code == 3
    assert "gave no result: a.csv, w: signal spans" in done.err
    assert len(json.loads(done.out)["signals"]) == 1


def test_clipped_samples_are_told_and_kept_out_of_the_backbone(ridgeback: Ridgeback, tmp_path: Path) -> None:
    path = written(tmp_path / "a.csv", t=T, u=np.clip(decay(), -0.7, 0.7))
    public = json.loads(ridgeback("estimate", path, *QUICK, "--format", "json").out)
    assert public["recording"]["clipped"] > 20
    assert any("are clipped: t = 0" in note for note in public["notes"])
    top = max(public["backbone"], key=lambda row: row["amplitude"])
    assert top["amplitude"] > 0.9  # what is above the flat tops follows from the samples below them
    rounding = 1e-8  # without noise the interval is as narrow as what the fit's last step leaves
    assert top["growth_rate_low_95_per_s"] - rounding < -0.05 < top["growth_rate_high_95_per_s"] + rounding
    halves = json.loads(ridgeback("estimate", path, "--half-cycles", "--format", "json").out)
    assert max(row["amplitude"] for row in halves["backbone"]) < 0.7
    assert max(row["amplitude"] for row in halves["track"]) == pytest.approx(0.7, rel=0.05)


def test_half_cycles_and_their_backbone(ridgeback: Ridgeback, tmp_path: Path) -> None:
    path = written(tmp_path / "a.csv", t=T, u=decay() + 0.3)
    public = json.loads(ridgeback("estimate", path, "--half-cycles", "--format", "json").out)
    assert public["method"] == "half-cycles"
    assert public["amplitude_definition"] == "peak"
    for row in public["track"][1:-1]:
        a = np.exp(-0.05 * row["time_s"])
        assert row["amplitude"] == pytest.approx(a, rel=2e-3)
        assert row["growth_rate_per_s"] == pytest.approx(-0.05, abs=1e-3)
        assert row["omega_rad_s"] == pytest.approx(8.0 - 0.3 * a**2, rel=1e-3)
    rows = table(ridgeback("estimate", path, "--half-cycles", "--backbone", "--format", "csv").out)
    assert set(rows[0]) >= {"amplitude", "omega_rad_s", "growth_rate_per_s"}


def test_a_matlab_file_gives_what_the_text_gives(ridgeback: Ridgeback, tmp_path: Path) -> None:
    text = written(tmp_path / "a.csv", t=T, u=decay())
    savemat(tmp_path / "a.mat", {"t": T, "u": decay()})
    of_text, of_mat = (
        table(ridgeback("estimate", name, *QUICK, "--format", "csv").out) for name in (text, str(tmp_path / "a.mat"))
    )
    assert of_text == of_mat


def test_without_h5py_the_environment_is_at_fault(
    ridgeback: Ridgeback, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.h5").write_bytes(b"\x89HDF\r\n\x1a\n")
    monkeypatch.setitem(sys.modules, "h5py", None)
    done = ridgeback("estimate", str(tmp_path / "a.h5"))
    assert done.code == 4
    remedy = "pip install 'ridgeback[hdf5]' brings it"
    assert done.err == f"ridgeback: reading a.h5 needs h5py, which is not installed; {remedy}\n"


@pytest.mark.parametrize("kind", ["svg", "png", "pdf"])
def test_a_picture_is_written_beside_the_numbers(ridgeback: Ridgeback, tmp_path: Path, kind: str) -> None:
    path = written(tmp_path / "a.csv", t=T, u=decay())
    picture = tmp_path / f"a.{kind}"
    done = ridgeback("estimate", path, *QUICK, "--plot", str(picture))
    assert (done.code, done.err) == (0, "")
    assert picture.read_bytes()[:5] in (b"<?xml", b"\x89PNG\r", b"%PDF-")
    assert "time, s" in done.out


def test_settings_reach_the_estimator(ridgeback: Ridgeback, tmp_path: Path) -> None:
    path = written(tmp_path / "a.csv", t=T, u=decay())

    def settings(*words: str) -> dict[str, object]:
        done = ridgeback("estimate", path, *words, "--format", "json")
        assert done.code == 0, done.err
        found = json.loads(done.out)
        return {"method": found["method"], **found["settings"]}

    limited = settings("--method", "pseudo-wigner", "--band-limited", "--single", "--window", "hann")
    assert limited["band_limited"] is True
    assert limited["single"] is True
    assert limited["lag_window"] == "hann"
    smooth = settings("--method", "smoothed-pseudo-wigner", "--smoothing", "0.5")
    assert smooth["smoothing_seconds"] == pytest.approx(0.5, abs=0.1)
    assert settings("--method", "polynomial-wigner", "--order", "4")["order"] == 4
    assert settings("--method", "harmonic-least-squares", "--harmonics", "2")["harmonics"] == [1, 2]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--plot", "a.gif"), "does not end in .svg, .png or .pdf"),
        (("--half-cycles", "--harmonic", "3"), "--half-cycles are those of the signal"),
        (("--backbone", "--harmonic", "3"), "--backbone is that of the fundamental"),
        (("--half-cycles", "--method", "wigner", "--lag", "3"), "no use for --method, --lag"),
        (("--monte-carlo", "5", "--window", "hann", "--single"), "no use for --window, --single"),
        (("--resample", "-3"), "'-3' is not above 0"),
        (("--detrend", "cubic"), "'cubic' is not one of"),
        (("--method", "hilbert", "--single"), "--method hilbert has no use for --single"),
        (("--run-column", "shot"), "no column shot"),
        (("--order", "5"), "'5' is not one of"),
    ],
)
def test_refusals_are_one_line(ridgeback: Ridgeback, tmp_path: Path, words: tuple[str, ...], message: str) -> None:
    done = ridgeback("estimate", written(tmp_path / "a.csv", t=T, u=decay()), *words)
    assert done.code == 2
    assert done.out == ""
    assert message in done.err
    assert done.err.count("\n") == 1


def test_treatment_belongs_to_a_recording(ridgeback: Ridgeback) -> None:
    done = ridgeback("report", "--fill", "0.1")
    assert done.code == 2
    assert "--fill belongs to --recording FILE" in done.err


def test_a_report_reads_what_estimate_reads(
    ridgeback: Ridgeback, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The recording that reaches the page is the one that the options describe."""
    seen: list[Recording] = []

    def taken(recording: Recording, **_: object) -> None:
        seen.append(recording)
        raise InputError("that is enough")

    monkeypatch.setattr("ridgeback.compare.report.recording_report.recording_report", taken)
    x = decay()
    x[250] = np.nan
    path = written(tmp_path / "a.csv", t=T, u=x)
    assert ridgeback("report", "--recording", path).code == 2
    assert ridgeback("report", "--recording", path, "--fill", "0.2", "--detrend", "linear").code == 2
    assert [recording.values.size for recording in seen] == [250, 500]
    assert seen[1].facts["detrend"] == "linear"


def test_what_a_table_has_no_room_for_is_said(ridgeback: Ridgeback, tmp_path: Path) -> None:
    """Notes of the measurement and why there is no interval: those that JSON has, a line each beside CSV."""
    noise = np.random.default_rng(1).standard_normal(T.size)
    path = written(tmp_path / "a.csv", t=T, u=noise)
    public = json.loads(ridgeback("estimate", path, *BAND, "--format", "json").out)
    assert "No amplitude: " in public["notes"][-1]
    reason = public["settings"]["no_interval"]
    done = ridgeback("estimate", path, *BAND, "--format", "csv")
    assert done.code == 3  # noise: no sample is valid
    wanted = [*public["notes"], f"No interval: {reason}."]
    *said, last = done.err.splitlines()
    assert said == [f"ridgeback: a.csv, u: {note}" for note in wanted]
    assert "no oscillation stands out of the noise" in last


@pytest.mark.parametrize("style", ["text", "json", "csv"])
def test_a_signal_without_a_backbone_is_named(ridgeback: Ridgeback, tmp_path: Path, style: str) -> None:
    noise = np.random.default_rng(1).standard_normal(T.size)
    files = [written(tmp_path / "a.csv", t=T, u=decay()), written(tmp_path / "noise.csv", t=T, u=noise)]
    done = ridgeback("estimate", *files, *BAND, "--backbone", "--format", style)
    assert done.code == 3
    last = done.err.splitlines()[-1]
    assert "noise.csv, u: no backbone, no oscillation stands out of the noise" in last
    assert "a.csv, u: no backbone" not in last
    assert "amplitude" in done.out


def test_a_backbone_that_is_refused_has_the_reason_and_no_other_note(ridgeback: Ridgeback, tmp_path: Path) -> None:
    """A second blow beside a drift, which is a note elsewhere: one smooth oscillation is not there."""
    x = (decay() + np.where(T > 5.0, np.sin(8.0 * (T - 5.0)), 0.0) + 0.02 * T)[:200]
    x += 0.003 * np.random.default_rng(2).standard_normal(x.size)
    path = written(tmp_path / "a.csv", t=T[: x.size], u=x)
    assert "local mean wanders" in " ".join(
        json.loads(ridgeback("estimate", path, *QUICK, "--format", "json").out)["notes"]
    )
    done = ridgeback("estimate", path, "--backbone")
    assert done.code == 2
    assert "a.csv, u: no backbone, the frequency wanders at random, jumps, or is that of several components" in done.err
    assert "local mean wanders" not in done.err
    assert len(done.err.splitlines()) == 1


def test_a_stretch_without_a_backbone_is_a_note(ridgeback: Ridgeback, tmp_path: Path) -> None:
    x = decay()
    x[250] = np.nan
    x[251:] = np.random.default_rng(1).standard_normal(T.size - 251)
    path = written(tmp_path / "a.csv", t=T, u=x)
    done = ridgeback("estimate", path, *BAND, "--backbone", "--format", "csv")
    assert done.code == 3  # the noise of the second stretch gives no valid value
    assert "a.csv, u, stretch 2: No amplitude: " in done.err
    assert "a.csv, u: no backbone" not in done.err


@pytest.mark.parametrize(
    "words",
    [
        ("-o", "z.svg", "--plot", "./z.svg"),
        ("-o", "a.csv"),
        ("-o", "link.csv"),
        ("-o", "sub/../a.csv"),
        ("--monte-carlo", "2", "-o", "a.csv"),
    ],
)
def test_no_output_replaces_another_or_the_recording(
    ridgeback: Ridgeback, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sub").mkdir()
    written(tmp_path / "a.csv", t=T, u=decay())
    (tmp_path / "link.csv").symlink_to("a.csv")
    before = (tmp_path / "a.csv").read_bytes()
    done = ridgeback("estimate", "a.csv", *QUICK, *words)
    assert done.code == 2
    assert "give each a name of its own" in done.err
    assert done.err.count("\n") == 1
    assert (tmp_path / "a.csv").read_bytes() == before
    assert not (tmp_path / "z.svg").exists()


@pytest.mark.parametrize("verb", [("identify", "a.csv"), ("report", "--recording", "a.csv")])
def test_no_verb_writes_over_its_recording(
    ridgeback: Ridgeback, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, verb: tuple[str, ...]
) -> None:
    monkeypatch.chdir(tmp_path)
    written(tmp_path / "a.csv", t=T, u=decay())
    done = ridgeback(*verb, "-o", "a.csv")
    assert done.code == 2
    assert "-o 'a.csv' is a file that is read too" in done.err


def test_a_checkpoint_is_no_output(ridgeback: Ridgeback, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    done = ridgeback("derive", "pendulum", "--order", "8", "--digits", "20", "--checkpoint", "x.json", "-o", "x.json")
    assert done.code == 2
    assert "-o 'x.json' is the file of --checkpoint too" in done.err
    assert not (tmp_path / "x.json").exists()


@pytest.mark.parametrize("more", [[], ["--half-cycles"], ["--backbone"]])
def test_noise_is_said_to_be_noise(more: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "noise.csv"
    x = np.random.default_rng(4).standard_normal(500)
    path.write_text("u\n" + "\n".join(map(repr, x.tolist())))
    code = main(["estimate", str(path), "--rate", "20", "--format", "json", *more])
    captured = capsys.readouterr()
    assert code == (2 if "--backbone" in more else 3)
    assert "noise alone shows as clear a peak with probability" in captured.err
    if not more:
        found = json.loads(captured.out)
        assert found["settings"]["noise_probability"] > 1e-3
        assert not any(row["valid"] for row in found["track"])
        assert main(["estimate", str(path), "--rate", "20"]) == 3
        assert "No oscillation stands out of the noise" in capsys.readouterr().out
