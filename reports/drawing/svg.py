"""A drawn canvas as inline SVG: themed, small, with ids of its own, and with a name for those who cannot see it."""

from __future__ import annotations

import io
import re
from functools import partial

from markupsafe import escape

from ridgeback.reports.drawing.canvas import Canvas
from ridgeback.reports.drawing.theme import SENTINELS

_NO_METADATA = dict.fromkeys(("Creator", "Date", "Format", "Type"))
# Written as references inside texts, so that no label can look like an attribute, a colour or a style.
_GUARD = {ord(letter): f"&#{ord(letter)};" for letter in '"#:'}
_REFERENCE = re.compile(r'(?:url\(#|xlink:href="#|href="#)([^")]+)')


def to_svg(canvas: Canvas, *, prefix: str, title: str, description: str) -> str:
    """Return one ``<svg>`` element, ready to stand in a page among others (``prefix`` keeps its ids apart)."""
    text = _raw(canvas)
    text = re.sub(r"^.*?(?=<svg)", "", text, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->|<metadata>.*?</metadata>|<defs>\s*<style.*?</defs>", "", text, flags=re.DOTALL)
    text = _theme(text)
    text = _classes(text)
    for key, markup in canvas.inserts.items():
        text = re.sub(rf'<g id="{re.escape(key)}">.*?</g>', partial(_constant, markup), text, flags=re.DOTALL)
    text = _own_ids(text, prefix)
    text = _compact(text)
    return _head(text, canvas, prefix=prefix, title=title, description=description)


def _constant(text: str, _: re.Match[str]) -> str:
    return text


def _prefixed(prefix: str, found: re.Match[str]) -> str:
    return prefix + found[1]


def _raw(canvas: Canvas) -> str:
    stream = io.StringIO()
    canvas.figure.savefig(stream, format="svg", metadata=_NO_METADATA)
    return re.sub(r">[^<]+<", lambda found: found[0].translate(_GUARD), stream.getvalue())


def _theme(text: str) -> str:
    return re.sub(r"#01fe[0-9a-f]{2}", lambda match: SENTINELS[match.group()], text)


def _classes(text: str) -> str:
    """Turn ``id="class:a b"`` into ``class="a b"`` and the font of every text into the page's own."""
    text = re.sub(r'id="class:([^"]*)"', r'class="\1"', text)
    text = re.sub(r"font: (?:(\d+(?:\.\d+)?)px) [^;\"]*(;?\s*)", r"font-size:\1px\2", text)
    return re.sub(r"(?:font-family|font-stretch|font-style|font-variant|font-weight): [^;\"]*;?\s*", "", text)


def _own_ids(text: str, prefix: str) -> str:
    used = set(_REFERENCE.findall(text))
    text = re.sub(r' id="([^"]*)"', lambda m: f' id="{prefix}-{m[1]}"' if m[1] in used else "", text)
    for opening in ("url(#", 'xlink:href="#'):
        text = re.sub(re.escape(opening) + r"(?!shared-)([^\")]+)", partial(_prefixed, f"{opening}{prefix}-"), text)
    return text.replace('xlink:href="', 'href="')


def _compact(text: str) -> str:
    def rounded(match: re.Match[str]) -> str:
        return f"{round(float(match.group()), 2) + 0.0:.2f}".rstrip("0").rstrip(".")

    def tenths(match: re.Match[str]) -> str:
        """Paths to a tenth of a point, a seventh of a pixel: finer than the line is wide by an order."""
        return f"{round(float(match.group()), 1) + 0.0:.1f}".removesuffix(".0")

    def attribute(match: re.Match[str]) -> str:
        value = re.sub(r"-?\d+\.\d+", tenths if match[1] == "d" else rounded, match[2])
        if match[1] == "d":
            value = re.sub(r"\s*([MLHVCQZz])\s*", r"\1", value).strip()
        if match[1] == "style":
            value = re.sub(r"([:;]) ", r"\1", value)
        return f' {match[1]}="{value}"'

    text = re.sub(r'\s(d|x|y|width|height|transform|style)="([^"]*)"', attribute, text)
    text = re.sub(r' transform="rotate\(-0[^"]*"', "", text)
    text = re.sub(r">\s+<", "><", text)
    while "<g></g>" in text:
        text = text.replace("<g></g>", "")
    return text.strip()


def _head(text: str, canvas: Canvas, *, prefix: str, title: str, description: str) -> str:
    width, height = canvas.figure.get_size_inches() * 72
    opening = (
        f'<svg class="{canvas.variant.name}" viewBox="0 0 {width:g} {height:g}" role="img" '
        f'aria-labelledby="{prefix}-t {prefix}-d"><title id="{prefix}-t">{escape(title)}</title>'
        f'<desc id="{prefix}-d">{escape(description)}</desc>'
    )
    return re.sub(r"^<svg[^>]*>", lambda _: opening, text)
