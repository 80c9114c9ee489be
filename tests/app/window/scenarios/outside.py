"""The outside view: its handles, its switches, and the pixels that it shares."""

from contextlib import contextmanager

import numpy as np
from imgui_bundle.imguizmo import im_guizmo
from outside_window import enter, place, press, scope, strokes, view
from window_driver import Key

from lucida.app.instruments.outside import gizmo as outside_gizmo
from lucida.app.instruments.outside import tint as outside_tint
from lucida.app.instruments.outside import view as outside
from lucida.app.instruments.outside.frustum import plane_corners
from lucida.app.instruments.outside.gizmo import LENGTH
from lucida.app.instruments.outside.paint import ground_of
from lucida.app.instruments.outside.view import OUTSIDE
from lucida.app.ui import palettes, theme


def drive_a_pixel_is_the_same_in_all_views(d):
    enter(d)
    window = d.window
    camera, size = window.renderers.camera(window.state), window.renderers.size
    corners = plane_corners(camera)
    target = (2 * size[1] // 3, size[0] // 4)
    part = (target[1] + 0.5) / size[0], (target[0] + 0.5) / size[1]
    point = corners[0] + part[0] * (corners[1] - corners[0]) + part[1] * (corners[3] - corners[0])
    d.move_to(place(d, point))
    name, pixel = window.hovered
    assert name == OUTSIDE
    near = 3 + size[0] / 60  # ImGui's mouse has whole numbers, and the plane is small on the screen
    assert max(abs(pixel[0] - target[0]), abs(pixel[1] - target[1])) < near
    steps = d.steps
    d.ctx.mouse_click(0)
    d.frames(2)
    assert window.state.marked == pixel
    assert d.steps == steps + 1
    d.settle()
    # Its ray goes from the eye through the pixel's centre to what the ray image has seen there.
    (ray,) = strokes(d, "ray")
    t = window.renderers.depth_at(window.state, pixel)
    drawn = camera.ray(*pixel, size)
    x, y = place(d, drawn.origin + t * drawn.direction)
    at = scope(d)
    end = ray.points[0, 1] + (at.origin.x, at.origin.y)
    assert np.allclose(end, (x, y), atol=1.0)
    start = place(d, np.asarray(camera.eye))
    assert np.allclose(ray.points[0, 0] + (at.origin.x, at.origin.y), start, atol=1.0)


def drive_the_legend_switches(d):
    enter(d)
    window = d.window
    press(d, "Show grid")
    assert not window.state.options.outside.grid
    assert not strokes(d, "grid")
    press(d, "Show grid")
    assert window.state.options.outside.grid
    for name, drawn in (("basis", "u"), ("volume", "edges")):
        assert strokes(d, drawn)
        d.change(outside={name: False})
        d.frames(2)
        assert not strokes(d, drawn)
    press(d, "Show bundle")
    rows, columns = window.state.options.outside.bundle
    d.settle()
    assert len(strokes(d, "bundle")) == rows * columns
    assert view(d).settled
    assert not d.steps, "undo is not for what an instrument shows"


def drive_nothing_is_drawn_anew_while_nothing_changes(d):
    enter(d)
    d.until(lambda: view(d).settled)
    d.frames(3)
    before = view(d).primitives
    assert before
    d.frames(6)
    assert view(d).primitives is before
    d.ctx.mouse_teleport_to_pos(d.point("Raster", 0.4, 0.6))
    d.until(lambda: view(d).primitives is not before)  # its ray
    assert strokes(d, "ray")


def drive_it_is_drawn_anew_in_another_look(d):
    """The look follows the preferences a frame later: what was drawn between is of the old one."""
    enter(d)
    drawn = []
    layers = outside.layers

    def watched(primitives, ground):
        drawn.append(theme.used().palette)
        return layers(primitives, ground)

    outside.layers = watched
    light = palettes.LIGHT, palettes.PRESENTED_LIGHT
    shown = *light, palettes.PRESENTED_DARK, palettes.DARK
    try:
        for palette in shown:
            look = {
                "theme": "light" if palette in light else "dark",
                "presentation": palette in (palettes.PRESENTED_LIGHT, palettes.PRESENTED_DARK),
            }
            drawn.clear()
            d.change(preferences=look)
            if look["presentation"]:
                d.frames(3)
                d.stage.show(OUTSIDE)
            d.until(lambda it=palette: bool(drawn) and drawn[-1] is it)
    finally:
        outside.layers = layers


def drive_handles_move_the_eye_and_turn_the_basis(d):
    """While a handle is dragged, only our own colours are shown, none of ImGuizmo's."""
    enter(d)
    d.show_small()
    window = d.window
    start = window.state.camera
    d.change(outside={"gizmo": "move"})
    d.frames(2)
    at = scope(d)
    x, y = place(d, np.asarray(start.eye))
    up = place(d, np.add(start.eye, 0.1 * at.reach * np.asarray(start.v)))  # along v's handle
    way = np.array([up[0] - x, up[1] - y])
    way = way / np.linalg.norm(way)
    grip = np.array([x, y]) + 0.4 * LENGTH * at.extent.x * way
    steps = d.steps
    d.move_to(tuple(grip))
    with _watched() as (hidden, colors):
        d.drag(tuple(grip), tuple(grip + 60 * way))
        d.picture()
    moved = window.state.camera
    way_moved = np.subtract(moved.eye, start.eye)
    assert way_moved @ start.v > 0.1
    assert np.allclose(way_moved, (way_moved @ start.v) * np.asarray(start.v), atol=1e-3)
    assert (moved.u, moved.v, moved.w) == (start.u, start.v, start.w)
    assert max(hidden) > 0, "ImGuizmo wrote nothing that could be hidden"
    ground = ground_of(window.state.scene.background, 0.0)
    shown = [theme.seen_on(theme.BASIS[name], ground) for name in "uvw"]
    expected = {packed(*(round(255 * x) for x in (c.x, c.y, c.z))) for c in shown}
    expected |= {0, 0xFFFFFF, packed(170, 170, 170)}  # hidden, held, the way from the beginning
    assert colors <= expected, f"ImGuizmo's own colours: {[hex(c) for c in colors - expected]}"
    assert window.state.options.outside.camera is None  # the view was not turned by it
    assert d.steps == steps + 1
    window.undo()
    assert window.state.camera == start
    d.move_to(tuple(grip))
    d.ctx.mouse_down(0)
    for length in (10, 30):
        d.move_to(tuple(grip + length * way))
    assert window.state.camera != start
    d.press(Key.escape)
    d.ctx.mouse_teleport_to_pos(tuple(grip + 60 * way))  # the mouse is still down
    d.frames(2)
    d.ctx.mouse_up(0)
    d.frames(2)
    assert window.state.camera == start
    assert d.steps == steps
    d.change(outside={"gizmo": "turn"})
    d.frames(2)
    x, y = place(d, np.asarray(start.eye))
    for angle in np.linspace(0.875, 2.875, 16, endpoint=False) * np.pi:
        turned = _turn_by(d, np.array([x, y]), angle)
        if turned:
            break
    camera = window.state.camera
    assert camera.eye == start.eye
    assert np.abs(np.asarray(camera.w) - start.w).max() > 1e-3
    assert np.allclose(camera.basis.T @ camera.basis, np.eye(3))
    assert camera.determinant > 0


@contextmanager
def _watched():
    """Watch a dragged handle: the numbers of hidden vertices, and the colours."""
    hidden = []
    colors = set()
    repaint = outside_gizmo.repaint

    def watched(draw, first, exchanged):
        repaint(draw, first, exchanged)
        after = outside_tint.vertex_colors(draw)[first:]
        hidden.append(int((after == 0).sum()))
        if outside_gizmo.is_dragging():
            colors.update((after & 0xFFFFFF).tolist())

    outside_gizmo.repaint = watched
    try:
        yield hidden, colors
    finally:
        outside_gizmo.repaint = repaint


def packed(red, green, blue):
    return red | green << 8 | blue << 16


def _turn_by(d, middle, angle):
    """Drags the ring of handles at an angle; whether there was one."""
    before = d.state.camera
    radius = 0.5 * LENGTH * scope(d).extent.x
    for part in (0.7, 0.85, 1.0, 1.1):
        grip = middle + part * radius * np.array([np.cos(angle), np.sin(angle)])
        d.move_to(tuple(grip))
        if not im_guizmo.is_over():
            continue
        d.drag(tuple(grip), tuple(grip + 30 * np.array([-np.sin(angle), np.cos(angle)])))
        if np.abs(np.subtract(d.state.camera.w, before.w)).max() > 1e-3:
            return True
        d.window.history = type(d.window.history)(d.state)
    return False
