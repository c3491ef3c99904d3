"""The paper's case: a damped pendulum released close to its upper equilibrium.

L. Galleani and L. Cohen: k = 4 pi (2 Hz at small angles), mu = 0.01, theta(0) = 0.95 pi at rest, 0 <= t <= 20.
"""

from __future__ import annotations

import math

from ridgeback.compare.motion.motion import Setting, setting
from ridgeback.symbolic.systems.catalogue import find

PARAMETERS = {"k": "12.566370614359172", "mu": "0.01"}
"""k is 4 pi to the last digit of a double."""
INITIAL = (0.95 * math.pi, 0.0)
DURATION, RATE = 20.0, 64.0


def paper_case(*, duration: float = DURATION, rate: float = RATE) -> Setting:
    """The paper's damped pendulum, in seconds.

    Parameters
    ----------
    duration
        Time to integrate over, s.
    rate
        Samples per second.

    Examples
    --------
    >>> paper_case().initial[0] / math.pi, paper_case().is_pendulum
    (0.95, True)
    """
    oscillator = find("damped-pendulum").with_parameters(PARAMETERS)
    return setting(oscillator, initial=INITIAL, duration=duration, rate=rate, time_unit="s")


def is_paper_case(chosen: Setting) -> bool:
    """Whether a setting is the paper's own: its equation, parameters, start, duration and rate.

    >>> is_paper_case(paper_case()), is_paper_case(paper_case(duration=10.0))
    (True, False)
    """
    paper = paper_case()
    same = chosen.oscillator.equation == paper.oscillator.equation
    mine, theirs = (s.case().parameters for s in (chosen, paper))
    numbers = [(chosen.duration, paper.duration), (chosen.rate, paper.rate)]
    numbers += list(zip(chosen.initial, paper.initial, strict=True))
    return same and mine == theirs and all(math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-12) for a, b in numbers)
