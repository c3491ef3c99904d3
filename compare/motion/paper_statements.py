"""The paper's nine figures: what it says of each, and what was measured here, with numbers.

The statements are about the method, so they are made for every oscillator with a potential; what the paper says is
a paraphrase, what was measured is computed from the comparison at hand and from nothing else.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ridgeback.common.numbers import decibels, offset, per_cent, scientific, signed
from ridgeback.common.quantities import frequency, short_amplitude
from ridgeback.compare.motion.error_norms import relative_error
from ridgeback.compare.motion.estimate_curves import SMOOTHED, WIGNER, WIGNER_OF_VELOCITY
from ridgeback.compare.motion.harmonics.folding import folded_sentence
from ridgeback.compare.motion.harmonics.order_analysis import Orders, Ripple, ripple
from ridgeback.compare.motion.harmonics.overtones import (
    Overtone,
    Overtones,
    even_sentence,
    folding_of,
    ratio_error,
    seen,
    slope,
)
from ridgeback.compare.motion.model_curves import CLOSED_FORM, LOW_ORDERS, expansion_name
from ridgeback.compare.motion.motion import Motion
from ridgeback.compare.motion.reconstruction import model_phase, relative_rms
from ridgeback.compare.motion.results import BiasCause, Curve, Reconstruction, Score, Statement, WignerBias
from ridgeback.numeric.arrays import Array, Mask
from ridgeback.numeric.orbits.energy import amplitude_from_energy, energy_of

LEAST_CHANGE = 0.01
"""Relative change of the frequency over the interior below which slopes are not compared."""


@dataclass(frozen=True)
class Evidence:
    """What the statements draw on."""

    motion: Motion
    curves: Mapping[str, Curve]
    scores: Mapping[str, Score]
    reconstruction: Reconstruction
    overtones: Overtones
    bias: WignerBias | None
    """The three readings of the Wigner bias, where there is a motion with known frequency."""

    def named(self, *names: str) -> tuple[Curve, ...]:
        """The curves of these names that there are."""
        return tuple(self.curves[name] for name in names if name in self.curves)

    @cached_property
    def energy_ripple(self) -> Ripple:
        """Ripple of A(t) by the energy about the averaged one, relative."""
        return ripple(lambda t: np.interp(t, self.motion.time, self.energy_excess), self.motion.rising)

    @cached_property
    def energy_excess(self) -> Array:
        """A(t) of (21) over that of the averaged action, less 1."""
        assert self.motion.averaged is not None  # noqa: S101 - the paper's motion has a potential
        return self.motion.energy_peak / self.motion.averaged.peak - 1

    def rms(self, name: str) -> str:
        """Interior rms of a curve in words."""
        score = self.scores.get(name)
        return per_cent(score.rms_interior if score else None, missing="no value")

    def size(self, value: float) -> str:
        """Amplitude in units of pi for an angle."""
        return short_amplitude(value, self.motion.setting.oscillator.unit)

    def hertz(self, omega: float) -> str:
        """Frequency in the case's own unit."""
        return frequency(omega, self.motion.setting.time_unit)

    def clock(self, value: float) -> str:
        """A time with its unit."""
        return f"{value:g} {self.motion.setting.time_unit}".strip()


def statements(evidence: Evidence) -> tuple[Statement, ...]:
    """One statement per figure of the paper that this motion has; limit cycles lack those about the energy."""
    return tuple(_statements(evidence))


def _statements(evidence: Evidence) -> Iterator[Statement]:
    yield _oscillation(evidence)
    yield _spectrogram(evidence)
    yield _derivative(evidence)
    if evidence.motion.has_backbone:
        yield _amplitude(evidence)
    yield _frequency(evidence)
    yield _signal(evidence)
    yield _wigner(evidence)
    yield _smoothed(evidence)
    if evidence.overtones.multiples:
        yield _harmonics(evidence)


def _oscillation(e: Evidence) -> Statement:
    run = e.motion.trajectory
    return Statement(
        figure=1,
        title="The integrated oscillation",
        paper="After 20 s the oscillation is still far from the linear region, with a final amplitude of about 2/3 π.",
        measured=(
            f"From {e.size(float(run.u[0]))} the amplitude changes to A = {e.size(float(e.motion.energy_peak[-1]))} at "
            f"t = {e.clock(float(run.time[-1]))}, over {e.motion.rising.size - 1} whole cycles. "
            f"Two integrators differ by at most {scientific(e.motion.disagreement)}{_unit(e)}."
        ),
    )


SLOPE_OFF = 0.02
"""Relative distance of a slope's ratio from the order that still counts as eq. (25)."""


def _spectrogram(e: Evidence) -> Statement:
    levels = e.overtones.of_u
    listed = ", ".join(f"{m} at {decibels(levels.level_db(m))}" for m in seen(e.motion, levels)) or "none seen"
    return Statement(
        figure=2,
        title="Time-frequency plane of the oscillation",
        paper="A fundamental of high energy and five weaker components whose slope increases with their order.",
        measured=(
            f"The fundamental holds {100 * levels.share[1]:.2f} % of the energy{_offset(levels)}; overtones re the "
            f"fundamental: {listed}. {even_sentence(e.motion, levels)}{_slopes(e)}"
        ),
    )


def _offset(levels: Orders) -> str:
    """Name the mean offset of an asymmetric well where it holds a visible share."""
    return f", the mean offset {100 * levels.share[0]:.2f} %" if levels.share[0] > 1e-4 else ""


def _slopes(e: Evidence) -> str:
    low, high = e.motion.zone.lower, e.motion.zone.upper
    base = slope(e.motion.reference_curve, low, high)
    if base is None or abs(base) * (high - low) < LEAST_CHANGE * float(e.motion.known_omega.mean()):
        return ""
    found = {
        one.multiple: own / base for one in e.overtones.tracked if (own := slope(one.track, low, high)) is not None
    }
    if not found:
        return ""
    parts = [f"harmonic {m} rises {ratio:.3f} times as fast as the fundamental" for m, ratio in found.items()]
    off = max(abs(ratio / m - 1.0) for m, ratio in found.items())
    verdict = (
        "as the paper’s eq. (25) has it" if off < SLOPE_OFF else "not the order, as the paper’s eq. (25) would have it"
    )
    return f" In the interior {', '.join(parts)}: within {per_cent(off)} of the order, {verdict}."


def _derivative(e: Evidence) -> Statement:
    u, v = e.overtones.of_u, e.overtones.of_velocity
    multiples = e.overtones.multiples
    gains = [f"{m} by {v.level_db(m) - u.level_db(m):.1f} dB (20 log {m} = {20 * np.log10(m):.1f})" for m in multiples]
    raised = f"Differentiation raises harmonic {', '.join(gains)}. " if gains else ""
    return Statement(
        figure=3,
        title="Time-frequency plane of the derivative",
        paper="The higher harmonics stand out more, by the factor ω² in the power spectrum; two are aliased.",
        measured=(f"{raised}{folded_sentence(folding_of(e.motion, v), e.hertz, e.motion.setting.time_unit)}"),
    )


def _amplitude(e: Evidence) -> Statement:
    away = _away_from_turnings(e.motion)
    early, late = _windowed(e, 0.0, 0.05), _windowed(e, 0.8, 1.0)
    span = e.motion.time[-1] - e.motion.time[0]
    wave = e.energy_ripple
    moving = (
        f"Between them it ripples {wave.per_cycle:.2f} times per cycle about the averaged amplitude; the frequency "
        f"made from it ripples by {per_cent(early)} rms before t = {e.clock(0.05 * span)} and {per_cent(late)} after "
        f"{e.clock(0.8 * span)}."
        if e.motion.dynamics.damping
        else "Without damping it is constant."
    )
    return Statement(
        figure=4,
        title="Amplitude from the energy, eq. (21)",
        paper="The amplitude from the energy represents the instantaneous envelope of the oscillation excellently.",
        measured=f"It passes through the positive turning points within {per_cent(away)}. {moving}",
    )


def _away_from_turnings(motion: Motion) -> float:
    """Largest relative distance of (21) from the positive turning points, both on the dense output."""
    turnings = motion.trajectory.turnings
    up = turnings.value > 0
    u, velocity = motion.trajectory.at(turnings.time[up])
    peak = amplitude_from_energy(motion.dynamics, energy_of(motion.dynamics, u, velocity)).peak
    return float(np.max(np.abs(peak / turnings.value[up] - 1)))


def _windowed(e: Evidence, first: float, last: float) -> float:
    """Rms of omega0 at the energy's amplitude over the averaged one, between two fractions of the span."""
    motion = e.motion
    span = motion.time[-1] - motion.time[0]
    keep = (motion.time >= motion.time[0] + first * span) & (motion.time <= motion.time[0] + last * span)
    error = motion.exact_at_energy[keep] / motion.known_omega[keep] - 1
    return float(np.sqrt(np.mean(error**2)))


def _frequency(e: Evidence) -> Statement:
    shown = e.named(CLOSED_FORM, *(expansion_name(order) for order in LOW_ORDERS))
    parts = [_zones(e, curve.name) for curve in shown]
    reference = e.motion.reference(e.motion.time)
    ends = reference[np.isfinite(reference)]
    crossing = _accidental(e)
    return Statement(
        figure=5,
        title="Fundamental frequency: estimated, predicted, and by a low-order expansion",
        paper="The prediction of the series, eq. (14), follows the estimate better than the expansion does, and "
        "improves with time.",
        measured=(
            f"The cycle frequency runs from {e.hertz(float(ends[0]))} to {e.hertz(float(ends[-1]))}. Relative rms "
            f"error in the first tenth, the interior and the last tenth: {'; '.join(parts)}.{crossing}"
        ),
        curves=shown,
    )


def _unit(e: Evidence) -> str:
    unit = e.motion.setting.oscillator.unit
    return f" {unit}" if unit else ""


def _zones(e: Evidence, name: str) -> str:
    score = e.scores[name]
    zones = (score.rms_start, score.rms_interior, score.rms_end)
    return f"{score.label}: {', '.join(per_cent(x, missing='no value') for x in zones)}"


def _accidental(e: Evidence) -> str:
    """Say where a lower order beats a higher one: an error that crosses zero, not a better expansion."""
    names = [expansion_name(order) for order in LOW_ORDERS]
    low, high = (e.scores.get(name) for name in names)
    if low is None or high is None or low.rms_interior is None or high.rms_interior is None:
        return ""
    error = relative_error(e.curves[names[0]], e.motion.reference)[e.motion.zone.interior(e.motion.time)]
    crosses = np.nanmin(error) < 0 < np.nanmax(error)
    if low.rms_interior >= high.rms_interior or not crosses:
        return ""
    return " Order 2 looks better than order 4 only because its error changes sign within the interior."


def _signal(e: Evidence) -> Statement:
    made = e.reconstruction
    low, high = e.motion.zone.lower, e.motion.zone.upper
    early, late = (per_cent(_part(made, keep)) for keep in (made.time < low, made.time > high))
    several = (
        f" With {made.components} components, as in eq. (7), the difference is {per_cent(made.rms_multicomponent)}."
        if made.rms_multicomponent is not None
        else ""
    )
    return Statement(
        figure=6,
        title="The oscillation and its one-component model, eq. (22)",
        paper="The agreement is very good, which shows how much of the motion is in the fundamental.",
        measured=(
            f"The model’s real part differs by {per_cent(made.rms_single)} rms of the signal: {early} in the first "
            f"tenth, {late} in the last.{_drift(e)}{several}"
        ),
    )


def _part(made: Reconstruction, keep: Mask) -> float:
    return relative_rms((made.single - made.signal)[keep], made.signal[keep])


def _drift(e: Evidence) -> str:
    """Phase of (23) gained or lost against the crossings over the whole record."""
    if not e.motion.has_backbone:
        return ""
    phase = model_phase(e.motion, e.motion.exact_at_energy)
    at = np.interp(e.motion.rising, e.motion.time, phase)
    drift = float(at[-1] - at[0] - 2 * np.pi * (e.motion.rising.size - 1))
    return f" Its phase, the integral of ω₀(t), drifts by {signed(drift)} rad over {e.motion.rising.size - 1} cycles."


def _wigner(e: Evidence) -> Statement:
    u, v = (e.curves.get(name) for name in (WIGNER, WIGNER_OF_VELOCITY))
    if u is None or v is None:
        measured = "The Wigner peak could not be taken; the table gives the reason."
    else:
        keep = u.valid & v.valid & e.motion.zone.interior(u.time)
        apart = float(np.sqrt(np.mean((u.omega[keep] / v.omega[keep] - 1) ** 2)))
        measured = f"The two estimates differ by {per_cent(apart)} rms in the interior. {_cause(e)}"
    return Statement(
        figure=7,
        title="Frequency from the Wigner peak of the signal and of its derivative",
        paper="Either signal can be used with success.",
        measured=measured,
        curves=e.named(WIGNER, WIGNER_OF_VELOCITY),
    )


_CAUSES = {
    BiasCause.UNNAMED: "",
    BiasCause.CURVATURE: ": the cause is curvature, not harmonics",
    BiasCause.OTHER: ": the difference is the part of the harmonics and of the decaying amplitude",
}


def _cause(e: Evidence) -> str:
    """The three readings of the bias, and its cause where one is named."""
    bias = e.bias
    if bias is None:
        return f"Against the cycle frequency the error is {e.rms(WIGNER)} rms."
    measured, alone, predicted = (offset(x) for x in (bias.measured, bias.fundamental_only, bias.predicted))
    text = (
        f"On average the peak of the signal lies {measured}. A signal of the fundamental alone gives {alone}, and "
        f"the curvature of ω₀(t) predicts {predicted} to leading order"
    )
    return f"{text}{_CAUSES[bias.cause]}."


def _smoothed(e: Evidence) -> Statement:
    score, full = e.scores.get(SMOOTHED), e.scores.get(WIGNER)
    if score is None or score.rms_interior is None:
        measured = "The smoothed pseudo-Wigner peak could not be taken; the table gives the reason."
    else:
        against = f" Over the full length, {_zones(e, WIGNER)}." if full and full.rms_interior is not None else ""
        measured = (
            f"Rms error in the first tenth, the interior and the last tenth: {_zones(e, SMOOTHED)}. "
            f"It is only valid half a window inside the record.{against}"
        )
    return Statement(
        figure=8,
        title="Frequency from the smoothed pseudo-Wigner peak",
        paper="Quite the same as from the Wigner distribution, with some bias especially near the borders.",
        measured=measured,
        curves=e.named(WIGNER, SMOOTHED),
    )


def _harmonics(e: Evidence) -> Statement:
    first = e.overtones.multiples[0]
    said = "; ".join(_harmonic_error(e, one) for one in e.overtones.tracked)
    raw = e.overtones.raw
    wrong = ""
    if raw is not None:
        error = ratio_error(raw, first, e.motion, e.motion.zone.lower, e.motion.zone.upper)
        wrong = (
            f" The raw Wigner peak near it is {per_cent(float(np.sqrt(np.mean(error**2))))} off: {raw.note}, "
            "so it must not be read as the harmonic."
        )
    slip = ""
    if first == 3 and e.motion.setting.is_pendulum:
        level = e.overtones.of_u.level_db(2)
        slip = f" The text’s factor 2 is a slip: multiple 2 is at {decibels(level)}, multiple 3 is meant."
    return Statement(
        figure=9,
        title="A higher harmonic against its multiple of the fundamental",
        paper="The harmonic agrees with 3 times the fundamental to a good approximation, which improves with time.",
        measured=f"Phase-locked, {said}.{wrong}{slip}" if said else f"Not tracked: {e.overtones.failed}.{slip}",
        curves=tuple(c for one in e.overtones.tracked[:1] for c in (one.track, one.predicted))
        + (() if raw is None else (raw,)),
    )


def _harmonic_error(e: Evidence, one: Overtone) -> str:
    curve, multiple = one.track, one.multiple
    low, high = e.motion.zone.lower, e.motion.zone.upper
    quarter = 0.25 * (high - low)
    spans = ((low, high), (low, low + quarter), (high - quarter, high))
    errors = [ratio_error(curve, multiple, e.motion, *span) for span in spans]
    whole, early, late = (per_cent(float(np.sqrt(np.mean(x**2)))) if x.size else "no value" for x in errors)
    return f"harmonic {multiple} is {multiple} ω₀ within {whole} rms ({early} early, {late} late in the interior)"
