"""A set of cameras: their names, frusta and points for the outside view, the path through them.

These are computed once per set. Pure; slow functions are called on a thread.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lucida.app.cameras.taken import is_fitted
from lucida.app.instruments.outside.cloud import Cloud
from lucida.app.instruments.outside.diagram import Segments
from lucida.app.instruments.outside.extent import framed, looked_from
from lucida.app.instruments.outside.frustum import border, point_at
from lucida.app.state.app_state import AppState
from lucida.app.state.paths import stored
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.files.cameras import CameraSet, PosedCamera, read_cameras
from lucida.renderer.files.cameras.given import given
from lucida.renderer.scene.model import Scene, View

Floats = NDArray[np.float64]

LINES = 10  # per camera: four edges, four sides of its image, two to mark up
CURVE = 4  # parts of a side that a lens bends
UP = 0.28  # the height of the mark for up, relative to the image's
INLIERS = (1.0, 99.0)  # percentiles that bound a reconstruction; points outside are strays
LOOKED_AT = 50_000  # points that are examined for that
SEED = 7  # for the order in which points are drawn
PLAIN = 150  # gray of points without colours
CORNERS = np.array(list(np.ndindex(2, 2, 2)), bool)  # a box's corners: True for the higher side
NO_POINTS = (np.zeros((0, 3), np.float32), np.zeros((0, 3), np.uint8))
# A frustum's length, relative to the cameras' extent: shorter if there are many.
SHORTEST, LONGEST, FOR_ONE = 0.03, 0.15, 0.7


@dataclass(frozen=True, eq=False)
class PoseSet:
    """A set of cameras.

    path: its file or folder.
    origins, ways: (n, 4 parts, 3), the origins and the equally long directions of the rays through
    the image's corners, and between them if there is a lens, from the upper left to the right.
    points, colors: a reconstruction's points, as in Cloud.
    low, high: (3,), a box around the cameras and most of the points.
    told: notes on the set, a phrase each.
    """

    path: Path
    format: str
    cameras: tuple[PosedCamera, ...]
    names: tuple[str, ...]
    origins: Floats
    ways: Floats
    points: NDArray[np.float32]
    colors: NDArray[np.uint8]
    low: Floats
    high: Floats
    told: tuple[str, ...]

    @property
    def origin(self) -> Floats:
        """Return the origin of positions in float32."""
        return (self.low + self.high) / 2

    @property
    def parts(self) -> int:
        """Return the number of parts of an image's side, which lenses bend; 1 if it is straight."""
        return self.ways.shape[1] // 4

    @property
    def lines(self) -> int:
        """Return the number of lines of a camera."""
        return LINES + 4 * (self.parts - 1)

    @property
    def length(self) -> float:
        """Return a length of frusta that suits the set, world units."""
        eyes = self.origins.mean(axis=1)
        reach = float(np.linalg.norm(np.ptp(eyes, axis=0))) / 2
        reach = reach or float(np.linalg.norm(self.high - self.low)) / 2 or 1.0
        return reach * min(max(FOR_ONE / len(eyes) ** 0.5, SHORTEST), LONGEST)

    @property
    def up(self) -> Floats:
        """Return the direction that is up in most of the images, a unit vector; (0, 1, 0) if they
        do not agree.

        Reconstructions are often upside down.
        """
        ways = np.array([posed.camera.v for posed in self.cameras], float)
        mean = (ways / np.linalg.norm(ways, axis=1, keepdims=True)).mean(axis=0)
        size = float(np.linalg.norm(mean))
        return mean / size if size > 0.3 else np.array([0.0, 1.0, 0.0])

    @property
    def folder(self) -> Path:
        """Return the base of relative paths in the set."""
        return self.path if self.path.is_dir() else self.path.parent

    @property
    def title(self) -> str:
        """Return the file's name; a folder's includes its parent, because many are called 0."""
        path = self.path
        return f"{path.parent.name}/{path.name}" if not path.suffix else path.name

    @property
    def counts(self) -> str:
        """Return the numbers of cameras and points, in words."""
        count, points = len(self.names), len(self.points)
        words = f"{count:,} camera{'s' if count != 1 else ''}"
        return words + (f", {points:,} points" if points else "")

    def view(self, number: int) -> View:
        """Return the view of a camera. Images of other resolutions show more, never less."""
        posed = self.cameras[number]
        return View(posed.camera, is_fitted(posed), (posed.camera, posed.size))


def load_poses(path: Path) -> CameraSet:
    """Return the contents of a file or a folder. Raises LucidaError."""
    return read_cameras(given(path))


def pose_set(path: Path, found: CameraSet) -> PoseSet:
    """Prepare a set. This takes some seconds for ten thousand cameras and millions of points."""
    curved = any(posed.camera.lens is not None for posed in found.cameras)
    rays = [_border_rays(posed.camera, CURVE if curved else 1) for posed in found.cameras]
    origins = np.array([origin for origin, _ in rays], float)
    ways = np.array([way for _, way in rays], float)
    eyes = origins.mean(axis=1)
    low, high = eyes.min(axis=0), eyes.max(axis=0)
    points, colors = np.zeros((0, 3)), np.zeros((0, 3), np.uint8)
    if found.points is not None:
        points = np.asarray(found.points, float).reshape(-1, 3)
        order = np.flatnonzero(np.isfinite(points).all(axis=1))
        order = np.random.default_rng(SEED).permutation(order)
        points = points[order]
        colors = np.full((len(order), 3), PLAIN, np.uint8)
        if found.point_colors is not None:
            colors = np.asarray(found.point_colors, np.uint8)[order]
    most = points[:LOOKED_AT]
    if len(most):
        ends = np.percentile(most, INLIERS, axis=0)
        low, high = np.minimum(low, ends[0]), np.maximum(high, ends[1])
    return PoseSet(
        path,
        found.format,
        found.cameras,
        _names(found.cameras),
        origins,
        ways,
        (points - (low + high) / 2).astype(np.float32),
        colors,
        low,
        high,
        found.taken,
    )


def _border_rays(camera: Camera, parts: int) -> tuple[Floats, Floats]:
    """Return the rays around a camera's image. parts: parts per side, 1 for the corners."""
    x, y = border(camera, parts).T
    origins, ends = (point_at(camera, x, y, t) for t in (0.0, 1.0))
    return origins, (ends - origins) / np.linalg.norm(ends - origins, axis=1).mean()


def _names(cameras: Sequence[PosedCamera]) -> tuple[str, ...]:
    """Return the names without their common folder. Unnamed cameras have their numbers."""
    names = [posed.name or posed.image or str(n) for n, posed in enumerate(cameras)]
    first, last = min(names), max(names)  # a prefix that these share is shared by all
    pairs = enumerate(zip(first, last, strict=False))
    shared = next((place for place, (one, other) in pairs if one != other), len(first))
    start = first.rfind("/", 0, shared) + 1
    return tuple(name[start:] for name in names)


# In the outside view.


def frusta(
    poses: PoseSet, numbers: Sequence[int] | NDArray[np.int64] | slice = slice(None)
) -> Floats:
    """Return lines (n * poses.lines, 2, 3) of these cameras."""
    origins = poses.origins[numbers]
    ends = origins + poses.length * poses.ways[numbers]
    corners, at = ends[:, :: poses.parts], poses.parts // 2
    middle_top, middle_bottom = (corners[:, ::2] + corners[:, 1::2]).swapaxes(0, 1) / 2
    if at:  # a curve
        middle_top, middle_bottom = ends[:, at], ends[:, 2 * poses.parts + at]
    tip = middle_top + UP * (middle_top - middle_bottom)
    nexts = np.roll(ends, -1, axis=1)
    lines = np.concatenate(
        [
            np.stack([origins[:, :: poses.parts], corners], axis=2),
            np.stack([ends, nexts], axis=2),
            np.stack([corners[:, :2], np.stack([tip, tip], axis=1)], axis=2),
        ],
        axis=1,
    )
    return lines.reshape(-1, 2, 3)


def cloud(poses: PoseSet, with_points: bool) -> Cloud:
    """Return a whole set as a cloud."""
    size = poses.length
    lines = Segments("poses", "pose", frusta(poses), 1.3, 0.9)
    points, colors = (poses.points, poses.colors) if with_points else NO_POINTS
    eyes = poses.origins.mean(axis=1)
    low, high = (poses.low, poses.high) if with_points else (eyes.min(axis=0), eyes.max(axis=0))
    around = np.where(CORNERS, high + size, low - size)
    return Cloud(lines, poses.origin, points, colors, around)


def with_set(state: AppState, poses: PoseSet, scene: Scene | None) -> AppState:
    """Return the state with a set. scene: the scene to view with the set's first camera; None to
    keep the current scene and camera.
    """
    file = stored(str(poses.path))
    if scene is None:
        return state.with_options(replace(state.options.poses, file=file, pose=-1))
    seen = state.with_scene(scene, poses.view(0))
    return seen.with_options(replace(seen.options.poses, file=file, pose=0))


def with_set_framed(state: AppState, poses: PoseSet, size: Size | None) -> AppState:
    """Return the state in which the outside view, of `size`, sees all of the set."""
    points = cloud(poses, state.options.poses.points).around
    way = looked_from(poses.up, np.asarray(state.camera.w))
    width, height = size or (4, 3)
    camera = framed(points, way, width / height, up=poses.up)
    return state.with_options(replace(state.options.outside, camera=camera))
