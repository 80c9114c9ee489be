"""Handles in the outside view that move the eye of the other camera and turn its basis (ImGuizmo).

Owns the drag of a handle. Knows nothing of what else is drawn.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from imgui_bundle import imgui, imguizmo
from numpy.typing import NDArray

from app import theme
from app.views.outside_mouse import Scope
from app.views.outside_tint import handle_colors, recolor
from renderer.camera import Camera, Vector, volume
from renderer.errors import LucidaError

gizmo = imguizmo.im_guizmo
Floats = NDArray[np.float64]

LENGTH = 0.2  # of the view: the handles' length in clip space
WIDTH, ARROW, RING = 3.0, 7.0, 2.5  # at 100 %: of lines, their heads, rings
NEAREST = 0.02  # of the view's distance: an eye that is nearer has no handles


@dataclass(frozen=True)
class _Drag:
    """camera: at its beginning. frame: the handles' axes then, columns of a rotation."""

    camera: Camera
    frame: Floats
    number: int


class Gizmo:
    """One for the view. over: whether the mouse was over a handle, or drags one."""

    def __init__(self) -> None:
        self.over = False
        self._drag: _Drag | None = None
        self._count = 0

    @property
    def gesture(self) -> tuple[str, int]:
        """What the changes of one drag have in common, for undo."""
        return ("outside gizmo", self._count)

    @property
    def dragging(self) -> bool:
        return self._drag is not None

    def cancel(self) -> None:
        self._drag = None

    def draw(
        self, scope: Scope, camera: Camera, kind: Literal["move", "turn"], orthonormal: bool
    ) -> Camera:
        """Draws the handles into the current window, and gives the camera as they have moved it.

        orthonormal: the basis stays so to the last digit.
        """
        matrices = gl_matrices(scope.shown, np.asarray(camera.eye), scope.reach)
        if matrices is None:
            self.over, self._drag = False, None
            return camera
        view, projection = matrices
        frame = rotation_of(camera) if self._drag is None else self._drag.frame
        if self._drag is not None:
            frame = rotation_between(self._drag.camera, camera) @ frame
        placed = np.eye(4)
        placed[:3, :3], placed[:3, 3] = frame, camera.eye
        matrix = _matrix16(placed)
        gizmo.begin_frame()
        gizmo.set_orthographic(scope.shown.is_parallel)
        gizmo.set_drawlist()
        gizmo.set_rect(scope.origin.x, scope.origin.y, scope.extent.x, scope.extent.y)
        gizmo.set_gizmo_size_clip_space(LENGTH)
        gizmo.allow_axis_flip(False)
        operation = gizmo.OPERATION.translate if kind == "move" else gizmo.OPERATION.rotate
        mode = gizmo.MODE.local  # its x, y and z are then u, v and w
        _widen()
        draw = imgui.get_window_draw_list()
        first = draw.vtx_buffer.size()
        moved = gizmo.manipulate(_matrix16(view), _matrix16(projection), operation, mode, matrix)
        recolor(draw, first, handle_colors())
        using = gizmo.is_using()
        self.over = using or gizmo.is_over()
        if not using:
            self._drag = None
            return camera
        if self._drag is None:
            self._count += 1
            self._drag = _Drag(camera, frame, self._count)
        if not moved:
            return camera
        result = np.asarray(matrix.values, float).reshape(4, 4).T
        return self._moved(camera, result, kind, orthonormal)

    def _moved(self, camera: Camera, result: Floats, kind: str, orthonormal: bool) -> Camera:
        assert self._drag is not None
        if not np.isfinite(result).all():
            return camera
        try:
            if kind == "move":
                return replace(camera, eye=_vector(result[:3, 3]))
            turn = nearest_rotation(result[:3, :3] @ self._drag.frame.T)
            basis = {name: _vector(turn @ getattr(self._drag.camera, name)) for name in "uvw"}
            turned = replace(camera, **basis)  # type: ignore[arg-type]
            return turned.orthonormalized() if orthonormal else turned
        except LucidaError:  # beyond the numbers: the camera stays
            return camera


def gl_matrices(camera: Camera, point: Floats, reach: float) -> tuple[Floats, Floats] | None:
    """View and projection as OpenGL has them, for handles at a point; None where the point is not
    well in front of the camera."""
    view = camera.camera_from_world.copy()
    depth = -float(view[2, :3] @ point + view[2, 3])  # in units of w
    scale = max(abs(depth), reach / float(np.linalg.norm(camera.w)))
    if not np.isfinite(depth) or depth < NEAREST * scale or depth < 1e-9:
        return None
    if camera.is_parallel:
        return view, camera.clip_from_camera(-20 * scale, 20 * scale)
    return view, camera.clip_from_camera(1e-3 * depth, 1e3 * scale)


def rotation_of(camera: Camera) -> Floats:
    """A right-handed orthonormal frame along the basis, (3, 3), as columns: for handles."""
    clean = camera.orthonormalized()
    frame = np.column_stack([clean.u, clean.v, clean.w])
    if volume(clean.u, clean.v, clean.w) < 0:
        frame[:, 0] = -frame[:, 0]
    return frame


def rotation_between(before: Camera, after: Camera) -> Floats:
    """The rotation that takes one camera's basis to another's."""
    return nearest_rotation(after.basis @ np.linalg.inv(before.basis))


def nearest_rotation(matrix: Floats) -> Floats:
    """The rotation nearest to a matrix (3, 3) that is almost one. Source: Kabsch 1976."""
    left, _, right = np.linalg.svd(matrix)
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    rotation: Floats = (left * signs) @ right
    return rotation


def _widen() -> None:
    """Lines as wide as others that teach."""
    style = gizmo.get_style()
    style.translation_line_thickness = theme.line_px(WIDTH)
    style.translation_line_arrow_size = theme.px(ARROW)
    style.rotation_line_thickness = style.rotation_outer_line_thickness = theme.line_px(RING)
    style.center_circle_size = theme.px(ARROW)


def _matrix16(matrix: Floats) -> imguizmo.im_guizmo.Matrix16:
    """Column by column, as OpenGL has it."""
    return gizmo.Matrix16(matrix.T.ravel().tolist())


def _vector(values: Floats) -> Vector:
    x, y, z = values.tolist()
    return x, y, z
