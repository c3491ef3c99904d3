"""What no expansion is derived for, and expansions as JSON and cut to a lower order."""

import pytest
from flint import fmpq, fmpz

from ridgeback.common.errors import InputError
from ridgeback.symbolic.expansion.energy_integral import energy_integral
from ridgeback.symbolic.expansion.lindstedt import lindstedt
from ridgeback.symbolic.flow.multiple_scales import multiple_scales
from ridgeback.symbolic.systems.catalogue import find
from ridgeback.symbolic.systems.oscillator import Oscillator


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: lindstedt(find("pendulum"), -1), "order -1"),
        (lambda: lindstedt(find("pendulum"), 2.5), "whole number"),  # type: ignore[arg-type]
        (lambda: lindstedt(find("pendulum"), 4, amplitude="rms"), "peak or trough or fundamental"),
        (lambda: lindstedt(find("damped-pendulum"), 4), "multiple-scales"),
        (lambda: energy_integral(find("van-der-pol"), 4), "multiple-scales"),
        (lambda: energy_integral(find("pendulum"), 4, amplitude="fundamental"), "peak"),
        (lambda: multiple_scales(find("pendulum"), 4, weight=0), "weight 0"),
        (lambda: lindstedt(find("pendulum"), 4).truncated(5), "order 5"),
        (lambda: lindstedt(find("van-der-pol"), 4, amplitude="action"), "peak or fundamental"),
        (lambda: energy_integral(find("pendulum"), 4).convert("fundamental"), "derive it as 'fundamental'"),
        (lambda: lindstedt(find("pendulum"), 4).difference(lindstedt(find("pendulum"), 4, amplitude="action")), "peak"),
        (lambda: lindstedt(find("pendulum"), 4).difference(lindstedt(find("van-der-pol"), 4)), "in A meets one in eps"),
        (lambda: energy_integral(find("pendulum"), 4).residual(), "no waveform to substitute"),
        (lambda: energy_integral(find("pendulum"), 4).amplitude_as("fundamental"), "derive it as 'fundamental'"),
        (lambda: energy_integral("u'' + u*abs(u) = 0", 4), r"other powers of A, from A\^\(1/2\)"),
        (lambda: lindstedt("u'' + k**2*u + c*u**3 = 0", 2).picture(), "without a value; set them to draw"),
        (lambda: multiple_scales("u'' + k**2*u + c*u**3 = 0", 2).picture(), "without a value; set them to draw"),
        (lambda: lindstedt("u'' + u*sin(c + u) = 0", 2), "sin is taken of a parameter"),
    ],
)
def test_bad_input_says_what_would_work(call, words: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(InputError, match=words) as caught:
        call()
    assert "\n" not in str(caught.value)


def test_public_json_form() -> None:
    assert lindstedt(find("pendulum"), 2).to_dict() == {
        "system": "pendulum",
        "method": "lindstedt",
        "amplitude": "peak",
        "order": 2,
        "variables": ["A"],
        "frequency": [{"powers": {"A": 0}, "coefficient": "1"}, {"powers": {"A": 2}, "coefficient": "-1/16"}],
    }
    cycle = lindstedt(find("van-der-pol"), 2).to_dict()
    assert cycle["variables"] == ["eps"]
    assert cycle["amplitude_series"] == [
        {"powers": {"eps": 0}, "coefficient": "2"},
        {"powers": {"eps": 2}, "coefficient": "1/96"},
    ]


def test_coefficients_of_many_thousand_digits_are_written() -> None:
    own = Oscillator.from_equation("u'' + u + 1e100*u**3 = 0")
    expansion = lindstedt(own, 100)
    (row,) = [row for row in expansion.to_dict()["frequency"] if row["powers"] == {"A": 98}]
    unit = lindstedt(Oscillator.from_equation("u'' + u + u**3 = 0"), 98).coefficients[98]
    numerator, _, denominator = str(row["coefficient"]).partition("/")
    assert len(numerator) > 4300
    scaled = unit * fmpq(10) ** 4900  # omega0 depends on c A^2 alone
    assert (fmpz(numerator), fmpz(denominator or "1")) == (scaled.p, scaled.q)
    assert len(expansion.latex()) > 100_000


@pytest.mark.parametrize("name", ["duffing", "van-der-pol", "helmholtz-duffing"])
def test_a_truncated_expansion_is_the_expansion_of_that_order(name: str) -> None:
    long, short = lindstedt(find(name), 6), lindstedt(find(name), 4)
    cut = long.truncated(4)
    assert (cut.order, cut.coefficients) == (4, short.coefficients)
    assert cut.amplitude_coefficients == short.amplitude_coefficients
    assert cut.waveform is not None
    assert short.waveform is not None
    assert len(cut.waveform) == len(short.waveform)
