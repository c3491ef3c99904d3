"""What very high orders ask of an oscillator: numbers for its parameters, and an identity."""

from __future__ import annotations

from ridgeback.common.errors import InputError
from ridgeback.symbolic.systems.oscillator import Oscillator
from ridgeback.symbolic.systems.structure import free_names


def require_numbers(oscillator: Oscillator, needed_by: str) -> None:
    """Refuse an oscillator with a parameter that is symbolic or irrational.

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
    natural = oscillator.normalised
    force = natural.force if oscillator.kind == "limit-cycle" else natural.rational
    names = sorted(set(free_names(force)) - {oscillator.small})
    if names:
        unset = ", ".join(str(natural.constants.get(name, name)) for name in names)
        raise InputError(f"{oscillator.name}: {unset} is no rational number; {needed_by} one for each parameter")


def identity(oscillator: Oscillator, order: int, amplitude: str) -> dict[str, str]:
    """What a checkpoint must agree on with the work that is to go on from it.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> identity(find("pendulum"), 8, "peak")["equation"]
    "u'' + sin(u) = 0 in units where k = 1"
    """
    natural = oscillator.normalised
    force = natural.force if oscillator.kind == "limit-cycle" else natural.bound
    return {
        "oscillator": oscillator.name,
        "equation": f"u'' + {force} = 0 in units where k = 1",
        "order": str(order),
        "amplitude": amplitude,
    }
