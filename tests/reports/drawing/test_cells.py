"""The error map and the time-frequency plane against slow, obvious twins."""

from __future__ import annotations

import io
import re
from itertools import groupby

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image

from ridgeback.reports.drawing import cells
from ridgeback.reports.drawing.raster import grey, mask_uri, png, shrink

sizes = st.tuples(st.integers(1, 7), st.integers(1, 9))
grids = sizes.flatmap(
    lambda size: st.lists(
        st.lists(st.integers(cells.MISSING, 5), min_size=size[1], max_size=size[1]), min_size=size[0], max_size=size[0]
    )
).map(lambda rows: np.array(rows, dtype=np.int64))


def _edges(count: int, seed: int) -> NDArray[np.float64]:
    return np.cumsum(np.random.default_rng(seed).uniform(1.0, 30.0, count + 1))


def _boxes(path: str) -> list[tuple[float, float, float, float]]:
    """Left, top, right, bottom of each rectangle of a path."""
    number = r"(-?[\d.]+)"
    shapes = re.findall(rf"M{number} {number}h{number}v{number}h{number}z", path)
    assert "".join("M{} {}h{}v{}h{}z".format(*shape) for shape in shapes) == path
    found = []
    for x, y, width, height, back in (tuple(map(float, shape)) for shape in shapes):
        assert back == -width
        found.append((min(x, x + width), min(y, y + height), max(x, x + width), max(y, y + height)))
    return found


@given(grid=grids, seed=st.integers(0, 99))
@settings(deadline=None, max_examples=60)
def test_rectangles_cover_each_cell_once_with_its_band(grid: cells.Bands, seed: int) -> None:
    x, y = _edges(grid.shape[1], seed), _edges(grid.shape[0], seed + 1)[::-1]
    boxes = [(band, *box) for band, path in cells.rectangles(grid, x, y).items() for box in _boxes(path)]
    for i in range(grid.shape[0]):
        for j in range(grid.shape[1]):
            u, v = (x[j] + x[j + 1]) / 2, (y[i] + y[i + 1]) / 2
            over = [band for band, left, top, right, bottom in boxes if left < u < right and top < v < bottom]
            assert over == [grid[i, j]]


@given(row=st.lists(st.integers(-1, 5), min_size=1, max_size=30))
def test_runs_are_those_of_groupby(row: list[int]) -> None:
    found = cells.runs(np.array(row, dtype=np.int64))
    assert [(value, stop - start) for start, stop, value in found] == [(k, len(list(g))) for k, g in groupby(row)]
    assert [start for start, _, _ in found] == [0, *(stop for _, stop, _ in found[:-1])]


@given(grid=grids, level=st.integers(-1, 5))
@settings(deadline=None, max_examples=60)
def test_the_staircase_is_every_edge_between_inside_and_outside(grid: cells.Bands, level: int) -> None:
    inside = grid <= level
    rows, columns = inside.shape
    wanted = {
        *(
            (j + 1, i, j + 1, i + 1)
            for i in range(rows)
            for j in range(columns - 1)
            if inside[i, j] != inside[i, j + 1]
        ),
        *(
            (j, i + 1, j + 1, i + 1)
            for i in range(rows - 1)
            for j in range(columns)
            if inside[i, j] != inside[i + 1, j]
        ),
    }
    segments = cells.staircase(inside)
    units = [unit for segment in segments for unit in _units(*segment)]
    assert len(units) == len(set(units))
    assert set(units) == wanted
    ends = [(upright, end) for segment in segments for upright in (segment[0] == segment[2],) for end in _ends(segment)]
    assert len(ends) == len(set(ends)), "two segments in line meet: they should be one"


def _units(a: int, b: int, c: int, d: int) -> list[tuple[int, int, int, int]]:
    if a == c:
        return [(a, row, a, row + 1) for row in range(b, d)]
    return [(column, b, column + 1, b) for column in range(a, c)]


def _ends(segment: tuple[int, int, int, int]) -> tuple[tuple[int, int], tuple[int, int]]:
    a, b, c, d = segment
    return (a, b), (c, d)


def test_the_outline_runs_along_cell_edges() -> None:
    x, y = np.array([0.0, 10.0, 25.0, 47.5]), np.array([30.0, 12.0, 0.0])
    inside = np.array([[True, True, False], [True, False, False]])
    path = cells.outline(cells.staircase(inside), x, y)
    assert sorted(re.findall(r"M[^M]+", path)) == ["M10 12L10 0", "M10 12L25 12", "M25 30L25 12"]


@given(errors=st.lists(st.floats(allow_nan=True, allow_infinity=True, width=64), min_size=1, max_size=40))
def test_bands_count_the_thresholds_passed(errors: list[float]) -> None:
    found = cells.bands(np.array([errors]))[0]
    for error, band in zip(errors, found, strict=True):
        wanted = cells.MISSING if np.isnan(error) else sum(abs(error) > level for level in cells.THRESHOLDS)
        assert band == wanted


def test_cell_edges_are_half_way_between_centres() -> None:
    centres = np.array([0.1, 0.4, 1.0, 3.0])
    found = cells.edges(centres)
    assert np.allclose(found[1:-1], (centres[1:] + centres[:-1]) / 2, rtol=0, atol=1e-15)
    assert (found[:-1] < centres).all()
    assert (centres < found[1:]).all()


@given(size=sizes, seed=st.integers(0, 999))
@settings(deadline=None, max_examples=40)
def test_the_png_is_what_another_reader_reads(size: tuple[int, int], seed: int) -> None:
    pixels = np.random.default_rng(seed).integers(0, 256, size, dtype=np.uint8)
    with Image.open(io.BytesIO(png(pixels))) as image:
        image.load()
        assert image.mode == "L"
        assert np.array_equal(np.asarray(image), pixels)


@given(
    size=st.tuples(st.integers(1, 40), st.integers(1, 40)),
    most=st.tuples(st.integers(1, 12), st.integers(1, 12)),
    seed=st.integers(0, 999),
)
@settings(deadline=None, max_examples=60)
def test_shrinking_takes_the_maximum_over_blocks(size: tuple[int, int], most: tuple[int, int], seed: int) -> None:
    plane = np.random.default_rng(seed).standard_normal(size)
    small = shrink(plane, *most)
    assert small.shape == tuple(map(min, size, most))
    bounds = [[k * n // m for k in range(m)] + [n] for n, m in zip(size, small.shape, strict=True)]
    for i in range(small.shape[0]):
        for j in range(small.shape[1]):
            block = plane[bounds[0][i] : bounds[0][i + 1], bounds[1][j] : bounds[1][j + 1]]
            assert small[i, j] == block.max()


def test_a_plane_has_low_frequencies_at_the_bottom() -> None:
    import base64

    level = np.full((3, 5), -60.0)
    level[0, 4] = 0.0
    data = base64.b64decode(mask_uri((level + 60) / 60).split(",")[1])
    with Image.open(io.BytesIO(data)) as image:
        pixels = np.asarray(image)
    assert pixels[2, 4] == 255
    assert pixels.sum() == 255


def test_grey_is_linear_in_decibels_to_half_a_step() -> None:
    level = np.linspace(-80.0, 5.0, 200)[None]
    wanted = 255 * np.clip((level + 60) / 60, 0, 1)
    assert np.abs(grey(level, -60.0).astype(float) - wanted).max() <= 255 / (2 * 47) + 0.5
