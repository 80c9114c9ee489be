"""Image files by their ending: .png .ppm .pgm .pbm .pfm .exr .npy.

Row 0 of an array is the image's top row in every file, regardless of the order in which the format
stores rows.

PNG, PPM, PGM and PBM hold pictures: 8-bit sRGB colours (PNG, PPM), their gray (PGM), or the gray
thresholded at half (PBM, one bit per pixel). renderer/images/display.py makes them from channels.
PFM, EXR and NPY hold unexposed numbers: linear light, ray parameters, world normals and indices.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Collection, Iterator, Sequence
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.system.atomic import atomic_write, check_writable
from lucida.renderer.system.errors import LucidaError

from .display import Bytes, gray_of, gray_picture, picture
from .frame import Frame
from .png import write_png

# EXR's channel names; by its convention for layers, "N.X" is the X of layer N.
EXR_CHANNELS = {
    "color": ("R", "G", "B"),
    "depth": ("Z",),
    "normal": ("N.X", "N.Y", "N.Z"),
    "id": ("id",),
    "primitive": ("primitive",),
}
HALF = 128  # the darkest gray that a bitmap shows white


def check_image_path(path: str | Path, endings: Collection[str] | None = None) -> str:
    """Return the ending of `path`, in lower case, if an image can be written there.

    endings: the allowed ones (default: ENDINGS). Raises LucidaError for another ending, or if the
    file cannot be written. Call this before a long rendering, not after it.
    """
    endings = ENDINGS if endings is None else endings
    ending = Path(path).suffix.lower()
    if ending not in endings:
        problem = f"the ending {ending!r} is unknown" if ending else "has no ending"
        if ending in ENDINGS:
            problem = f"{ending} cannot hold this picture"
        raise LucidaError("", problem, f"give one of {' '.join(endings)}", str(path))
    check_writable(path)
    return ending


def write_image(
    path: str | Path, frame: Frame, channel: str = "color", exposure_ev: float = 0.0
) -> None:
    """Write one channel of a frame in the format of the path's ending. Replaces a file atomically.

    exposure_ev brightens the colour of the 8-bit formats by 2^exposure_ev. The others keep the
    numbers: PFM float32 (PF for three numbers per pixel, Pf for one); EXR float32 channels R G B,
    Z, N.X N.Y N.Z, or uint32 id (4294967295: nothing hit); NPY the frame's array, unchanged. Raises
    LucidaError for an unsuitable ending, path or channel.
    """
    ending = check_image_path(path)
    frame.channel(channel)
    with atomic_write(path) as file:
        _write_frame(file, ending, frame, channel, exposure_ev)


def encode_image(ending: str, frame: Frame, channel: str, exposure_ev: float) -> bytes:
    """Return the bytes of the file that write_image() writes."""
    content = io.BytesIO()
    _write_frame(content, ending, frame, channel, exposure_ev)
    return content.getvalue()


def _write_frame(
    file: BinaryIO, ending: str, frame: Frame, channel: str, exposure_ev: float
) -> None:
    if ending in DATA:
        DATA[ending](file, frame.channel(channel), channel)
    else:
        shown = (gray_picture if ending in GRAYS else picture)(frame, channel, exposure_ev)
        PICTURES[ending](file, shown)


def write_picture(path: str | Path, shown: Bytes) -> None:
    """Write an sRGB picture, uint8 (height, width, 3), as .png .ppm .pgm or .pbm."""
    ending = check_image_path(path, PICTURES)
    content = gray_of(shown) if ending in GRAYS else shown
    with atomic_write(path) as file:
        PICTURES[ending](file, content)


def _write_netpbm(file: BinaryIO, shown: Bytes) -> None:
    """Write P6 for colours (height, width, 3), P5 for gray (height, width)."""
    kind = b"P6" if shown.ndim == 3 else b"P5"
    file.write(b"%s\n%d %d\n255\n" % (kind, shown.shape[1], shown.shape[0]))
    file.write(np.ascontiguousarray(shown).data)


def _write_pbm(file: BinaryIO, gray: Bytes) -> None:
    """Write P4: one bit per pixel, 1 (black) if the gray is below half."""
    white = gray >= HALF
    file.write(b"P4\n%d %d\n" % (white.shape[1], white.shape[0]))
    file.write(np.packbits(~white, axis=1).data)


def _write_pfm(file: BinaryIO, data: NDArray, channel: str) -> None:
    """Write little-endian float32 (indicated by a negative scale), the bottom row first."""
    magic = b"PF" if data.ndim == 3 else b"Pf"
    file.write(b"%s\n%d %d\n-1.0\n" % (magic, data.shape[1], data.shape[0]))
    file.write(np.ascontiguousarray(data[::-1], dtype="<f4").data)


def _write_exr(file: BinaryIO, data: NDArray, channel: str) -> None:
    import OpenEXR

    names = EXR_CHANNELS[channel]
    planes = data.reshape(*data.shape[:2], len(names))
    if data.dtype == np.int32:
        planes = planes.view(np.uint32)
    header = {"type": OpenEXR.scanlineimage, "compression": OpenEXR.ZIP_COMPRESSION}
    channels = {name: np.ascontiguousarray(planes[..., k]) for k, name in enumerate(names)}
    OpenEXR.File(header, channels).write(file)


def join_exrs(
    to: str, parts: Sequence[Path], channel: str, size: tuple[int, int]
) -> Iterator[None]:
    """Write images of write_image() that lie below one another as one image of (width, height).

    Only one part is in memory at a time. Yields after each part. Raises OSError for other files.
    """
    import Imath
    import OpenEXR

    names, kind = EXR_CHANNELS[channel], Imath.PixelType.FLOAT
    if channel in ("id", "primitive"):
        kind = Imath.PixelType.UINT
    header = OpenEXR.Header(*size)
    header["channels"] = {name: Imath.Channel(Imath.PixelType(kind)) for name in names}
    whole = OpenEXR.OutputFile(to, header)
    for path in parts:
        try:
            with OpenEXR.File(str(path), separate_channels=True) as part:
                planes = {name: part.channels()[name].pixels for name in names}
        except (RuntimeError, KeyError) as error:
            raise OSError(str(error)) from None
        rows = len(planes[names[0]])
        whole.writePixels({name: plane.tobytes() for name, plane in planes.items()}, rows)
        yield
    whole.close()


def _write_npy(file: BinaryIO, data: NDArray, channel: str) -> None:
    np.lib.format.write_array(file, np.ascontiguousarray(data), allow_pickle=False)


GRAYS = (".pgm", ".pbm")
PICTURES: dict[str, Callable[[BinaryIO, NDArray], None]] = {
    ".png": write_png,
    ".ppm": _write_netpbm,
    ".pgm": _write_netpbm,
    ".pbm": _write_pbm,
}
DATA: dict[str, Callable[[BinaryIO, NDArray, str], None]] = {
    ".pfm": _write_pfm,
    ".exr": _write_exr,
    ".npy": _write_npy,
}
ENDINGS = (*PICTURES, *DATA)
