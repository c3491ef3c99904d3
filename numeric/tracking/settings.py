"""Which settings of an estimate each method makes use of: one that it does not is refused, not passed over."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from ridgeback.common.errors import InputError

OF_ONE_KERNEL = ("wigner", "pseudo-wigner", "smoothed-pseudo-wigner")
"""Methods whose lag kernel can be limited to a band or held in single precision."""
WITH_WINDOW = (
    "auto",
    "pseudo-wigner",
    "smoothed-pseudo-wigner",
    "polynomial-wigner",
    "spectrogram",
    "reassigned-spectrogram",
    "synchrosqueezed",
)
USED_BY: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "lag_window": WITH_WINDOW,
        "smoothing_seconds": ("smoothed-pseudo-wigner",),
        "harmonics": ("auto", "harmonic-least-squares", "polynomial-wigner"),
        "order": ("polynomial-wigner",),
        "scope": ("harmonic-least-squares",),
        "band_limited": OF_ONE_KERNEL,
        "single": OF_ONE_KERNEL,
    }
)
"""Methods by setting; band and window length are used by all but ``model-fit``, which has the band alone."""
OF_A_TRACK = ("lag_seconds", *USED_BY)


def unused(method: str, given: Sequence[str]) -> list[str]:
    """Those of the given settings that a method makes no use of.

    >>> unused("hilbert", ["band", "lag_seconds", "order"]), unused("model-fit", ["band", "lag_seconds"])
    (['order'], ['lag_seconds'])
    """
    if method == "model-fit":
        return [name for name in given if name in OF_A_TRACK]
    return [name for name in given if name in USED_BY and method not in USED_BY[name]]


def refuse_unused(method: str, given: Sequence[str]) -> None:
    """Raise InputError for a setting that a method makes no use of, with those that have one.

    >>> refuse_unused("hilbert", ["order"])
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: method 'hilbert' has no use for order, which polynomial-wigner has; leave it out
    """
    for name in unused(method, given):
        raise InputError(f"method {method!r} has no use for {name}{whose(name)}; leave it out")


def whose(name: str) -> str:
    """Who does make use of a setting, as part of a sentence; nothing where all but one do.

    >>> whose("order"), whose("lag_seconds")
    (', which polynomial-wigner has', '')
    """
    users = USED_BY.get(name, ())
    return f", which {', '.join(users)} {'has' if len(users) == 1 else 'have'}" if users else ""
