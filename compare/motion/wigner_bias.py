"""Why the full Wigner peak lies low: measured, repeated on the fundamental alone, and predicted from the curvature.

If harmonics were the cause, a signal without harmonics would show no bias; if curvature is, it shows the same bias,
and the leading formula phi''' <tau^4> / (24 <tau^2>) gives its size.
"""

from __future__ import annotations

import numpy as np

from ridgeback.compare.motion.error_norms import mean, relative_error
from ridgeback.compare.motion.estimate_curves import RECIPES, attempt
from ridgeback.compare.motion.motion import Motion
from ridgeback.compare.motion.reconstruction import KnownMotion
from ridgeback.compare.motion.results import BiasCause, Curve, WignerBias
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.orbits.paper_model import slope_of_samples

NAMED = 1e-3
"""Mean relative bias below which no cause is named."""
SAME = 0.25
"""Two biases are the same when they differ by at most this share of the measured one."""


def wigner_bias(motion: Motion, measured: Curve | None, known: KnownMotion) -> WignerBias:
    """Compare the measured bias of the full Wigner peak with that of the fundamental alone and the curvature formula.

    Parameters
    ----------
    motion
        The integrated motion, with the reference that biases are relative to.
    measured
        The Wigner peak of the motion's samples; None where it could not be taken.
    known
        The synthetic motion whose fundamental alone is analysed in the same way.
    """
    inside = motion.zone.interior(motion.time)
    peak = attempt(RECIPES[0], known.fundamental, motion.trajectory.rate).curve
    bias = None if measured is None else _mean_inside(motion, measured)
    alone = None if peak is None else _against(motion, peak, known.omega)
    return WignerBias(
        measured=bias,
        fundamental_only=alone,
        predicted=float(np.mean((predicted_bias(motion.time, known.omega) / known.omega)[inside])),
        cause=cause_of(bias, alone),
    )


def cause_of(measured: float | None, alone: float | None) -> BiasCause:
    """Curvature is the cause only when the fundamental alone shows the same bias.

    >>> cause_of(-0.0080, -0.0079), cause_of(-0.0080, -0.0010), cause_of(1e-5, 1e-5)
    (<BiasCause.CURVATURE: 'curvature'>, <BiasCause.OTHER: 'other'>, <BiasCause.UNNAMED: 'unnamed'>)
    """
    if measured is None or alone is None or abs(measured) < NAMED:
        return BiasCause.UNNAMED
    return BiasCause.CURVATURE if abs(alone - measured) <= SAME * abs(measured) else BiasCause.OTHER


def _mean_inside(motion: Motion, curve: Curve) -> float | None:
    error = relative_error(curve, motion.reference)
    return mean(error[motion.zone.interior(curve.time)])


def _against(motion: Motion, curve: Curve, omega: Array) -> float | None:
    expected = np.interp(curve.time, motion.time, omega)
    keep = curve.valid & motion.zone.interior(curve.time)
    return mean((curve.omega / expected - 1)[keep])


# Without a lag window tau runs over -2 m .. 2 m, m the distance from the nearer end, so <tau^4> / <tau^2> = 0.6 (2 m)^2
# and the bias is omega'' * 0.6 * 4 m^2 / 24 = omega'' m^2 / 10 (leading order in the curvature).
def predicted_bias(time: Array, omega: Array) -> Array:
    """Leading-order bias of the full Wigner peak of a chirp with frequency omega(t), rad per time unit.

    >>> t = np.linspace(0.0, 20.0, 201)
    >>> round(float(predicted_bias(t, 5.0 + 0.01 * t**2)[100]), 6)    # omega'' = 0.02, m = 10
    0.2
    """
    bend = slope_of_samples(time, slope_of_samples(time, omega))
    margin = np.minimum(time - time[0], time[-1] - time)
    return np.asarray(bend * margin**2 / 10)
