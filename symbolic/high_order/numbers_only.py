"""What very high orders ask of an oscillator: numbers for its parameters, and an identity."""

from __future__ import annotations

from ridgeback.common.errors import InputError
from ridgeback.symbolic.arithmetic.roots import root_in
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.symbolic.systems.structure import free_names


def require_numbers(oscillator: Oscillator, needed_by: str) -> None:
    """Refuse an oscillator with a symbolic parameter; what is irrational has a name and a value.

    Parameters
    ----------
    oscillator
        To be expanded; the small parameter of a limit cycle stays symbolic.
    needed_by
        Who cannot do without numbers, for the message: "balls need".

    Raises
    ------
    InputError
        Names the parameters.
    """
    names = sorted(set(free_names(oscillator.substituted_force)) - {oscillator.small})
    if names:
        raise InputError(f"{oscillator.name}: {', '.join(names)} is no number; {needed_by} one for each parameter")


def identity(oscillator: Oscillator, order: int, amplitude: str) -> dict[str, str]:
    """What a checkpoint must agree on with the work that is to go on from it.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> identity(find("pendulum"), 8, "peak")["equation"]
    "u'' + sin(u) = 0 in units where k = 1"
    """
    natural = oscillator.normalised
    force = natural.force if oscillator.kind == "limit-cycle" else natural.bound
    root = root_in(force)
    return {
        "oscillator": oscillator.name,
        "equation": f"u'' + {force} = 0 in units where k = 1" + (f", {root.told}" if root else ""),
        "order": str(order),
        "amplitude": amplitude,
    }
