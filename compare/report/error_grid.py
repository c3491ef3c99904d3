"""What the sliders of a page move over: omega0 of every order at every amplitude, with an error that is proved.

The value is that of the generated code, the double itself; its error against the exact omega0 is enclosed in ball
arithmetic where there is an enclosure.  Elsewhere the study's reference with its own uncertainty takes its place, and
nothing is called certified.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.common.show.brief import Brief
from ridgeback.compare.binding.generated_code import as_module, omega0_of
from ridgeback.compare.study.derived import Derived
from ridgeback.compare.study.results import Study
from ridgeback.numeric.arrays import Array, freeze
from ridgeback.symbolic.certificates.values import Errors, errors_of_values, growth_power
from ridgeback.symbolic.codegen import written

PAIRS = ((0.02, 0.04), (0.16, 0.32))
"""Pairs of amplitudes between which the power of the error is read, as shares of the radius or of the largest one."""


@dataclass(frozen=True, repr=False)
class ErrorGrid(Brief):
    """omega0 by generated code over order and amplitude, and its relative error against the exact one."""

    orders: tuple[int, ...]
    amplitudes: Array
    """Shape (M,), the doubles that the code is given."""
    exact: Array
    """Exact omega0, shape (M,), rad per time unit."""
    values: Array
    """Shape (N, M), rad per time unit: what the code returns."""
    errors: Array
    """Shape (N, M), signed."""
    bounds: Array
    """Shape (N, M): the size of the error is certainly at most this; or the study's estimate of that."""
    certified: bool
    code: Mapping[int, str]
    """The JavaScript of each order."""
    scale: float
    """The argument k of the code."""
    observed: tuple[tuple[float, float, Array], ...] = ()
    """Smaller and larger amplitude of a pair, and the power of A with which each order's error grows between."""

    def __post_init__(self) -> None:
        freeze(self)


def error_grid(derived: Derived, study: Study) -> ErrorGrid:
    """Evaluate every order of a study at its amplitudes, and enclose the errors.

    Parameters
    ----------
    derived
        The series, at least of the study's highest order.
    study
        Orders and amplitudes, and the reference where nothing can be enclosed.

    Examples
    --------
    >>> from ridgeback.compare.study.derived import derive
    >>> from ridgeback.compare.study.study import study
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> found = derive(find("pendulum"), 8)
    >>> grid = error_grid(found, study(find("pendulum"), (2, 8), [0.5, 1.0]))
    >>> grid.certified, bool((abs(grid.errors) <= grid.bounds).all()), [round(float(p), 1) for p in grid.observed[0][2]]
    (True, True, [4.0, 10.0])
    """
    parts = [derived.expansion.truncated(order) for order in study.orders]
    k = float(derived.expansion.scale)
    forms = [omega0_of(part) for part in parts]
    values = np.array([np.asarray(as_module(form).omega0(study.amplitudes), dtype=float) for form in forms])
    code = {order: function(written(form, "javascript")) for order, form in zip(study.orders, forms, strict=True)}
    enclosed = _enclosed(derived, study.amplitudes, values)
    if enclosed is None:
        errors = values / study.reference - 1
        exact, bounds = study.reference, np.abs(errors) + study.reference_error
    else:
        exact, errors, bounds = (np.array(part) for part in (enclosed.exact, enclosed.signed, enclosed.bounds))
    return ErrorGrid(
        orders=study.orders,
        amplitudes=study.amplitudes,
        exact=exact,
        values=values,
        errors=errors,
        bounds=bounds,
        certified=enclosed is not None,
        code=code,
        scale=k,
        observed=_observed(derived, study) if enclosed is not None else (),
    )


def function(text: str) -> str:
    r"""The function of one number in generated JavaScript, without what belongs to a module.

    >>> function("// x\nexport function omega0_unchecked(A, k = 1.0) {\n  return k;\n}\n\n// rest")
    'function omega0(A, k = 1.0) {\n  return k;\n}'
    """
    found = re.search(r"export function omega0_unchecked\(.*?\n}\n", text, flags=re.DOTALL)
    if found is None:
        raise ValueError("the generated JavaScript holds no function omega0_unchecked")
    return found[0].strip().replace("export function omega0_unchecked", "function omega0", 1)


def _enclosed(derived: Derived, amplitudes: Array, values: Array) -> Errors | None:
    """Errors of the values; None where omega0 has no enclosure at one of the amplitudes."""
    if derived.expansion.variable != "A":
        return None
    try:
        return errors_of_values(derived.undamped.oscillator, amplitudes.tolist(), values.tolist())
    except InputError:
        return None


def _observed(derived: Derived, study: Study) -> tuple[tuple[float, float, Array], ...]:
    """The power of A with which each order's error grows between two amplitudes, from enclosed errors."""
    top = derived.limits.radius or float(study.amplitudes[-1])
    oscillator = derived.undamped.oscillator
    parts = [derived.expansion.truncated(order) for order in study.orders]
    found = []
    for shares in PAIRS:
        small, large = (Fraction(f"{share * top:.3g}") for share in shares)
        try:
            powers = np.array([growth_power(oscillator, part, small, large) for part in parts])
        except InputError:
            return ()
        found.append((float(small), float(large), powers))
    return tuple(found)
