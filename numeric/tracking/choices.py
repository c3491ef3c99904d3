"""What an estimator used, as far as code reads it back from a track."""

from __future__ import annotations

from dataclasses import dataclass, fields
from enum import StrEnum

from ridgeback.numeric.components.modulation import Swing
from ridgeback.numeric.components.tones import Tone


class Scope(StrEnum):
    """Of harmonic least squares: splines over the whole record, or a polynomial in a sliding window."""

    LOCAL = "local"
    GLOBAL = "global"


class Definition(StrEnum):
    """Of an amplitude: the size of the first harmonic, or the turning point."""

    FUNDAMENTAL = "fundamental"
    PEAK = "peak"


class Held(StrEnum):
    """What holds in a stretch of a record and not beside it, as it is told."""

    CLEAR = "the amplitude stands above the noise"
    FOLLOWED = "one smooth oscillation can be followed"
    STARTED = "what swells, falls or dies within a few cycles at the start is over"


def said(held: tuple[Held, ...]) -> str:
    """What holds, in words.

    >>> said((Held.STARTED, Held.CLEAR))[-48:]
    'is over and the amplitude stands above the noise'
    """
    return " and ".join(one.value for one in held)


@dataclass(frozen=True)
class Choices:
    """The settings that an estimator was given or chose from the data.

    Parameters
    ----------
    start : float, optional
        Time of the signal's first sample.
    multiple : int
        Which harmonic the track is of, 1 the fundamental.
    scope : Scope, optional
        That of harmonic least squares.
    lag_seconds, smoothing_seconds, filter_seconds : float, optional
        Full widths of the lag window, the smoothing along time and the low-pass, in time units.
    cycles_per_knot : float, optional
        Mean distance of a global model's knots.
    harmonics : tuple of int
        The multiples that were fitted, the fundamental included; empty where none were.
    phase_degree, order : int, optional
        Degree of the phase in a sliding window; number of factors of a polynomial lag product.
    hysteresis : float, optional
        Half width of the zone around zero in which crossings are not counted, in the signal's unit.
    noise : float, optional
        Standard deviation of the noise that was found, in the signal's unit.
    one_sided_borders : bool
        Whether values near the ends are fits to one side, and so of use although the window is not whole there.
    decimated_by : int
        How many samples of the record stand behind one sample of the signal that the track is of.
    span : (float, float), optional
        First and last time of the stretch in which the amplitude stands above the noise, where that is not all of the
        record: the track is of that stretch.
    span_why : tuple of Held
        What holds in that stretch and not beside it.
    tones : tuple of Tone
        What was found beside the oscillation and taken off.
    spikes : int
        Samples far outside the noise that enter no fit.
    doubt : str
        Why no interval can be claimed of this record, if so.
    swing : Swing, optional
        How the amplitude or the frequency swings, where lines beside it say so.
    why : str
        The reason for what was chosen, for display.

    Examples
    --------
    >>> Choices(start=0.0, multiple=3, harmonics=(1, 3)).shown()
    {'start': 0.0, 'multiple': 3, 'harmonics': (1, 3)}
    """

    start: float | None = None
    multiple: int = 1
    scope: Scope | None = None
    lag_seconds: float | None = None
    smoothing_seconds: float | None = None
    filter_seconds: float | None = None
    cycles_per_knot: float | None = None
    harmonics: tuple[int, ...] = ()
    phase_degree: int | None = None
    order: int | None = None
    hysteresis: float | None = None
    noise: float | None = None
    one_sided_borders: bool = False
    decimated_by: int = 1
    span: tuple[float, float] | None = None
    span_why: tuple[Held, ...] = ()
    tones: tuple[Tone, ...] = ()
    spikes: int = 0
    doubt: str = ""
    swing: Swing | None = None
    why: str = ""

    def span_notes(self) -> tuple[str, ...]:
        """The stretch that the track is of, in words, where that is not all of the record.

        >>> Choices(span=(4.2, 39.9)).span_notes()
        ('The amplitude stands above the noise from t = 4.2 to 39.9; the rest is left out.',)
        """
        if self.span is None:
            return ()
        why = said(self.span_why or (Held.CLEAR,))
        return (f"{why[0].upper()}{why[1:]} from t = {self.span[0]:.6g} to {self.span[1]:.6g}; the rest is left out.",)

    def shown(self) -> dict[str, object]:
        """What differs from its default, by name, for display."""
        held = {item.name: (getattr(self, item.name), item.default) for item in fields(self)}
        some = {
            name: value
            for name, (value, default) in held.items()
            if value != default and name not in ("tones", "swing")
        }
        return {**some, **({"span_why": said(self.span_why)} if self.span_why else {})}
