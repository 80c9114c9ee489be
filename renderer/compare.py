"""Raster against ray: do the two images agree, and where not, is a line of the image the reason?

Owns the promise of parity: the tolerances and the causes. Knows nothing of files or windows.

Two pixels agree if object, ray parameter, normal and colour do, within the tolerances below. A
disagreement is explained if the pixel's centre lies within TOLERANCE_PX of a line where the exact
image jumps (renderer/edges.py): a rasterizer that snaps vertices may then see the other side.
Only lines of the two primitives that were seen count, never those of something hidden.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera
from renderer.edges import Lines
from renderer.frame import CHANNELS, Frame
from renderer.images.display import encode_srgb
from renderer.scene.flat import FlatScene, flatten
from renderer.scene.model import Scene

TOLERANCE_PX = 1 / 128
DEPTH_RELATIVE = 1e-4
NORMAL = 1e-3  # a component
COLOR = 2 / 255  # after the display transform

CAUSES = ("outline", "meeting", "clip", "checker", "grazing")
AGREE, UNEXPLAINED = 0, 255  # labels; a cause's label is its place in CAUSES plus 1
MOST_EXAMINED = 1 << 20  # disagreeing pixels; more than that is not a matter of edges

_SLOPE_OF_SRGB = 12.92  # the steepest: smaller linear differences need no closer look


@dataclass(frozen=True, eq=False)
class Comparison:
    """Counts of pixels, the largest errors among the agreeing ones, and a label a pixel.

    explained: pixels by cause. "outline": at the edge of what one of the two saw. "meeting": where
    two surfaces meet. "clip": where near or far cuts. "checker": at a cell's border. "grazing": the
    surface is so oblique that TOLERANCE_PX moves its depth by more than the difference.
    labels: uint8 (height, width). worst: (row, column) of the largest colour difference.
    times_s: what each renderer took.
    """

    size: tuple[int, int]
    agree: int
    explained: dict[str, int]
    unexplained: int
    max_depth_error: float
    max_normal_error: float
    max_color_error: float
    worst: tuple[int, int]
    times_s: dict[str, float]
    labels: NDArray[np.uint8]
    raster: Frame
    ray: Frame

    @property
    def pixels(self) -> int:
        return self.size[0] * self.size[1]

    def to_dict(self) -> dict[str, object]:
        """Everything but the images, as plain numbers."""
        return {
            "size": list(self.size),
            "pixels": self.pixels,
            "agree": self.agree,
            "explained": dict(self.explained),
            "unexplained": self.unexplained,
            "max_depth_error": self.max_depth_error,
            "max_normal_error": self.max_normal_error,
            "max_color_error": self.max_color_error,
            "worst": list(self.worst),
            "times_s": dict(self.times_s),
        }

    def summary(self) -> str:
        """A few lines for the command line."""
        width, height = self.size
        causes = ", ".join(f"{name} {count}" for name, count in self.explained.items() if count)
        return "\n".join(
            [
                f"{width}x{height}: {self.agree} of {self.pixels} pixels agree",
                f"explained:   {sum(self.explained.values())}" + (f" ({causes})" if causes else ""),
                f"unexplained: {self.unexplained}",
                f"largest errors where they agree: depth {self.max_depth_error:.1e} (relative), "
                f"normal {self.max_normal_error:.1e}, color {self.max_color_error * 255:.2f}/255",
                "raster {raster:.1f} ms, ray {ray:.1f} ms".format(
                    **{name: 1e3 * time for name, time in self.times_s.items()}
                ),
            ]
        )

    def summary_short(self) -> str:
        """For a status line."""
        if self.unexplained:
            return f"disagree: {_pixels(self.unexplained)}"
        edges = sum(self.explained.values())
        if not edges:
            return "agree: all pixels"
        return f"agree: all but {_pixels(edges, 'edge ')}"

    def difference_image(self) -> NDArray[np.uint8]:
        """uint8 (height, width, 3): the raster image darkened, explained pixels in blue,
        unexplained ones in vermilion."""
        gray = 0.35 * encode_srgb(self.raster.channel("color")).mean(axis=2, keepdims=True)
        image = np.repeat((255 * gray).astype(np.uint8), 3, axis=2)
        image[(self.labels != AGREE) & (self.labels != UNEXPLAINED)] = (86, 180, 233)
        image[self.labels == UNEXPLAINED] = (255, 94, 0)
        return image


def compare(
    scene: Scene,
    camera: Camera,
    size: tuple[int, int],
    backend: str = "auto",
    progress: Callable[[float], None] | None = None,
) -> Comparison:
    """Renders the scene with both renderers and compares; progress gets fractions 0 to 1."""
    from renderer.raster import Rasterizer  # heavy, and not needed by compare_frames
    from renderer.trace import Tracer

    with Rasterizer(scene, backend=backend) as rasterizer:
        raster = rasterizer.render(camera, size, channels=CHANNELS)
    with Tracer(scene) as tracer:
        ray = tracer.render(camera, size, channels=CHANNELS, progress=progress)
    return compare_frames(flatten(scene), camera, size, raster, ray)


def compare_frames(
    flat: FlatScene, camera: Camera, size: tuple[int, int], raster: Frame, ray: Frame
) -> Comparison:
    """Compares two frames that hold all CHANNELS of the same view; size: (width, height)."""
    disagree, errors, color_error = _disagreement(raster, ray)
    labels = np.where(disagree, np.uint8(UNEXPLAINED), np.uint8(AGREE))
    i, j = np.nonzero(disagree)
    if 0 < len(i) <= MOST_EXAMINED:
        labels[i, j] = _explain(flat, camera, size, raster, ray, i, j)
    counts = np.bincount(labels.ravel(), minlength=256)
    row, column = np.unravel_index(int(np.argmax(color_error)), color_error.shape)
    return Comparison(
        size=size,
        agree=int(counts[AGREE]),
        explained={name: int(counts[k]) for k, name in enumerate(CAUSES, start=1)},
        unexplained=int(counts[UNEXPLAINED]),
        max_depth_error=errors[0],
        max_normal_error=errors[1],
        max_color_error=errors[2],
        worst=(int(row), int(column)),
        times_s={"raster": raster.time_s, "ray": ray.time_s},
        labels=labels,
        raster=raster,
        ray=ray,
    )


def _disagreement(
    raster: Frame, ray: Frame
) -> tuple[NDArray[np.bool_], tuple[float, float, float], NDArray[np.float32]]:
    """Where the frames disagree; the largest errors elsewhere; the colour error everywhere."""
    depth_a, depth_b = raster.channel("depth"), ray.channel("depth")
    color_a, color_b = raster.channel("color"), ray.channel("color")
    with np.errstate(invalid="ignore"):
        both_missed = np.isposinf(depth_a) & np.isposinf(depth_b)
        depth = np.where(both_missed, 0, np.abs(depth_a - depth_b) / depth_b)
    normal = np.abs(raster.channel("normal") - ray.channel("normal")).max(axis=2)
    color = np.abs(color_a - color_b).max(axis=2) * np.float32(_SLOPE_OF_SRGB)
    # The display transform is costly and shrinks most differences: only where it may matter.
    near = color > COLOR
    color[near] = np.abs(encode_srgb(color_a[near]) - encode_srgb(color_b[near])).max(axis=1)
    disagree = raster.channel("id") != ray.channel("id")
    # Negated comparisons, so that NaN disagrees with everything.
    disagree |= ~(depth <= DEPTH_RELATIVE) | ~(normal <= NORMAL) | ~(color <= COLOR)
    agree = ~disagree
    errors = (
        float(depth[agree].max(initial=0)),
        float(normal[agree].max(initial=0)),
        float(color[agree].max(initial=0)),
    )
    return disagree, errors, color


def _explain(
    flat: FlatScene,
    camera: Camera,
    size: tuple[int, int],
    raster: Frame,
    ray: Frame,
    i: NDArray[np.intp],
    j: NDArray[np.intp],
) -> NDArray[np.uint8]:
    """The labels of the disagreeing pixels (i, j)."""
    lines = Lines(flat, camera, size)
    seen = [
        (frame.channel("primitive")[i, j], frame.channel("depth")[i, j].astype(float))
        for frame in (raster, ray)
    ]
    (first, t_first), (second, t_second) = seen
    t = np.where(second >= 0, t_second, t_first)
    same = (first == second) & (first >= 0)
    # The cases in the order of CAUSES: each a distance in pixels.
    distances = [
        np.fmin(lines.outline_px(first, i, j), lines.outline_px(second, i, j)),
        lines.meeting_px(first, second, i, j, t),
        np.fmin(lines.clip_px(first, i, j, t_first), lines.clip_px(second, i, j, t_second)),
        np.where(same, lines.checker_px(second, i, j, t), np.inf),
    ]
    with np.errstate(divide="ignore", invalid="ignore"):
        difference = np.abs(t_first - t_second)
        moved = difference / lines.slope(second, i, j, t)
    grazing = same & (difference > DEPTH_RELATIVE * t) & ~np.isnan(moved)
    distances.append(np.where(grazing, moved, np.inf))
    labels = np.full(len(i), UNEXPLAINED, np.uint8)
    for label in range(len(CAUSES), 0, -1):
        labels[distances[label - 1] <= TOLERANCE_PX] = label
    return labels


def _pixels(count: int, kind: str = "") -> str:
    return f"{count} {kind}pixel{'' if count == 1 else 's'}"
