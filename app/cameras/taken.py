"""A camera from elsewhere, pasted or opened: the resulting view, and how it was interpreted.

Pure.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from lucida.renderer.files.cameras import CameraSet, PosedCamera, format_named
from lucida.renderer.files.cameras.rigid import UNSEEN_PX
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import one_line


@dataclass(frozen=True)
class TakenCamera:
    """A camera from elsewhere.

    view: the resulting view.
    said: its format, conventions and lens, in a sentence.
    posed: the camera as in its source.
    """

    view: View
    said: str
    posed: PosedCamera


def told_of(found: CameraSet) -> str:
    """Return the format in words, and each convention that was assumed; for a single camera, also
    its lens, and the reason why it looks stretched.
    """
    told = list(found.taken)
    posed = found.cameras[0]
    if posed.size is not None and not is_fitted(posed):
        told.append(
            f"its pixels are not square: seen as they are at {posed.size[0]}x{posed.size[1]}"
        )
    if posed.camera.lens is not None:
        told.append(f"with its lens, {posed.camera.lens}")
    what = format_named(found.format).what
    return one_line(f"{what}: {'; '.join(told)}" if told else what)


def is_fitted(posed: PosedCamera) -> bool:
    """Return True if images of other shapes may show more than the camera's own.

    They may not if its pixels are not square: its own image would then change.
    """
    if posed.size is None:
        return posed.fit
    left, right, bottom, top = posed.camera.viewport
    wide = (right - left) / posed.size[0] * math.hypot(*posed.camera.u)
    high = (top - bottom) / posed.size[1] * math.hypot(*posed.camera.v)
    return abs(wide / high - 1) * max(posed.size) / 2 <= UNSEEN_PX
