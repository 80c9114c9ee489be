"""A texture may be as large as the documents say: in every place that holds it."""

from __future__ import annotations

from renderer.raster.tables import TABLE_WIDTH
from renderer.scene.limits import IMAGE_BYTES, TEXELS, TEXTURE_SIDE

USUAL_SIDE = 16384  # GL_MAX_TEXTURE_SIZE of graphics cards, and of Mesa's software


def test_the_largest_texture_fits_everywhere() -> None:
    """With its border among a scene's texels, whose table is wrapped into a texture of the driver;
    in a file that is not compressed, four bytes a pixel."""
    assert (TEXTURE_SIDE + 1) ** 2 <= TEXELS
    assert TABLE_WIDTH <= USUAL_SIDE and -(-TEXELS // TABLE_WIDTH) <= USUAL_SIDE
    assert 4 * TEXTURE_SIDE**2 + 4096 <= IMAGE_BYTES
