"""The one error that a caller can cause."""


class InputError(ValueError):
    """A value from outside is unusable; the message is one line: what, which value, what would work.

    >>> raise InputError("order -1 is negative; use 0 or more")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: order -1 is negative; use 0 or more
    """
