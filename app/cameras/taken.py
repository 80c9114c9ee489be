"""A camera from elsewhere, pasted or opened: the resulting view, how it was interpreted, and the
question before its lens is ignored.

Pure.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from app.cameras.described import lens_numbers
from renderer.camera_formats import CameraSet, PosedCamera, format_named
from renderer.camera_formats.rigid import UNSEEN_PX
from renderer.errors import one_line
from renderer.scene.model import View


@dataclass(frozen=True)
class TakenCamera:
    """A camera from elsewhere.

    view: the resulting view.
    said: its format and conventions, in a sentence.
    posed: as in its source, with the lens.
    source: the file's name, or the clipboard.
    """

    view: View
    said: str
    posed: PosedCamera
    source: str

    @property
    def has_lens(self) -> bool:
        return self.posed.distortion is not None


def told_of(found: CameraSet) -> str:
    """Return the format in words, and each convention that was assumed; for a single camera, also
    the reason why it looks stretched.
    """
    told = list(found.taken)
    posed = found.cameras[0]
    if posed.size is not None and not is_fitted(posed):
        told.append(
            f"its pixels are not square: seen as they are at {posed.size[0]}x{posed.size[1]}"
        )
    what = format_named(found.format).what
    return one_line(f"{what}: {'; '.join(told)}" if told else what)


def is_fitted(posed: PosedCamera) -> bool:
    """Return True if images of other shapes may show more than the camera's own.

    Not if its pixels are not square: its own image would then change.
    """
    if posed.size is None:
        return posed.fit
    left, right, bottom, top = posed.camera.viewport
    wide = (right - left) / posed.size[0] * math.hypot(*posed.camera.u)
    high = (top - bottom) / posed.size[1] * math.hypot(*posed.camera.v)
    return abs(wide / high - 1) * max(posed.size) / 2 <= UNSEEN_PX


def lens_question(camera: TakenCamera) -> str:
    """Return the question to the user before a lens is ignored."""
    lens = camera.posed.distortion
    assert lens is not None
    numbers = one_line(f"{camera.source}: {', '.join(lens_numbers(lens))} ({lens.model})")
    return (
        f"{numbers}: this lens moves {lens.effect}.\n"
        "A pinhole has no distortion. `lucida camera FILE --undistort OUT` takes it out of the\n"
        "photographs; or open the camera without it."
    )
