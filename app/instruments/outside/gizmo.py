"""Handles in the outside view that move the camera's eye, and turn its basis, or the vector up that
the basis is made from (ImGuizmo).
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui, imguizmo

from lucida.app.state.app_state import AppState
from lucida.app.ui import theme
from lucida.app.ui.contrast import Rgb
from lucida.app.ui.host import Host
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats, Vector, three, volume
from lucida.renderer.system.errors import LucidaError

from .mouse import Scope
from .tint import Rgb8, handle_colors, repaint

gizmo = imguizmo.im_guizmo

LENGTH = 0.26  # the handles' length in clip space
WIDTH, ARROW, RING = 3.0, 7.0, 2.5  # widths of lines, heads and rings at 100 %
PARALLEL = math.sin(math.radians(3))  # up and w at a smaller angle become exactly parallel
NEAREST = 0.02  # times the view's distance: a nearer eye has no handles


@dataclass(frozen=True)
class _Drag:
    """A drag of a handle.

    camera, up, frame: their values at its start; the frame is the handles' axes, as columns of a
    rotation. now: the current frame.
    """

    camera: Camera
    up: Vector
    frame: Floats
    now: Floats


class Gizmo:
    """The handles of the view. over: True if the mouse was over a handle, or drags one."""

    def __init__(self) -> None:
        self.over = False
        self._drag: _Drag | None = None
        self._count = 0

    def cancel(self) -> None:
        if self._drag is not None:
            let_go()
        self._drag = None

    def follow(self, host: Host, scope: Scope, ground: Rgb) -> None:
        """Draw the selected handles into the current window, and move the camera by them.

        ground: the colour under the handles.
        """
        state, options = host.state, host.state.options.outside
        kind = options.gizmo
        if kind == "none" or (kind == "up" and options.target is None):
            self.over = False
            self.cancel()
            return
        camera, frame = state.camera, np.eye(4)
        frame[:3, :3] = rotation_of(camera) if self._drag is None else self._drag.now
        frame[:3, 3] = camera.eye
        operation = gizmo.OPERATION.translate if kind == "move" else gizmo.OPERATION.rotate
        # In the handles' own space, x, y and z are u, v and w.
        handle = Handle(
            "outside", frame, operation, gizmo.MODE.local, LENGTH, handle_colors(ground)
        )
        found = manipulate(handle, scope.shown, scope.origin, scope.extent, scope.reach)
        self.over = found is not None and found.over
        if found is None or not found.using:
            self._drag = None
            return
        host.animate()
        if self._drag is None:
            self._count += 1
            self._drag = _Drag(camera, options.up, frame[:3, :3], frame[:3, :3])
        after = camera, options.up
        if escaped():
            after, self._drag = (self._drag.camera, self._drag.up), None
        elif found.moved is not None and np.isfinite(found.moved).all():
            with contextlib.suppress(LucidaError):  # out of the number range: the camera stays
                after = self._moved(self._drag, state, found.moved)
        if after != (camera, options.up):
            # One drag is one undo step.
            state = state.with_camera(after[0]).with_options(replace(options, up=after[1]))
            host.apply(state, ("outside gizmo", self._count))

    def _moved(self, drag: _Drag, state: AppState, result: Floats) -> tuple[Camera, Vector]:
        """Return the camera and up after a drag to the frame `result`, (4, 4)."""
        camera, options = state.camera, state.options.outside
        if options.gizmo == "move":
            return replace(camera, eye=three(result[:3, 3])), options.up
        turned = nearest_rotation(result[:3, :3] @ drag.frame.T)
        self._drag = replace(drag, now=turned @ drag.frame)
        if options.gizmo == "up":
            return with_up(camera, drag.camera, turned @ drag.up)
        u, v, w = (turned @ drag.camera.basis).T
        camera = replace(camera, u=three(u), v=three(v), w=three(w))
        return camera.orthonormalized() if state.keep_orthonormal else camera, options.up


def with_up(camera: Camera, before: Camera, up: Floats) -> tuple[Camera, Vector]:
    """Return a camera whose basis is made from w and `up`, and the vector up. If up is almost
    parallel to w, it becomes exactly parallel; then there is no basis, and the camera stays.

    before: the camera with w and the lengths of u and v.
    """
    w = np.asarray(before.w) / np.linalg.norm(before.w)
    across = np.cross(up, w)
    if np.linalg.norm(across) < PARALLEL * np.linalg.norm(up):
        return camera, three(np.copysign(np.linalg.norm(up), up @ w) * w)
    u = across / np.linalg.norm(across)
    lengths = (float(np.linalg.norm(v)) for v in (before.u, before.v))
    u, v = (length * axis for length, axis in zip(lengths, (u, np.cross(w, u)), strict=True))
    return replace(camera, u=three(u), v=three(v)), three(up)


class Handle(NamedTuple):
    """A set of ImGuizmo's handles.

    name: a unique name. frame: their position and axes, (4, 4). length: their length in clip space.
    colors: the colours that replace ImGuizmo's.
    """

    name: str
    frame: Floats
    operation: imguizmo.im_guizmo.OPERATION
    mode: imguizmo.im_guizmo.MODE
    length: float
    colors: Mapping[Rgb8, ImVec4]


class Manipulated(NamedTuple):
    """The mouse's effect on handles. moved: their new frame, (4, 4); None if it is the same."""

    using: bool
    over: bool
    moved: Floats | None


def manipulate(
    handle: Handle, camera: Camera, origin: ImVec2, extent: ImVec2, reach: float
) -> Manipulated | None:
    """Draw handles into the current window, seen by a camera. Return None if they are not well in
    front of it.

    origin, extent: the view's corner and size. reach: the reach of everything in sight.
    """
    matrices = gl_matrices(camera, handle.frame[:3, 3], reach)
    if matrices is None:
        return None
    view, projection = matrices
    matrix = matrix16(handle.frame)
    begin_handles()
    gizmo.set_orthographic(camera.is_parallel)
    gizmo.set_drawlist()
    gizmo.set_rect(origin.x, origin.y, extent.x, extent.y)
    gizmo.set_gizmo_size_clip_space(handle.length)
    gizmo.allow_axis_flip(False)
    widen()
    draw = imgui.get_window_draw_list()
    first = draw.vtx_buffer.size()
    gizmo.push_id(handle.name)
    moved = gizmo.manipulate(
        matrix16(view), matrix16(projection), handle.operation, handle.mode, matrix,
    )  # fmt: skip
    using, over = is_dragging(), gizmo.is_using() or gizmo.is_over()
    gizmo.pop_id()  # is_using() refers to the pushed ID
    repaint(draw, first, handle.colors)
    after = np.asarray(matrix.values, float).reshape(4, 4).T if moved else None
    return Manipulated(using, over, after)


def gl_matrices(camera: Camera, point: Floats, reach: float) -> tuple[Floats, Floats] | None:
    """Return view and projection in OpenGL's form for handles at a point, or None if the point
    is not well in front of the camera.
    """
    view = camera.camera_from_world.copy()
    depth = -float(view[2, :3] @ point + view[2, 3])  # in units of w
    scale = max(abs(depth), reach / float(np.linalg.norm(camera.w)))
    if not np.isfinite(depth) or depth < NEAREST * scale or depth < 1e-9:
        return None
    if camera.is_parallel:
        return view, camera.clip_from_camera(-20 * scale, 20 * scale)
    return view, camera.clip_from_camera(1e-3 * depth, 1e3 * scale)


def rotation_of(camera: Camera) -> Floats:
    """Return a right-handed orthonormal frame along the basis, (3, 3), as columns."""
    clean = camera.orthonormalized()
    frame = np.column_stack([clean.u, clean.v, clean.w])
    if volume(clean.u, clean.v, clean.w) < 0:
        frame[:, 0] = -frame[:, 0]
    return frame


def nearest_rotation(matrix: Floats) -> Floats:
    """Return the rotation nearest to a matrix (3, 3) that is almost one. Source: Kabsch 1976."""
    left, _, right = np.linalg.svd(matrix)
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    rotation: Floats = (left * signs) @ right
    return rotation


_begun = -1  # the frame of the latest handles
_let_go = False


def begin_handles() -> None:
    """Begin a frame of handles. Call it before each of them is drawn."""
    global _begun
    if _begun != imgui.get_frame_count():
        _begun = imgui.get_frame_count()
        gizmo.begin_frame()


def let_go() -> None:
    """End the drag of a handle although the mouse is still down. ImGuizmo itself continues it."""
    global _let_go
    _let_go = True


def is_dragging() -> bool:
    """Return True while a handle that was just drawn is dragged."""
    global _let_go
    _let_go = _let_go and imgui.is_mouse_down(0)
    return gizmo.is_using() and not _let_go


def escaped() -> bool:
    """Return True if Escape cancels and ends the drag of a handle.

    Call this in each frame of a drag: Escape does nothing else meanwhile.
    """
    imgui.internal.set_key_owner(imgui.Key.escape, imgui.get_id("handle"))
    if not imgui.is_key_pressed(imgui.Key.escape, False):
        return False
    let_go()
    return True


def widen() -> None:
    """Set the widths of the handles' lines."""
    style = gizmo.get_style()
    style.translation_line_thickness = theme.line_px(WIDTH)
    style.translation_line_arrow_size = style.center_circle_size = theme.px(ARROW)
    style.rotation_line_thickness = style.rotation_outer_line_thickness = theme.line_px(RING)


def matrix16(matrix: Floats) -> imguizmo.im_guizmo.Matrix16:
    """Return a matrix in OpenGL's order, column by column."""
    return gizmo.Matrix16(matrix.T.ravel().tolist())
