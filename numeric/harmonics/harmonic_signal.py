"""A signal as slowly varying harmonics of one phase, the form in which noise bounds are computed.

    x(t) = d(t) + sum over h of [b_h(t) cos h phi(t) + c_h(t) sin h phi(t)],     c_1 = 0, b_1 >= 0, omega = phi'.

b_h, c_h and d are cubic splines, found by one sparse linear least-squares fit along a given frequency; what is left
of the sine of the fundamental is then turned into its phase, so that omega is exactly the derivative of phi.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline
from scipy.sparse import csc_array, diags_array, hstack
from scipy.sparse.linalg import splu

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, freeze
from ridgeback.numeric.signal.samples import TWO_PI

KNOT_CYCLES = 2.0
"""Default spacing of the splines' knots, in cycles of the slowest part: half the default window of an estimator."""
FEWEST_CYCLES = 3.0


@dataclass(frozen=True)
class HarmonicSignal:
    """Harmonics of one phase, with amplitudes that vary slowly.

    Parameters
    ----------
    rate : float
        Samples per time unit.
    phase, omega : array of float, shape (N,)
        Phase of the fundamental in rad, and its derivative in rad per time unit.
    multiples : tuple of int
        Which harmonics, 1 first.
    cosine, sine : array of float, shape (H, N)
        Their coefficients, ``[harmonic, sample]``.
    offset : array of float, shape (N,)
        The slow part beside them.
    start : float
        Time of the first sample.
    parameters : int
        Spline coefficients that were fitted, 0 for a signal that was not.
    """

    rate: float
    phase: Array
    omega: Array
    multiples: tuple[int, ...]
    cosine: Array
    sine: Array
    offset: Array
    start: float = 0.0
    parameters: int = 0
    """Spline coefficients that were fitted, 0 for a signal that was not."""

    def __post_init__(self) -> None:
        freeze(self)

    @property
    def time(self) -> Array:
        """Sample times."""
        return self.start + np.arange(self.phase.size) / self.rate

    @property
    def angles(self) -> Array:
        """The phases h phi, ``[harmonic, sample]``."""
        return np.asarray(np.multiply.outer(np.array(self.multiples, dtype=float), self.phase))

    def values(self) -> Array:
        """The samples."""
        waves = self.cosine * np.cos(self.angles) + self.sine * np.sin(self.angles)
        return np.asarray(waves.sum(axis=0) + self.offset)

    def turning(self) -> Array:
        """Derivative of the samples by the phase: sum of h (c_h cos h phi - b_h sin h phi)."""
        h = np.array(self.multiples, dtype=float)[:, None]
        return np.asarray((h * (self.sine * np.cos(self.angles) - self.cosine * np.sin(self.angles))).sum(axis=0))

    # (b cos h phi + c sin h phi)' = (b' + h omega c) cos h phi + (c' - h omega b) sin h phi
    def rate_of_change(self) -> HarmonicSignal:
        """The derivative by time, as harmonics of the same phase."""
        turn = np.multiply.outer(np.array(self.multiples, dtype=float), self.omega)
        slopes = [make_interp_spline(self.time, part, k=3, axis=-1).derivative()(self.time) for part in self._parts()]
        return replace(self, cosine=slopes[0] + turn * self.sine, sine=slopes[1] - turn * self.cosine, offset=slopes[2])

    def _parts(self) -> tuple[Array, Array, Array]:
        return self.cosine, self.sine, self.offset


def uniform_knots(last: float, spacing: float, degree: int = 3) -> Array:
    """Clamped knots on 0 .. ``last``, at most ``spacing`` apart.

    >>> uniform_knots(2.0, 1.0, degree=1).tolist()
    [0.0, 0.0, 1.0, 2.0, 2.0]
    """
    inner = np.linspace(0.0, last, max(1, int(np.ceil(last / spacing))) + 1)
    return np.concatenate([np.zeros(degree), inner, np.full(degree, last)])


def decompose(
    x: Array,
    omega: Array,
    rate: float,
    *,
    multiples: tuple[int, ...] = (1,),
    spacing: float | None = None,
    start: float = 0.0,
) -> HarmonicSignal:
    """Fit slowly varying harmonics to samples along a frequency.

    Parameters
    ----------
    x : array of float, shape (N,)
        The samples.
    omega : array of float, shape (N,)
        Frequency of the fundamental, rad per time unit.
    rate : float
        Samples per time unit.
    multiples : tuple of int
        Which harmonics, 1 first.
    spacing : float, optional
        Distance of the splines' knots, in time units; KNOT_CYCLES of the lowest frequency by default.
    start : float
        Time of the first sample.

    Returns
    -------
    HarmonicSignal
        The fit, with the frequency corrected.

    Raises
    ------
    InputError
        When ``multiples`` do not begin with 1, or the record is shorter than FEWEST_CYCLES cycles.

    Examples
    --------
    >>> t = np.arange(400) / 20.0
    >>> signal = decompose(np.cos(2 * np.pi * 1.5 * t) + 0.25, np.full(400, 9.4), 20.0)
    >>> bool(np.abs(signal.omega - 3 * np.pi).max() < 1e-3), bool(np.abs(signal.cosine[0] - 1).max() < 1e-4)
    (True, True)
    """
    if multiples[:1] != (1,):
        raise InputError(f"harmonics {multiples} do not begin with the fundamental, 1")
    time, last = np.arange(x.size) / rate, (x.size - 1) / rate
    cycle = TWO_PI / float(omega.min())
    if last < FEWEST_CYCLES * cycle:
        raise InputError(f"signal spans {last / cycle:.3g} cycles; {FEWEST_CYCLES:g} are needed for its harmonics")
    knots = uniform_knots(last, KNOT_CYCLES * cycle if spacing is None else spacing)
    phase = make_interp_spline(time, omega, k=3).antiderivative()(time)
    angles = np.multiply.outer(np.array(multiples, dtype=float), phase)
    waves = [np.ones(x.size), *np.cos(angles), *np.sin(angles)]
    parts = _slow_parts(x, time, knots, waves)
    slopes = [BSpline(knots, c, 3).derivative()(time) for c in (parts[1], parts[1 + len(multiples)])]
    values = np.stack([BSpline(knots, c, 3)(time) for c in parts])
    return _folded(rate, start, phase, omega, multiples, values, slopes, parts.size)


def _slow_parts(x: Array, time: Array, knots: Array, waves: list[Array]) -> Array:
    """Spline coefficients ``[wave, coefficient]`` of the factors of the waves, by sparse normal equations."""
    basis = BSpline.design_matrix(time, knots, 3)
    columns = csc_array(hstack([diags_array(wave) @ basis for wave in waves]))
    normal = csc_array(columns.T @ columns)
    # A floor far below any resolved direction: a spline at the end of a harmonic's support may see hardly a sample.
    floor = 1e-10 * float(normal.diagonal().max())
    solved = splu(csc_array(normal + diags_array(np.full(normal.shape[0], floor)))).solve(np.asarray(columns.T @ x))
    return np.asarray(solved).reshape(len(waves), -1)


# b cos phi + c sin phi = a cos(phi - psi), psi = atan2(c, b); the harmonics turn with it, and omega loses psi'.
def _folded(
    rate: float,
    start: float,
    phase: Array,
    omega: Array,
    multiples: tuple[int, ...],
    values: Array,
    slopes: list[Array],
    parameters: int,
) -> HarmonicSignal:
    count = len(multiples)
    even, odd = values[1 : 1 + count], values[1 + count :]
    square = even[0] ** 2 + odd[0] ** 2
    psi = np.unwrap(np.arctan2(odd[0], even[0]))
    turn = np.multiply.outer(np.array(multiples, dtype=float), psi)
    return HarmonicSignal(
        rate=rate,
        phase=phase - psi,
        omega=omega - (even[0] * slopes[1] - odd[0] * slopes[0]) / np.maximum(square, np.finfo(float).tiny),
        multiples=multiples,
        cosine=even * np.cos(turn) + odd * np.sin(turn),
        sine=odd * np.cos(turn) - even * np.sin(turn),
        offset=values[0],
        start=start,
        parameters=parameters,
    )
