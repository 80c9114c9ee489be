"""Random cameras of ours, points that they see, and the pixels that they see them at.

Pixels are (x, y) from the image's left upper corner, centres at .5: what formats differ in is
theirs to add.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.files.cameras import CameraSet, Options, PosedCamera, read_cameras, written
from lucida.renderer.files.cameras.given import Given
from tests.support.format_cameras import lens_camera
from tools.conformance.measured import Job

POINTS = 8  # a camera
NEAREST, FARTHEST = 0.5, 5.0  # of the viewport's distance, or of w in parallel rays
LEAST_SIDE, MOST_SIDE = 16, 3000  # of an image


@dataclass(frozen=True)
class Case:
    """points: (POINTS, 3) in the world. pixels: (POINTS, 2), as our camera has them."""

    posed: PosedCamera
    points: Floats
    pixels: Floats

    @property
    def camera(self) -> Camera:
        return self.posed.camera

    @property
    def size(self) -> Size:
        assert self.posed.size is not None
        return self.posed.size

    def file(self, format: str, options: Options | None = None) -> bytes:
        """This camera as a format's file."""
        return written([self.posed], format, options)


MakeCamera = Callable[[np.random.Generator, str], Camera]


def any_size(random: np.random.Generator) -> Size:
    width, height = random.integers(LEAST_SIDE, MOST_SIDE, 2).tolist()
    return width, height


def cases(job: Job, make: MakeCamera, parallel: bool = False) -> Iterator[Case]:
    """As many as the job wants; parallel: every second one is."""
    random = job.random
    for number in range(job.cameras):
        projection = "parallel" if parallel and number % 2 else "perspective"
        yield case_of(make(random, projection), any_size(random), random, f"c{number}.png")


def lens_cases(job: Job, kinds: Sequence[str]) -> Iterator[Case]:
    """As many as the job wants, with lenses of these kinds of LENSES, one after another."""
    random = job.random
    for number in range(job.cameras):
        kind = kinds[number % len(kinds)]
        case = None
        while case is None or not np.isfinite(case.pixels).all():  # a lens may not see a corner
            camera = lens_camera(random, kind)
            case = case_of(camera, any_size(random), random, f"c{number}.png")
        yield case


def case_of(camera: Camera, size: Size, random: np.random.Generator, name: str) -> Case:
    """Points all over its image, at different depths."""
    row, column = random.uniform(0, 1, (2, POINTS)) * np.array(size[::-1])[:, None] - 0.5
    ray = camera.ray(row, column, size)
    points = ray.origin + random.uniform(NEAREST, FARTHEST, (POINTS, 1)) * ray.direction
    return Case(PosedCamera(camera, size, name), points, pixels(camera, points, size))


def pixels(camera: Camera, points: Floats, size: Size | None) -> Floats:
    """Return the pixels of points by our camera, (n, 2)."""
    assert size is not None
    seen = camera.project(points, size)
    return np.stack([seen.column + 0.5, seen.row + 0.5], axis=-1)


def read(data: bytes, format: str, options: Options | None = None) -> CameraSet:
    """Cameras of a file's content, found without its name."""
    found = read_cameras(Given("file", data), options=options)
    if found.format != format:
        raise AssertionError(f"a file of {format} was taken for {found.format}")
    return found


def only(cameras: CameraSet) -> PosedCamera:
    (camera,) = cameras.cameras
    return camera


def sight(K: Floats, R: Floats, t: Floats, points: Floats) -> Floats:
    """Computer vision's own formula: K (R p + t), divided by its third part; (n, 2)."""
    seen = (points @ R.T + t) @ K.T
    return seen[:, :2] / seen[:, 2:]


def from_clip(clip_from_world: Floats, points: Floats, size: Size) -> Floats:
    """OpenGL's and glTF's: column vectors into clip space, y up, to the image's size; (n, 2)."""
    clip = np.column_stack([points, np.ones(len(points))]) @ clip_from_world.T
    x, y = (clip[:, :2] / clip[:, 3:]).T
    return np.stack([(x + 1) / 2 * size[0], (1 - y) / 2 * size[1]], axis=-1)


def points_ahead(random: np.random.Generator) -> Floats:
    """(POINTS, 3), in computer vision's camera space: z forward."""
    x, y = random.uniform(-1, 1, (2, POINTS))
    return np.column_stack([x, y, random.uniform(2, 4, POINTS)])


def any_pose(random: np.random.Generator) -> Floats:
    """Return a rotation and a translation, (4, 4)."""
    pose = np.eye(4)
    pose[:3, :3], _ = np.linalg.qr(random.normal(size=(3, 3)))
    pose[:3, 0] *= np.linalg.det(pose)
    pose[:3, 3] = 3 * random.normal(size=3)
    return pose
