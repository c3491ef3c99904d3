"""The classical oscillators; parameters are in natural units (k = 1) unless others are given."""

from __future__ import annotations

from math import pi
from typing import Final

from ridgeback.symbolic.systems.entries.entry import Entry

_NAYFEH_MOOK: Final = "A. H. Nayfeh and D. T. Mook, Nonlinear Oscillations, Wiley, New York, 1979"
_GALLEANI_COHEN: Final = "L. Galleani and L. Cohen, The pendulum: a time-frequency model"
_KOVACIC_BRENNAN: Final = (
    "I. Kovacic and M. J. Brennan (eds), The Duffing Equation: Nonlinear Oscillators and their Behaviour, "
    "Wiley, Chichester, 2011"
)
_VAN_DER_POL: Final = (
    "B. van der Pol, On relaxation-oscillations, The London, Edinburgh, and Dublin Philosophical Magazine and "
    "Journal of Science, Series 7, 2(11), 978-992, 1926"
)
_RAYLEIGH: Final = (
    "Lord Rayleigh, On maintained vibrations, The London, Edinburgh, and Dublin Philosophical Magazine and "
    "Journal of Science, Series 5, 15(94), 229-235, 1883"
)


CLASSICAL: Final = (
    Entry(
        name="linear",
        title="Linear oscillator",
        equation="u'' + 2*mu*u' + k**2*u = 0",
        potential="k**2*u**2/2",
        values={"mu": "0", "k": "1"},
        reference=_NAYFEH_MOOK + ", section 1.1",
        description="The frequency does not depend on the amplitude; with damping it is sqrt(k^2 - mu^2).",
        exact="k",
        aliases=("harmonic", "linear-oscillator"),
        damped="damped-linear",
        damped_aliases=("linear-damped",),
    ),
    Entry(
        name="pendulum",
        title="Pendulum",
        equation="theta'' + 2*mu*theta' + k**2*sin(theta) = 0",
        potential="k**2*(1 - cos(theta))",
        values={"mu": "0", "k": "1"},
        reference=_GALLEANI_COHEN + ", eq. (1)",
        description="Softening: the frequency falls with the amplitude and vanishes at the separatrix, A = pi.",
        exact="k*agm(1, cos(A/2))",
        initial=(0.95 * pi, 0.0),
        aliases=("simple-pendulum",),
        unit="rad",
        damped="damped-pendulum",
        damped_aliases=("pendulum-damped",),
    ),
    Entry(
        name="duffing-hardening",
        title="Duffing oscillator, hardening",
        equation="u'' + 2*mu*u' + k**2*u + eps*u**3 = 0",
        potential="k**2*u**2/2 + eps*u**4/4",
        values={"mu": "0", "k": "1", "eps": "1"},
        reference=_KOVACIC_BRENNAN + ", chapter 2",
        description="The frequency rises with the amplitude; there is no separatrix.",
        exact="agm(sqrt(k**2 + eps*A**2), sqrt(k**2 + eps*A**2/2))",
        aliases=("duffing", "hardening-duffing"),
        damped="damped-duffing-hardening",
        damped_aliases=("damped-duffing", "duffing-damped"),
    ),
    Entry(
        name="duffing-softening",
        title="Duffing oscillator, softening",
        equation="u'' + 2*mu*u' + k**2*u + eps*u**3 = 0",
        potential="k**2*u**2/2 + eps*u**4/4",
        values={"mu": "0", "k": "1", "eps": "-1"},
        reference=_KOVACIC_BRENNAN + ", chapter 2",
        description="The frequency falls with the amplitude and vanishes at the saddles, A = k/sqrt(-eps).",
        exact="agm(sqrt(k**2 + eps*A**2), sqrt(k**2 + eps*A**2/2))",
        initial=(0.9, 0.0),
        aliases=("softening-duffing",),
        damped="damped-duffing-softening",
    ),
    Entry(
        name="helmholtz-duffing",
        title="Helmholtz-Duffing oscillator",
        equation="u'' + 2*mu*u' + k**2*u + alpha2*u**2 + alpha3*u**3 = 0",
        potential="k**2*u**2/2 + alpha2*u**3/3 + alpha3*u**4/4",
        values={"mu": "0", "k": "1", "alpha2": "1", "alpha3": "1"},
        reference=_KOVACIC_BRENNAN + ", chapter 2; " + _NAYFEH_MOOK + ", section 2.3.1",
        description=(
            "Quadratic and cubic stiffness: unequal turning points and a mean offset.  With the default values the "
            "well is single (alpha2^2 < 4 k^2 alpha3), so every amplitude oscillates."
        ),
        aliases=("helmholtz", "duffing-helmholtz"),
        damped="damped-helmholtz-duffing",
    ),
    Entry(
        name="van-der-pol",
        title="Van der Pol oscillator",
        equation="u'' - eps*(1 - u**2)*u' + k**2*u = 0",
        kind="limit-cycle",
        values={"eps": "1/2", "k": "1"},
        reference=_VAN_DER_POL,
        description="Self-excited: every orbit approaches a limit cycle of amplitude near 2; expanded in eps.",
        initial=(2.0, 0.0),
        aliases=("vdp",),
    ),
    Entry(
        name="rayleigh",
        title="Rayleigh oscillator",
        equation="u'' - eps*(1 - u'**2/3)*u' + k**2*u = 0",
        kind="limit-cycle",
        values={"eps": "1/2", "k": "1"},
        reference=_RAYLEIGH,
        description="Self-excited; its velocity obeys the van der Pol equation when k = 1, so their frequencies agree.",
        initial=(2.0, 0.0),
        aliases=("lord-rayleigh",),
    ),
)
