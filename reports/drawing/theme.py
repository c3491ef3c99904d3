"""Colours, sizes and fonts of a page: one table of tokens, used as CSS variables by text and figures alike.

The page's drawings name classes, which its style sheet colours by these variables, so that one drawing serves the light
page, the dark page and the printer; pictures that stand by themselves are drawn in the light page's colours.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

# token: (light, dark).  s1..s5 are series, b0..b5 bands from good to bad (good recedes into the page), E, S, T the
# three ways (expansions, series model, estimates), pos and neg the signs of a plane, shade what an error leaves out.
TOKENS: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "bg": ("#FFFFFF", "#14171A"),
        "fg": ("#1B1F24", "#E6E9ED"),
        "muted": ("#5B6470", "#9AA4B0"),
        "grid": ("#DDE1E6", "#30363D"),
        "link": ("#0B57A4", "#7DBBF5"),
        "card": ("#F6F7F9", "#1C2025"),
        "s1": ("#0F3C6E", "#4A86C5"),
        "s2": ("#B5501A", "#E09A55"),
        "s3": ("#1D7B6D", "#7BE8CA"),
        "s4": ("#985AC3", "#CBBCE6"),
        "s5": ("#501829", "#E5497F"),
        "b0": ("#F3F7FA", "#1B232B"),
        "b1": ("#CFE3EE", "#20405C"),
        "b2": ("#92C1DC", "#27628F"),
        "b3": ("#4E95C3", "#3E8BC0"),
        "b4": ("#22639D", "#7DB7DD"),
        "b5": ("#10386B", "#CFE6F4"),
        "E": ("#B5501A", "#E09A55"),
        "S": ("#0F3C6E", "#6FA8E0"),
        "T": ("#1D7B6D", "#7BE8CA"),
        "pos": ("#10386B", "#8CC4F0"),
        "neg": ("#B5501A", "#E09A55"),
        "shade": ("#F1F3F5", "#1B1F23"),
    }
)

SERIES = ("s1", "s2", "s3", "s4", "s5")

# Text is always measured in DejaVu Sans, which matplotlib ships: it is wider than the fonts that a
# browser takes for system-ui, so a label that fits when measured also fits on the page.
DRAWING: Mapping[str, object] = MappingProxyType(
    {
        "svg.fonttype": "none",
        "svg.hashsalt": "ridgeback",
        "svg.image_inline": True,
        "font.family": ["DejaVu Sans"],
        "font.size": 10.0,
        "axes.labelsize": 10.0,
        "xtick.labelsize": 10.0,
        "ytick.labelsize": 10.0,
        "axes.linewidth": 0.8,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.unicode_minus": True,
        "axes.axisbelow": True,
        "lines.linewidth": 1.8,
        "lines.solid_joinstyle": "round",
        "grid.linewidth": 0.6,
        "hatch.linewidth": 0.6,
        "path.simplify": True,
        "path.simplify_threshold": 0.3,
        "agg.path.chunksize": 0,
        "text.usetex": False,
        "text.parse_math": False,  # a dollar in a name is a dollar
        "figure.dpi": 72.0,
        "savefig.dpi": 72.0,
    }
)


@dataclass(frozen=True)
class Variant:
    """One of the two drawings of a figure; sizes in inches, 72 SVG units each."""

    name: str
    width: float
    height: float


WIDE = Variant(name="wide", width=7.6, height=4.2)
NARROW = Variant(name="narrow", width=3.75, height=3.6)


def colour_of(token: str) -> str:
    """The light page's colour of a token, for pictures that stand by themselves.

    >>> colour_of("bg")
    '#FFFFFF'
    """
    return TOKENS[token][0]


def _declarations(theme: int) -> str:
    return "".join(f"--{token}:{colours[theme]};" for token, colours in TOKENS.items())


def variables_css() -> str:
    """Return the CSS that sets all tokens: light always, dark on a screen that prefers it (never in print).

    >>> variables_css().startswith(":root{--bg:#FFFFFF;")
    True
    """
    light = f":root{{{_declarations(0)}}}"
    dark = f"@media screen and (prefers-color-scheme:dark){{:root{{{_declarations(1)}}}}}"
    return f"{light}\n{dark}\n"
