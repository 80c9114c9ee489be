"""Comparison of the two renderers' images, and of their differences with the lines of the image.

This module defines parity: the tolerances, the causes and the errors. difference.py defines the
differences, and their colours.

Two pixels agree if object, ray parameter, normal and colour do, within the tolerances below.
why_different.py finds the line of the image that explains a difference.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.pixels import ENLARGEMENT, Pixel
from lucida.renderer.images.difference import (
    CAUSE_COLORS,
    SHADING_COLOR,
    UNEXPLAINED_COLOR,
    difference,
    false_color,
    most,
)
from lucida.renderer.images.display import encode_srgb
from lucida.renderer.images.frame import CHANNELS, Frame
from lucida.renderer.images.shared_numbers import MUTED, SRGB_SLOPE
from lucida.renderer.scene.flat import FlatScene, flatten
from lucida.renderer.scene.model import Scene
from lucida.renderer.scene.precision import check_precision

from .why_black import hits_nothing, why_nothing_is_hit
from .why_different import CAUSES, DEPTH_RELATIVE, NORMAL, Differing, explained

COLOR = 2 / 255  # after the display transform

# Labels; a cause's label is its index in CAUSES plus 1. SHADING: the same hit in both images with a
# different colour that no line explains.
AGREE, SHADING, UNEXPLAINED = 0, 254, 255
MOST_EXAMINED = 1 << 20  # disagreeing pixels; more are not due to edges

_NEGLIGIBLE = 1e-5  # a display value; smaller differences are not worth a closer look


@dataclass(frozen=True, eq=False)
class Comparison:
    """Counts of pixels, the errors, and a label per pixel.

    explained: pixels by cause, see why_different.py. unexplained: all others.
    shading: the unexplained pixels of which only the colour differs. max_...: the largest errors
    among the agreeing pixels. worst: (row, column) of the largest difference in colour, with
    largest_color and rms_color over all pixels, as display values. labels: uint8 (height, width).
    times_s: each renderer's time. nothing_hit: the reason that neither image shows anything and
    nothing was compared; empty if something is hit. outside: pixels outside the lens, which do not
    count.
    """

    size: tuple[int, int]
    agree: int
    explained: dict[str, int]
    unexplained: int
    shading: int
    max_depth_error: float
    max_normal_error: float
    max_color_error: float
    worst: Pixel
    largest_color: float
    rms_color: float
    times_s: dict[str, float]
    labels: NDArray[np.uint8]
    raster: Frame
    ray: Frame
    nothing_hit: str = ""
    outside: int = 0

    def __repr__(self) -> str:
        counts = {"agree": self.agree} | self.explained | {"unexplained": self.unexplained}
        told = ", ".join(f"{name} {count}" for name, count in counts.items() if count)
        return f"Comparison({self.size[0]}x{self.size[1]} pixels: {told})"

    @property
    def pixels(self) -> int:
        """The number of pixels that were compared."""
        return self.size[0] * self.size[1] - self.outside

    @property
    def differing(self) -> int:
        """The number of pixels that do not agree, explained or not."""
        return self.pixels - self.agree

    def to_dict(self) -> dict[str, object]:
        """Return everything except the images, as plain numbers."""
        return {
            "size": list(self.size),
            **{name: getattr(self, name) for name in _REPORTED},
            "worst": list(self.worst),
            "nothing_hit": self.nothing_hit or None,
            "times_s": dict(self.times_s),
        }

    def summary(self) -> str:
        """Return a few lines for the command line."""
        (width, height), (row, column) = self.size, self.worst
        causes = ", ".join(f"{name} {count}" for name, count in self.explained.items() if count)
        return "\n".join(
            [
                *([self.verdict()] if self.nothing_hit and not self.unexplained else []),
                f"{width}x{height}: {self.agree} of {self.pixels} pixels agree"
                + (f"; {self.outside} are outside of the lens" if self.outside else ""),
                f"explained:   {sum(self.explained.values())}" + (f" ({causes})" if causes else ""),
                f"unexplained: {self.unexplained}"
                + (f" ({self.shading} in the colour alone)" if self.shading else ""),
                f"largest errors where they agree: depth {self.max_depth_error:.1e} (relative), "
                f"normal {self.max_normal_error:.1e}, color {self.max_color_error * 255:.2f}/255",
                f"color everywhere: largest error {self.largest_color * 255:.1f}/255 "
                f"at row {row}, column {column} (from 0), "
                f"RMS {self.rms_color * 255:.3f}/255",
                "raster {raster:.1f} ms, ray {ray:.1f} ms".format(
                    **{name: 1e3 * time for name, time in self.times_s.items()}
                ),
            ]
        )

    def verdict(self) -> str:
        """Return the result as one clause, such as "all but 4 edge pixels agree"."""
        if self.unexplained:
            verb = "differs" if self.unexplained == 1 else "differ"
            return f"{_pixels(self.unexplained)} {verb} without an explanation"
        if self.nothing_hit:
            return f"nothing is hit in either image: {self.nothing_hit}"
        causes = [name for name, count in self.explained.items() if count]
        if not causes:
            return "all pixels agree"
        kind = f"{causes[0]} " if len(causes) == 1 else ""
        names = f" ({', '.join(causes)})" if len(causes) > 1 else ""
        return f"all but {_pixels(sum(self.explained.values()), kind)} agree{names}"

    def difference_image(self) -> NDArray[np.uint8]:
        """Return the raster image darkened, with differing pixels in their cause's colour
        (difference.py) and unexplained ones in vermilion; uint8 (height, width, 3).
        """
        gray = MUTED * encode_srgb(self.raster.channel("color")).mean(axis=2, keepdims=True)
        image = np.repeat((255 * gray).astype(np.uint8), 3, axis=2)
        marked = self.labels != AGREE
        image[marked] = LABEL_COLORS[self.labels[marked]]
        return image

    def false_color(self, channel: str = "color", gain: float = 1.0) -> NDArray[np.uint8]:
        """Return the difference of a channel as colours, uint8 (height, width, 3); see
        difference.py.
        """
        return false_color(difference(self.raster, self.ray, channel), channel, gain)


_REPORTED = (
    *("pixels", "outside", "agree", "explained", "unexplained", "shading"),
    *("max_depth_error", "max_normal_error", "max_color_error", "largest_color", "rms_color"),
)


def _label_colors() -> NDArray[np.uint8]:
    colors = np.zeros((256, 3), np.uint8)
    for label, name in enumerate(CAUSES, start=1):
        colors[label] = CAUSE_COLORS[name]
    colors[SHADING], colors[UNEXPLAINED] = SHADING_COLOR, UNEXPLAINED_COLOR
    return colors


LABEL_COLORS = _label_colors()  # uint8 (256, 3), by label


def compare(
    scene: Scene,
    camera: Camera,
    size: tuple[int, int],
    backend: str = "auto",
    progress: Callable[[float], None] | None = None,
) -> Comparison:
    """Render the scene with both renderers and compare. progress is called with fractions 0 to 1.

    Raises LucidaError for a camera that sees too little or too much for float32.
    """
    from lucida.renderer.raster import Rasterizer  # heavy, and not needed by compare_frames
    from lucida.renderer.trace import Tracer

    flat = flatten(scene)
    check_precision(camera, size, lambda: flat)
    with Rasterizer(scene, backend=backend) as rasterizer:
        raster = rasterizer.render(camera, size, channels=CHANNELS)
    with Tracer(scene) as tracer:
        ray = tracer.render(camera, size, channels=CHANNELS, progress=progress)
    return compare_frames(flat, camera, size, raster, ray, enlargement=ENLARGEMENT)


def compare_frames(
    flat: FlatScene,
    camera: Camera,
    size: tuple[int, int],
    raster: Frame,
    ray: Frame,
    effects: bool = False,
    enlargement: int | None = None,
) -> Comparison:
    """Compare two frames of the same view with all CHANNELS; size: (width, height).

    effects: the ray image has shadows or mirrors, so that many colours differ. Lines are not
    searched for pixels that differ only in colour. enlargement: of the faces in which the raster
    image of a lens was looked up; None if both images were made from the pixels' rays.
    """
    depth, normal, color = _differences(raster, ray)
    same_hit = raster.channel("id") == ray.channel("id")
    # The comparisons are negated so that NaN disagrees with everything.
    same_hit &= ~(~(depth <= DEPTH_RELATIVE) | ~(normal <= NORMAL))
    agree = same_hit & (color <= COLOR)
    labels = np.where(agree, np.uint8(AGREE), np.uint8(UNEXPLAINED))
    labels[same_hit & ~agree] = SHADING
    i, j = np.nonzero(labels == UNEXPLAINED if effects else ~agree)
    if 0 < len(i) <= MOST_EXAMINED:
        causes = explained(flat, camera, size, Differing(raster, ray, i, j), enlargement)
        labels[i, j] = np.where(causes == AGREE, labels[i, j], causes)
    outside = 0
    if camera.lens is not None:
        beyond = np.isnan(camera.lens_directions(size)[..., 0])
        outside = int(np.count_nonzero(beyond & agree))
    counts = np.bincount(labels.ravel(), minlength=256)
    finite = color[np.isfinite(color)]
    row, column = np.unravel_index(int(np.argmax(color)), color.shape)  # NaN counts as the largest
    return Comparison(
        size=size,
        agree=int(counts[AGREE]) - outside,
        explained={name: int(counts[k]) for k, name in enumerate(CAUSES, start=1)},
        unexplained=int(counts[UNEXPLAINED] + counts[SHADING]),
        shading=int(counts[SHADING]),
        max_depth_error=float(depth[agree].max(initial=0)),
        max_normal_error=float(normal[agree].max(initial=0)),
        max_color_error=float(color[agree].max(initial=0)),
        worst=(int(row), int(column)),
        largest_color=float(finite.max(initial=0)),
        rms_color=math.sqrt(float(np.square(finite, dtype=np.float64).mean()))
        if len(finite)
        else 0.0,
        times_s={"raster": raster.time_s, "ray": ray.time_s},
        labels=labels,
        raster=raster,
        ray=ray,
        nothing_hit=why_nothing_is_hit(flat, camera).text if hits_nothing(raster, ray) else "",
        outside=outside,
    )


def _differences(
    raster: Frame, ray: Frame
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32]]:
    """Return absolute differences of depth, normal and colour, float32 (height, width)."""
    depth, normal = (difference(raster, ray, channel) for channel in ("depth", "normal"))
    color_a, color_b = raster.channel("color"), ray.channel("color")
    with np.errstate(invalid="ignore"):
        color = most(color_b - color_a) * np.float32(SRGB_SLOPE)
    # The display transform is costly and shrinks most differences: use it only where needed.
    near = color > _NEGLIGIBLE
    color[near] = most(encode_srgb(color_b[near]) - encode_srgb(color_a[near]))
    return depth, normal, color


def _pixels(count: int, kind: str = "") -> str:
    return f"{count} {kind}pixel{'' if count == 1 else 's'}"
