"""Photograph files: recognised by their names, and decoded for display at the size needed.

A photograph is display values (sRGB), upright, as its EXIF orientation says. Transparent parts stay
transparent, and show the image.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.reading import check_file
from lucida.renderer.images.frame import LARGEST_PIXELS
from lucida.renderer.system.errors import LucidaError

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

PHOTO_ENDINGS = (".jpg", ".jpeg", ".png", ".webp", ".tif", ".tiff")
ORIENTATION = 0x0112  # of EXIF
UNREADABLE = "is not a readable picture"
REMEDY = "give a JPEG, PNG, WebP or TIFF file"

Size = tuple[int, int]  # (width, height)


@dataclass(frozen=True, eq=False)
class DecodedPhotograph:
    """A photograph in memory.

    pixels: uint8 (height, width, 4), display values and alpha, row 0 at the top.
    size: the file's own, upright.
    """

    pixels: NDArray[np.uint8]
    size: Size


def is_photograph(source: str) -> bool:
    """Return True for the name of a picture, never of a scene."""
    return source.lower().endswith(PHOTO_ENDINGS)


def found_photograph(source: str) -> str:
    """Return the absolute path of a readable picture. Raises LucidaError."""
    path = Path(source).absolute()
    decoded(path, (16, 16))
    return str(path)


def decoded(path: Path, wanted: Size) -> DecodedPhotograph:
    """Return a file's picture with the wanted number of pixels, (width, height), or with its own
    size if that is smaller. Each pixel is the mean of the area that it covers. Raises LucidaError.
    """
    from PIL import Image

    check_file(path)
    try:
        with Image.open(path) as opened:
            return _decoded(opened, wanted)
    except LucidaError as error:
        raise LucidaError("", error.problem, error.remedy, str(path)) from None
    except MemoryError:
        problem = "needs more memory than there is"
        raise LucidaError("", problem, "give a smaller picture", str(path)) from None
    except Image.DecompressionBombError:
        raise _too_large(str(path)) from None
    except Exception:  # decoders raise anything for a broken file
        raise LucidaError("", UNREADABLE, REMEDY, str(path)) from None


def _decoded(opened: Picture, wanted: Size) -> DecodedPhotograph:
    from PIL import Image, ImageOps

    is_lying = opened.getexif().get(ORIENTATION, 1) >= 5  # rows become columns
    own = opened.size[::-1] if is_lying else opened.size
    opened.draft("RGB", wanted[::-1] if is_lying else wanted)  # decode no more pixels than needed
    if opened.width * opened.height > LARGEST_PIXELS:
        raise _too_large()
    picture = _eight_bits(ImageOps.exif_transpose(opened))
    size = min(wanted[0], own[0]), min(wanted[1], own[1])
    if picture.size != size:
        picture = picture.resize(size, Image.Resampling.BOX)
    return DecodedPhotograph(np.array(picture.convert("RGBA")), own)


def _eight_bits(opened: Picture) -> Picture:
    """Return the picture in 8 bits a channel, with alpha if it has any."""
    from PIL import Image

    if opened.mode.startswith("I"):  # 16 bits of gray, stored in 16 or 32 bits
        gray = np.clip(np.asarray(opened).astype(np.int64) >> 8, 0, 255)
        return Image.fromarray(gray.astype(np.uint8))
    if opened.mode == "F":
        raise LucidaError("", "has pixel values without a known maximum", REMEDY)
    has_alpha = "transparency" in opened.info or opened.mode in ("RGBA", "LA", "PA", "RGBa", "La")
    return opened.convert("RGBA" if has_alpha else "RGB")


def _too_large(path: str = "") -> LucidaError:
    most = f"{LARGEST_PIXELS // 1_000_000} million"
    return LucidaError("", f"has more than {most} pixels", "give a smaller picture", path)
