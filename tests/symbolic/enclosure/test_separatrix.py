"""Amplitudes up to the separatrix, and where a family of orbits ends otherwise."""

import pytest
from flint import arb

from ridgeback.common.errors import InputError
from ridgeback.symbolic.enclosure.enclosure import enclose, separatrix
from tests.symbolic.enclosure.own import near, own


@pytest.mark.parametrize(
    ("text", "peak", "trough"),
    [
        ("u'' + sin(u)", "3.14159265358979323846", "-3.14159265358979323846"),
        ("u'' + u - 4*u**3", "0.5", "-0.5"),
        ("u'' + u + u**2", "0.5", "-1"),
        ("u'' + u - u**2", "1", "-0.5"),
        ("u'' + u*(1 - u)**2", "1", "-0.33333333333333333333"),
        ("u'' + u + u**3", None, None),
        ("u'' + sinh(u)", None, None),
        ("u'' + u*(1 - u)*(u + 2)/2", "1", "-0.61257411327721"),
    ],
)
def test_separatrix(text: str, peak: str | None, trough: str | None) -> None:
    found = separatrix(own(text))
    assert (found.peak is None) == (peak is None)
    if peak is not None and trough is not None:
        assert near(found.peak, arb(peak) + arb(0, "1e-12"), 50)
        assert near(found.trough, arb(trough) + arb(0, "1e-12"), 50)
        assert found.saddle.overlaps(found.peak) or found.saddle.overlaps(found.trough)


@pytest.mark.parametrize(
    ("text", "below", "at"),
    [
        ("u'' + u - u**3", "0.999999999999", "1"),
        ("u'' + u + u**2", "0.499999999999", "0.5"),
        ("u'' + u*(1 - u)**2", "0.9999", "1"),
        ("u'' + sin(u)", "3.141592653589", "3.1416"),
        ("u'' + sin(u) + u**2/10", "1.6905", "1.7"),
    ],
)
def test_amplitudes_are_taken_up_to_the_separatrix_and_refused_at_it(text: str, below: str, at: str) -> None:
    system = own(text)
    slow = enclose(system, below, bits=53)
    assert slow.omega > 0
    assert slow.omega < enclose(system, "0.1").omega
    limit = float(separatrix(system).peak)
    for beyond in (at, "1000"):
        with pytest.raises(InputError, match=rf"at or beyond the separatrix at {limit:.10g}; use less"):
            enclose(system, beyond)


def test_a_barrier_on_the_far_side_counts() -> None:
    """Left of the well of u + u^2 the saddle at -1 is met first, though the peak side has no barrier at all."""
    assert separatrix(own("u'' + u + u**2")).saddle == -1
    with pytest.raises(InputError, match=r"separatrix at 0\.5"):
        enclose(own("u'' + u + u**2"), "0.75")


def test_a_singular_force_ends_the_family() -> None:
    assert enclose(own("u'' + tan(u)"), "1.57").omega > 3
    with pytest.raises(InputError, match="not analytic on the way"):
        enclose(own("u'' + tan(u)"), "1.6")


def test_a_potential_that_saturates_turns_nothing_back() -> None:
    """Morse: V < 1/2 on the right, so an orbit from the left returns only from above u = -log 2."""
    morse = own("u'' + (1 - exp(-u))*exp(-u)")
    assert enclose(morse, "3").omega > 0
    assert enclose(morse, "0.69", definition="trough").omega > 0
    with pytest.raises(InputError, match="does not rise as high on the other side"):
        enclose(morse, "2", definition="trough")


def test_what_cannot_be_decided_is_said_to_be() -> None:
    """sin(u)(1 - sin(u)) touches 0 at pi/2 without crossing it: no interval test can prove that."""
    with pytest.raises(InputError, match="cannot decide"):
        separatrix(own("u'' + sin(u) + cos(2*u)/2 - 1/2"))
