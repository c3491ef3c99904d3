"""The one error that a caller can cause."""


class InputError(ValueError):
    """A value from outside is unusable; the message is one line: what, which value, what would work.

    >>> raise InputError("order -1 is negative; use 0 or more")
    Traceback (most recent call last):
        ...
    ridgeback.common.errors.InputError: order -1 is negative; use 0 or more
    """

    def __str__(self) -> str:
        """The message on one printable line, whatever names and values of a file stand in it."""
        return one_line(super().__str__())


def one_line(text: str) -> str:
    r"""The text on one line, with control characters escaped so that no value can disturb the terminal.

    >>> one_line("bad\n  value \x1b[31m")
    'bad value \\x1b[31m'
    """
    joined = " ".join(text.split())
    return "".join(c if c.isprintable() else c.encode("unicode_escape", "backslashreplace").decode() for c in joined)
