"""The tools over the outside view: its menu, the axes that turn it, the labels."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.instruments.outside.diagram import Role
from lucida.app.instruments.outside.extent import way_of
from lucida.app.instruments.outside.looking import TRIAD_PX, camera_along
from lucida.app.instruments.outside.mouse import Scope
from lucida.app.instruments.outside.paint import role_color
from lucida.app.instruments.outside.painting import measured, rimmed_text
from lucida.app.instruments.outside.placing import Box, Edges, LabelPlacer
from lucida.app.instruments.outside.projected import Primitive, Text
from lucida.app.instruments.outside.switches import (
    AXIS_NAMES,
    SWITCHES,
    handles,
    is_on,
    toggled,
    with_gizmo,
)
from lucida.app.state.bounds import whole_range_of
from lucida.app.state.options.outside import OutsideOptions
from lucida.app.ui import theme
from lucida.app.ui.areas import press_area
from lucida.app.ui.contrast import Rgb
from lucida.app.ui.host import Host
from lucida.app.ui.theme import framebuffer_scale
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats

PAD = 6  # around the menu's button


def use_tools(host: Host, scope: Scope, more: Floats) -> tuple[Edges, ...]:
    """Draw the menu and the axes into the view's window, and do what they are clicked for. Return
    the boxes that they cover, in the view's pixels.

    more: points (n, 3) that must be in sight with the scene.
    """
    state = host.state
    now = state.options.outside
    pad, origin = theme.px(PAD), scope.origin
    imgui.set_cursor_screen_pos(ImVec2(origin.x + pad, origin.y + pad))
    if imgui.button("Show##outside"):
        imgui.open_popup("outside menu")
    covered = imgui.get_item_rect_max() - origin
    options = now
    if imgui.begin_popup("outside menu"):
        options = _menu(now, host.renderers.camera(state))
        imgui.end_popup()
    axis = triad(scope.shown, origin, scope.extent)
    if axis is not None:
        options = replace(options, camera=camera_along(host, scope, axis, more))
    if options.camera != now.camera:
        host.travel(state.with_options(options))
    elif options != now:
        host.apply(state.with_options(options))
    scale, right, around = framebuffer_scale(), scope.extent.x, 2 * theme.px(TRIAD_PX)
    return (
        (0.0, 0.0, scale * (covered.x + pad), scale * (covered.y + pad)),
        (scale * (right - around), 0.0, scale * right, scale * around),
    )


def _menu(options: OutsideOptions, camera: Camera) -> OutsideOptions:
    """Draw the entries of the menu: switches, handles, views. Return the options after a click.

    camera: the one in the scene.
    """

    def entry(name: str, tip: str, is_on: bool, after: OutsideOptions) -> OutsideOptions:
        clicked = imgui.menu_item(name, "", is_on)[0]
        imgui.set_item_tooltip(tip)
        return after if clicked else options

    for switch in SWITCHES:
        on, after = is_on(options, switch.field), toggled(options, switch.field)
        options = entry(switch.name, switch.tip, on, after)
    options = _bundle_fields(options)
    imgui.separator()
    for kind, name, tip in handles(options):
        options = entry(name, tip, options.gizmo == kind, with_gizmo(options, kind))
    imgui.separator()
    tips = "a view that sees the scene and the camera", "look from the camera: what it sees"
    options = entry("fit all", tips[0], options.camera is None, replace(options, camera=None))
    return entry("from camera", tips[1], False, replace(options, camera=camera))


def _bundle_fields(options: OutsideOptions) -> OutsideOptions:
    rows, columns = options.bundle
    imgui.set_next_item_width(theme.px(110))
    changed, values = imgui.slider_int2(
        "rows, columns", [rows, columns], *whole_range_of(OutsideOptions, "bundle")
    )
    if changed:
        return replace(options, bundle=(int(values[0]), int(values[1])))
    return options


def triad(camera: Camera, origin: ImVec2, extent: ImVec2) -> str | None:
    """Draw the world's axes in the upper right corner, as the camera sees them. Return the clicked
    one: "x", "-x", ... A view that is narrower than they are has none.
    """
    radius, ball = theme.px(30), theme.px(9.5)
    if extent.x < 2 * (radius + ball + theme.px(8)):
        return None
    middle = ImVec2(
        origin.x + extent.x - radius - ball - theme.px(8), origin.y + radius + ball + theme.px(8)
    )
    draw = imgui.get_window_draw_list()
    disc = radius + ball + theme.px(3)
    draw.add_circle_filled(middle, disc, theme.u32(theme.rgb("#0c0d0f", 0.45)), 48)
    clicked = None
    for depth, name, across, up in _axes_seen(camera):
        spot = ImVec2(middle.x + radius * across, middle.y - radius * up)
        color = _axis_color(name[-1], 0.55 + 0.225 * (1 + depth))
        is_positive = not name.startswith("-")
        size = ball if is_positive else 0.72 * ball
        if is_positive:
            draw.add_line(middle, spot, theme.u32(color), theme.px(2.2))
        imgui.set_cursor_screen_pos(ImVec2(spot.x - size, spot.y - size))
        if press_area(f"axis {name}##outside", ImVec2(2 * size, 2 * size)):
            clicked = name
        hovered = imgui.is_item_hovered()
        imgui.set_item_tooltip(f"look {AXIS_NAMES[name]}")
        if is_positive:
            draw.add_circle_filled(spot, size, theme.u32(color))
            text = imgui.calc_text_size(name)
            at = ImVec2(spot.x - text.x / 2, spot.y - text.y / 2 - theme.px(1))
            draw.add_text(at, theme.u32(theme.rgb("#101215")), name)
        else:
            draw.add_circle_filled(spot, size, theme.u32(theme.rgb("#1a1d21", 0.85)))
            draw.add_circle(spot, size, theme.u32(color), 0, theme.px(1.5))
        if hovered:
            draw.add_circle(spot, size + theme.px(1.5), theme.u32(theme.MARK), 0, theme.px(2))
    return clicked


@lru_cache(maxsize=1)
def _axes_seen(camera: Camera) -> list[tuple[float, str, float, float]]:
    """Return the depths of the world's axes, their names, and where a camera sees their ends: to
    the right and up. The farthest is first.
    """
    back = np.asarray(camera.w) / np.linalg.norm(camera.w)
    right = np.asarray(camera.u) - (back @ camera.u) * back
    right = right / np.linalg.norm(right)
    up = np.cross(back, right)
    if up @ np.asarray(camera.v) < 0:
        up = -up
    ways = [(name, way_of(name)) for name in AXIS_NAMES]
    ends = [(float(way @ back), name, float(way @ right), float(way @ up)) for name, way in ways]
    return sorted(ends, key=lambda end: end[0])


def _axis_color(name: str, light: float) -> ImVec4:
    """Return the gray of a world axis: colours are for the basis."""
    base = {"x": 0.86, "y": 0.95, "z": 0.76}[name] * light
    return ImVec4(base, base, base, 1.0)


STRONG = 1.5  # the size of names that teach, in sizes of the type


class Written(NamedTuple):
    """A label in its place. at: its upper left corner in the view, in ImGui's pixels. pieces: see
    measured(). lit: on the ground of a formula's term that is pointed out.
    """

    role: Role
    at: tuple[float, float]
    size: float
    pieces: list[tuple[imgui.ImFont, str, float]]
    lit: bool


def written(
    primitives: Sequence[Primitive],
    placer: LabelPlacer,
    extent: ImVec2,
    fonts: theme.Fonts,
    tools: tuple[Edges, ...],
) -> list[Written]:
    """Return the texts of a diagram in their places.

    placer: the view's own. extent: of the view. tools: boxes in the view's pixels that are covered.
    """
    scale = framebuffer_scale()
    texts = [part for part in primitives if isinstance(part, Text)]
    sizes = [theme.whole_px(theme.type_px() * (STRONG if part.strong else 1.0)) for part in texts]
    pieces, boxes = [], []
    for part, size in zip(texts, sizes, strict=True):
        pieces.append(measured(part.text, part.strong, size, fonts))
        room = scale * theme.px(7 if part.strong else 13)
        boxes.append(Box(scale * sum(piece[2] for piece in pieces[-1]), scale * size, room))
    centers = placer.place(primitives, boxes, (scale * extent.x, scale * extent.y), tools)
    return [
        Written(
            part.role, ((x - box.width / 2) / scale, (y - box.height / 2) / scale), size, found,
            part.lit,
        )
        for part, size, found, box, (x, y) in zip(texts, sizes, pieces, boxes, centers, strict=True)
    ]  # fmt: skip


def draw_labels(labels: Iterable[Written], origin: ImVec2, ground: Rgb) -> None:
    """Draw labels into a view at `origin`. ground: the colour under them."""
    draw, shadow = imgui.get_window_draw_list(), theme.u32(theme.rgb("#07080a", 0.85))
    for role, (x, y), size, pieces, lit in labels:
        at = ImVec2(math.floor(origin.x + x), math.floor(origin.y + y))
        if lit:
            pad, width = theme.px(4), sum(wide for *_, wide in pieces)
            low, high = (
                ImVec2(at.x - pad, at.y - pad),
                ImVec2(at.x + width + pad, at.y + size + pad),
            )
            draw.add_rect_filled(low, high, theme.u32(theme.rgb("#0c0d0f", 0.9)), pad)
            draw.add_rect(low, high, theme.u32(role_color(role, ground)), pad, theme.px(2))
        color = theme.u32(role_color(role, ground))
        for font, text, wide in pieces:
            rimmed_text(draw, font, size, at, text, color, shadow, theme.px(1.8))
            at.x += wide
