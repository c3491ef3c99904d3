"""An argument that would leave no trace in the result is refused, not passed over."""

from __future__ import annotations

from ridgeback.common.errors import InputError


def refuse_unused(what: str, **given: object) -> None:
    """Raise InputError for the first argument that was given though ``what`` has no use for it; None is not given.

    >>> refuse_unused("a formula that has been derived", method=None, amplitude="peak")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: a formula that has been derived has no use for amplitude; leave it out
    """
    for name, value in given.items():
        if value is not None:
            raise InputError(f"{what} has no use for {name}; leave it out")
