"""Labels beside the ends of curves, moved apart so that none covers another, each led to its curve."""

from __future__ import annotations

from collections.abc import Sequence

WIDTHS = {"narrow": "iIl.,:;'|!()[] ·/", "wide": "mwMW—–ωΣ@%"}


def apart(wanted: Sequence[float], step: float, low: float, high: float) -> list[float]:
    """Places at least ``step`` apart between ``low`` and ``high``, in the order of the wanted ones, moved little.

    >>> apart([50.0, 0.0, 1.0], 10.0, 0.0, 60.0)
    [50.0, 0.0, 10.0]
    """
    order = sorted(range(len(wanted)), key=lambda i: wanted[i])
    step = min(step, (high - low) / max(len(wanted) - 1, 1))
    placed = [min(max(wanted[i], low), high) for i in order]
    for _ in range(200):
        moved = False
        for j in range(len(placed) - 1):
            lack = step - (placed[j + 1] - placed[j])
            if lack > 1e-6:
                placed[j] -= lack / 2
                placed[j + 1] += lack / 2
                moved = True
        placed = [min(max(y, low), high) for y in placed]
        if not moved:
            break
    for j in range(1, len(placed)):
        placed[j] = max(placed[j], placed[j - 1] + step)
    over = max(0.0, placed[-1] - high) if placed else 0.0
    ceiling = high
    for j in range(len(placed) - 1, -1, -1) if over else ():
        placed[j] = min(placed[j], ceiling)
        ceiling = placed[j] - step
    result = [0.0] * len(placed)
    for j, i in enumerate(order):
        result[i] = round(placed[j], 6)
    return result


def text_width(words: str, size: float = 13.5) -> float:
    """About how wide a text is set, in pixels.

    >>> text_width("mm") > text_width("ii")
    True
    """
    shares = (0.32 if c in WIDTHS["narrow"] else 0.86 if c in WIDTHS["wide"] else 0.58 for c in words)
    return size * sum(shares)
