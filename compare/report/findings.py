"""What was found along one motion, as ranked sentences made from typed results, each with the floor it stands on."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ridgeback.common.numbers import number, offset, per_cent, two_digits
from ridgeback.common.quantities import amplitude, duration, frequency
from ridgeback.compare.benchmark.contenders import OrderCrossing, Reference, Row, Verdict
from ridgeback.compare.benchmark.results import Benchmark
from ridgeback.compare.benchmark.verdict import closest
from ridgeback.compare.motion.harmonics.folding import folded_sentence
from ridgeback.compare.motion.results import BiasCause, MotionComparison
from ridgeback.compare.report.cards import best_of_way
from ridgeback.compare.report.naming import REMOVED, capital, estimator, follow, plural, refused_names, short_name
from ridgeback.compare.study.derived import Derived

MOST = 5
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
    """
    named = short_name(verdict.best)
    error = per_cent(verdict.best.relative_rms_error)
    followed = f"{capital(named)} {follow(verdict.best)} ω₀(t)"
    if verdict.rival is None or verdict.ratio is None:
        return f"{followed} within {error}"
    rival = short_name(verdict.rival)
    least = min(float(row.relative_rms_error or 0.0) for row in (verdict.best, verdict.rival) if row is not None)
    if verdict.decided and verdict.ratio < 1.0:
        times = f"{'' if least > reference.floor else 'at least '}{two_digits(1.0 / verdict.ratio)} times"
        return f"{followed} within {error}; {rival} is {times} closer"
    if verdict.decided and float(verdict.best.relative_rms_error or 0.0) <= reference.floor:
        within = f"as closely as it is defined ({per_cent(reference.floor)})"
        return f"{followed} {within}, at least {two_digits(verdict.ratio)} times closer than {rival}"
    if verdict.decided:
        return f"{followed} within {error}, {two_digits(verdict.ratio)} times closer than {rival}"
    both = f"{capital(named)} and {rival} both follow ω₀(t)"
    if least > reference.floor:
        return f"{both} within {per_cent(verdict.rival.relative_rms_error)}"
    return f"{both} as closely as it is defined, to {per_cent(reference.floor)}"


def lead_of(found: Benchmark, *, timed: bool) -> str:
    """The third way beside the verdict's two, and what the two kinds of way cost."""
    said = {found.verdict.way, found.verdict.rival_way}
    others = [best_of_way(found, way) for way in ("expansions", "series model", "estimates") if way not in said]
    rest = [row for row in others if row is not None]
    parts = [f"{capital(in_sentence(row))} {per_cent(row.relative_rms_error)} off." for row in rest]
    parts += [text] if timed and (text := _costs(found)) else []
    return " ".join(parts)


def in_sentence(row: Row) -> str:
    """A contender with its verb.

    >>> in_sentence(Row("series-21", "", "series-model", order=21)), in_sentence(Row("wigner", "", "estimate"))
    ('the paper’s series (14), cut after 21 terms, is', 'Wigner peak is')
    """
    if row.kind == "series-model":
        return f"the paper’s series (14), cut after {row.order} terms, is"
    return f"{short_name(row)} {'are' if plural(row) else 'is'}"


def _costs(found: Benchmark) -> str:
    formula, estimate = best_of_way(found, "expansions"), best_of_way(found, "estimates")
    if formula is None or estimate is None or not formula.time_ns_per_value or not estimate.time_ns_per_value:
        return ""
    ratio = estimate.time_ns_per_value / formula.time_ns_per_value
    known = " once A is known" if formula.amplitude_from is not None else ""
    return (
        f"A value of {short_name(formula)} costs {duration(1e-9 * formula.time_ns_per_value)}{known}, "
        f"{number(float(f'{ratio:.1g}'), 1)} times less than one of {short_name(estimate)}."
    )


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
    yield Finding(
        4,
        f"Two readings of ω₀(t), by crossings and by turning points, differ by {per_cent(reference.definition)} rms: "
        "errors below that are not told apart.",
    )
    yield from _ripple(found)
    yield from _passing(found)
    yield from _equal(found)
    refused = [row for row in found.contenders if row.refused]
    if refused:
        yield Finding(3, f"No result from {refused_names(refused)}; the table says why.")


def _ripple(found: Benchmark) -> Iterator[Finding]:
    rows = {row.kind: row for row in found.contenders if row.ranked}
    exact, averaged = rows.get("closed-form"), rows.get("averaged")
    if exact is None or averaged is None:
        return
    floor = found.reference.floor
    error, smooth = float(exact.relative_rms_error or 0.0), float(averaged.relative_rms_error or 0.0)
    if error > SHARE * max(smooth, floor):
        text = (
            f"With A(t) from the energy of each instant even the exact backbone stops at {per_cent(error)}: that "
            f"amplitude ripples twice a cycle. The averaged action leaves {per_cent(smooth)}."
        )
        yield Finding(2, text)


def _passing(found: Benchmark) -> Iterator[Finding]:
    """The crossing with the best raw estimate that an expansion passes, told only when it is settled."""
    settled = [c for c in found.crossings.orders if c.settled and c.amplitude_from != "energy"]
    passed = [c for c in settled if c.after is not None and c.before is not None]
    ahead = [c for c in settled if c.after is None]
    if passed:
        yield Finding(1, _crossing(min(passed, key=lambda c: c.estimate_error)))
    elif ahead:
        yield Finding(1, _crossing(min(ahead, key=lambda c: c.estimate_error)))


def _crossing(c: OrderCrossing) -> str:
    name, error = estimator(c.estimate), per_cent(c.estimate_error)
    if c.after is None:
        return f"The expansion stays behind {name} ({error}) to order {c.before}."
    return f"The expansion passes {name} ({error}) between orders {c.before} and {c.after}."


def _equal(found: Benchmark) -> Iterator[Finding]:
    pairs = [e for e in found.crossings.equal_coefficients if e.amplitude_from != "energy"]
    told = [e for e in pairs if abs(e.series_error - e.expansion_error) > found.reference.floor]
    if told:
        e = max(told, key=lambda pair: pair.coefficients)
        text = (
            f"With {e.coefficients} coefficients each, the paper’s series (14) errs {per_cent(e.series_error)} and the "
            f"expansion (order {e.order}) {per_cent(e.expansion_error)}."
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
        f" {capital(name)} errs {per_cent(raw.relative_rms_error)}, and {per_cent(row.relative_rms_error)} with its "
        f"{REMOVED}."
    )
