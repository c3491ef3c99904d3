"""Oscillators with limit cycles, beside those of van der Pol and Rayleigh."""

from __future__ import annotations

from typing import Final

from ridgeback.symbolic.systems.entries.entry import Entry

SELF_EXCITED: Final = (
    Entry(
        name="rayleigh-van-der-pol",
        title="Rayleigh-van der Pol hybrid",
        equation="u'' - eps*(1 - u**2 - u'**2)*u' + u = 0",
        kind="limit-cycle",
        values={"eps": "1/2"},
        exact="1",
        reference="H. Haken, J. A. S. Kelso and H. Bunz, Biological Cybernetics 51, 347-356, 1985",
        description="Both ways of limiting the growth at once: with equal weights the limit cycle is a circle.",
        aliases=("hybrid",),
    ),
    Entry(
        name="rayleigh-van-der-pol-weighted",
        title="Rayleigh-van der Pol hybrid, weighted",
        equation="u'' - eps*(1 - u**2/2 - u'**2/6)*u' + u = 0",
        kind="limit-cycle",
        values={"eps": "1/2"},
        reference="B. A. Kay, J. A. S. Kelso, E. L. Saltzman and G. Schoener, J. Exp. Psychology 13, 178-192, 1987",
        description="Between van der Pol's and Rayleigh's: amplitude 2 in leading order, as of both.",
    ),
    Entry(
        name="van-der-pol-duffing",
        title="Van der Pol-Duffing oscillator",
        equation="u'' - eps*((1 - u**2)*u' - u**3/4) + u = 0",
        kind="limit-cycle",
        values={"eps": "1/10"},
        reference="A. H. Nayfeh and D. T. Mook, Nonlinear Oscillations, Wiley, New York, 1979",
        description="A hardening spring under van der Pol's excitation: it shifts the frequency in first order.",
    ),
)
