"""The file of a film, by its ending: MP4 (H.264), GIF, WebP."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from typing import BinaryIO

from PIL import Image

from app.films.workers import PACKAGE
from renderer.atomic import atomic_write
from renderer.camera import Size
from renderer.errors import LucidaError

ENDINGS = (".mp4", ".gif", ".webp")
FASTEST_GIF = 50  # frames a second: its unit is a hundredth of a second


def check_film(path: Path, size: Size, fps: float) -> None:
    """Raise LucidaError if the file cannot hold such a film."""
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        remedy = f"give {', '.join(ENDINGS)}, or a folder (out/)"
        raise LucidaError("-o", f"the ending {ending!r} is unknown", remedy)
    if ending == ".mp4":
        if size[0] % 2 or size[1] % 2:
            problem = f"{size[0]}x{size[1]} has an odd side, which .mp4 does not take"
            raise LucidaError("--size", problem, "give even sides")
        try:
            import av  # noqa: F401
        except ImportError:
            raise LucidaError("-o", ".mp4 needs the package av", PACKAGE) from None
    if ending == ".gif" and fps > FASTEST_GIF:
        raise LucidaError("--fps", f"{fps:g} is too fast for a GIF", f"give {FASTEST_GIF} or less")


def encode(path: Path, frames: Sequence[Path], fps: float) -> Iterator[float]:
    """Write the film of these pictures atomically. Yield the finished part."""
    with atomic_write(path) as file:
        if path.suffix.lower() == ".mp4":
            yield from _mp4(file, frames, fps)
        else:
            images = (_opened(frame) for frame in frames[1:])
            _opened(frames[0]).save(
                file,
                format=path.suffix[1:].upper(),
                save_all=True,
                append_images=images,
                duration=1000 / fps,
                loop=0,
            )
            yield 1.0


def _mp4(file: BinaryIO, frames: Sequence[Path], fps: float) -> Iterator[float]:
    import av

    with av.open(file, "w", format="mp4") as container:
        stream = container.add_stream("libx264", rate=Fraction(fps).limit_denominator(1001))
        stream.width, stream.height = _opened(frames[0]).size
        stream.pix_fmt = "yuv420p"  # the only one that every player shows
        stream.options = {"crf": "16"}
        for number, frame in enumerate(frames, 1):
            container.mux(stream.encode(av.VideoFrame.from_image(_opened(frame))))
            yield number / len(frames)
        container.mux(stream.encode())


def _opened(path: Path) -> Image.Image:
    try:
        with Image.open(path) as image:
            return image.convert("RGB")
    except OSError:
        remedy = "delete it, and run the command again"
        raise LucidaError("", "is no picture", remedy, str(path)) from None
