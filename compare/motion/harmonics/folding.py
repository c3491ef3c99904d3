"""Which multiples of the fundamental a sampling rate folds back, as in the paper's footnote 3."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ridgeback.numeric.arrays import Array


@dataclass(frozen=True)
class Folding:
    """Which multiples the sampling rate folds back, and which rates fold as the paper's footnote 3 has it."""

    folded: tuple[int, ...]
    """Multiples that pass half the rate at some time of the motion."""
    whole: tuple[int, ...]
    """Those that do not."""
    two_fold: tuple[float, float] | None
    """Rates, in samples per time unit, at which the two highest multiples are folded and no other; None below three."""
    highest: float
    """Highest frequency of the fundamental, cycles per time unit."""
    rate: float
    """Samples per time unit."""


# a multiple m is folded when m f_0(t) > rate / 2 at some time t
def folding(multiples: tuple[int, ...], highest: float, rate: float) -> Folding:
    """Which multiples are folded.

    Parameters
    ----------
    multiples : tuple of int
        Those of the motion, rising.
    highest : float
        Highest frequency of the fundamental, cycles per time unit.
    rate : float
        Samples per time unit.

    Examples
    --------
    >>> found = folding((3, 5, 7, 9, 11), 1.468, 25.6)
    >>> found.folded, [round(rate, 1) for rate in found.two_fold]
    ((9, 11), [20.6, 26.4])
    """
    beyond = tuple(m for m in multiples if 2.0 * m * highest > rate)
    whole = tuple(m for m in multiples if m not in beyond)
    two_fold = (2.0 * multiples[-3] * highest, 2.0 * multiples[-2] * highest) if len(multiples) > 2 else None
    return Folding(beyond, whole, two_fold, highest, rate)


# sampled at f_s, the frequency f is seen at |f - f_s round(f / f_s)|
def folded(omega: Array, rate: float) -> Array:
    """Where a frequency in rad per time unit is seen after sampling.

    >>> (folded(2.0 * np.pi * np.array([9.0, 13.2]), 25.6) / (2.0 * np.pi)).round(6).tolist()
    [9.0, 12.4]
    """
    sampled = 2.0 * np.pi * rate
    return np.asarray(np.abs(omega - sampled * np.round(omega / sampled)))


def folded_sentence(found: Folding, hertz: Callable[[float], str], time_unit: str = "") -> str:
    """Which multiples of the derivative this sampling folds, and which rates fold the two highest alone."""
    nyquist, top = hertz(np.pi * found.rate), max(found.whole, default=1)
    names = [numbers_text(m) for m in (found.folded, found.whole)]
    if not found.folded:
        said = f"Nothing that is seen is aliased: multiple {top} reaches "
        said += f"{hertz(2.0 * np.pi * top * found.highest)}, the Nyquist frequency is {nyquist}."
    else:
        rest = f", {names[1]} {'is' if len(found.whole) == 1 else 'are'} not" if found.whole else ""
        verb = f"multiple {names[0]} is" if len(found.folded) == 1 else f"multiples {names[0]} are"
        said = f"Beyond the Nyquist frequency of {nyquist}, {verb} folded back{rest}."
    if found.two_fold is None:
        return said
    low, high = (f"{end:.3g}" for end in found.two_fold)
    pair = numbers_text(tuple(sorted((*found.folded, *found.whole))[-2:]))
    return f"{said} Sampling rates between {low} and {high} per {time_unit or 'time unit'} fold {pair} alone."


def numbers_text(numbers: tuple[int, ...]) -> str:
    """Numbers in words.

    >>> numbers_text((9, 11)), numbers_text((3, 5, 7))
    ('9 and 11', '3, 5 and 7')
    """
    *first, last = map(str, numbers) if numbers else ("none",)
    return f"{', '.join(first)} and {last}" if first else last
