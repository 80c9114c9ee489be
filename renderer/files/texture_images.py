"""Image files as textures: decoded by Pillow, within bounds.

Only images in the folder of the file that names them, or below it, are read.
"""

from __future__ import annotations

import io
import os
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.scene.limits import IMAGE_BYTES, JPEG_SCANS, TEXELS, TEXTURE_SIDE, TEXTURES
from lucida.renderer.system.errors import LucidaError, one_line, quoted, shortened

from .reading import check_bytes, read_file

Bytes = NDArray[np.uint8]
# Pillow reads dozens of other formats, which are not used for textures.
FORMATS = ("PNG", "JPEG", "BMP", "TGA", "GIF", "WEBP", "PPM")
_REMEDY = "save it as PNG or JPEG"
_SHOWN = 80  # letters of a name


class FoundImage(NamedTuple):
    """pixels: from decode_image(). file: None for an image inside another file."""

    pixels: Bytes
    file: Path | None = None


def decode_image(data: bytes, has_opacity: bool = False) -> Bytes:
    """Return the pixels of an image file, uint8 (height, width, 3), sRGB; with has_opacity,
    (height, width, 4), including the file's opacity, if any.

    Raises LucidaError if it is not such a file, is damaged, or is too large.
    """
    from PIL import Image

    check_bytes(len(data), IMAGE_BYTES, "")
    if data.startswith(b"\xff\xd8") and data.count(b"\xff\xda") > JPEG_SCANS:
        raise LucidaError("", f"has more than {JPEG_SCANS} scans", _REMEDY)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with Image.open(io.BytesIO(data), formats=FORMATS) as image:
                # Only the header has been read; memory for the pixels is allocated later.
                width, height = image.size
                if not 1 <= min(width, height) <= max(width, height) <= TEXTURE_SIDE:
                    problem = f"is {width}x{height} pixels"
                    raise LucidaError("", problem, f"stay within {TEXTURE_SIDE} a side")
                if image.mode == "F":
                    raise LucidaError("", "holds floating-point numbers", _REMEDY)
                if image.mode.startswith("I"):  # 16 bits, whose upper half conversion would drop
                    gray = (np.asarray(image, np.int64) >> 8).clip(0, 255).astype(np.uint8)
                    pixels = np.repeat(gray[..., None], 3, axis=2)
                else:
                    has_any = "A" in image.getbands() or "transparency" in image.info
                    kept = "RGBA" if has_opacity and has_any else "RGB"
                    pixels = np.array(image.convert(kept))
                if has_opacity and pixels.shape[2] == 3:
                    opaque = np.full((*pixels.shape[:2], 1), 255, np.uint8)
                    pixels = np.concatenate([pixels, opaque], axis=2)
    except LucidaError:
        raise
    except MemoryError:
        raise LucidaError("", "does not fit into memory", "give a smaller image") from None
    except Image.DecompressionBombError:
        raise LucidaError("", "has too many pixels", f"stay within {TEXTURE_SIDE} a side") from None
    except Image.UnidentifiedImageError:
        raise LucidaError("", f"is not one of {', '.join(FORMATS)}", _REMEDY) from None
    except Exception:  # Pillow raises various exceptions for damaged files
        raise LucidaError("", "is cut off or damaged", _REMEDY) from None
    pixels.setflags(write=False)
    return pixels


def inner_path(name: str, folder: Path) -> Path:
    """Return the path of a file that another one names, in that one's folder or below it.

    Raises LucidaError for any other: an absolute path, or a `..` or link that leads out.
    """
    plain = name.replace("\\", "/")
    if not plain:
        raise LucidaError("", "names no image", "give the name of a file")
    root = os.path.realpath(folder)
    try:
        is_outside = (
            os.path.isabs(plain)
            or bool(os.path.splitdrive(name)[0])
            or plain[1:2] == ":"
            or not Path(os.path.realpath(folder / plain)).is_relative_to(root)
        )
    except (OSError, ValueError):
        is_outside = True
    if is_outside:
        raise LucidaError(
            "", f"{shown(name)} is not in the folder of the file that names it", "copy it there"
        )
    return folder / plain


def read_image(name: str, folder: Path, has_opacity: bool = False) -> FoundImage:
    """Return the image of a name, inside the folder. Raises LucidaError naming it."""
    path = inner_path(name, folder)
    try:
        return FoundImage(decode_image(read_file(path, IMAGE_BYTES), has_opacity), path.absolute())
    except LucidaError as error:
        raise LucidaError("", f"{shown(name)} {error.problem}", error.remedy) from None


def shown(name: str) -> str:
    """Return an image's name for messages."""
    return quoted(shortened(name, _SHOWN))


@dataclass
class ModelImages:
    """The images of one model. Each is read once, and each error is reported once.

    notes: one line for each image that is not shown; its surfaces have their plain colour.
    """

    notes: list[str] = field(default_factory=list)
    _read: dict[str, FoundImage | None] = field(default_factory=dict)
    _texels: int = 0

    def get(self, name: str, read: Callable[[], FoundImage]) -> FoundImage | None:
        """Return the image of this name; None if it cannot be read."""
        if name not in self._read:
            self._read[name] = self._new(len(self._read), read)
        return self._read[name]

    def note(self, problem: str, what: str = "texture") -> None:
        line = one_line(f"{what}: {problem}")
        if line not in self.notes:
            self.notes.append(line)

    def _new(self, number: int, read: Callable[[], FoundImage]) -> FoundImage | None:
        try:
            if number >= TEXTURES:
                raise LucidaError("", f"there are more than {TEXTURES}", "use fewer")
            found = read()
            texels = self._texels + found.pixels.shape[0] * found.pixels.shape[1]
            if texels > TEXELS:
                problem = f"all images together have more than {TEXELS // 10**6} million pixels"
                raise LucidaError("", problem, "use smaller ones")
        except LucidaError as error:
            self.note(f"{error}; the plain colour is shown")
            return None
        self._texels = texels
        return found
