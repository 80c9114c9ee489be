"""The variants of the packet kernels, each of which is compiled separately.

Code for textures, effects and lenses would slow down the images that need none of it. Needs no
numba.
"""

from __future__ import annotations

from enum import StrEnum

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import Scene, has_textures


class Variant(StrEnum):
    """PLAIN: neither textures nor effects. RICH: textures, shadows and mirrors. LENS: all of these,
    seen through a lens.
    """

    PLAIN = "plain"
    RICH = "rich"
    LENS = "lens"


def variant_of(scene: Scene, camera: Camera, effects: bool) -> Variant:
    """Return the variant that an image needs. effects: True for shadows or mirrors."""
    if camera.lens is not None:
        return Variant.LENS
    return Variant.RICH if effects or has_textures(scene) else Variant.PLAIN
