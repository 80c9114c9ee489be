"""The comparison of both images, in the background, once both are complete and still."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from lucida.app.ui.background import Background
from lucida.renderer.images.frame import Frame
from lucida.renderer.scene.flat import FlatScene, flatten
from lucida.renderer.scene.model import Scene
from lucida.renderer.scene.precision import check_precision
from lucida.renderer.system.errors import LucidaError

from .progressive_ray import RayImage
from .request import ImageRequest

if TYPE_CHECKING:
    from lucida.renderer.compare.raster_and_ray import Comparison
    from lucida.renderer.compare.why_black import Darkness


@dataclass(frozen=True, eq=False)
class Verdict:
    """The result of a comparison.

    text: for the status line. agrees: None if the images cannot be compared. comparison: counts,
    errors and a label per pixel, even if the images differ by shadows and mirrors, which only rays
    find. darkness: a note if the ray image is dark, with the reason.
    """

    request: ImageRequest
    text: str
    agrees: bool | None
    comparison: Comparison
    darkness: Darkness


class Agreement:
    """A comparison of pairs of images on its own thread.

    wake: called on that thread when a verdict is ready. compared: the last request that was
    compared, or that failed.
    """

    def __init__(self, wake: Callable[[], None]) -> None:
        self._comparing: Background[Verdict] = Background("lucida-compare", wake)
        self._flat: tuple[Scene, FlatScene] | None = None  # used in the thread only
        self.compared: ImageRequest | None = None
        self.verdict: Verdict | None = None
        self.error: Exception | None = None

    @property
    def busy(self) -> bool:
        return self._comparing.busy

    def submit(self, image: RayImage, raster: Frame) -> None:
        """Compare a full ray image with the raster image of the same request."""
        request, ray = image.request, image.frame
        self.compared, self.error = request, None
        self._comparing.submit(lambda: self._compare(request, raster, ray))

    def fail(self, request: ImageRequest, error: Exception) -> None:
        """Report that a request cannot be compared."""
        self.compared, self.error = request, error

    def forget(self) -> None:
        """Drop an error, and compare again."""
        self.compared = self.error = None

    def poll(self) -> None:
        """Take a new verdict."""
        outcome = self._comparing.poll()
        if outcome is not None:
            self.verdict, self.error = outcome.value, outcome.error

    def verdict_on(self, request: ImageRequest | None) -> Verdict | None:
        """Return the verdict if it is on this request."""
        verdict = self.verdict
        return verdict if verdict is not None and verdict.request == request else None

    def close(self) -> None:
        self._comparing.close()

    def _compare(self, request: ImageRequest, raster: Frame, ray: Frame) -> Verdict:
        from lucida.renderer.compare.raster_and_ray import compare_frames
        from lucida.renderer.compare.why_black import darkness

        scene, camera, size = request.scene, request.camera, request.size
        if self._flat is None or self._flat[0] is not scene:
            self._flat = (scene, flatten(scene, self._flat))
        flat = self._flat[1]
        limit = ""
        try:
            check_precision(camera, size, lambda: flat)
        except LucidaError as error:
            limit = error.problem
        comparison = compare_frames(
            flat, camera, size, raster, ray, request.has_effects, request.enlargement
        )
        dark = darkness(flat, camera, ray)
        text, agrees = comparison.verdict(), None
        if comparison.nothing_hit:
            pass
        elif request.has_effects:
            text = "not compared: only rays find shadows and mirrors"
        elif limit:
            text = f"not compared: the camera {limit}"
        else:
            agrees = not comparison.unexplained
            text = f"raster and ray: {text}" + ", at their centres" * (request.samples > 1)
        return Verdict(request, text, agrees, comparison, dark)
