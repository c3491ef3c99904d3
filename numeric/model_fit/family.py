"""A family of oscillators u'' + f(u, u'; p) = 0 with free parameters p, as the fit of a model needs it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, frozen
from ridgeback.numeric.motion.dynamics import Dynamics

Scalars = Sequence[float]


@dataclass(frozen=True)
class Family:
    """An oscillator with free parameters.

    Parameters
    ----------
    name : str
        For messages.
    names : tuple of str
        The free parameters; everything else has its number.
    start : array of float, shape (P,)
        Their values to begin with.
    force : callable
        ``force(u, v, p)`` is f on floats.
    forces : callable
        The same over arrays of u and v.
    partials : callable
        ``partials(u, v, p)`` gives f_u, f_v and then the derivative of f by each parameter.
    dynamics : callable
        ``dynamics(p)`` binds the parameters.

    Raises
    ------
    InputError
        Where the starting values do not go with the names, or are not finite.
    """

    name: str
    names: tuple[str, ...]
    start: Array
    force: Callable[[float, float, Scalars], float]
    forces: Callable[[Array, Array, Scalars], Array]
    partials: Callable[[float, float, Scalars], Sequence[float]]
    dynamics: Callable[[Scalars], Dynamics]

    def __post_init__(self) -> None:
        object.__setattr__(self, "start", frozen(self.start))
        if self.start.shape != (len(self.names),) or len(set(self.names)) < len(self.names):
            raise InputError(f"{self.name}: {self.start.size} starting values for the parameters {self.names}")
        wrong = [name for name, value in zip(self.names, self.start.tolist(), strict=True) if not math.isfinite(value)]
        if wrong:
            raise InputError(f"{self.name}: parameter {wrong[0]} has no finite value to start from")
