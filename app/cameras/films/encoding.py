"""Files made of pictures, by their ending: a film (MP4 with H.264), or a large image (PNG, EXR)
that is joined from its parts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from pathlib import Path

from PIL import Image

from lucida.renderer.camera.image_plane import Size
from lucida.renderer.images import join_exrs
from lucida.renderer.images.png import join_pngs
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError

from .workers import PACKAGE

# A writer writes a file of these pictures, and yields the finished fraction.
Writer = Callable[[Path, Sequence[Path]], Iterator[float]]
BT709 = 1  # H.264's number for its primaries, transfer function and matrix


def film_writer(path: Path, size: Size, fps: float) -> Writer | None:
    """Return the writer of a film's file; None for a folder of frames.

    size: a frame's size. Raises LucidaError if the file cannot hold such a film.
    """
    ending = path.suffix.lower()
    if not ending:
        return None
    if ending != ".mp4":
        remedy = "give .mp4, or a folder (out/)"
        raise LucidaError("-o", f"the ending {ending!r} is unknown", remedy)
    if size[0] % 2 or size[1] % 2:
        problem = f"{size[0]}x{size[1]} has an odd side, which .mp4 does not take"
        raise LucidaError("--size", problem, "give even sides")
    try:
        import av  # noqa: F401
    except ImportError:
        raise LucidaError("-o", ".mp4 needs the package av", PACKAGE) from None
    return partial(_film, fps, size)


def image_writer(channel: str, size: Size) -> Writer:
    """Return a writer that joins parts, one below another, to an image, as .png or .exr."""

    def write(path: Path, parts: Sequence[Path]) -> Iterator[float]:
        with atomic_write(path) as file:
            if path.suffix.lower() == ".exr":
                joining = join_exrs(file.name, parts, channel, size)
            else:
                joining = join_pngs(file, (part.read_bytes() for part in parts), size[1])
            for number in range(len(parts)):
                try:
                    next(joining)
                except (ValueError, OSError):
                    raise _no_picture(parts[number]) from None
                yield (number + 1) / len(parts)
            next(joining, None)

    return write


def _film(fps: float, size: Size, path: Path, frames: Sequence[Path]) -> Iterator[float]:
    import av
    from av.video.reformatter import ColorRange, Colorspace

    with atomic_write(path) as file, av.open(file, "w", format="mp4") as container:
        stream = container.add_stream("libx264", rate=Fraction(fps).limit_denominator(1001))
        stream.width, stream.height = size
        stream.pix_fmt = "yuv420p"  # the only one that every player shows
        stream.options = {"crf": "16"}
        # Without tags, players assume that small films use BT.601.
        stream.color_primaries = stream.color_trc = stream.colorspace = BT709
        stream.color_range = ColorRange.MPEG
        for number, one in enumerate(frames, 1):
            frame = av.VideoFrame.from_image(_opened(one, size)).reformat(
                format=stream.pix_fmt, dst_colorspace=Colorspace.ITU709
            )
            container.mux(stream.encode(frame))
            yield number / len(frames)
        container.mux(stream.encode())


def _opened(path: Path, size: Size) -> Image.Image:
    try:
        with Image.open(path) as file:
            image = file.convert("RGB")
    except OSError:
        raise _no_picture(path) from None
    if image.size != size:
        raise _no_picture(path, "belongs to a film of another size")
    return image


def _no_picture(path: Path, problem: str = "is not a picture") -> LucidaError:
    return LucidaError("", problem, "delete it, and run the command again", str(path))
