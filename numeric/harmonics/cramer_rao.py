"""The Cramer-Rao bound for omega(t) in the harmonic model with white Gaussian noise, from its Fisher matrix.

For x = s(theta) + noise of variance sigma^2 the Fisher matrix is D^T D / sigma^2, D = ds/dtheta, and a function g of
the parameters cannot be estimated without bias better than

    var g >= sigma^2 |R^-T grad g|^2,       D = Q R                           (Kay 1993, section 3.8 and 3.9).

Here s is the model that harmonic least squares fits: a phase and slow amplitudes, each a combination of basis
functions of time, and an offset: polynomials in a window.  Nuisance parameters (amplitudes, harmonics, offset) cost
what they cost: nothing is neglected.  With one tone, constant amplitude and many cycles, the bound of phase degree 1 is
12 sigma^2 rate^2 / (A^2/2 N^3).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array
from ridgeback.numeric.harmonics.harmonic_signal import HarmonicSignal
from ridgeback.numeric.signal.samples import checked_work

PHASE_DEGREE = 3
AMPLITUDE_DEGREE = 2
DRIFT_DEGREE = 1
BLOCK_VALUES = 2_000_000


@dataclass(frozen=True)
class Order:
    """The orders of the model whose bound is asked for; polynomial degrees over one window.

    ``multiples`` are those beside the fundamental that are fitted with free amplitudes and phases.  Each harmonic has
    ``harmonic_degree`` (None: that of the fundamental's amplitude); 0 ties its phase to the fundamental's.

    >>> Order((3, 5)).size
    21
    """

    multiples: tuple[int, ...] = ()
    phase_degree: int = PHASE_DEGREE
    amplitude_degree: int = AMPLITUDE_DEGREE
    harmonic_degree: int | None = None
    drift_degree: int = DRIFT_DEGREE

    @property
    def harmonics(self) -> int:
        """Degree of the harmonics' amplitudes."""
        return self.amplitude_degree if self.harmonic_degree is None else self.harmonic_degree

    @property
    def size(self) -> int:
        """The number of parameters."""
        own = self.phase_degree + self.amplitude_degree + self.drift_degree + 3
        return own + 2 * len(self.multiples) * (self.harmonics + 1)


def local_bound(
    signal: HarmonicSignal,
    noise: float,
    *,
    half: int,
    order: Order,
    centres: NDArray[np.intp] | None = None,
) -> Array:
    """Least standard deviation of omega from a window around each centre: the Cramer-Rao bound of a local model.

    Parameters
    ----------
    signal : HarmonicSignal
        The true signal.
    noise : float
        Standard deviation of the white noise, in the signal's unit.
    half : int
        Samples on each side of a window.
    order : Order
        The model.
    centres : array of int, optional
        All samples by default.

    Returns
    -------
    array of float, shape (centres,)
        Rad per time unit.  Near the ends the window stops and omega is read off-centre, as the estimator does.

    Raises
    ------
    InputError
        For a window that is longer than the record, holds fewer samples than parameters, or does not determine them,
        and for work over the budget.

    References
    ----------
    Kay, Fundamentals of Statistical Signal Processing: Estimation Theory, 1993, ch. 3.

    Examples
    --------
    >>> tone = HarmonicSignal(1.0, 0.7 * np.arange(401.0), np.full(401, 0.7), (1,), np.ones((1, 401)),
    ...     np.zeros((1, 401)), np.zeros(401))
    >>> bound = local_bound(tone, 0.1, half=200, order=Order(phase_degree=1, amplitude_degree=0, drift_degree=0))
    >>> round(float(bound[200] / np.sqrt(12 * 0.1**2 / (0.5 * 401 * (401**2 - 1)))), 2)
    1.0
    """
    length, total = 2 * half + 1, signal.phase.size
    if half < 1 or length > total:
        raise InputError(f"window of {length} samples does not fit a signal of {total}; use 3 to {total}")
    if length < order.size:
        raise InputError(f"window of {length} samples is too short for the {order.size} parameters of the model")
    centres = np.arange(total) if centres is None else centres
    work = 2.0 * centres.size * length * order.size**2
    checked_work(work, f"the bound in {centres.size} windows of {length} samples", "ask for fewer centres")
    begins = np.clip(centres - half, 0, total - length)
    at = (centres - begins - half) / half
    block = max(1, BLOCK_VALUES // (length * order.size))
    parts = [
        _window_deviation(signal, begins[i : i + block], at[i : i + block], half, order)
        for i in range(0, centres.size, block)
    ]
    return noise * signal.rate / half * np.concatenate(parts)


def _window_deviation(signal: HarmonicSignal, begins: NDArray[np.intp], at: Array, half: int, order: Order) -> Array:
    """Deviation of d phi / ds at s = ``at`` in each window, for unit noise."""
    window = begins[:, None] + np.arange(2 * half + 1)
    s = np.arange(-half, half + 1) / half
    legendre = np.polynomial.legendre.legvander(s, max(order.phase_degree, order.amplitude_degree, order.drift_degree))
    phase = legendre[:, : order.phase_degree + 1]
    slow = {degree: legendre[:, : degree + 1] for degree in (order.amplitude_degree, order.harmonics)}
    columns = [
        signal.turning()[window][..., None] * phase,
        np.cos(signal.phase)[window][..., None] * slow[order.amplitude_degree],
    ]
    for h in order.multiples:
        angle = h * signal.phase[window][..., None]
        columns += [np.cos(angle) * slow[order.harmonics], np.sin(angle) * slow[order.harmonics]]
    columns.append(np.broadcast_to(legendre[:, : order.drift_degree + 1], (*window.shape, order.drift_degree + 1)))
    slope = (
        np.polynomial.legendre.legder(np.eye(order.phase_degree + 1), axis=0)
        if order.phase_degree
        else np.zeros((1, 1))
    )
    gradient = np.polynomial.legendre.legvander(at, slope.shape[0] - 1) @ slope
    return deviation(np.concatenate(columns, axis=2), gradient[:, None, :])[:, 0]


def deviation(jacobian: Array, gradients: Array) -> Array:
    """Least deviations |R^-T g| for unit noise: one for each row of ``gradients[..., row, parameter]``.

    The Jacobian is ``[..., sample, parameter]``.  Parameters that the gradients leave out come last and have gradient
    0.  Raises InputError where the samples do not determine the parameters.

    >>> deviation(np.array([[2.0, 0.0], [0.0, 1.0]]), np.array([[1.0], [4.0]]))
    array([0.5, 2. ])
    """
    scale = np.linalg.norm(jacobian, axis=-2)
    if jacobian.shape[-2] < scale.shape[-1] or not np.all(scale > 0.0):
        raise InputError("the samples do not determine the model: one of its parts has no effect on them")
    triangle = np.asarray(np.linalg.qr(jacobian / scale[..., None, :], mode="r"))
    if not np.abs(np.diagonal(triangle, axis1=-2, axis2=-1)).min() > 1e-10:
        raise InputError(
            "the samples do not determine the model: two of its parts look alike at this sampling rate and window; "
            "use fewer harmonics, a longer window or a higher rate"
        )
    known = gradients.shape[-1]
    target = np.zeros((*scale.shape, gradients.shape[-2]))
    target[..., :known, :] = np.swapaxes(gradients / scale[..., None, :known], -1, -2)
    return np.asarray(np.linalg.norm(np.linalg.solve(np.swapaxes(triangle, -1, -2), target), axis=-2))
