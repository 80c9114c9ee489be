"""Handles in the outside view that move the eye or the image plane of the camera, and turn its
basis, or the vector up that the basis is made from (ImGuizmo).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui, imguizmo
from numpy.typing import ArrayLike

from lucida.app.instruments.outside.frustum import plane_corners
from lucida.app.instruments.outside.mouse import Scope
from lucida.app.instruments.outside.tint import Rgb8, handle_colors, hide_text, recolor
from lucida.app.ui import theme
from lucida.app.ui.contrast import Rgb
from lucida.app.ui.host import Host
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats, Vector, three, volume
from lucida.renderer.system.errors import LucidaError

gizmo = imguizmo.im_guizmo
Kind = Literal["none", "move", "turn", "distance", "up"]

LENGTH = 0.26  # of the view: the handles' length in clip space
WIDTH, ARROW, RING = 3.0, 7.0, 2.5  # at 100 %: of lines, their heads, rings
TEXT_AT = 18.0  # at 100 %: what the motion's text is away from the eye, to the right and below
LEAST_PART = 1e-4  # of the largest part of a motion: what is less is rounding
ALONG = 0.999  # the cosine from which on a turn is about an axis of the basis
PARALLEL = math.sin(math.radians(3))  # of up with w: then it is put quite parallel
LEAST_DISTANCE = 0.01  # of the largest one while a plane is dragged
NEAREST = 0.02  # of the view's distance: an eye that is nearer has no handles


@dataclass(frozen=True)
class _Drag:
    """A drag. camera, up, frame: at its start; the frame is the handles' axes, as columns of a
    rotation. turned: by how much they have been turned since.
    """

    camera: Camera
    up: Vector
    frame: Floats
    turned: Floats


class Gizmo:
    """The handles of the view. over: True if the mouse was over a handle, or drags one."""

    def __init__(self) -> None:
        self.over = False
        self._drag: _Drag | None = None
        self._count = 0

    @property
    def dragging(self) -> bool:
        return self._drag is not None

    def cancel(self) -> None:
        if self._drag is not None:
            let_go()
        self._drag = None

    def follow(self, host: Host, scope: Scope, ground: Rgb) -> None:
        """Draw the selected handles into the current window, and move the camera by them.

        ground: the colour under the handles.
        """
        state, options = host.state, host.state.options.outside
        if options.gizmo == "none" or (options.gizmo == "up" and options.target is None):
            self.over = False
            self.cancel()
            return
        before = state.camera, options.up
        after = self._draw(scope, before, options.gizmo, state.keep_orthonormal, ground, host.fonts)
        if after != before:
            # One drag is one undo step.
            state = state.with_camera(after[0]).with_options(replace(options, up=after[1]))
            host.apply(state, ("outside gizmo", self._count))
        if self.dragging:
            host.animate()

    def _draw(
        self,
        scope: Scope,
        now: tuple[Camera, Vector],
        kind: Kind,
        orthonormal: bool,
        ground: Rgb,
        fonts: theme.Fonts,
    ) -> tuple[Camera, Vector]:
        """Draw the handles. Return the camera and up as they moved them."""
        camera, up = now
        middle = np.asarray(camera.eye, float)
        if kind == "distance":
            middle = plane_corners(camera).mean(axis=0)
        frame = rotation_of(camera)
        if self._drag is not None:
            frame = self._drag.turned @ self._drag.frame
        placed = np.eye(4)
        placed[:3, :3], placed[:3, 3] = frame, middle
        operation = {
            "move": gizmo.OPERATION.translate,
            "distance": gizmo.OPERATION.translate_z,
        }.get(kind, gizmo.OPERATION.rotate)
        # In its own space, x, y and z are u, v and w.
        asked = Handle(
            "outside", placed, operation, gizmo.MODE.local, LENGTH, handle_colors(ground)
        )
        found = manipulate(asked, scope.shown, scope.origin, scope.extent, scope.reach)
        if found is None:
            self.over, self._drag = False, None
            return now
        self.over = found.over
        if not found.using:
            self._drag = None
            return now
        if self._drag is not None and escaped():
            begun, self._drag = self._drag, None
            return begun.camera, begun.up
        if self._drag is None:
            self._count += 1
            self._drag = _Drag(camera, up, frame, np.eye(3))
        if found.moved is not None:
            camera, up = self._moved(now, found.moved, kind, orthonormal)
        text = motion(self._drag.camera, camera)
        if kind == "distance":
            text = f"d = {camera.distance:.4g}"
        write(text, found.clip_from_world, middle, scope.origin, scope.extent, fonts)
        return camera, up

    def _moved(
        self, now: tuple[Camera, Vector], result: Floats, kind: Kind, orthonormal: bool
    ) -> tuple[Camera, Vector]:
        assert self._drag is not None
        if not np.isfinite(result).all():
            return now
        (camera, up), begun = now, self._drag
        try:
            if kind == "move":
                return replace(camera, eye=three(result[:3, 3])), up
            if kind == "distance":
                return replace(camera, distance=distance_of(begun.camera, result[:3, 3])), up
            turned = nearest_rotation(result[:3, :3] @ begun.frame.T)
            self._drag = replace(begun, turned=turned)
            if kind == "up":
                return with_up(camera, begun.camera, turned @ begun.up)
            basis = {name: three(turned @ getattr(begun.camera, name)) for name in "uvw"}
            other = replace(camera, **basis)  # type: ignore[arg-type]
            return other.orthonormalized() if orthonormal else other, up
        except LucidaError:  # beyond the numbers: the camera stays
            return now


def distance_of(camera: Camera, middle: Floats) -> float:
    """Return the distance, in units of w, at which the image plane goes through a point."""
    ahead = np.linalg.solve(camera.basis, np.subtract(camera.eye, middle))[2]
    return max(float(ahead), LEAST_DISTANCE * camera.distance)


def with_up(camera: Camera, before: Camera, up: Floats) -> tuple[Camera, Vector]:
    """Return a camera whose basis is made from w and `up`, and the vector up, which becomes
    parallel to w if it almost is. Then there is no basis, and the camera stays.

    before: has w, and the lengths of u and v.
    """
    w = np.asarray(before.w) / np.linalg.norm(before.w)
    across = np.cross(up, w)
    if np.linalg.norm(across) < PARALLEL * np.linalg.norm(up):
        return camera, three(np.copysign(np.linalg.norm(up), up @ w) * w)
    u = across / np.linalg.norm(across)
    lengths = (float(np.linalg.norm(v)) for v in (before.u, before.v))
    u, v = (length * axis for length, axis in zip(lengths, (u, np.cross(w, u)), strict=True))
    return replace(camera, u=three(u), v=three(v)), three(up)


def motion(before: Camera, after: Camera) -> str:
    """Return in the letters of the basis what a handle did: the displacement of the eye along u, v
    and w, or the angle and the axis by which the basis was turned.
    """
    moved = np.linalg.solve(before.basis, np.subtract(after.eye, before.eye))
    rotation = rotation_between(before, after)
    angle = np.degrees(np.arccos(np.clip((np.trace(rotation) - 1) / 2, -1, 1)))
    if angle > 0.0 and np.abs(rotation - np.eye(3)).max() > 1e-9:
        axis = np.array([rotation[k - 1, k - 2] - rotation[k - 2, k - 1] for k in range(3)])
        along = rotation_of(before).T @ axis / max(float(np.linalg.norm(axis)), 1e-30)
        name = int(np.abs(along).argmax())
        if abs(along[name]) > ALONG:
            return f"about {'uvw'[name]}: {np.copysign(angle, along[name]):.1f}°"
        return f"turned by {angle:.1f}°"
    least = LEAST_PART * float(np.abs(moved).max())
    parts = [f"Δ{n} {x:.4g}" for n, x in zip("uvw", moved, strict=True) if abs(x) > least]
    return "  ".join(parts)


def write(
    text: str,
    clip_from_world: Floats,
    point: ArrayLike,
    origin: ImVec2,
    extent: ImVec2,
    fonts: theme.Fonts,
) -> None:
    """Write text next to a point of the world that is being moved, on its own ground.

    origin, extent: of the view. The font is the one that has Greek letters.
    """
    x, y, _, w = clip_from_world @ np.append(point, 1.0)
    if not text or not w > 0:
        return
    at = ImVec2(
        origin.x + (x / w + 1) / 2 * extent.x + theme.px(TEXT_AT),
        origin.y + (1 - y / w) / 2 * extent.y + theme.px(TEXT_AT),
    )
    imgui.push_font(fonts.bold, 0.0)
    size, pad = imgui.calc_text_size(text), theme.px(5)
    low, far = ImVec2(at.x - pad, at.y - pad), ImVec2(at.x + size.x + pad, at.y + size.y + pad)
    draw = imgui.get_window_draw_list()
    draw.add_rect_filled(low, far, theme.u32(theme.PANEL, 0.9), theme.px(3))
    draw.add_text(at, theme.u32(theme.TEXT), text)
    imgui.pop_font()


class Handle(NamedTuple):
    """Handles of ImGuizmo.

    name: distinguishes them from others. frame: (4, 4), where they are, with their axes. length: in
    clip space. colors: in place of ImGuizmo's. head_px: the most of an arrow's head. snap: the
    steps of a motion.
    """

    name: str
    frame: Floats
    operation: imguizmo.im_guizmo.OPERATION
    mode: imguizmo.im_guizmo.MODE
    length: float
    colors: Mapping[Rgb8, ImVec4]
    head_px: float = math.inf
    snap: imguizmo.im_guizmo.Matrix3 | None = None


class Manipulated(NamedTuple):
    """The mouse's effect on handles. moved: their new frame, (4, 4); None if it is the same."""

    using: bool
    over: bool
    moved: Floats | None
    clip_from_world: Floats


def manipulate(
    handle: Handle, camera: Camera, origin: ImVec2, extent: ImVec2, reach: float
) -> Manipulated | None:
    """Draw handles into the current window, seen by a camera; None if they are not well in front
    of it.

    origin, extent: of the view. reach: of everything in sight.
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
    widen(handle.head_px)
    draw = imgui.get_window_draw_list()
    first = draw.vtx_buffer.size()
    gizmo.push_id(handle.name)
    moved = gizmo.manipulate(
        matrix16(view), matrix16(projection), handle.operation, handle.mode, matrix,
        snap=handle.snap,
    )  # fmt: skip
    using, over = is_dragging(), gizmo.is_using() or gizmo.is_over()
    gizmo.pop_id()  # is_using() asks for the pushed one
    recolor(draw, first, handle.colors)
    hide_text(draw, first)
    after = np.asarray(matrix.values, float).reshape(4, 4).T if moved else None
    return Manipulated(using, over, after, projection @ view)


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


def rotation_between(before: Camera, after: Camera) -> Floats:
    """Return the rotation that takes one camera's basis to another's."""
    return nearest_rotation(after.basis @ np.linalg.inv(before.basis))


def nearest_rotation(matrix: Floats) -> Floats:
    """Return the rotation nearest to a matrix (3, 3) that is almost one. Source: Kabsch 1976."""
    left, _, right = np.linalg.svd(matrix)
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    rotation: Floats = (left * signs) @ right
    return rotation


_begun = -1
_let_go = False


def begin_handles() -> None:
    """Begin a frame of handles. Call it before each of them is drawn."""
    global _begun
    if _begun != imgui.get_frame_count():
        _begun = imgui.get_frame_count()
        gizmo.begin_frame()


def let_go() -> None:
    """End the drag of a handle although the mouse is still down. ImGuizmo itself goes on."""
    global _let_go
    _let_go = True


def is_dragging() -> bool:
    """Return True while a handle that was just drawn is dragged."""
    global _let_go
    _let_go = _let_go and imgui.is_mouse_down(0)
    return gizmo.is_using() and not _let_go


def escaped() -> bool:
    """Return True if Escape cancels and ends the drag of a handle.

    Call in each frame of a drag: Escape does nothing else meanwhile.
    """
    imgui.internal.set_key_owner(imgui.Key.escape, imgui.get_id("handle"))
    if not imgui.is_key_pressed(imgui.Key.escape, False):
        return False
    let_go()
    return True


def widen(most_px: float = math.inf) -> None:
    """Set the widths of the handles' lines. most_px: of an arrow's head, if handles are short."""
    style = gizmo.get_style()
    head = min(theme.px(ARROW), most_px)
    part = head / theme.px(ARROW)
    style.translation_line_thickness = style.scale_line_thickness = part * theme.line_px(WIDTH)
    style.translation_line_arrow_size = style.center_circle_size = head
    style.scale_line_circle_size = head
    ring = part * theme.line_px(RING)
    style.rotation_line_thickness = style.rotation_outer_line_thickness = ring


def matrix16(matrix: Floats) -> imguizmo.im_guizmo.Matrix16:
    """Return a matrix in OpenGL's order, column by column."""
    return gizmo.Matrix16(matrix.T.ravel().tolist())
