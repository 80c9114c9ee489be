"""Figures for slides and papers: files of the outside view, one or both images, or the probe."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import imgui_bundle
import numpy as np
from imgui_bundle import ImVec4, imgui_microtex
from PIL import Image

from lucida.app.cameras.films.frames import with_z
from lucida.app.instruments.outside.figure import (
    LETTER_WIDTH,
    WHITE,
    Color,
    Figure,
    Label,
    Part,
    Picture,
)
from lucida.app.instruments.outside.figure_view import PLACE, outside_figure
from lucida.app.instruments.outside.paint import figure_color, ground_of
from lucida.app.instruments.outside.svg import svg
from lucida.app.instruments.probe.copying import all_lines, as_latex
from lucida.app.instruments.probe.reading import Reading
from lucida.app.instruments.probe.view import ProbeView
from lucida.app.state.app_state import AppState
from lucida.app.ui import formula, theme
from lucida.app.ui.explaining.plain import plain_math
from lucida.app.ui.host import Host
from lucida.app.web import pdf
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images.display import picture
from lucida.renderer.images.frame import Frame, stored
from lucida.renderer.system.errors import LucidaError

from .figure_choice import ENDINGS, FigureChoice, What

GAP = 0.02  # between both images, as a fraction of the width
FORMULA_PX = 24.0  # type size of the probe's formulas
FACES = Path(imgui_bundle.__file__).parent / "assets" / "fonts" / "Roboto"
SAMPLES = 2  # per side of a PNG's pixel, because resvg does not average a larger image's pixels
FINE = 4  # pixels of an image per side of a pixel of the page
FORMULA_GAP, ROW_GAP = 0.3, 0.4  # between formulas, as fractions of their size


def figure_of(host: Host, choice: FigureChoice) -> Figure:
    """Return a figure of what the window shows. Raises LucidaError, moderngl.Error."""
    page, ground = _page(host, choice)
    if choice.what == "outside":
        return replace(outside_figure(host, choice.size, choice.scale, page), ground=ground)
    if choice.what == "probe":
        parts: Iterable[Part] = _formulas(host, choice, page)
    else:
        parts = _images(host.state, choice, [_shown(host, name) for name in _names(choice)])
    return Figure(choice.size, tuple(parts), choice.scale, ground)


def encoder(host: Host, choice: FigureChoice) -> Callable[[str], bytes]:
    """Return a function that makes a figure's file for an ending, on any thread.

    An image has the page's pixels, unless the window's resolution is set. Raises LucidaError,
    moderngl.Error.
    """
    name, is_probe = host.state.scene.name, choice.what == "probe"
    if _names(choice) and host.state.images.resolution is None:
        make = _images_anew(host, choice)
    else:
        figure = figure_of(host, choice)
        make = lambda: figure  # noqa: E731
    latex = as_latex(_reading(host), host.options.indexing) if is_probe else ""
    return partial(_encoded, make, f"{name}: {choice.what}" if name else choice.what, latex)


def _page(host: Host, choice: FigureChoice) -> tuple[Color, Color | None]:
    """Return the colour of the page, and of its background; None for a transparent background."""
    behind = ground_of(host.state.scene.background, host.state.images.exposure_ev)
    if choice.what == "probe":
        behind = theme.PANEL.x, theme.PANEL.y, theme.PANEL.z
    page: Color = behind if choice.ground == "shown" else WHITE
    return page, None if choice.ground == "transparent" else page


def _encoded(make: Callable[[], Figure], title: str, latex: str, ending: str) -> bytes:
    if ending == ".tex":
        if not latex:
            raise LucidaError(ending, "is for the probe's formulas", f"give {', '.join(ENDINGS)}")
        return latex.encode()
    figure = make()
    if ending == ".png":
        file = io.BytesIO()
        painted(figure).save(file, "PNG")
        return file.getvalue()
    drawing = svg(figure, title)
    if ending != ".pdf":
        return drawing.encode()
    width, height = figure.size
    style = f"@page{{size:{width}px {height}px;margin:0}}body{{margin:0}}svg{{display:block}}"
    drawing = drawing.partition("?>")[2]  # embedded in a page, it has no XML declaration
    return pdf.pdf(f"<!DOCTYPE html><style>{style}</style>{drawing}", pdf.browser())


def painted(figure: Figure) -> Image.Image:
    """Rasterize a figure's SVG file with resvg. Return sRGB and opacity in pixels of its page."""
    import resvg_py  # only for PNG files

    faces = [str(FACES / f"Roboto-{face}.ttf") for face in ("Regular", "Bold")]
    drawn = resvg_py.svg_to_bytes(
        svg(figure), skip_system_fonts=True, font_files=faces, zoom=SAMPLES
    )
    with Image.open(io.BytesIO(drawn)) as file:
        return file.convert("RGBA").resize(figure.size, Image.Resampling.BOX)


def _names(choice: FigureChoice) -> tuple[What, ...]:
    """Return the images that a figure shows, from left to right."""
    if choice.what == "pair":
        return "raster", "ray"
    return (choice.what,) if choice.what in ("raster", "ray") else ()


def _shown(host: Host, name: What) -> Frame:
    """Return an image of the window, with its present channel and the depth."""
    state, both = host.state, host.renderers
    region, channel = (0, 0, *both.size[::-1]), state.images.channel
    values = both.raster_values if name == "raster" else both.ray_values
    shown, depth = (values(state, key, region) for key in (channel, "depth"))
    if shown is None or depth is None:
        raise LucidaError(
            f"the {name} image", "is not complete, or no view shows it", "wait, or show it"
        )
    channels: dict[str, Any] = {"depth": depth, stored(channel): shown}
    return Frame(both.size, **channels)


def _images_anew(host: Host, choice: FigureChoice) -> Callable[[], Figure]:
    """Return a function that makes a figure of images with the page's pixels, on any thread."""
    state, both = host.state, host.renderers
    request, names, channel = both.request(state), _names(choice), state.images.channel
    assert request is not None
    assert both.textures is not None
    request = replace(request, size=_extent(choice, both.size))
    channels, frames = (stored(channel), "depth"), dict[What, Frame]()
    if "raster" in names:
        rasterizer = both.textures.rasterizer
        rasterizer.draw(request, PLACE)
        arrays = rasterizer.of(request.scene).read(channels, place=PLACE)
        frames["raster"] = Frame(request.size, **arrays)
    ground = _page(host, choice)[1]

    def make() -> Figure:
        if "ray" in names:
            with both.live.make_tracer(request) as tracer:
                frames["ray"] = tracer.render(
                    request.camera, request.size, channels, request.samples
                )
        shown = [frames[name] for name in names]
        if channel == "z":
            shown = [with_z(frame, request.camera) for frame in shown]
        parts = _images(state, choice, shown)
        return Figure(choice.size, tuple(parts), choice.scale, ground)

    return make


def _extent(choice: FigureChoice, shape: Size) -> Size:
    """Return the largest size of each image on the page that has the aspect ratio of `shape`."""
    count = len(_names(choice))
    room = (1 - GAP * (count - 1)) * choice.size[0] / count, choice.size[1]
    scale = min(room[0] / shape[0], room[1] / shape[1])
    return max(1, round(scale * shape[0])), max(1, round(scale * shape[1]))


def _images(state: AppState, choice: FigureChoice, frames: Sequence[Frame]) -> Iterator[Part]:
    """Yield one image, or both side by side, pixel by pixel."""
    width, height = _extent(choice, frames[0].size)
    free = choice.size[0] - len(frames) * width
    gap = round(GAP * choice.size[0]) * (len(frames) - 1)
    y = (choice.size[1] - height) // 2
    for number, (name, frame) in enumerate(zip(_names(choice), frames, strict=True)):
        pixels = picture(frame, stored(state.images.channel), state.images.exposure_ev)
        if choice.ground != "shown":
            seen = np.isfinite(frame.channel("depth"))[..., None] * np.uint8(255)
            pixels = np.concatenate([pixels, seen], axis=2, dtype=np.uint8)
        x = (free - gap) // 2 + number * (width + gap)
        yield Picture(name, pixels, (x, y), (x + width, y + height))


def _reading(host: Host) -> Reading:
    reading = host.view(ProbeView).reading
    if reading is None:
        raise LucidaError("the probe", "shows no pixel", "mark one, and open Instruments > Probe")
    return reading


def _formulas(host: Host, choice: FigureChoice, page: Color) -> list[Part]:
    """Return the probe's formulas, one below the other, smaller if they would not fit."""
    lines = all_lines(_reading(host), host.options.indexing)
    rows = [[text for text in (line.latex, line.latex_numbers) if text] for line in lines]
    size = FORMULA_PX * choice.scale
    parts, extent = _set(rows, size, page)
    fit = float((choice.size / extent).min())
    return parts if fit >= 1 else _set(rows, 0.98 * fit * size, page)[0]


def _set(rows: list[list[str]], size: float, page: Color) -> tuple[list[Part], Floats]:
    """Typeset rows of formulas at a size. Return them, and their width and height, (2,)."""
    ink, parts = ImVec4(*figure_color("text", 0.0, page), 1.0), list[Part]()
    y, widest = size, 0.0
    for row in rows:
        x = size
        if not formula.available():
            text = "  ".join(map(plain_math, row))
            at, color = (x, y + size / 2), (ink.x, ink.y, ink.z)
            parts.append(Label("formula", text, at, size, color, False, align=0.0, rim=False))
            x, y = x + LETTER_WIDTH * size * len(text), y + size
        else:
            made = [
                imgui_microtex.render(formula.tinted(text, page), FINE * size, ink) for text in row
            ]
            baseline = max(one.baseline_y for one in made) / FINE
            for one in made:
                low = x, y + baseline - one.baseline_y / FINE
                high = x + one.width / FINE, low[1] + one.height / FINE
                parts.append(Picture("formula", one.pixels_as_array().copy(), low, high))
                x += one.width / FINE + FORMULA_GAP * size
            y += baseline + max(one.height - one.baseline_y for one in made) / FINE
        y, widest = y + ROW_GAP * size, max(widest, x)
    return parts, np.array([widest, y])
