"""What was found along one motion, as ranked sentences made from typed results, each with the floor it stands on."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ridgeback.common.numbers import number, offset, per_cent, scientific
from ridgeback.common.quantities import amplitude, frequency, measured_time
from ridgeback.compare.benchmark.contenders import OrderCrossing, Reference, Row, Verdict
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.benchmark.verdict import closest
from ridgeback.compare.motion.harmonics.folding import folded_sentence
from ridgeback.compare.motion.results import BiasCause, MotionComparison
from ridgeback.compare.report.cards import best_of_way
from ridgeback.compare.report.naming import (
    REMOVED,
    at_most,
    capital,
    estimator,
    follow,
    plural,
    short_name,
    spoken,
)
from ridgeback.compare.study.derived import Derived

MOST = 5
FEW = 1e4
"""Ratios from here on are written as powers of ten."""
TOLD_TIMES = 1.5
"""A least ratio of errors from which on a title says it."""
SHARE = 2.0
"""A floor is spoken of when it is this many times the reference's own."""


@dataclass(frozen=True)
class Finding:
    """One sentence, and how much it matters: 0 stands first."""

    rank: int
    text: str


def title_of(verdict: Verdict, reference: Reference) -> str:
    """The verdict in one sentence: the best way, its error, and how far the next way is behind.

    Parameters
    ----------
    verdict
        Typed judgement of a benchmark.
    reference
        What errors are measured against; below its floor nothing is told apart.

    Examples
    --------
    >>> best, rival = (Row("x", "x", "expansion", order=n, relative_rms_error=e) for n, e in ((8, 1e-3), (2, 1e-2)))
    >>> title_of(Verdict("expansions", best, "estimates", rival, 10.0, True, ""), Reference("", 1e-9, 1e-6))
    'Order 8 follows ω₀(t) within 0.10 %, 10 times closer than order 2'
    >>> title_of(Verdict("expansions", best, "estimates", rival, 5.0, True, ""), Reference("", 1e-9, 2e-3))
    'Order 8 follows ω₀(t) as closely as it is defined (0.20 %), at least 2.6 times closer than order 2'
    """
    error, floor = per_cent(verdict.best.relative_rms_error), per_cent(reference.floor)
    followed = f"{capital(spoken(verdict.best))} {follow(verdict.best)} ω₀(t)"
    closely = f"as closely as it is {_how(reference)}"
    if verdict.rival is None or verdict.ratio is None:
        return f"{followed} within {error}"
    rival = spoken(verdict.rival)
    if not verdict.decided:
        both = f"{capital(spoken(verdict.best))} and {rival} both follow ω₀(t)"
        if max(verdict.errors) <= reference.floor:
            return f"{both} {closely}, to {floor}"
        open_ = "" if reference.told_apart(*verdict.errors) else f"; it is {_how(reference)} to {floor}"
        return f"{both} within {per_cent(max(verdict.errors))}{open_}"
    times = verdict.times(reference)
    if verdict.ratio < 1.0:
        return f"{followed} within {error}; {rival} is {times} times closer"
    if min(verdict.errors) >= reference.floor:
        return f"{followed} within {error}, {times} times closer than {rival}"
    if verdict.least_ratio(reference) < TOLD_TIMES:
        return f"{followed} {closely} ({floor}), {rival} within {per_cent(verdict.rival.relative_rms_error)}"
    return f"{followed} {closely} ({floor}), {times} times closer than {rival}"


def _how(reference: Reference) -> str:
    """What leaves omega0(t) open: that it has two readings, or its integration."""
    return "defined" if reference.defined else "known"


def lead_of(found: Benchmark, *, timed: bool) -> str:
    """The third way beside the verdict's two, and what the two kinds of way cost."""
    said = {found.verdict.way, found.verdict.rival_way}
    others = [best_of_way(found, way) for way in ("expansions", "series model", "estimates") if way not in said]
    rest = [row for row in others if row is not None]
    parts = [f"{capital(in_sentence(row))} {at_most(row.relative_rms_error, found.reference)} off." for row in rest]
    parts += [text] if timed and (text := _costs(found)) else []
    return " ".join(parts)


def in_sentence(row: Row) -> str:
    """A contender with its verb.

    >>> in_sentence(Row("series-21", "", "series-model", order=21)), in_sentence(Row("wigner", "", "estimate"))
    ('the paper’s series, cut after 21 terms, is', 'Wigner peak is')
    """
    if row.kind == "series-model":
        return f"the paper’s series, cut after {row.order} terms, is"
    return f"{short_name(row)} {'are' if plural(row) else 'is'}"


def _costs(found: Benchmark) -> str:
    formula, estimate = best_of_way(found, "expansions"), best_of_way(found, "estimates")
    if formula is None or estimate is None or not formula.time_ns_per_value or not estimate.time_ns_per_value:
        return ""
    ratio = estimate.time_ns_per_value / formula.time_ns_per_value
    known = " once A is known" if formula.amplitude_from is not None else ""
    cost = measured_time(1e-9 * formula.time_ns_per_value, formula.time_scatter)
    return (
        f"A value of {spoken(formula)} costs {cost}{known}, "
        f"some {_times(ratio)} times less than one of {spoken(estimate)}."
    )


def _times(ratio: float) -> str:
    """A ratio of measured times, to one digit.

    >>> _times(8.3e5), _times(1.2e5), _times(41.0)
    ('8 × 10⁵', '10⁵', '40')
    """
    return scientific(ratio, digits=1).removeprefix("1 × ") if ratio >= FEW else number(float(f"{ratio:.1g}"), 1)


def findings(found: Benchmark, decay: MotionComparison, derived: Derived | None, start: float) -> tuple[str, ...]:
    """At most five sentences, those that matter most first.

    Parameters
    ----------
    found
        Every contender on this motion.
    decay
        The same motion compared.
    derived
        What was derived; None where that was refused.
    start
        Peak amplitude at the start, in the unit of u.
    """
    said = [
        *_about_start(decay, derived, start),
        *_from_contenders(found),
        *_about_wigner(decay, found),
        *_about_sampling(decay),
    ]
    ranked = sorted(said, key=lambda finding: finding.rank)
    return tuple(finding.text for finding in ranked[:MOST])


def _about_start(decay: MotionComparison, derived: Derived | None, start: float) -> Iterator[Finding]:
    if derived is None or derived.expansion.variable != "A" or derived.limits.radius is None:
        return
    radius, unit = derived.limits.radius, decay.case.unit
    if start > radius:
        text = (
            f"The motion starts at A = {amplitude(start, unit)}, outside the radius of convergence "
            f"{number(radius)} of the series in A: there more orders make it worse."
        )
        yield Finding(0, text)


def _about_sampling(decay: MotionComparison) -> Iterator[Finding]:
    """The paper's footnote 3: which multiples this rate folds back."""
    if decay.folding.folded:
        yield Finding(
            1, folded_sentence(decay.folding, lambda w: frequency(w, decay.case.time_unit), decay.case.time_unit)
        )


def _from_contenders(found: Benchmark) -> Iterator[Finding]:
    reference = found.reference
    floor = per_cent(reference.floor)
    why = (
        f"Two readings of ω₀(t), by crossings and by turning points, differ by {floor} rms"
        if reference.defined
        else f"The integration leaves ω₀(t) open by {floor} rms"
    )
    yield Finding(4, f"{why}: errors are told apart where they differ by more than twice that.")
    yield from _ripple(found)
    yield from _passing(found)
    yield from _equal(found)


def _ripple(found: Benchmark) -> Iterator[Finding]:
    exact = next((row for row in found.contenders if row.ranked and row.kind == "closed-form"), None)
    averaged = next((row for row in found.contenders if row.ranked and row.method == "averaged-action"), None)
    if exact is None or averaged is None:
        return
    floor = found.reference.floor
    error, smooth = float(exact.relative_rms_error or 0.0), float(averaged.relative_rms_error or 0.0)
    if error > SHARE * max(smooth, floor):
        text = (
            f"With A(t) from the energy of each instant even the exact backbone stops at {per_cent(error)}: that "
            f"amplitude ripples twice a cycle. The averaged action leaves {at_most(smooth, found.reference)}"
            f"{_less_damping(found, smooth)}."
        )
        yield Finding(2, text)


def _less_damping(found: Benchmark, smooth: float) -> str:
    """What sqrt(omega0^2 - mu^2) of the averaged action leaves, where that is told from omega0 itself."""
    row = next((row for row in found.contenders if row.ranked and row.method == "averaged-damped"), None)
    error = None if row is None else row.relative_rms_error
    if error is None or max(error, found.reference.floor) >= smooth:
        return ""
    return f", and √(ω₀² − μ²), as linear damping has it, {at_most(error, found.reference)}"


def _passing(found: Benchmark) -> Iterator[Finding]:
    """The crossing with the best raw estimate that an expansion passes, told only when it is settled."""
    settled = [c for c in found.crossings.orders if c.settled and c.amplitude_from != "energy"]
    passed = [c for c in settled if c.after is not None and c.before is not None]
    ahead = [c for c in settled if c.after is None]
    if passed:
        yield Finding(1, _crossing(min(passed, key=lambda c: c.estimate_error), found.reference))
    elif ahead:
        yield Finding(1, _crossing(min(ahead, key=lambda c: c.estimate_error), found.reference))


def _crossing(c: OrderCrossing, reference: Reference) -> str:
    name, error = estimator(c.estimate), at_most(c.estimate_error, reference)
    if c.after is None:
        return f"The expansion stays behind {name} ({error}) to order {c.before}."
    return f"The expansion passes {name} ({error}) between orders {c.before} and {c.after}."


def _equal(found: Benchmark) -> Iterator[Finding]:
    pairs = [e for e in found.crossings.equal_coefficients if e.amplitude_from != "energy"]
    told = [e for e in pairs if found.reference.told_apart(e.series_error, e.expansion_error)]
    if told:
        e = max(told, key=lambda pair: pair.coefficients)
        text = (
            f"With {e.coefficients} coefficients each, the paper’s series errs "
            f"{at_most(e.series_error, found.reference)} and the expansion (order {e.order}) "
            f"{at_most(e.expansion_error, found.reference)}."
        )
        yield Finding(2, text)


def _about_wigner(decay: MotionComparison, found: Benchmark) -> Iterator[Finding]:
    bias = decay.wigner_bias
    if bias is None or bias.measured is None or bias.cause is BiasCause.UNNAMED:
        return
    size = offset(bias.measured)
    if bias.cause is BiasCause.CURVATURE:
        why = f"curvature of ω₀(t): a signal without harmonics shows {offset(bias.fundamental_only)}"
    else:
        why = f"not curvature alone: a signal without harmonics shows {offset(bias.fundamental_only)}"
    cured = _cured(found)
    yield Finding(3, f"The full-length Wigner peak lies {size} on average; the cause is {why}.{cured}")


def _cured(found: Benchmark) -> str:
    rows = [row for row in found.contenders if row.corrected_by and row.ranked and "wigner" in row.method]
    row = closest(rows, found.reference.floor)
    raw = None if row is None else {r.method: r for r in found.contenders}.get(row.method.removesuffix("-corrected"))
    if row is None or raw is None or not raw.relative_rms_error or not row.relative_rms_error:
        return ""
    if row.relative_rms_error > raw.relative_rms_error:
        return ""
    name = estimator(raw.method)
    return (
        f" {capital(name)} errs {at_most(raw.relative_rms_error, found.reference)}, and "
        f"{at_most(row.relative_rms_error, found.reference)} with its {REMOVED}."
    )
