"""Array-API code under other libraries than NumPy, where they are installed."""

from __future__ import annotations

import warnings
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from ridgeback.symbolic.codegen import generate
from ridgeback.symbolic.expansion.each_side import energy_on_each_side
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.systems.catalogue import find
from tests.symbolic.generated import load

X = np.linspace(-3.2, 3.2, 101)


def test_jax_gives_the_same_bits_and_a_derivative(tmp_path: Path) -> None:
    """Compiled it fuses products with sums, and differs in the last place; its derivative is the code's own."""
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    module = load(generate(energy_integral(find("pendulum"), 40), "array-api", up_to=Fraction(3)), tmp_path)
    plain = module.omega0(X)
    assert np.array_equal(np.asarray(module.omega0(jax.numpy.asarray(X))), plain, equal_nan=True)
    assert np.allclose(np.asarray(jax.jit(module.omega0)(jax.numpy.asarray(X))), plain, 4e-16, equal_nan=True)
    inside = X[np.abs(X) <= 3]
    slope = jax.vmap(jax.grad(module.omega0))(jax.numpy.asarray(inside))
    assert np.allclose(np.asarray(slope), module.omega0_slope(inside), rtol=0, atol=1e-15)


@pytest.mark.parametrize("system", ["pendulum", "cube-root"])
def test_pytorch_gives_the_same_bits(system: str, tmp_path: Path) -> None:
    torch = pytest.importorskip("torch")
    pytest.importorskip("array_api_compat")
    oscillator = find(system)
    series = energy_integral(oscillator, 40) if system == "pendulum" else energy_on_each_side(oscillator, 2)
    module = load(generate(series, "array-api", up_to=Fraction(3)), tmp_path)
    found, plain = module.omega0(torch.asarray(X)).numpy(), module.omega0(X)
    if system == "pendulum":
        assert np.array_equal(found, plain, equal_nan=True)
    else:  # PyTorch's square root is not always rounded correctly
        assert np.allclose(found, plain, rtol=1e-14, atol=0, equal_nan=True)


@pytest.mark.parametrize("language", ["python", "array-api"])
@pytest.mark.parametrize("domain_end", [Fraction(5, 2), Fraction(3)])
def test_nothing_is_computed_from_what_lies_outside(language: str, domain_end: Fraction, tmp_path: Path) -> None:
    """Infinities and numbers near overflow give nan without a warning, alone and among others."""
    module = load(generate(energy_integral(find("pendulum"), 40), language, up_to=domain_end), tmp_path)
    outside = np.array([np.inf, -np.inf, np.nan, 1.7e308, -1e160, float(domain_end) * (1 + 1e-15)])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for function in (module.omega0, module.omega0_slope):
            assert np.isnan(function(outside)).all()
            assert all(np.isnan(function(np.asarray(value))) for value in outside)
            mixed = function(np.append(outside, 0.5))
            assert mixed[-1] == function(np.asarray(0.5))
