"""The inputs of an image, for either renderer."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.pixels import ENLARGEMENT
from lucida.renderer.editing.documents import are_versions
from lucida.renderer.raster.targets import Region
from lucida.renderer.scene.model import Scene

MIRROR_DEPTH = 4  # reflections of a ray, where mirrors are shown


@dataclass(frozen=True)
class ImageRequest:
    """Everything that an image depends on, for both renderers.

    size: (width, height) of the full image. shadows, mirrors: effects of the ray image that the
    raster image cannot show. channel: the visible one. samples: per pixel, for the colour of the
    full ray image. enlargement: texels per pixel of the faces behind a lens.
    """

    scene: Scene
    camera: Camera
    size: tuple[int, int]
    shadows: bool = False
    mirrors: bool = False
    channel: str = field(default="color", compare=False)
    samples: int = 1
    enlargement: int = ENLARGEMENT

    @property
    def has_effects(self) -> bool:
        return self.shadows or self.mirrors

    @property
    def without_effects(self) -> ImageRequest:
        """Return the request without the effects that only the ray image shows."""
        if not self.has_effects and self.samples == 1:
            return self
        return replace(self, shadows=False, mirrors=False, samples=1)

    def shown(self, channel: str, values: NDArray, region: Region) -> NDArray:
        """Return a region's values; for channel z, distances instead of ray parameters."""
        if channel != "z":
            return values
        top, left, bottom, right = region
        return self.camera.z_from_t(values, self.size, (slice(top, bottom), slice(left, right)))

    def may_stand_in_for(self, newer: ImageRequest | None) -> bool:
        """Return True if its image may be shown until a newer request's image is complete.

        Both must have the same size, and the same scene in any edited version. Older images of a
        moving camera are acceptable; anything else would be stale.
        """
        if newer is None or newer.size != self.size:
            return False
        return self.has_scene_of(newer)

    def has_scene_of(self, other: ImageRequest) -> bool:
        """Return True if another request has the same scene, in any edited version."""
        same = other.scene.objects is self.scene.objects  # also after saving
        return same or are_versions(other.scene, self.scene)

    def is_served_by(self, other: ImageRequest | None) -> bool:
        """Return True if the Tracer that was made for another request can serve this one."""
        return other is not None and (self.shadows, self.mirrors) == (other.shadows, other.mirrors)
