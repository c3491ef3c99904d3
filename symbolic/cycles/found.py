"""The limit cycles of an oscillator: where the search finds one, the proof."""

from __future__ import annotations

from dataclasses import dataclass, replace

import sympy

from ridgeback.common.errors import InputError
from ridgeback.common.progress import Wanted, showing
from ridgeback.symbolic.arithmetic.balls import natural_frequency
from ridgeback.symbolic.cycles.averaged import balanced_amplitudes
from ridgeback.symbolic.cycles.enclose import Cycle, enclose_cycle, turns_of
from ridgeback.symbolic.cycles.search import MOST_STEPS, OCTAVES, runs_out, scan
from ridgeback.symbolic.systems.any_form import OscillatorLike, as_oscillator
from ridgeback.symbolic.systems.oscillator import Oscillator, U, V
from ridgeback.symbolic.systems.sides import require_one_law


@dataclass(frozen=True)
class Unproved:
    """A place where the search saw a cycle that could not be enclosed, and why."""

    peak: float
    why: str


def limit_cycles(
    oscillator: OscillatorLike, *, bits: int = 128, progress: Wanted = None
) -> tuple[Cycle | Unproved, ...]:
    """Enclose every limit cycle about the origin that a scan of the return map finds.

    Parameters
    ----------
    oscillator : Oscillator, str, path, sympy.Eq or sympy.Expr
        Any form of an oscillator with numbers for its parameters.
    bits : int, optional
        The relative radius of each frequency is at most about 2**-bits.
    progress : bool or callable, optional
        Called with the share that is done and the name of the step; True shows a bar.

    Returns
    -------
    tuple of Cycle or Unproved
        By rising peak.  Each ball holds a true limit cycle; that the scan has found all of them is not proved.

    Raises
    ------
    InputError
        For an oscillator whose orbits all close, for one with a symbolic parameter, and where none is found.

    Examples
    --------
    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> [cycle.omega.str(12, radius=False) for cycle in limit_cycles(find("van-der-pol"), bits=64)]
    ['0.984720976645']
    """
    own = as_oscillator(oscillator)
    _check(own)
    force, k = own.substituted_force, float(natural_frequency(own.natural_frequency))
    turns = turns_of(force)
    expected = balanced_amplitudes(force, k) or (1.0,)
    ways = {backwards: in_time(force, backwards=backwards) for backwards in (False, True)}
    if all(runs_out(ways[False], peak, turns=turns) for peak in expected):
        raise InputError(
            f"{own.name}: the motion from the peak {expected[0]:.4g} is not followed to its turning point within "
            f"{MOST_STEPS} steps, so that no limit cycle is looked for; if its loss is many times the natural "
            "frequency (a relaxation oscillation), use a smaller one"
        )
    scans = {backwards: scan(way, turns=turns, near=expected) for backwards, way in ways.items()}
    seen = sorted((a, backwards) for backwards, found in scans.items() for a in found.peaks)
    if not seen:
        low, high = expected[0] / 2**OCTAVES, expected[-1] * 2**OCTAVES
        raise InputError(
            f"{own.name}: a scan of the return map found no limit cycle with a peak in {low:.3g} .. {high:.3g}"
            + _lost(sum(found.lost for found in scans.values()))
        )
    with showing(progress) as told:
        proved = []
        for done, (peak, backwards) in enumerate(seen):
            told(done / len(seen), f"limit cycle near the peak {peak:.3g}")
            proved.append(_proved(ways[backwards], peak, k, bits, backwards=backwards))
        return tuple(proved)


def _lost(count: int) -> str:
    """What the refusal says of motions that the scan did not follow."""
    motions = "1 motion was" if count == 1 else f"{count} motions were"
    return f"; {motions} not followed to the turning point within {MOST_STEPS} steps" if count else ""


def in_time(force: sympy.Expr, *, backwards: bool) -> sympy.Expr:
    """The force as time runs: backwards, what repels attracts, and can be followed.

    >>> in_time(U - V, backwards=True)
    u + u'
    """
    return force.subs(V, -V) if backwards else force


def limits_itself(oscillator: Oscillator, small: str) -> bool:
    """Whether the averaged loss of an oscillator changes its sign at some amplitude, for a small parameter above 0.

    >>> from ridgeback.symbolic.systems.catalogue import find
    >>> limits_itself(find("van-der-pol"), "eps"), limits_itself(find("damped-pendulum"), "mu")
    (True, False)
    """
    own = oscillator.with_parameters({small: "1/10"})
    return not own.natural_frequency.free_symbols and bool(
        balanced_amplitudes(own.substituted_force, float(natural_frequency(own.natural_frequency)))
    )


def _check(oscillator: Oscillator) -> None:
    require_one_law(oscillator.name, oscillator.substituted_force)
    if oscillator.closes:
        raise InputError(
            f"{oscillator.name}: every orbit near the origin closes, so that there is no limit cycle to enclose; "
            "use its amplitude, or another value of the small parameter"
        )
    names = sorted(str(symbol) for symbol in oscillator.substituted_force.free_symbols if symbol not in (U, V))
    if names:
        raise InputError(f"{oscillator.name}: a limit cycle is enclosed with numbers only; set {', '.join(names)}")


def _proved(force: sympy.Expr, peak: float, k: float, bits: int, *, backwards: bool) -> Cycle | Unproved:
    try:
        cycle = enclose_cycle(force, peak, unit=k, bits=bits)
    except InputError as refusal:
        return Unproved(peak, str(refusal))
    return replace(cycle, multiplier=1 / cycle.multiplier) if backwards else cycle
