"""The share of intervals that hold, and between which shares the true one lies."""

from __future__ import annotations

from scipy.stats import beta

LIMITS = 92.0, 98.0
"""Where the share that holds is to lie, in per cent."""


def bounds(share: float, count: float) -> tuple[float, float]:
    """Between which shares the true one lies at 95 %, where ``share`` of ``count`` independent trials hold.

    The exact interval of Clopper and Pearson, Biometrika 26 (1934) 404; ``count`` need not be whole (Korn and Graubard,
    Survey Methodology 24 (1998) 193).

    >>> [round(bound, 3) for bound in bounds(0.9, 10)], bounds(1.0, 10)[1]
    ([0.555, 0.997], 1.0)
    """
    held = share * count
    low = float(beta.ppf(0.025, held, count - held + 1)) if share > 0.0 else 0.0
    high = float(beta.ppf(0.975, held + 1, count - held)) if share < 1.0 else 1.0
    return low, high


def written(share: float, count: float) -> str:
    """A share in per cent with its interval, in bold where that does not meet the limits.

    >>> written(0.95, 100), written(0.7, 100)
    ('95 (89 to 98)', '**70 (60 to 79)**')
    """
    low, high = (100 * bound for bound in bounds(share, count))
    text = f"{100 * share:.0f} ({low:.0f} to {high:.0f})"
    return text if low <= LIMITS[1] and high >= LIMITS[0] else f"**{text}**"
