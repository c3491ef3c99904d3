"""Oscillators that are not analytic at rest, or not linear there: stops, roots, drag in a fluid, dry friction."""

from __future__ import annotations

from typing import Final

from ridgeback.symbolic.systems.entries.entry import Entry

_NAYFEH_MOOK: Final = "A. H. Nayfeh and D. T. Mook, Nonlinear Oscillations, Wiley, New York, 1979"
_MICKENS: Final = "R. E. Mickens, Truly Nonlinear Oscillations, World Scientific, Singapore, 2010"

KINKED: Final = (
    Entry(
        name="bilinear",
        title="Bilinear spring",
        equation="u'' + k1**2*max(u, 0) + k2**2*min(u, 0) = 0",
        values={"k1": "2", "k2": "1"},
        exact="2*k1*k2/(k1 + k2)",
        reference="S. W. Shaw and P. J. Holmes, Journal of Sound and Vibration 90, 129-155, 1983",
        description="Another stiffness on each side: half a cycle takes pi/k1 and half pi/k2, whatever the amplitude.",
    ),
    Entry(
        name="bilinear-stops",
        title="Bilinear oscillator between two stops",
        equation="u'' + 2*mu*u' + k1**2*u + (k2**2 - k1**2)*(max(u - s, 0) + min(u + s, 0)) "
        "+ p*(sign(u - s) + sign(u + s))/2 = 0",
        values={"mu": "1/160", "k1": "1", "k2": "2", "s": "1", "p": "1/8"},
        kind="damped",
        initial=(3.0, 0.0),
        reference="S. W. Shaw and P. J. Holmes, Journal of Sound and Vibration 90, 129-155, 1983",
        description="Linear between two springs at u = s and -s, stretched beforehand with the force p: omega0(t) of a "
        "decay has a kink where the amplitude falls below s, and is k1 from there on.",
        aliases=("stops",),
    ),
    Entry(
        name="kinked-spring",
        title="Linear spring with an odd quadratic part",
        equation="u'' + k**2*u + eps*u*abs(u) = 0",
        values={"k": "1", "eps": "1"},
        reference=_MICKENS,
        description="The frequency rises with the first power of the amplitude: omega0 = 1 + 4 eps A/(3 pi) + ....",
    ),
    Entry(
        name="antisymmetric-constant",
        title="Antisymmetric constant force",
        equation="u'' + sign(u) = 0",
        values={},
        exact="pi/(2*sqrt(2*A))",
        reference=_MICKENS,
        description="A ball bouncing to both sides of rest: parabolas, and a frequency like A^(-1/2).",
    ),
    Entry(
        name="cube-root",
        title="Cube-root oscillator",
        equation="u'' + u**(1/3) = 0",
        values={},
        reference=_MICKENS,
        description="Truly nonlinear and limp: the frequency falls like A^(-1/3), 1.0704505 at A = 1.",
    ),
    Entry(
        name="quadratic",
        title="Odd quadratic oscillator",
        equation="u'' + u*abs(u) = 0",
        values={},
        reference=_MICKENS,
        description="Truly nonlinear: the frequency rises like A^(1/2), 0.9146814 at A = 1.",
    ),
    Entry(
        name="cubic",
        title="Cubic oscillator",
        equation="u'' + u**3 = 0",
        values={},
        exact="A*agm(1, 1/sqrt(2))",
        reference=_MICKENS,
        description="Truly nonlinear: a mass between two springs that are just not stretched; the frequency is "
        "proportional to A.",
    ),
    Entry(
        name="quadratic-damping",
        title="Quadratic damping",
        equation="u'' + c*abs(u')*u' + k**2*u = 0",
        values={"c": "1/50", "k": "1"},
        kind="damped",
        reference=_NAYFEH_MOOK + ", section 3.2",
        description="Drag in a fluid: a'/a = -4 k c a/(3 pi), so that the amplitude falls like 1/t.",
    ),
    Entry(
        name="coulomb-damping",
        title="Dry friction",
        equation="u'' + F*sign(u') + k**2*u = 0",
        values={"F": "1/50", "k": "1"},
        kind="damped",
        reference="J. P. Den Hartog, Transactions of the ASME 53, 107-115, 1931",
        description="Each half cycle takes 2 F/k^2 from the amplitude, until friction holds the mass.",
        aliases=("dry-friction", "friction"),
    ),
)
