"""A camera from elsewhere, pasted or opened: the view that it becomes, what it was taken for, and
what is asked before its lens is left out.

Pure; owns the words. Knows nothing of formats but their names.
"""

from __future__ import annotations

from dataclasses import dataclass

from app.cameras.described import lens_numbers
from renderer.camera_formats import CameraSet, PosedCamera, format_named
from renderer.errors import one_line
from renderer.scene.model import View


@dataclass(frozen=True)
class TakenCamera:
    """view: what it becomes. said: what it was taken for, and by which conventions, a sentence.
    posed: as its source has it, with the lens. source: the file's name, or the clipboard."""

    view: View
    said: str
    posed: PosedCamera
    source: str

    @property
    def has_lens(self) -> bool:
        return self.posed.distortion is not None


def told_of(found: CameraSet) -> str:
    """The format in words, and each convention that was taken."""
    what = format_named(found.format).what
    return one_line(f"{what}: {'; '.join(found.taken)}" if found.taken else what)


def lens_question(camera: TakenCamera) -> str:
    """What the user is asked before a lens is left out."""
    lens = camera.posed.distortion
    assert lens is not None
    numbers = one_line(f"{camera.source}: {', '.join(lens_numbers(lens))} ({lens.model})")
    return (
        f"{numbers}: this lens moves a corner by {lens.corner_px:.3g} pixels.\n"
        "A pinhole has no distortion. Undistort the images first, or open the camera without it."
    )
