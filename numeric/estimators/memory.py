"""What memory an estimate takes, said before it is begun.

Measured at 100,000 and 300,000 samples, 33 to the cycle; meant to be right within a factor of three.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ridgeback.common.errors import InputError
from ridgeback.numeric.signal.samples import MEMORY_BUDGET

WITH_BIAS = 500
"""For each sample, of the models of the whole signal that bias and interval rest on, and by which ``auto`` chooses."""
BYTES: Mapping[str, int] = MappingProxyType(
    {
        "auto": WITH_BIAS,
        "pseudo-wigner": 900,
        "smoothed-pseudo-wigner": 900,
        "spectrogram": 870,
        "reassigned-spectrogram": 900,
        "synchrosqueezed": 900,
        "hilbert": 400,
        "zero-crossing": 430,
        "polynomial-wigner": 3600,
        "harmonic-least-squares": 500,
    }
)
"""For each sample, by method, without bias and interval."""


def check_memory(method: str, size: int) -> None:
    """Refuse an estimate that would take more than the budget.

    >>> check_memory("polynomial-wigner", 1_000_000)
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: polynomial-wigner of 1000000 samples would take about 3.6 GB, over 1 GB; ...
    """
    needed = BYTES.get(method, 0) * size
    if needed > MEMORY_BUDGET:
        other = (
            "pseudo-wigner or hilbert" if method == "auto" else "auto, which takes fewer samples where the rate allows"
        )
        raise InputError(
            f"{method} of {size} samples would take about {needed / 1e9:.2g} GB, over {MEMORY_BUDGET / 1e9:g} GB; use "
            f"method {other}, or at most {MEMORY_BUDGET // BYTES[method]} samples"
        )


def without_room(size: int) -> str | None:
    """Why bias and interval of a record cannot be had within the budget; None where they can.

    >>> without_room(300_000) is None, without_room(1_000_000) is None
    (True, False)
    """
    needed = WITH_BIAS * size
    if needed <= MEMORY_BUDGET:
        return None
    return (
        f"the bias of {size} samples would take about {needed / 1e9:.2g} GB, over {MEMORY_BUDGET / 1e9:g} GB; use "
        f"method auto, which takes fewer samples where the rate allows, or at most {MEMORY_BUDGET // WITH_BIAS}"
    )
