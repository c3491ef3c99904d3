"""A recording of a velocity or an acceleration as one of the displacement, each harmonic weighted as it must be.

A model of the whole signal has for its harmonic h the complex amplitude X = B e^(i h phi), X'/X = D = B'/B + i h omega.
The derivative of a slowly changing wave U with U'/U = D is U' = D U, and U'' = (D^2 + D') U.  So

    U = X / D  from a velocity,      U = X / (D^2 + D')  from an acceleration,

with the D of U itself, which differs from that of X by F'/F, F the divisor: found in ROUNDS steps.  What the model
leaves, noise, is divided by the divisor of the fundamental's mean frequency, so that it stays as strong beside it.
"""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from ridgeback.common.errors import InputError
from ridgeback.numeric.arrays import Array, ComplexArray
from ridgeback.numeric.harmonics.spline_model import SplineModel
from ridgeback.numeric.recording.recording import Recording
from ridgeback.numeric.signal.decimation import checked
from ridgeback.numeric.tracking.request import FEWEST_SAMPLES, Options, prepared

ORDERS = {"displacement": 0, "velocity": 1, "acceleration": 2}
"""How often the displacement is differentiated."""
ROUNDS = 2
GIVEN = "quantity"
"""The fact of a recording that says what was measured, where somebody said so."""
NAMED = {
    "acceleration": (
        re.compile(r"(?<![a-z])(acc|accel|accelerations?|accelerometer|beschleunigung)(?![a-z])"),
        re.compile(r"(m|mm|cm|rad|deg)[ /_]*(s\^?-?2|s\*\*2|s²)"),
    ),
    "velocity": (
        re.compile(r"(?<![a-z])(vel|velo|velocity|speed|geschwindigkeit)(?![a-z])"),
        re.compile(r"(m|mm|cm|rad|deg)[ /_]+s(?![\^\d*²])"),
    ),
}
"""Names and units of columns that say what was measured."""
STANDARD_GRAVITY = {"g": 9.80665, "mg": 9.80665e-3}
"""In m/s^2."""
AN_A = re.compile(r"a[ _]?[xyz]?[ _]?\d*")
"""Names of a column in g, that could be grams, by which it is of an acceleration."""


def named_quantity(recording: Recording) -> str:
    """What a recording's name and unit say that it is; empty where they say nothing, or somebody said it.

    >>> x, rate = np.cos(0.3 * np.arange(40)), 10.0
    >>> named_quantity(Recording.from_arrays(x, rate, name="acc_z", units="m/s^2"))
    'acceleration'
    >>> named_quantity(Recording.from_arrays(x, rate, name="v", units="mm/s")), named_quantity(
    ...     Recording.from_arrays(x, rate, name="accuracy", units="mm"))
    ('velocity', '')
    >>> [named_quantity(Recording.from_arrays(x, rate, name=n, units="g")) for n in ("az", "mass")]
    ['acceleration', '']
    """
    if GIVEN in recording.facts:
        return ""
    name, unit = recording.name.lower().strip(), recording.units.lower()
    if unit in STANDARD_GRAVITY and AN_A.fullmatch(name):
        return "acceleration"
    for quantity, (names, units) in NAMED.items():
        if names.search(name.replace("_", " ")) or units.fullmatch(unit):
            return quantity
    return ""


def as_said(recording: Recording, quantity: str | None) -> Recording:
    """The displacement behind a recording of this quantity; where nobody said what it is, as it is.

    A name or a unit that speaks of another quantity than a displacement is told in a note then.
    """
    if quantity is not None:
        return as_displacement(recording, quantity)
    named = named_quantity(recording)
    if not named:
        return recording
    note = (
        f"By its name or unit the column is of {'an acceleration' if named == 'acceleration' else 'a velocity'}: "
        f"amplitude and growth rate below are of that, and its harmonics are not those of the displacement; "
        f"--quantity {named} converts it."
    )
    return replace(recording, notes=(note, *recording.notes))


def as_displacement(recording: Recording, quantity: str) -> Recording:
    """The displacement of which a recording has the velocity or the acceleration.

    Parameters
    ----------
    recording : Recording
        The samples as they were measured.
    quantity : str
        ``"displacement"``, ``"velocity"`` or ``"acceleration"``.

    Returns
    -------
    Recording
        The same times, in the unit of the samples times the second, or its square, and named as what it is; an
        acceleration in g, standard gravity, in metres.  Its mean is 0: a constant is nothing that a derivative shows.

    Raises
    ------
    InputError
        For another quantity, and where no model of the whole signal settles.

    Examples
    --------
    >>> t = np.arange(640) / 32.0
    >>> u = np.exp((-0.05 + 7j) * t)
    >>> found = as_displacement(Recording.from_arrays(((-0.05 + 7j) ** 2 * u).real, 32.0), "acceleration")
    >>> bool(np.abs(found.values - u.real).max() < 1e-4)
    True
    """
    if quantity not in ORDERS:
        raise InputError(f"quantity {quantity!r} is unknown; use one of {', '.join(ORDERS)}")
    order = ORDERS[quantity]
    facts = {**recording.facts, GIVEN: quantity}
    if order == 0:
        return replace(recording, facts=facts)
    unit, scale = recording.units, STANDARD_GRAVITY.get(recording.units.lower(), 1.0) if order == 2 else 1.0
    unit = "m/s^2" if scale != 1.0 else unit
    x, rate = scale * recording.values, recording.rate
    wrong = recording.clipped if recording.clipped.any() else None
    samples = replace(checked(x, rate, start=0.0, what="quantity", at_least=FEWEST_SAMPLES), wrong=wrong)
    try:
        request = prepared(samples, Options()).separated()
        model = request.models.best
    except InputError as error:
        raise InputError(f"{recording.label}: the {quantity} cannot be converted to a displacement: {error}") from None
    values = displaced(request.signal.x, model, quantity)
    unit = integrated_unit(unit, order)
    note = (
        f"The {quantity} was converted to a displacement{f' ({unit})' if unit else ''}, harmonic by harmonic along a "
        "model of the signal; its mean is not known."
    )
    name = f"displacement from {recording.name}"
    return replace(recording, values=values, name=name, units=unit, notes=(note, *recording.notes), facts=facts)


def displaced(x: Array, model: SplineModel, quantity: str) -> Array:
    """The displacement of samples of a velocity or an acceleration, less their mean, along a model of them.

    >>> from ridgeback.numeric.harmonics.signal_model import signal_models
    >>> t = np.arange(640) / 32.0
    >>> u = np.exp((-0.05 + 7j) * t)
    >>> x = ((-0.05 + 7j) * u).real
    >>> model = signal_models(x, 32.0, np.full(640, 7.0), half=40).best
    >>> bool(np.abs(displaced(x, model, "velocity") - u.real).max() < 1e-4)
    True
    """
    order = ORDERS[quantity]
    wave = sum((converted(model, h, order) for h in (1, *model.multiples)), np.zeros(x.size, dtype=np.complex128))
    omega = model.mean_omega
    rest = (x - model.samples(keep=lambda h: h > 0)) / (omega if order == 1 else -(omega**2))
    return np.asarray(wave.real + rest - rest.mean(), dtype=np.float64)


def integrated_unit(unit: str, order: int) -> str:
    """The unit of an integral over time.

    >>> integrated_unit("mm/s", 1), integrated_unit("m/s^2", 2), integrated_unit("V", 2), integrated_unit("", 2)
    ('mm', 'm', 'V s^2', '')
    """
    seconds = "s" if order == 1 else "s^2"
    return unit.removesuffix(f"/{seconds}") if unit.endswith(f"/{seconds}") or not unit else f"{unit} {seconds}"


def converted(model: SplineModel, multiple: int, order: int) -> ComplexArray:
    """A harmonic of the displacement, as a complex wave."""
    wave, own = harmonic(model, multiple)
    step = float(model.time[1] - model.time[0])
    divisor = divided(own, order, step)
    for _ in range(ROUNDS):
        divisor = divided(own - np.gradient(divisor, step) / divisor, order, step)
    return np.asarray(wave / divisor, dtype=np.complex128)


def divided(turn: ComplexArray, order: int, step: float) -> ComplexArray:
    """D, or D^2 + D'."""
    return turn if order == 1 else np.asarray(turn**2 + np.gradient(turn, step))


def harmonic(model: SplineModel, multiple: int) -> tuple[ComplexArray, ComplexArray]:
    """The complex wave of a harmonic, of which the samples are the real part, and its logarithmic derivative."""
    turning = model.growth + 1j * multiple * model.omega
    wave = model.size * np.exp(1j * multiple * model.phase)
    if multiple == 1:
        return wave, turning
    at, basis = 1 + 2 * model.multiples.index(multiple), model.basis
    cosine, sine = model.coefficients[:, at], model.coefficients[:, at + 1]
    share = basis.values(cosine) - 1j * basis.values(sine)
    rise = basis.slopes(cosine) - 1j * basis.slopes(sine)
    slow = np.where(share == 0.0, 0.0, rise / np.where(share == 0.0, 1.0, share))
    return wave * share, turning + slow
