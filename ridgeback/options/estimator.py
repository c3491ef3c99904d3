"""How a verb is told which estimator to use, and with which windows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from typing import Any

import click

from ridgeback.options.arguments import BAND, POSITIVE
from ridgeback.options.model import Model
from ridgeback.options.shared import added

Command = Callable[..., None]
WINDOWS = ("blackman", "gaussian", "hamming", "hann", "rectangular")


@dataclass(frozen=True)
class Estimator:
    """Method and settings as they were said; ``given`` are the settings in the words of ``estimators.estimate``."""

    method: str
    band: tuple[float, float] | None
    lag: float | None
    remove_bias: bool
    window: str | None = None
    smoothing: float | None = None
    harmonics: int | None = None
    order: int | None = None
    band_limited: bool = False
    single: bool = False
    components: int | None = None
    model: Model | None = None

    def given(self) -> dict[str, Any]:
        """Keyword arguments of ``estimate``; what was not said keeps its default there."""
        said: dict[str, Any] = {
            "method": self.method,
            "band": self.band,
            "lag_seconds": self.lag,
            "lag_window": self.window,
            "smoothing_seconds": self.smoothing,
            "harmonics": self.harmonics,
            "order": self.order,
            "band_limited": self.band_limited or None,
            "single": self.single or None,
            "components": self.components,
            "remove_bias": self.remove_bias,
            "family": None if self.model is None else self.model.family(self.method),
        }
        return {name: value for name, value in said.items() if value is not None}

    def check(self) -> None:
        """Raise click.UsageError for settings that the method makes no use of.

        >>> Estimator("hilbert", None, None, False, order=6).check()
        Traceback (most recent call last):
            ...
        click.exceptions.UsageError: --method hilbert has no use for --order, which polynomial-wigner has; leave out
        """
        from ridgeback.numeric.tracking.settings import unused, whose

        idle = unused(self.method, list(self.given()))
        if idle:
            named = ", ".join(spelled(name) + whose(name) for name in idle)
            raise click.UsageError(f"--method {self.method} has no use for {named}; leave out")

    def given_besides(self, *names: str) -> list[str]:
        """Options that were given although only those of these settings have a meaning.

        >>> Estimator("auto", None, 2.0, True).given_besides("band", "lag_seconds")
        ['--remove-bias']
        """
        unset = {"method": "auto", "remove_bias": False}
        given = [name for name, value in self.given().items() if name not in names and value != unset.get(name)]
        return [spelled(name) for name in given]


SPELLED = {"lag_seconds": "--lag", "lag_window": "--window", "smoothing_seconds": "--smoothing"}


def spelled(name: str) -> str:
    """A setting as the command line calls it.

    >>> spelled("lag_seconds"), spelled("band_limited")
    ('--lag', '--band-limited')
    """
    return SPELLED.get(name, "--" + name.replace("_", "-"))


def estimator_options(command: Command) -> Command:
    """Give a verb the options of the estimators, as one ``estimator``."""

    @wraps(command)
    def wrapped(
        *args: Any,
        method: str,
        band: tuple[float, float] | None,
        lag: float | None,
        remove_bias: bool,
        window: str | None,
        smoothing: float | None,
        harmonics: int | None,
        order: int | None,
        band_limited: bool,
        single: bool,
        components: int | None,
        **rest: Any,
    ) -> None:
        estimator = Estimator(
            *(method, band, lag, remove_bias, window, smoothing, harmonics, order, band_limited, single, components)
        )
        command(*args, estimator=estimator, **rest)

    return added(wrapped, OPTIONS)


def components_of(value: str) -> int | None:
    """A number of components, None for "auto".

    >>> components_of("auto"), components_of("2")
    (None, 2)
    """
    if value == "auto":
        return None
    if value.isdecimal() and 1 <= int(value) <= MOST_COMPONENTS:
        return int(value)
    raise click.BadParameter(f"{value!r} is neither auto nor a number from 1 to {MOST_COMPONENTS}")


MOST_COMPONENTS = 16
OPTIONS = (
    click.option(
        "--method", default="auto", show_default=True, metavar="NAME", help="Estimator; a wrong name lists them all."
    ),
    click.option(
        "--band", type=BAND, default=None, metavar="LOW,HIGH", help="Search band in rad/s.  Default: from the data."
    ),
    click.option(
        "--lag", type=POSITIVE, default=None, metavar="SECONDS", help="Length of the window.  Default: four cycles."
    ),
    click.option(
        "--window",
        type=click.Choice(WINDOWS),
        default=None,
        help="Lag window of the Wigner family.  Default: blackman.",
    ),
    click.option(
        "--smoothing",
        type=POSITIVE,
        default=None,
        metavar="SECONDS",
        help="Time smoothing of smoothed-pseudo-wigner.  Default: one cycle.",
    ),
    click.option(
        "--harmonics",
        type=click.IntRange(1, 99),
        default=None,
        metavar="N",
        help="Highest harmonic that harmonic-least-squares fits.  Default: those the data show.",
    ),
    click.option(
        "--order",
        type=click.Choice(("4", "6")),
        callback=lambda _, __, value: None if value is None else int(value),
        default=None,
        help="Of the polynomial Wigner distribution.  Default: 6.",
    ),
    click.option(
        "--band-limited",
        is_flag=True,
        help="Limit the signal to its band first (wigner, pseudo-wigner, smoothed-pseudo-wigner): faster.",
    ),
    click.option(
        "--components",
        metavar="auto|N",
        callback=lambda _, __, value: components_of(value),
        default="auto",
        show_default=True,
        help="Oscillations to tell apart: the strongest in the band, and tones beside it, which are taken off; with N "
        "the N strongest have a track and a backbone each.",
    ),
    click.option("--single", is_flag=True, help="Compute these three in single precision."),
    click.option("--remove-bias", is_flag=True, help="Take the estimated bias off the values."),
)
