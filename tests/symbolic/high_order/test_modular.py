"""Many primes make the same rationals as exact arithmetic, in one process or several."""

import json
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ridgeback.common.errors import InputError
from ridgeback.common.hashed_lines import write_signed
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.high_order.by_primes import lindstedt_by_primes, primes, rational, residues
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator


@pytest.mark.parametrize("name", ["pendulum", "duffing-softening", "helmholtz-duffing", "van-der-pol", "rayleigh"])
@pytest.mark.parametrize("amplitude", ["peak", "fundamental"])
def test_the_primes_give_the_exact_series(name: str, amplitude: str) -> None:
    exact = lindstedt(find(name), 20, amplitude=amplitude)
    modular = lindstedt_by_primes(find(name), 20, amplitude=amplitude)
    assert modular.frequency == exact.frequency
    assert modular.amplitude_series == exact.amplitude_series


def test_the_natural_frequency_travels_with_the_series() -> None:
    fast = find("van-der-pol").with_parameters({"k": 3})
    assert lindstedt_by_primes(fast, 6).frequency == lindstedt(fast, 6).frequency


@pytest.mark.parametrize("pool", [ProcessPoolExecutor, ThreadPoolExecutor])
def test_any_executor_serves(pool: type) -> None:
    told: list[tuple[float, str]] = []
    with pool(2) as executor:
        series = lindstedt_by_primes(
            find("van-der-pol"), 12, executor=executor, workers=2, progress=lambda *step: told.append(step)
        )
    assert series.frequency == lindstedt(find("van-der-pol"), 12).frequency
    assert told[-1][0] == 1.0
    assert all(share < 1.0 for share, _ in told[:-1])


def test_a_corrupted_residue_is_not_accepted(monkeypatch: pytest.MonkeyPatch) -> None:
    # One wrong prime among the first makes every later reconstruction disagree with the primes kept back.
    import ridgeback.symbolic.high_order.by_primes as module

    calls = iter(range(10**6))

    def corrupt(oscillator, order, amplitude, prime):  # type: ignore[no-untyped-def]
        found = residues(oscillator, order, amplitude, prime)
        if next(calls) == 2:
            wrong = (*found.frequency[:-1], (found.frequency[-1] + 1) % prime)
            found = module.Residues(found.prime, wrong, found.amplitude)
        if next(calls) > 60:
            raise TimeoutError
        return found

    monkeypatch.setattr(module, "residues", corrupt)
    with pytest.raises(TimeoutError):
        lindstedt_by_primes(find("duffing"), 6)


@given(st.fractions(max_denominator=10**9, min_value=-(10**9), max_value=10**9))
@settings(max_examples=200, deadline=None)
def test_rational_reconstruction_inverts_reduction(value: Fraction) -> None:
    first, second = (p for p, _ in zip(primes(), range(2), strict=False))
    modulus = first * second
    found = rational(value.numerator * pow(value.denominator, -1, modulus) % modulus, modulus)
    assert found is not None
    assert (int(found.p), int(found.q)) == (value.numerator, value.denominator)


def test_symbolic_parameters_are_refused() -> None:
    with pytest.raises(InputError, match="is no rational number; the primes need one"):
        lindstedt_by_primes(Oscillator.from_equation("u'' + u + c*u**3"), 4)


Lines = list[Any]


def one_more_prime(lines: Lines) -> None:
    lines[0]["used"] += 1


def another_residue(lines: Lines) -> None:
    lines[1][0][1][2] += 1


def a_value_beyond_its_modulus(lines: Lines) -> None:
    lines[2] = lines[0]["modulus"]


def a_coefficient_less(lines: Lines) -> None:
    lines[0]["values"] -= 1


def another_order(lines: Lines) -> None:
    lines[0]["identity"]["order"] = "31"


@pytest.mark.parametrize(
    ("forge", "order", "what"),
    [
        (one_more_prime, 30, "number of primes"),
        (another_residue, 30, "computation"),
        (a_value_beyond_its_modulus, 30, "computation"),
        (a_coefficient_less, 30, "order"),
        (another_order, 31, "order"),
    ],
)
def test_a_forged_claim_is_caught_by_the_numbers(
    forge: Callable[[Lines], None], order: int, what: str, tmp_path: Path
) -> None:
    path, vdp = tmp_path / "state", find("van-der-pol")

    def interrupt(_: float, step: str) -> None:
        if int(step.split(maxsplit=1)[0]) > 300:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        lindstedt_by_primes(vdp, 30, checkpoint=path, progress=interrupt)
    lines = [json.loads(line) for line in path.read_text().splitlines()[:-1]]
    forge(lines)
    write_signed(path, [json.dumps(line) + "\n" for line in lines])
    with pytest.raises(InputError, match=f"claims another {what}"):
        lindstedt_by_primes(vdp, order, checkpoint=path)


@pytest.mark.parametrize("line", [1, 6])
def test_a_forged_residue_does_not_run_for_ever(line: int, tmp_path: Path) -> None:
    """One wrong number among the residues: no modulus ever suits it, and after a while they are found again."""
    path, vdp = tmp_path / "state", find("van-der-pol")
    lindstedt_by_primes(vdp, 8, checkpoint=path)
    lines = [json.loads(text) for text in path.read_text().splitlines()[:-1]]
    if line == 1:
        lines[1][1][1][4] += 1
    else:
        lines[line] = f"{int(lines[line], 16) + 1:x}"
    write_signed(path, [json.dumps(text) + "\n" for text in lines])
    with pytest.raises(InputError, match="claims other residues modulo"):
        lindstedt_by_primes(vdp, 8, checkpoint=path)


def test_a_finished_run_leaves_its_state_to_the_caller(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import ridgeback.symbolic.high_order.by_primes as module

    path, vdp, used = tmp_path / "state", find("van-der-pol"), list[int]()
    first = lindstedt_by_primes(vdp, 20, checkpoint=path)

    def counted(*given: Any) -> Any:
        used.append(given[-1])
        return residues(*given)

    monkeypatch.setattr(module, "residues", counted)
    assert lindstedt_by_primes(vdp, 20, checkpoint=path).frequency == first.frequency
    assert used == [next(primes())]  # found again to test the file; everything else is in it
