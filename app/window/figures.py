"""Figures for slides and papers: the outside view, an image or both, or the probe, in a file."""

from __future__ import annotations

import io
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from imgui_bundle import ImVec4, imgui_microtex
from PIL import Image

from lucida.app.instruments.outside.figure import (
    LETTER_WIDTH,
    WHITE,
    Color,
    Figure,
    Label,
    Part,
    Picture,
)
from lucida.app.instruments.outside.figure_view import outside_figure
from lucida.app.instruments.outside.paint import figure_color, ground_of
from lucida.app.instruments.outside.png import painted
from lucida.app.instruments.outside.svg import svg
from lucida.app.instruments.probe.copying import all_lines, as_latex
from lucida.app.instruments.probe.reading import Reading
from lucida.app.instruments.probe.view import ProbeView
from lucida.app.ui import formula, theme
from lucida.app.ui.explaining.plain import plain_math
from lucida.app.ui.host import Host
from lucida.app.web import pdf
from lucida.app.window.figure_choice import ENDINGS, FigureChoice, What
from lucida.renderer.camera.checks import Floats
from lucida.renderer.images.display import picture
from lucida.renderer.images.frame import Frame
from lucida.renderer.system.errors import LucidaError

GAP = 0.02  # between the pair, in parts of the width
FORMULA_PX = 24.0  # of the probe's formulas
FORMULA_GAP, ROW_GAP = 0.3, 0.4  # from one to the next, in parts of their size


def figure_of(host: Host, choice: FigureChoice) -> Figure:
    """Return a figure of what the window shows. Raises LucidaError, moderngl.Error."""
    behind = ground_of(host.state.scene.background, host.state.images.exposure_ev)
    if choice.what == "probe":
        behind = theme.PANEL.x, theme.PANEL.y, theme.PANEL.z
    page: Color = behind if choice.ground == "shown" else WHITE
    ground = None if choice.ground == "transparent" else page
    if choice.what == "outside":
        figure = outside_figure(host, choice.size, choice.scale, page)
        return Figure(figure.size, figure.parts, figure.unit, ground, figure.image)
    parts = _formulas(host, choice, page) if choice.what == "probe" else _images(host, choice)
    return Figure(choice.size, tuple(parts), choice.scale, ground)


def encoder(host: Host, choice: FigureChoice) -> Callable[[str], bytes]:
    """Return a function that makes a figure's file for an ending, on any thread.

    Raises LucidaError, moderngl.Error.
    """
    figure, name = figure_of(host, choice), host.state.scene.name
    is_probe = choice.what == "probe"
    latex = as_latex(_reading(host), host.options.indexing) if is_probe else ""
    return partial(_encoded, figure, f"{name}: {choice.what}" if name else choice.what, latex)


def _encoded(figure: Figure, title: str, latex: str, ending: str) -> bytes:
    if ending == ".tex":
        if not latex:
            raise LucidaError(ending, "is for the probe's formulas", f"give {', '.join(ENDINGS)}")
        return latex.encode()
    if ending == ".png":
        file = io.BytesIO()
        Image.fromarray(painted(figure)).save(file, "PNG")
        return file.getvalue()
    drawing = svg(figure, title)
    if ending != ".pdf":
        return drawing.encode()
    width, height = figure.size
    style = f"@page{{size:{width}px {height}px;margin:0}}body{{margin:0}}svg{{display:block}}"
    drawing = drawing.partition("?>")[2]  # in a page, it is no file of its own
    return pdf.pdf(f"<!DOCTYPE html><style>{style}</style>{drawing}", pdf.browser())


def _images(host: Host, choice: FigureChoice) -> list[Part]:
    """Return one image or both side by side, as large as the page allows, pixel by pixel."""
    state, both = host.state, host.renderers
    names: tuple[What, ...] = ("raster", "ray") if choice.what == "pair" else (choice.what,)
    gap = GAP * choice.size[0] * (len(names) - 1)
    room = np.array([(choice.size[0] - gap) / len(names), choice.size[1]])
    region, channel = (0, 0, *both.size[::-1]), state.images.channel
    parts: list[Part] = []
    for number, name in enumerate(names):
        values = both.raster_values if name == "raster" else both.ray_values
        found: dict[str, Any] = {key: values(state, key, region) for key in (channel, "depth")}
        if any(one is None for one in found.values()):
            raise LucidaError(
                f"the {name} image", "is not complete, or no view shows it", "wait, or show it"
            )
        pixels = picture(Frame(both.size, **found), channel, state.images.exposure_ev)
        if choice.ground != "shown":
            seen = np.isfinite(found["depth"])[..., None] * np.uint8(255)
            pixels = np.concatenate([pixels, seen], axis=2, dtype=np.uint8)
        extent = np.array(both.size) * (room / both.size).min()
        low = (number * (room[0] + gap), 0.0) + (room - extent) / 2
        (x, y), (x_end, y_end) = low.tolist(), (low + extent).tolist()
        parts.append(Picture(name, pixels, (x, y), (x_end, y_end)))
    return parts


def _reading(host: Host) -> Reading:
    reading = host.view(ProbeView).reading
    if reading is None:
        raise LucidaError("the probe", "shows no pixel", "mark one, and show the probe")
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
            made = [imgui_microtex.render(formula.tinted(text, page), size, ink) for text in row]
            baseline = max(one.baseline_y for one in made)
            for one in made:
                low = x, y + baseline - one.baseline_y
                high = x + one.width, low[1] + one.height
                parts.append(Picture("formula", one.pixels_as_array().copy(), low, high))
                x += one.width + FORMULA_GAP * size
            y += baseline + max(one.height - one.baseline_y for one in made)
        y, widest = y + ROW_GAP * size, max(widest, x)
    return parts, np.array([widest, y])
