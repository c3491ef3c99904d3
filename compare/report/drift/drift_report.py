"""A motion under drifting parameters as a report: omega0 at the conserved action, its error, what the drift changes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ridgeback.common.csv_text import csv_text
from ridgeback.common.numbers import number, per_cent, scientific, two_digits
from ridgeback.common.progress import Progress, silent
from ridgeback.compare.drift.comparison import compare_drift
from ridgeback.compare.drift.results import DriftComparison
from ridgeback.compare.report.naming import parameters_line
from ridgeback.compare.report.provenance import provenance
from ridgeback.compare.report.results import Card, Described, Report
from ridgeback.compare.report.stages import Stopwatch
from ridgeback.compare.report.system_report import UNNAMED
from ridgeback.numeric.orbits.adiabatic import SLOW
from ridgeback.symbolic.flow.drift import drifting
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator

MANY = 1e5
"""A ratio from here on is written as a power of ten."""


def drift_report(
    oscillator: OscillatorLike,
    laws: Mapping[str, str],
    *,
    initial: tuple[float, float] | None = None,
    duration: float | None = None,
    rate: float | None = None,
    timed: bool = True,
    command: str = "",
    progress: Progress = silent,
) -> Report:
    """Integrate a motion under a drift and say how well the conserved action gives its frequency.

    Parameters
    ----------
    oscillator
        Any form of an oscillator; a parameter that drifts needs no value.
    laws
        For each drifting parameter an expression in t.
    initial, duration, rate
        As for :func:`ridgeback.compare.drift.comparison.compare_drift`.
    timed
        Whether measured times are kept.
    command
        The command line that makes the same report, for its provenance.
    progress
        Called with the share of the work that is done, 0 to 1, and the name of the step.

    Returns
    -------
    Report
        A page with frequency, error, amplitude and plane of the motion.

    Raises
    ------
    InputError
        As :func:`ridgeback.compare.drift.comparison.compare_drift` does.
    """
    own = as_oscillator(oscillator)
    watch = Stopwatch(progress)
    with watch.stage("following the drift", 0.0, 1.0) as inner:
        found = compare_drift(own, laws, initial=initial, duration=duration, rate=rate, progress=inner)
    progress(1.0, "done")
    start = drifting(own, laws).start
    case = found.case
    name = "" if case.title == UNNAMED else case.title
    settings = {
        "system": case.system,
        "equation": case.equation,
        "drift": found.laws,
        **{f"parameter {name} at t = 0": value for name, value in case.parameters.items()},
        "initial": f"{case.initial[0]!r}, {case.initial[1]!r}",
        "duration": case.duration,
        "rate": case.rate,
    }
    return Report(
        title=drift_title(found),
        lead=f"{found.laws}: ω₀ changes by at most {per_cent(found.rate)} in a radian of the motion.",
        summary=findings(found),
        cards=drift_cards(found),
        derivation=None,
        study=None,
        ranges=(),
        decay=None,
        recording=None,
        provenance=provenance(settings, command=command, seconds=watch.seconds() if timed else None),
        described=Described(name, start.equation_latex, parameters_line(case), start.reference),
        csv={"drift.csv": table(found.rows())},
        timed=timed,
        drift=found,
    )


def drift_title(found: DriftComparison) -> str:
    """The finding in one sentence."""
    if not found.adiabatic.is_slow:
        return "This drift is not slow: the action is not conserved well enough to be relied on"
    if found.max_error is None:
        return "The motion holds too few cycles to hold the conserved action against"
    ratio = _ratio(found)
    times = scientific(ratio) if ratio and ratio >= MANY else two_digits(ratio or 0.0)
    closer = f", {times} times closer than the parameters of t = 0" if ratio else ""
    return f"The conserved action follows ω₀(t) within {per_cent(found.max_error)}{closer}"


def _ratio(found: DriftComparison) -> float | None:
    if not found.max_error or found.frozen_error is None or found.frozen_error < 2 * found.max_error:
        return None
    return found.frozen_error / found.max_error


def findings(found: DriftComparison) -> tuple[str, ...]:
    """What was found, each with what it stands on."""
    J = found.adiabatic.action
    kept = abs(float(J[-1] / J[0]) - 1.0)
    said = [
        f"Against the cycle frequency of the integrated motion ω₀(J; p(t)) errs by {per_cent(found.rms_error)} rms and "
        f"{per_cent(found.max_error)} at most.",
        f"Expected to leading order is {per_cent(found.expected_error)}, of second order in the rates of drift and "
        "damping: exact for a linear oscillator, the order of it for others.",
        f"The frequency of the parameters of t = 0 is off by up to {per_cent(found.frozen_error)}.",
        "Nothing is lost: the action is that of the start throughout."
        if kept < 1e-12
        else f"Damping takes {per_cent(kept)} of the action; what is averaged is its loss.",
        f"Two integrators agree within {number(found.disagreement, 2)} in u.",
    ]
    if not found.adiabatic.is_slow:
        said.insert(0, f"A drift counts as slow up to {per_cent(SLOW)} in a radian.")
    return tuple(said)


def drift_cards(found: DriftComparison) -> tuple[Card, ...]:
    """Error by the action, without the drift, and how slow it is."""
    omega, peak = found.adiabatic.omega, found.adiabatic.peak
    by_action = (
        ("rms", per_cent(found.rms_error)),
        ("expected", per_cent(found.expected_error)),
        ("needs", "p(t) and the start, no integration"),
    )
    without = (("ω₀ at the start", number(float(omega[0]))), ("at the end", number(float(omega[-1]))))
    slow = (("amplitude at the start", number(float(peak[0]))), ("at the end", number(float(peak[-1]))))
    return (
        Card("Conserved action", per_cent(found.max_error), "largest error of ω₀(J; p(t))", by_action, "expansions"),
        Card(
            "Parameters of t = 0", per_cent(found.frozen_error), "largest error without the drift", without, "estimates"
        ),
        Card("Rate of the drift", per_cent(found.rate), "change of ω₀ in a radian, at most", slow, "series model"),
    )


def table(rows: Sequence[Mapping[str, float | None]]) -> str:
    """The samples as CSV."""
    return csv_text(list(rows[0]), [list(row.values()) for row in rows])
