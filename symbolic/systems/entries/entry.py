"""One line of the catalogue."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Entry:
    """An oscillator as text.

    Parameters
    ----------
    name, title, equation, reference, description : str
        As of an ``Oscillator``.
    values : dict of str to str
        The default of each parameter.
    kind : str
        As the equation makes it.
    potential : str, optional
        P(u) of the restoring force.
    exact : str, optional
        omega0 in closed form in the peak amplitude A and the parameters; ``agm(x, y)`` is the arithmetic-geometric
        mean.  Of a limit cycle in the small parameter.
    initial : (float, float)
        State (u, u') at time 0.
    aliases : tuple of str
        Other names.
    unit : str
        Of u.
    damped : str, optional
        Name of the twin that has mu = 1/100 by default.
    damped_aliases : tuple of str
        Other names of the twin.
    """

    name: str
    title: str
    equation: str
    values: dict[str, str]
    reference: str
    description: str
    kind: str = "conservative"
    potential: str | None = None
    exact: str | None = None
    initial: tuple[float, float] = (1.0, 0.0)
    aliases: tuple[str, ...] = ()
    unit: str = ""
    damped: str | None = None
    damped_aliases: tuple[str, ...] = field(default=())
