"""Time-frequency planes: a spectrogram's level, and the Wigner distribution with its sign and its ridge."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ridgeback.common.numbers import decibels, minus, per_cent
from ridgeback.common.quantities import frequency
from ridgeback.compare.motion.harmonics.folding import Folding, folded, folded_sentence
from ridgeback.compare.motion.results import Curve, Image, MotionComparison, SignedPlane
from ridgeback.numeric.arrays import Array
from ridgeback.reports.drawing.apart import text_width
from ridgeback.reports.drawing.figure import Figure
from ridgeback.reports.drawing.marks import curve, drawing, group, line, places, rect, text, trace
from ridgeback.reports.drawing.panel import Panel
from ridgeback.reports.drawing.raster import mask_uri
from ridgeback.reports.drawing.scale import Scale, round_values
from ridgeback.reports.figures.clock import Clock, shown

SIZE = (500.0, 372.0)
APART, CLEAR_DB = 0.35, 3.0
"""A multiple is a ridge where its level is so much above that this share of the fundamental away, on both sides."""
SEEN = 0.5
"""Pixels from which on a distance of ridge and reference is worth enlarging."""
FOLDED = "rd d2 nf"
"""Style of a line of a folded multiple."""
PLACES = np.linspace(0.05, 0.95, 19)
"""Shares of a folded line at which its name may stand."""
WIDE, HIGH, ABOVE, CLEAR, MARGIN = 92.0, 14.0, 7.0, 16.0, 34.0
"""Pixels: what such a name takes, how far it is above its line and from others, what names at the right take."""
MOST = 7
"""Highest multiple of the fundamental that is marked."""


def planes(decay: MotionComparison) -> Figure:
    """Spectrogram and Wigner distribution of the motion, side by side."""
    clock = Clock(decay.case.time_unit)
    span = (float(decay.time[0]), float(decay.time[-1]))
    image = decay.spectrogram_velocity if decay.folding.folded else decay.spectrogram_u
    strong = _strong(decay, image)
    left = level_plane("spectrogram", image, clock, span, decay.reference, strong, decay.folding)
    right = signed_plane("wigner", decay.wigner_u, clock, span, decay.interior)
    return Figure(
        key="planes",
        wide=left + right,
        narrow="",
        caption=_caption(decay, image, strong),
        many="two",
        label="Spectrogram and Wigner distribution",
        data={
            "planes": [_level_data(image, clock, span), _signed_data(decay.wigner_u, clock, span)],
            "link": "time",
            "unit": clock.time_unit,
        },
    )


def _level_data(image: Image, clock: Clock, span: tuple[float, float]) -> dict[str, object]:
    """What reads a plane of levels: its places, its ranges, its floor."""
    return {**_plane_data(image, clock, span), "floor": image.floor_db}


def _signed_data(plane: SignedPlane, clock: Clock, span: tuple[float, float]) -> dict[str, object]:
    """The same of a plane with signs, whose scale has a knee."""
    return {**_plane_data(plane, clock, span), "knee": plane.knee}


def _plane_data(plane: Image | SignedPlane, clock: Clock, span: tuple[float, float]) -> dict[str, object]:
    panel = _frame(span, plane.omega, clock)
    (t0, t1), (w0, w1) = _edges(plane.time), _edges(plane.omega * clock.factor)
    return {"box": panel.box(), "time": [t0, t1], "frequency": [w0, w1], "unit": clock.unit}


def record_data(image: Image, clock: Clock, span: tuple[float, float]) -> dict[str, object]:
    """What reads the one plane of a recording."""
    return {"planes": [_level_data(image, clock, span)], "link": "time", "unit": clock.time_unit}


def _strong(decay: MotionComparison, image: Image) -> list[int]:
    """Multiples of the fundamental that are ridges of the spectrogram: leakage of a stronger one falls off sideways."""
    known = decay.reference.valid & np.isfinite(decay.reference.omega)
    omega = np.interp(image.time, decay.reference.time[known], decay.reference.omega[known])
    found = []
    for multiple in range(1, MOST + 1):
        if multiple * float(omega.max()) < float(image.omega[-1]):
            here, below, above = (
                image.level_db[_nearest(image.omega, (multiple + shift) * omega), np.arange(image.time.size)]
                for shift in (0.0, -APART, APART)
            )
            stands_out = float(np.median(here - np.maximum(below, above))) > CLEAR_DB
            if float(np.median(here)) > image.floor_db + 8 and (multiple == 1 or stands_out):
                found.append(multiple)
    return found


def _nearest(axis: Array, values: Array) -> NDArray[np.intp]:
    """Rows of an axis nearest to values."""
    return np.asarray(np.abs(axis[:, None] - values[None, :]).argmin(axis=0))


def _caption(decay: MotionComparison, image: Image, strong: Sequence[int]) -> str:
    listed = ", ".join(f"{m} ω₀" for m in strong if m > 1)
    first = f"Left: {image.note.split('.  ')[0]}; thin lines are multiples of the reference"
    first += f", {listed} standing out." if listed else "; no harmonic stands out."
    first += _folded(decay)
    bias = _bias(decay)
    return (
        f"{first} Shaded: the window would leave the record. Right: blue positive, orange negative, fringes are cross "
        f"terms; dashed the reference, thick the ridge{bias}."
    )


def _folded(decay: MotionComparison) -> str:
    """Which multiples the sampling folds, and which rates would fold the two highest alone."""
    if not decay.folding.folded:
        return ""
    unit = decay.case.time_unit
    said = folded_sentence(decay.folding, lambda omega: frequency(omega, unit), unit)
    return f" Dashed: multiples beyond half the sampling rate, where they are folded back to. {said}"


def _bias(decay: MotionComparison) -> str:
    bias = decay.wigner_bias
    if bias is None or bias.measured is None or abs(bias.measured) < 1e-4:
        return ""
    return f", on average {per_cent(abs(bias.measured))} {'below' if bias.measured < 0 else 'above'} it"


def _frame(span: tuple[float, float], omega: Array, clock: Clock) -> Panel:
    x = Scale(*span, 44.0, 492.0)
    return Panel(x, Scale(0.0, float(omega[-1]) * clock.factor, 286.0, 28.0))


def _axes(panel: Panel, clock: Clock, title: str) -> list[str]:
    unit = clock.unit or "ω"
    marks = [text(0, 12, unit, "m"), text(max(44.0, text_width(unit) + 14.0), 12, title, "fgt b")]
    marks.append(trace("ax nf", "M", panel.left, panel.top, "V", panel.bottom, "H", panel.right))
    for value in panel.y.ticks(5):
        marks += [
            line(panel.left - 4, panel.y(value), panel.left, panel.y(value), "ax"),
            text(panel.left - 7, panel.y(value) + 4, f"{value:g}", "m", "end"),
        ]
    marks.append(panel.named_columns(panel.x.ticks(5), [f"{value:g}" for value in panel.x.ticks(5)]))
    marks.append(text(panel.right, panel.bottom + 33, clock.time_title, "m", "end"))
    return marks


def _edges(values: Array) -> tuple[float, float]:
    half = 0.5 * float(values[1] - values[0]) if values.size > 1 else 0.5
    return float(values[0]) - half, float(values[-1]) + half


def _box(panel: Panel, time: Array, omega: Array, clock: Clock) -> tuple[float, float, float, float]:
    (t0, t1), (w0, w1) = _edges(time), _edges(omega * clock.factor)
    x0, x1 = max(panel.x(t0), panel.left), min(panel.x(t1), panel.right)
    return x0, panel.y(w1), x1 - x0, panel.y(w0) - panel.y(w1)


def _image(mask: str, uri: str, box: tuple[float, float, float, float]) -> str:
    x, y, width, height = (places(v) for v in box)
    place = f'x="{x}" y="{y}" width="{width}" height="{height}"'
    return f'<mask id="{mask}"><image href="{uri}" {place} preserveAspectRatio="none"/></mask>'


def _masked(key: str) -> str:
    return f'mask="url(#{key})"'


def level_plane(
    key: str,
    image: Image,
    clock: Clock,
    span: tuple[float, float],
    reference: Curve | None,
    multiples: Sequence[int] = (1,),
    folding: Folding | None = None,
) -> str:
    """One plane in decibels, with multiples of a curve over it, folded ones dashed, and a bar of its colours."""
    panel = _frame(span, image.omega, clock)
    box = _box(panel, image.time, image.omega, clock)
    share = np.clip((image.level_db - image.floor_db) / -image.floor_db, 0.0, 1.0)
    marks = [f"<defs>{_image(f'{key}-m', mask_uri(share), box)}{_ramp(f'{key}-g', ('bg', 'b5'))}</defs>"]
    frame = (panel.left, panel.top, panel.right - panel.left, panel.bottom - panel.top)
    clip = f'<clipPath id="{key}-c">{rect(*frame, "")}</clipPath>'
    marks.append(
        f"<defs>{clip}</defs>" + rect(panel.left, panel.top, panel.right - panel.left, panel.bottom - panel.top, "hat")
    )
    plane = rect(*box, "bgf") + rect(*box, "b5 img", _masked(f"{key}-m"))
    moving, names = [f'<g clip-path="url(#{key}-c)">{plane}</g>'], []
    taken: list[tuple[float, float]] = []
    if reference is not None:
        x = panel.x.of(reference.time)
        inside = (reference.time >= image.time[0]) & (reference.time <= image.time[-1])
        lines = [(m * shown(reference), f"{m} ω₀" if m > 1 else "ω₀", "rd nf") for m in multiples]
        if folding is not None:
            lines += [(folded(m * shown(reference), folding.rate), f"{m} ω₀, folded", FOLDED) for m in folding.folded]
        drawn = [np.where(inside, panel.y.of(omega * clock.factor), np.nan) for omega, _, _ in lines]
        for (_, words, style), whole in zip(lines, drawn, strict=True):
            y = np.where(whole >= panel.top, whole, np.nan)
            if np.isfinite(y).any():
                moving.append(curve(x, y, style))
                last = int(np.flatnonzero(np.isfinite(y))[-1])
                if style == FOLDED:
                    taken.append(_free_place(x, y, panel, [other for other in drawn if other is not whole], taken))
                    names.append(text(*taken[-1], words, "e b sm", "middle"))
                else:
                    names.append(_name_of(words, x, y, last))
    marks += [panel.zooming(moving), group(names, "halo nz")]
    marks += _axes(panel, clock, image.name) + _bar(
        f"{key}-g",
        [(v, decibels(v)) for v in round_values(image.floor_db, 0.0, 5)],
        image.floor_db,
        0.0,
        "of the maximum",
    )
    return drawing(*SIZE, "one", f"{image.name}, level in decibels of its maximum", marks)


def _name_of(words: str, x: Array, y: Array, last: int) -> str:
    """The name of a line, at its end."""
    beside = float(x[last]) < SIZE[0] - 40
    at = (float(x[last]) + (3 if beside else -4), float(y[last]) + (4 if beside else -8))
    return text(*at, words, "e b sm", "start" if beside else "end")


def _free_place(
    x: Array, y: Array, panel: Panel, others: Sequence[Array], taken: Sequence[tuple[float, float]]
) -> tuple[float, float]:
    """Where the name of a folded line stands: above it, within the panel, clear of other lines and of such names."""
    seen = np.flatnonzero(np.isfinite(y))
    spots = [(float(x[i]), float(y[i]) - ABOVE) for i in seen[(PLACES * (seen.size - 1)).astype(int)]]
    left, right = panel.left + WIDE / 2, panel.right - WIDE / 2 - MARGIN

    def clearance(spot: tuple[float, float]) -> float:
        """Pixels to the nearest other line, at most ``CLEAR``; less outside the panel and on another name."""
        near = np.abs(x - spot[0]) < WIDE / 2
        lines = [np.abs(other[near] - spot[1] + HIGH / 3) for other in others]
        nearest = min((float(np.nanmin(d)) for d in lines if np.isfinite(d).any()), default=CLEAR)
        inside = spot[1] > panel.top + HIGH and left < spot[0] < right
        apart = all(abs(spot[0] - a) > WIDE or abs(spot[1] - b) > HIGH for a, b in taken)
        return min(nearest, CLEAR) - CLEAR * ((not inside) + (not apart))

    return max(spots, key=clearance)


def signed_plane(
    key: str, plane: SignedPlane, clock: Clock, span: tuple[float, float], interior: tuple[float, float]
) -> str:
    """One plane in two hues that meet in the background, its ridge and the reference over it, a part of it enlarged."""
    panel = _frame(span, plane.omega, clock)
    box = _box(panel, plane.time, plane.omega, clock)
    positive, negative = (mask_uri(np.clip(sign * plane.values, 0.0, 1.0)) for sign in (1.0, -1.0))
    defs = (
        _image(f"{key}-p", positive, box) + _image(f"{key}-n", negative, box) + _ramp(f"{key}-g", ("neg", "bg", "pos"))
    )
    marks = [f"<defs>{defs}</defs>"]
    pair = rect(*box, "posf img", _masked(f"{key}-p")) + rect(*box, "negf img", _masked(f"{key}-n"))
    lines = _ridge(plane, panel, clock)
    enlarged = _enlarged(plane, panel, clock, pair + lines, interior)
    marks += [panel.zooming([pair, lines]), group(enlarged, "nz"), *_axes(panel, clock, plane.name)]
    marks += _bar(f"{key}-g", _signed_ticks(plane.knee), -1.0, 1.0, "of the maximum (arcsinh)")
    return drawing(*SIZE, "one", f"{plane.name}, signed, with its ridge and the reference", marks)


def _signed_ticks(knee: float) -> list[tuple[float, str]]:
    """Shares of the maximum through the plane's own scale."""
    return [(float(np.arcsinh(v / knee) / np.arcsinh(1 / knee)), minus(f"{v:g}")) for v in (-1.0, -0.1, 0.0, 0.1, 1.0)]


def _ridge(plane: SignedPlane, panel: Panel, clock: Clock) -> str:
    """Both casings below, then the ridge, then the dashes of the reference: neither hides the other."""
    below, ridges, dashes = [], [], []
    for overlay in plane.overlays:
        x, y = panel.x.of(overlay.time), panel.y.of(shown(overlay) * clock.factor)
        if overlay.kind == "reference":
            below.append(curve(x, y, "rfc nf"))
            dashes.append(curve(x, y, "rf2 nf"))
        else:
            below.append(curve(x, y, "rdTc nf"))
            ridges.append(curve(x, y, "rdT nf"))
    return "".join([*below, *ridges, *dashes])


def _enlarged(plane: SignedPlane, panel: Panel, clock: Clock, content: str, interior: tuple[float, float]) -> list[str]:
    """The region of the interior where ridge and reference part most, enlarged, where that shows and there is room."""
    ridge = next((o for o in plane.overlays if o.kind != "reference"), None)
    reference = next((o for o in plane.overlays if o.kind == "reference"), None)
    if ridge is None or reference is None or not ridge.valid.any():
        return []
    known = reference.valid & np.isfinite(reference.omega)
    apart = shown(ridge) / np.interp(ridge.time, reference.time[known], reference.omega[known]) - 1
    apart = np.where((ridge.time >= interior[0]) & (ridge.time <= interior[1]), apart, np.nan)
    if not np.isfinite(apart).any():
        return []
    at = int(np.nanargmax(np.abs(apart)))
    x, y = panel.x(float(ridge.time[at])), panel.y(float(ridge.omega[at]) * clock.factor)
    if abs(float(apart[at])) * (panel.bottom - y) < SEEN:
        return []
    width, height = 160.0, 52.0
    x0 = min(max(x - width / 2, panel.left), panel.right - width)
    y0 = min(max(y - height / 2, panel.top), panel.bottom - height)
    big = (panel.left + 100, panel.top + 8, 200.0, 100.0)
    if y0 < big[1] + big[3] + 12:
        big = (panel.left + 100, panel.bottom - 108, 200.0, 100.0)
        if y0 + height > big[1] - 12:
            return []
    source = (x0, y0, width, height)
    percent = f"{100 * abs(float(apart[at])):.1f} % {'low' if apart[at] < 0 else 'high'}"
    words = [
        text(big[0] + big[2] - 6, big[1] + big[3] - 8, f"ridge, {percent}", "t b sm", "end"),
        text(big[0] + 6, big[1] + 14, "reference", "fgt b sm"),
    ]
    return [
        rect(*source, "zb"),
        _leads(source, big),
        _lens(source, big, rect(*source, "bgf") + content),
        rect(*big, "zb"),
        group(words, "halo"),
    ]


Rectangle = tuple[float, float, float, float]
"""Left, top, width and height."""


def _lens(source: Rectangle, big: Rectangle, content: str) -> str:
    """The content of one rectangle in a larger one; its own size keeps the page's rule for drawings off it."""
    x, y, width, height = (places(v) for v in big)
    view = " ".join(places(v) for v in source)
    place = f'x="{x}" y="{y}" width="{width}" height="{height}" style="width:{width}px;height:{height}px"'
    return f'<svg class="in" {place} viewBox="{view}" preserveAspectRatio="none">{content}</svg>'


def _leads(source: Rectangle, big: Rectangle) -> str:
    """Lines from the corners of a rectangle to those of its enlargement."""
    below = big[1] > source[1]
    a, b = (source[1] + source[3], big[1]) if below else (source[1], big[1] + big[3])
    ends = ((source[0], big[0]), (source[0] + source[2], big[0] + big[2]))
    d = "".join(f"M{places(x)} {places(a)}L{places(x_big)} {places(b)}" for x, x_big in ends)
    return f'<path d="{d}" class="zl"/>'


def _ramp(key: str, tokens: Sequence[str]) -> str:
    stops = "".join(
        f'<stop offset="{i / (len(tokens) - 1):g}" style="stop-color:var(--{token})"/>'
        for i, token in enumerate(tokens)
    )
    return f'<linearGradient id="{key}">{stops}</linearGradient>'


def _bar(ramp: str, ticks: Sequence[tuple[float, str]], low: float, high: float, words: str) -> list[str]:
    scale = Scale(low, high, 44.0, 284.0)
    marks = [f'<rect x="44" y="340" width="240" height="10" fill="url(#{ramp})" class="bar"/>']
    marks += [text(scale(v), 365, name, "m sm", "middle") for v, name in ticks]
    return [*marks, text(294, 350, words, "m sm")]
