"""Whether a frequency wanders at random: models on more and more knots go on changing the phase, and do not converge.

Where phi is smooth, splines on knots h apart come to it as h^6: after the first few numbers of knots the next changes
it by no more than noise does.  A phase that is a random walk, or the integral of one, is changed by every number that
is tried (its spectrum falls with a power of the frequency), by more than the errors of the one on more knots, whose
Fisher information is far too small an error then.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from ridgeback.numeric.arrays import Mask
from ridgeback.numeric.harmonics.signal_model import SignalModels

STEPS, LAST, SLOPE = 6, 4, -2.0
"""Steps from one number of knots to the next that change the phase clearly, from which on it may wander; and the power
of the number of coefficients with which the last of these changes fall at least where it does not."""
EXACT = 2e-3
"""Noise over amplitude below which knots follow what is there: what a model of the whole still misses is in view."""
CLEARLY = 3.0
"""Deviations of what noise explains."""


# In noise of variance s^2 two nested models of K and K' coefficients for phi have sum a^2 (phi' - phi)^2 / (2 s^2)
# distributed as chi^2 with K' - K degrees of freedom.
def wandering(models: SignalModels, sound: Mask) -> str:
    """Why models cannot be trusted between which the phase goes on changing; empty where it does not.

    Parameters
    ----------
    models : SignalModels
        Of the oscillation.
    sound : array of bool, shape (N,)
        Samples that count.

    Examples
    --------
    >>> from ridgeback.numeric.harmonics.signal_model import signal_models
    >>> t, rng = np.arange(900) / 12.0, np.random.default_rng(1)
    >>> for steps in (0.0, 0.04):
    ...     x = np.cos(6.0 * t + np.cumsum(steps * rng.normal(size=900))) + 0.02 * rng.normal(size=900)
    ...     print(wandering(signal_models(x, 12.0, np.full(900, 6.0), half=24, multiples=()), np.ones(900, bool))[:32])
    <BLANKLINE>
    the frequency wanders at random,
    """
    if models.best.noise < EXACT * float(models.best.size.max()):
        return ""
    noise, at, changes, last = models.best.band_noise, [], [], 0.0
    tried = [model for model in models.others if model.basis.count <= models.fine.basis.count]
    for model, more in pairwise(tried):  # beyond the finer one they follow the noise
        freedom = more.basis.count - model.basis.count
        turned = sound * more.size * (more.phase - model.phase)
        beyond = float(turned @ turned) / (2.0 * max(noise, np.finfo(float).tiny) ** 2) - freedom
        if beyond > CLEARLY**2 + CLEARLY * math.sqrt(2.0 * freedom):
            step = math.log(more.basis.count / model.basis.count)
            at.append(math.log(model.basis.count) + 0.5 * step)
            changes.append(0.5 * math.log(beyond / step))
            last = math.sqrt(2.0 * beyond / sound.sum()) * noise / float(np.sqrt(np.mean((sound * more.size) ** 2)))
    if len(at) < STEPS or np.polyfit(at[-LAST:], changes[-LAST:], 1)[0] < SLOPE:
        return ""
    return (
        "the frequency wanders at random, jumps, or is that of several components: models on more and more knots do "
        f"not converge, of which {len(at)} in turn change the phase, the last still by {last:.2g} rad; give a "
        "--band or a --span in which it goes on smoothly"
    )
