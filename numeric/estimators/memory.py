"""What memory an estimate takes, said before it is begun.

Measured as the peak of the process less what imports take, at 100,000 and 1,000,000 samples, 32 to the cycle
(``python -m benchmarks.speed.recordings --estimators``); meant to be right within a factor of three.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ridgeback.common.errors import InputError
from ridgeback.numeric.signal.samples import MEMORY_BUDGET

FIXED = 60_000_000
"""The blocks that any estimate works in."""
WITH_BIAS = 450
"""For each sample, with the models of the whole signal and their noisy copies that bias and interval rest on."""
USUAL = 300
"""For each sample, without bias and interval."""
BYTES: Mapping[str, int] = MappingProxyType({"polynomial-wigner": 700})
"""The same of the methods that take more, with bias or without."""


def predicted_bytes(method: str, size: int, *, bias: bool) -> int:
    """What an estimate of so many samples takes.

    >>> predicted_bytes("hilbert", 1_000_000, bias=True)
    510000000
    """
    return FIXED + size * max(BYTES.get(method, 0), WITH_BIAS if bias else USUAL)


def most_samples(method: str, *, bias: bool) -> int:
    """How many samples fit the budget.

    >>> most_samples("hilbert", bias=True)
    2088888
    """
    return (MEMORY_BUDGET - FIXED) // (predicted_bytes(method, 1, bias=bias) - FIXED)


def check_memory(method: str, size: int) -> None:
    """Refuse an estimate that would take more than the budget even without bias and interval.

    >>> check_memory("polynomial-wigner", 2_000_000)
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: polynomial-wigner of 2000000 samples would take about 1.5 GB, over 1 GB; ...
    """
    needed = predicted_bytes(method, size, bias=False)
    if needed > MEMORY_BUDGET:
        other = "" if method == "auto" else "method auto, which takes fewer samples where the rate allows, or "
        raise InputError(
            f"{method} of {size} samples would take about {needed / 1e9:.2g} GB, over {MEMORY_BUDGET / 1e9:g} GB; use "
            f"{other}at most {most_samples(method, bias=False)} samples"
        )


def without_room(method: str, size: int) -> str | None:
    """Why bias and interval of a record cannot be had within the budget; None where they can.

    >>> without_room("hilbert", 1_000_000) is None, without_room("hilbert", 3_000_000) is None
    (True, False)
    """
    needed = predicted_bytes(method, size, bias=True)
    if needed <= MEMORY_BUDGET:
        return None
    return (
        f"the bias of {size} samples would take about {needed / 1e9:.2g} GB, over {MEMORY_BUDGET / 1e9:g} GB; use "
        f"method auto, which takes fewer samples where the rate allows, or at most {most_samples(method, bias=True)}"
    )
