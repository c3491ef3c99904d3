"""The components (7) of a motion by two routes, and the energy that simulate hands over."""

from __future__ import annotations

import csv
import io

import numpy as np
import pytest

from ridgeback.cli import main
from ridgeback.common.errors import InputError
from ridgeback.compare.motion.harmonics.components import components
from ridgeback.compare.motion.motion import integrate_motion, setting
from ridgeback.symbolic.systems.catalogue import find


def test_measured_components_are_those_of_the_undamped_orbit_and_add_up_to_the_motion() -> None:
    for name, start in (("helmholtz-duffing", 0.3), ("duffing-hardening", 1.5), ("toda", 1.0)):
        motion = integrate_motion(setting(find(name), initial=(start, 0.0), duration=60.0), digits=None)
        found = components(motion, count=20)
        assert found.model_error is not None
        assert found.model_error < 1e-8
        # at a peak every cosine is 1
        whole = found.offset + found.amplitude.sum(axis=0)
        assert whole == pytest.approx(np.full(found.time.size, start), rel=1e-9)


def test_a_decay_keeps_the_harmonics_of_its_amplitude_to_first_order_in_the_damping() -> None:
    errors = []
    for mu in ("0.01", "0.001"):
        damped = find("damped-duffing-hardening").with_parameters({"mu": mu})
        found = components(integrate_motion(setting(damped, initial=(1.0, 0.0), duration=60.0), digits=None))
        errors.append(abs(found.amplitude[2] / found.model[2] - 1).max())
    assert errors[1] < 0.2 * errors[0] < 0.02


@pytest.mark.parametrize(("mu", "seen"), [("0.05", [1, 3, 5]), ("0.3", [1])])
def test_what_a_decay_leaks_into_other_multiples_is_no_component(mu: str, seen: list[int]) -> None:
    """An odd force has odd multiples only: what the window finds at the even ones is within its floor."""
    damped = find("damped-pendulum").with_parameters({"k": 3, "mu": mu})
    found = components(integrate_motion(setting(damped, initial=(2.0, 0.0), duration=30.0), digits=None))
    even = np.s_[1::2]
    assert (np.abs(found.amplitude[even]) < 4 * found.floor[even]).all()
    assert [m + 1 for m in range(9) if found.seen[m].any()][: len(seen)] == seen
    assert "a_2" not in found.headline()
    assert ("a_3" in found.headline()) == (3 in seen)


def test_the_velocity_of_rayleigh_has_the_components_of_van_der_pol_and_no_model_is_claimed() -> None:
    found = components(integrate_motion(setting(find("van-der-pol"), initial=(2.0, 0.0), duration=120.0), digits=None))
    # u = 2 cos(t) - (eps/4) sin(3 t) + ...: the third harmonic is a sine, its cosine of second order
    assert found.model is None
    assert found.model_error is None
    assert found.amplitude[0, -1] == pytest.approx(2.0, abs=0.01)
    with pytest.raises(InputError, match="outside 1 to"):
        components(integrate_motion(setting(find("linear"), duration=60.0), digits=None), count=99)


def test_simulate_adds_the_terms_of_the_energy_balance(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["simulate", "damped-pendulum", "--initial", "1,0", "--duration", "5", "--rate", "8", "--energy"]
    assert main(words) == 0
    rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(io.StringIO(capsys.readouterr().out))]
    for row in rows:
        assert row["kinetic_energy"] == pytest.approx(0.5 * row["velocity"] ** 2)  # (16)
        assert row["potential_energy"] == pytest.approx(np.cos(1.0) - np.cos(row["u"]))  # (17), k = 1
        assert abs(row["kinetic_energy"] + row["potential_energy"] + row["dissipated_energy"]) < 1e-11  # (15)
    assert main(["simulate", "van-der-pol", "--energy"]) == 2
    assert "no potential" in capsys.readouterr().err
