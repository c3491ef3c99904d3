"""The three ways to omega0(t) on three cards with the same rows: error, cost, how far it holds, what it needs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ridgeback.common.numbers import NONE, number, per_cent, rounded_down, threshold
from ridgeback.common.quantities import measured_time
from ridgeback.compare.benchmark.contenders import WAYS, Row, Way
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.benchmark.verdict import closest
from ridgeback.compare.noise.results import NoiseStudy, estimator_of
from ridgeback.compare.report.naming import SOURCES, at_most, estimator, short_name
from ridgeback.compare.report.results import Card
from ridgeback.compare.study.results import Range, Study
from ridgeback.compare.study.study import first_violation
from ridgeback.numeric.orbits.paper_model import series_frequency

HEADINGS: dict[Way, str] = {
    "expansions": "Perturbation expansion",
    "series model": "The paper’s series model",
    "estimates": "Estimate from samples",
}
NOISE_DB = 20.0
LANGUAGES = {"c": "in C", "python": "in Python", "numpy": "in NumPy"}


@dataclass(frozen=True)
class Known:
    """What the cards are made from."""

    benchmark: Benchmark
    study: Study | None
    ranges: Sequence[Range]
    noise: NoiseStudy | None
    target: float
    pendulum: bool
    natural_frequency: float


def cards(known: Known) -> tuple[Card, ...]:
    """One card for each way, in the order expansions, series model, estimates."""
    return (_expansions(known), _series(known), _estimates(known))


def best_of_way(found: Benchmark, way: Way) -> Row | None:
    """The contender of a way that has the least error, as the verdict takes it."""
    of_way = [row for row in found.contenders if WAYS[row.kind] == way and row.ranked]
    return closest(of_way, found.reference.floor)


def refusal(found: Benchmark, way: Way) -> str:
    """Why a way gave nothing."""
    said = [row.refused for row in found.contenders if WAYS[row.kind] == way and row.refused]
    return said[0] if said else "no contender of this way covers enough of the motion to be ranked"


def cost(row: Row) -> str:
    """What a value costs, or a track, and how that scatters from run to run."""
    value = row.time_ns_per_value
    if value is None:
        return "not timed"
    if WAYS[row.kind] == "estimates" or row.kind == "slow-flow":
        track = f"{measured_time(row.time_s_per_track, row.time_scatter)} a track, " if row.time_s_per_track else ""
        return f"{track}{measured_time(1e-9 * value, row.time_scatter)} a value"
    language = LANGUAGES.get(row.language or "", "")
    return f"{measured_time(1e-9 * value, row.time_scatter)} a value" + (f" {language}" if language else "")


def _refused(known: Known, way: Way) -> Card:
    return Card(HEADINGS[way], NONE, "no result", (("why", refusal(known.benchmark, way)),), way)


def _card(
    known: Known, way: Way, row: Row, rows: tuple[tuple[str, str], ...], heading: str = "", text: str = ""
) -> Card:
    """A card whose error is never less than what the reference leaves open, which is said where it is."""
    reference, error = known.benchmark.reference, float(row.relative_rms_error or 0.0)
    what = "defined" if reference.defined else "known"
    below = (("limit", f"ω₀(t) is {what} to {per_cent(reference.floor)}"),) if error < reference.floor else ()
    value = at_most(error, reference, "≤ ")
    return Card(heading or HEADINGS[way], value, text or short_name(row), (*rows, *below), way)


def _expansions(known: Known) -> Card:
    row = best_of_way(known.benchmark, "expansions")
    if row is None:
        return _refused(known, "expansions")
    rows = (("cost", cost(row)), ("holds", _range(known, row)), ("needs", _needs(row)))
    return _card(known, "expansions", row, rows)


def _range(known: Known, row: Row) -> str:
    """Up to where the order keeps the target, counted to the first violation."""
    reach = [r for r in known.ranges if r.order == row.order and r.target == known.target]
    if known.study is None or row.kind != "expansion" or not reach:
        return span(known.benchmark)
    return within(known.study, known.target, reach[0].up_to)


def within(study: Study, target: float, up_to: float | None) -> str:
    """A range of use in words."""
    letter = "A" if study.variable == "A" else "ε"
    if up_to is None:
        return f"{threshold(target)} at no {letter} studied"
    return (
        f"within {threshold(target)} up to {letter} = {number(rounded_down(up_to, 3))} {study.amplitude_unit}".strip()
    )


def span(found: Benchmark) -> str:
    """The stretch that errors are taken over."""
    low, high = found.support
    return f"along this motion, t = {number(low, 3)} to {number(high, 3)} {found.case.time_unit}".strip()


def _needs(row: Row) -> str:
    if row.kind == "slow-flow":
        return "the equation and a start"
    if row.amplitude_from == "energy":
        return "the equation and the trajectory’s energy"
    if row.amplitude_from == "fit":
        return "the equation and the turning points"
    if row.amplitude_from == "action":
        return "the equation and a start"
    return "the equation alone"


def _series(known: Known) -> Card:
    found = known.benchmark
    exact = next((r for r in found.contenders if r.kind == "closed-form" and r.ranked), None)
    if known.pendulum:
        row = best_of_way(found, "series model")
        if row is None:
            return _refused(known, "series model")
        best = (
            ""
            if exact is None
            else f"{at_most(exact.relative_rms_error, found.reference)}, all terms, A(t) from the energy"
        )
        floor = (("at best", best),) if best else ()
        holds = _series_reach(known, row)
        needs = f"the equation, and {SOURCES[row.amplitude_from]}" if row.amplitude_from else "the equation"
        rows = (("cost", cost(row)), ("holds", holds), ("needs", needs), *floor)
        return _card(known, "series model", row, rows, text=f"{row.order} terms")
    if exact is None:
        why = "no potential, so neither the paper’s series nor an amplitude from the energy"
        return Card("The paper’s model", NONE, "does not apply", (("why", why),), "series model")
    rows = (
        ("cost", cost(exact)),
        ("holds", "at every amplitude that oscillates"),
        ("needs", "the equation and the trajectory’s energy"),
    )
    return _card(known, "series model", exact, rows, "The paper’s model", "exact ω₀ at A(t) from the energy")


def _series_reach(known: Known, row: Row) -> str:
    """Up to which amplitude the truncated series keeps the target, over the amplitudes of the study."""
    if known.study is None or row.order is None:
        return span(known.benchmark)
    grid = known.study.amplitudes
    values = series_frequency(grid, k=known.natural_frequency, terms=row.order)
    return within(known.study, known.target, first_violation(grid, values / known.study.reference - 1, known.target))


def _estimates(known: Known) -> Card:
    found = known.benchmark
    row = best_of_way(found, "estimates")
    if row is None:
        return _refused(known, "estimates")
    rows = (
        ("cost", cost(row)),
        ("holds", in_noise(known.noise, row) or span(found)),
        ("needs", f"{found.time.size} samples, no equation"),
    )
    return _card(known, "estimates", row, rows)


def in_noise(noise: NoiseStudy | None, row: Row) -> str:
    """What becomes of an estimate in noise; empty where it was not studied."""
    if noise is None:
        return ""
    plain = row.method.removesuffix("-corrected")
    for cell in noise.cells:
        if estimator_of(cell.method) == plain and cell.snr_db == NOISE_DB and cell.rms is not None:
            raw = "" if not row.corrected_by else f"{estimator(plain)} "
            return f"{raw}{per_cent(cell.rms)} in noise at {number(NOISE_DB)} dB"
    return ""
