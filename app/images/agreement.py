"""Do the two images agree? Compared in the background, once both are complete and still.

Owns the comparing thread and the last pair of images. Knows nothing of windows.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from app.images.progressive_ray import RayImage
from app.images.request import ImageRequest
from app.widgets.background import Background
from renderer.errors import LucidaError
from renderer.frame import Frame
from renderer.precision import check_precision
from renderer.scene.flat import FlatScene, flatten
from renderer.scene.model import Scene

if TYPE_CHECKING:
    from renderer.black import Darkness
    from renderer.compare import Comparison


@dataclass(frozen=True, eq=False)
class Verdict:
    """text: for the status line. unexplained: pixels that differ for no good reason.

    comparison: counts, errors and a label a pixel, also where shadows and mirrors, which only rays
    find, make the images differ. darkness: of the ray image, and why.
    """

    request: ImageRequest
    text: str
    unexplained: int
    comparison: Comparison
    darkness: Darkness


class Agreement:
    """wake: called from the comparing thread when a verdict is there."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._comparing: Background[Verdict] = Background("lucida-compare", wake)
        self._flat: tuple[Scene, FlatScene] | None = None  # used in the thread only
        self.pair: tuple[ImageRequest, Frame, Frame] | None = None
        self.verdict: Verdict | None = None
        self.error: Exception | None = None

    @property
    def busy(self) -> bool:
        return self._comparing.busy

    def submit(self, image: RayImage, raster: Frame) -> None:
        """Compares a full ray image with the raster image of the same request."""
        self.pair = (image.request, raster, image.frame)
        self.error = None
        self._comparing.submit(lambda: self._compare(image.request, raster, image.frame))

    def poll(self) -> None:
        """Takes a verdict that has come."""
        outcome = self._comparing.poll()
        if outcome is not None:
            self.verdict, self.error = outcome.value, outcome.error

    def verdict_on(self, request: ImageRequest | None) -> Verdict | None:
        """The verdict, if it is about this request."""
        verdict = self.verdict
        return verdict if verdict is not None and verdict.request == request else None

    def frame_of(self, request: ImageRequest | None) -> Frame | None:
        """The traced image of a request, if it is the last pair's."""
        if self.pair is None or self.pair[0] != request:
            return None
        return self.pair[2]

    def close(self) -> None:
        self._comparing.close()

    def _compare(self, request: ImageRequest, raster: Frame, ray: Frame) -> Verdict:
        from renderer.black import darkness
        from renderer.compare import compare_frames

        if self._flat is None or self._flat[0] is not request.scene:
            self._flat = (request.scene, flatten(request.scene, self._flat))
        flat, camera = self._flat[1], request.camera
        limit = ""
        try:
            check_precision(camera, request.size, lambda: flat)
        except LucidaError as error:
            limit = error.problem
        comparison = compare_frames(
            flat, camera, request.size, raster, ray, effects=request.has_effects
        )
        dark = darkness(request.scene, flat, camera, ray, request.shadows)
        text, unexplained = comparison.summary_short(), comparison.unexplained
        if request.has_effects and not comparison.nothing_hit:
            text, unexplained = "not compared: only rays find shadows and mirrors", 0
        elif limit:
            text, unexplained = f"not compared: the camera {limit}", 0
        elif request.samples > 1:
            text += ", at their centres"
        return Verdict(request, text, unexplained, comparison, dark)
