"""Oscillators whose force holds the velocity: masses that vary with place, relativity, centres without a potential."""

from __future__ import annotations

from typing import Final

from ridgeback.symbolic.systems.entries.entry import Entry

MOVING_MASS: Final = (
    Entry(
        name="mathews-lakshmanan",
        title="Mathews-Lakshmanan oscillator",
        equation="u'' + (u - h*u*u'**2)/(1 + h*u**2) = 0",
        values={"h": "1"},
        exact="1/sqrt(1 + h*A**2)",
        reference="P. M. Mathews and M. Lakshmanan, Quarterly of Applied Mathematics 32, 215-218, 1974",
        description="A mass that falls with the distance; its motion is a pure cosine at every amplitude.",
    ),
    Entry(
        name="parabola",
        title="Particle on a parabola",
        equation="u'' + (u + h*u*u'**2)/(1 + h*u**2) = 0",
        values={"h": "1"},
        reference="A. H. Nayfeh and D. T. Mook, Nonlinear Oscillations, Wiley, New York, 1979",
        description="The distance from the axis of a bead that slides on a rotating parabola.",
    ),
    Entry(
        name="beam",
        title="Inextensible beam, first mode",
        equation="u'' + (u + alpha*u*u'**2 + beta*u**3)/(1 + alpha*u**2) = 0",
        values={"alpha": "1/2", "beta": "1"},
        reference="M. N. Hamdan and N. H. Shabaneh, Journal of Sound and Vibration 199, 711-736, 1997",
        description="A slender cantilever: inertia and stiffness both grow with the deflection.",
    ),
    Entry(
        name="bubble",
        title="Gas bubble in a liquid",
        equation="u'' + 3*u'**2/(2*(1 + u)) + (1 - (1 + u)**(-4))/(4*(1 + u)) = 0",
        values={},
        reference="M. S. Plesset and A. Prosperetti, Annual Review of Fluid Mechanics 9, 145-185, 1977",
        description="Rayleigh and Plesset's radius, without viscosity and surface tension, of a gas with exponent 4/3.",
        initial=(0.3, 0.0),
        aliases=("rayleigh-plesset",),
    ),
    Entry(
        name="relativistic",
        title="Relativistic oscillator",
        equation="u'' + u*(1 - h*u'**2)**(3/2) = 0",
        values={"h": "1"},
        reference="R. E. Mickens, Journal of Sound and Vibration 212, 905-908, 1998",
        description="A linear spring on a body whose speed stays below that of light, 1/sqrt(h).",
    ),
    Entry(
        name="modified-emden",
        title="Modified Emden oscillator",
        equation="u'' + 3*u*u' + u**3 + u = 0",
        kind="reversible",
        values={},
        exact="1",
        reference="V. K. Chandrasekar, M. Senthilvelan and M. Lakshmanan, Physical Review E 72, 066203, 2005",
        description="Isochronous, with terms that look like damping: a symmetry closes its orbits.",
        initial=(0.5, 0.0),
    ),
    Entry(
        name="reversible",
        title="Quadratic reversible centre",
        equation="u'' + u*u' + u = 0",
        kind="reversible",
        values={},
        reference="R. L. Devaney, Transactions of the American Mathematical Society 218, 89-113, 1976",
        description="A centre without a potential: (u, t) to (-u, -t) maps motions to motions.",
        initial=(0.5, 0.0),
    ),
)
