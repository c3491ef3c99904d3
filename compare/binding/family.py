"""A symbolic oscillator with some parameters left free, as functions of floats with exact derivatives."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import sympy

from ridgeback.common.errors import InputError
from ridgeback.compare.binding.bind import bind
from ridgeback.compare.binding.closures import ARRAY, SCALAR
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.model_fit.family import Family, Scalars
from ridgeback.numeric.motion.dynamics import Dynamics
from ridgeback.symbolic.arithmetic.closures import evaluator
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V
from ridgeback.symbolic.systems.parameters import symbol_of
from ridgeback.symbolic.systems.sides import kinks_of

START = 1.0
"""Where a free parameter begins that has no value."""


def family_of(oscillator: OscillatorLike, free: Sequence[str]) -> Family:
    """Free the named parameters of an oscillator; their present values are where a fit begins.

    Parameters
    ----------
    oscillator
        An oscillator, or anything that names one.
    free
        Parameters to be found, each once; one without a value begins at 1.

    Returns
    -------
    Family
        The force and its exact derivatives by u, u' and the free parameters, as functions of floats.

    Raises
    ------
    InputError
        For unknown names, for none or one twice, and for another parameter that has no number.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> pendulum = family_of(find("pendulum").with_parameters({"k": 2, "mu": "0.1"}), ("k", "mu"))
    >>> pendulum.start.tolist(), pendulum.force(0.0, 1.0, (2.0, 0.1)), pendulum.partials(0.0, 1.0, (2.0, 0.1))
    ([2.0, 0.1], 0.2, (4.0, 0.2, 0.0, 2.0))
    """
    oscillator = as_oscillator(oscillator)
    _check(oscillator, free)
    fixed = {symbol_of(name): value for name, value in oscillator.parameters.items() if name not in free}
    force = oscillator.force.subs(fixed)
    if any(isinstance(kink, sympy.sign) for kink in kinks_of(force)):
        raise InputError(
            f"{oscillator.name}: the force holds a sign or a root of |u|, which may jump or have no derivative; "
            "model-fit takes abs, max and min, and functions that are smooth"
        )
    symbols = (U, V, *(symbol_of(name) for name in free))
    scalar, vector = evaluator(force, symbols, SCALAR), evaluator(force, symbols, ARRAY)
    slopes = [evaluator(sympy.diff(force, symbol), symbols, SCALAR) for symbol in symbols]

    def forces(u: Array, v: Array, p: Scalars) -> Array:
        return np.asarray(vector((u, v, *p)) + np.zeros_like(u), dtype=np.float64)

    def bound(p: Scalars) -> Dynamics:
        return bind(oscillator, values={name: repr(float(value)) for name, value in zip(free, p, strict=True)})

    values = [oscillator.parameters[name] for name in free]
    return Family(
        name=oscillator.name,
        names=tuple(free),
        start=np.array([START if value is None else float(value) for value in values]),
        force=lambda u, v, p: float(scalar((u, v, *p))),
        forces=forces,
        partials=lambda u, v, p: tuple(slope((u, v, *p)) for slope in slopes),
        dynamics=bound,
    )


def _check(oscillator: Oscillator, free: Sequence[str]) -> None:
    known = ", ".join(oscillator.parameters) or "none"
    unknown = [name for name in free if name not in oscillator.parameters]
    if unknown:
        raise InputError(f"{oscillator.name} has no parameter {unknown[0]} to be freed; it has {known}")
    if not free or len(set(free)) < len(free):
        raise InputError(f"{oscillator.name}: name each free parameter once, of {known}")
    missing = [name for name, value in oscillator.parameters.items() if value is None and name not in free]
    if missing:
        raise InputError(
            f"{oscillator.name}: parameter {missing[0]} has no number; set it ({missing[0]}=1), or free it as well"
        )
