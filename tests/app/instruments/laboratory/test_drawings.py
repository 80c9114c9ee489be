"""The laboratory's drawings: they fit, are legible from afar, and show correct numbers."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from sketched import sketched

from lucida.app.instruments.laboratory import array, images, light, ruler, shapes, storage
from lucida.app.instruments.laboratory.kinds import KINDS
from lucida.app.instruments.laboratory.looks import look_of
from lucida.app.instruments.laboratory.page import Page
from lucida.app.instruments.laboratory.pages import PAGES, drawn
from lucida.app.instruments.laboratory.sheet import between, reached
from lucida.app.instruments.outside.figure import Figure, Label, Line, Picture, Polygon
from lucida.app.instruments.outside.svg import svg
from lucida.app.state.options.laboratory import LONGEST, LaboratoryOptions
from lucida.app.ui import palettes, theme
from lucida.renderer.camera.camera import Camera

# Sheets, with the heights of their windows; the last is a page on a phone.
SIZES = {(1280, 1080): 1080, (853, 720): 720, (683, 768): 768, (1920, 1080): 1080, (360, 480): 0}
NOISE = np.random.default_rng(2).uniform(0, 2, 1 << 22).astype(np.float32)
CAPITALS = 22 / 1080  # their height relative to the window's, legible from the last row


def page_of(page: str, size=(853, 720), progress: float = 0.0, **options) -> Page:
    shape = images.image_size(page, size, (8, 6)) if PAGES[page].has_image else (1, 1)
    color = NOISE[: 3 * shape[0] * shape[1]].reshape(shape[1], shape[0], 3)
    chosen = LaboratoryOptions(page=page, progress=progress, **options)
    return Page(size, look_of(palettes.DARK), chosen, color, 0.0, (0.3, 0.6))


def figure_of(page: str, *args, **options) -> Figure:
    return drawn(page_of(page, *args, **options))


def points_of(figure: Figure) -> np.ndarray:
    found = []
    for part in figure.parts:
        if isinstance(part, Line):
            found += part.pieces
        elif isinstance(part, Polygon):
            found.append(part.points)
        elif isinstance(part, Label):
            wide = 0.51 * part.size * len(part.text)
            x, y = part.center
            left = x - part.align * wide
            found.append(np.array([(left, y - part.size / 2), (left + wide, y + part.size / 2)]))
        else:
            found.append(np.array([part.low, part.high]))
    return np.concatenate(found)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("page", PAGES)
def test_every_build_fits_and_can_be_read(page, size):
    for progress in range(PAGES[page].builds + 1):
        figure = figure_of(page, size, float(progress))
        points = points_of(figure)
        assert (points >= -0.5).all() and (points <= np.array(size) + 0.5).all(), (
            progress, points.min(axis=0), points.max(axis=0))  # fmt: skip
        texts = [part for part in figure.parts if isinstance(part, Label)]
        least = min((theme.CAPITAL * part.size for part in texts), default=size[1])
        assert least >= CAPITALS * SIZES[size], least


@pytest.mark.parametrize("page", PAGES)
def test_each_build_is_a_picture_of_its_own_and_a_file(page):
    texts = [svg(figure_of(page, (640, 480), float(k))) for k in range(PAGES[page].builds + 1)]
    assert len({*texts}) == len(texts)
    for text in texts:
        ElementTree.fromstring(text)
        assert not re.search(r"\bnan\b|\binf\b", text)
    assert PAGES[page].builds <= LONGEST


def test_builds_are_interpolated():
    assert [reached(p, 2) for p in (0.0, 1.0, 1.25, 2.0, 3.0)] == [0, 0, 0.25, 1, 1]
    assert [float(between(p, (1, 3, 7))) for p in (0.0, 0.5, 1.0, 1.5, 2.0, 9.0)] == [
        1, 2, 3, 5, 7, 7]  # fmt: skip


def test_discs_of_light_add_where_they_overlap():
    def colors(progress: float) -> dict[tuple[float, ...], int]:
        figure = figure_of("projectors", progress=progress)
        lit = [p for p in figure.parts if isinstance(p, Polygon) and {*p.color} <= {0.0, 1.0}]
        return {part.color: len(part.points) for part in lit}

    pure = {(1, 0, 0), (0, 1, 0), (0, 0, 1)}
    assert set(colors(0.0)) == pure
    assert set(colors(1.0)) == pure | {(1, 1, 0), (0, 1, 1), (1, 0, 1), (1, 1, 1)}
    words = [part.text for part in figure_of("projectors", progress=1.0).parts
             if isinstance(part, Label)]  # fmt: skip
    assert sorted(words) == ["cyan", "magenta", "white", "yellow"]
    assert len({*map(tuple, light.discs(2.0).round(9).tolist())}) == 1


def test_bars_of_storage_are_to_scale():
    figure = figure_of("storage", progress=3.0)
    lengths = [np.ptp(part.points[:, 0]) for part in figure.parts if isinstance(part, Polygon)]
    np.testing.assert_allclose(np.array(lengths) / lengths[0], [1, 8, 24, 96])
    texts = [part.text for part in figure.parts if isinstance(part, Label) and part.strong]
    assert texts[1::2] == ["128 KB", "1 MB", "3 MB", "12 MB"]
    assert [storage.short(kind.storage_bytes((1024, 1024))) for kind in KINDS] == texts[1::2]


def test_memory_is_laid_out_as_numpy_says():
    numbers = np.arange(12)
    for by_rows, order in ((False, "F"), (True, "C")):
        canvas = numbers.reshape(array.ROWS, array.COLUMNS, order=order)
        for cell in np.ndindex(array.ROWS, array.COLUMNS):
            assert array.place(*cell, by_rows) == canvas[cell]
    names: dict = {"np": np, "height": array.ROWS, "width": array.COLUMNS}
    exec("\n".join(array.NUMPY), names)
    assert names["canvas"].shape == (3, 4, 3) and names["canvas"][array.LIT].tolist() == (
        pytest.approx(array.ORANGE))  # fmt: skip
    row, column = (number + 1 for number in array.LIT)
    assert array.JULIA[1].startswith(f"canvas[{row}, {column}] =")


def test_rulers_lead_to_the_camera_s_u_and_v():
    camera = Camera()
    row, column = ruler.PIXEL
    direction = camera.ray(row - 1, column - 1, (ruler.COUNT, ruler.COUNT)).direction
    assert ruler.numbers(column)[-1][1] == pytest.approx(direction[0])
    assert -ruler.numbers(row)[-1][1] == pytest.approx(direction[1])
    texts = {part.text for part in figure_of("ruler", progress=4.0).parts
             if isinstance(part, Label)}  # fmt: skip
    assert {"6.5", "0.65", "0.15", "2.5", "0.25", "-0.25"} <= texts


def test_both_representations_show_the_same_part():
    for progress, zoom in ((0.0, 1), (1.0, 4), (2.0, 16)):
        raster, vector = (part for part in figure_of("shapes", progress=progress).parts
                          if hasattr(part, "figure"))  # fmt: skip
        assert raster.scale == vector.scale and raster.first == vector.first
        part = np.subtract(raster.high, raster.low) / raster.scale
        np.testing.assert_allclose(part, shapes.SIDE_PX / zoom)


def test_few_pixels_are_numbered_and_counted():
    figure = figure_of("raster")
    (picture,) = (part for part in figure.parts if isinstance(part, Picture))
    assert picture.pixels.shape == (6, 8, 3)
    texts = [part.text for part in figure.parts if isinstance(part, Label)]
    assert texts[:14] == [*"12345678", *"123456"]
    assert texts[14:] == ["8 x 6 pixels", "3 numbers each: 144 numbers"]


# All builds of each page and the moments between them, as recorded on 2026-11-30. If a drawing
# changes on purpose, look at it in the window and record the number that the failure names.
SKETCHES = {
    "function": 813568.74,
    "shapes": 802950.85,
    "projectors": 3168035.90,
    "displays": 12860679.76,
    "raster": 42682.42,
    "kinds": 26681.25,
    "exposure": 8847.51,
    "storage": 83629.84,
    "array": 893498.04,
    "devices": 2717414.64,
    "dimension": 1814587.78,
    "ruler": 6507384.06,
}


def figures(page: str) -> list[Figure]:
    last = PAGES[page].builds
    wide = [figure_of(page, progress=float(at), phase=0.3) for at in np.arange(0, last + 0.5, 0.5)]
    return [*wide, figure_of(page, (360, 480), float(last), phase=0.3)]


@pytest.mark.parametrize("page", PAGES)
def test_a_page_is_drawn_as_recorded(page):
    assert sketched(figures(page)) == pytest.approx(SKETCHES[page], abs=0.02)
