"""What the parameters mean that the planes have in common: said once, and put into the docstring of each.

A docstring names such a parameter in braces on a line of its own; :func:`documented` puts its text there when the
module is loaded, so that ``help(wigner)`` shows every parameter by name.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from textwrap import indent
from typing import Final, TypeVar

F = TypeVar("F", bound=Callable[..., object])

SHARED: Final = {
    "signal": """\
x : array, shape (N,)
    The signal.  Real samples are made analytic, complex ones are taken as they are.""",
    "real_signal": """\
x : array of float, shape (N,)
    The real signal.""",
    "rate": """\
rate : float
    Samples per time unit.""",
    "lag_seconds": """\
lag_seconds : float
    Stretch of signal that a column sees, in time units: the lag tau runs over -lag_seconds .. lag_seconds.""",
    "lag_window": """\
lag_window : {"hann", "blackman", "gaussian", "hamming", "rectangular"}
    Window over the lags, 1 at tau = 0.""",
    "window_seconds": """\
window_seconds : float
    Full width of the window, in time units.""",
    "closed_window": """\
window_name : {"hann", "blackman"}
    The window, one that ends at zero.""",
    "n_fft": """\
n_fft : int, optional
    Rows of the plane, about twice the number of lags by default.""",
    "transform": """\
n_fft : int, optional
    Length of the transform, about twice the window by default.""",
    "start": """\
start : float
    Time of the first sample.""",
    "remove_mean": """\
remove_mean : bool
    Whether a real signal loses its mean first.""",
    "single": """\
single : bool
    Work in single precision: half the memory, an error near 3e-7 of the largest value.""",
    "memory": """\
memory : int
    Bytes that the plane, or the work towards it, may take.""",
    "progress": """\
progress : bool or callable, optional
    ``True`` shows a bar; a function is told the share done and the step.""",
}
_PLACE: Final = re.compile(r"^( *)\{(\w+)\}$", re.MULTILINE)


def documented(function: F) -> F:
    """Put the texts of the shared parameters into a function's docstring.

    Examples
    --------
    >>> @documented
    ... def silence(rate: float) -> None:
    ...     '''Nothing.
    ...
    ...     Parameters
    ...     ----------
    ...     {rate}
    ...     '''
    >>> print(silence.__doc__.splitlines()[4].strip())
    rate : float
    """
    if function.__doc__ is not None:  # python -OO has none
        function.__doc__ = _PLACE.sub(lambda found: indent(SHARED[found[2]], found[1]), function.__doc__)
    return function
