"""Below a lecture's text: the buttons that walk its steps, the outline, the way back to the step.

Owns their look. Gives what was asked for; what comes of that is lecture/view.py's.
"""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from app.lecture.session import LectureSession

RESTORE = "back to the step"
END = "End the lecture"
STEP_EM, PLACE_EM = 2.0, 4.4  # the widths of the buttons that walk, and of the place between them


@dataclass(frozen=True)
class Walk:
    """What was clicked. number: of a step to go to."""

    number: int | None = None
    restores: bool = False
    ends: bool = False


def rows_of(width: float) -> int:
    """Of buttons, in a column of that width: whether the way back has room beside those that
    walk."""
    text = imgui.calc_text_size(RESTORE).x + 2 * imgui.get_style().frame_padding.x
    return 1 if _walking_px() + imgui.get_font_size() + text <= width else 2


def walking(session: LectureSession, is_as_given: bool) -> Walk:
    """Back, the place in the lecture, next; the outline; the way back to the step. is_as_given:
    whether nothing differs from the step's own."""
    number, count = session.number, len(session.lecture.steps)
    size, wish = imgui.get_font_size(), Walk()
    fits = rows_of(imgui.get_content_region_avail().x) == 1
    imgui.begin_disabled(number == 0)
    if imgui.button("<##back", ImVec2(STEP_EM * size, 0)):
        wish = Walk(number - 1)
    imgui.end_disabled()
    imgui.set_item_tooltip("the step before (Page Up)")
    imgui.same_line()
    if imgui.button(f"{number + 1} / {count}##outline", ImVec2(PLACE_EM * size, 0)):
        imgui.open_popup("outline")
    imgui.set_item_tooltip("all steps")
    imgui.same_line()
    imgui.begin_disabled(number == count - 1)
    if imgui.button(">##next", ImVec2(STEP_EM * size, 0)):
        wish = Walk(number + 1)
    imgui.end_disabled()
    imgui.set_item_tooltip("the next step (Page Down)")
    if fits:
        imgui.same_line(0, size)
    imgui.begin_disabled(is_as_given)
    if imgui.button(f"{RESTORE}##restore", ImVec2(0 if fits else _walking_px(), 0)):
        wish = Walk(restores=True)
    imgui.end_disabled()
    imgui.set_item_tooltip("its own scene, camera and views (Backspace)")
    return _outline(session) or wish


def _outline(session: LectureSession) -> Walk | None:
    """All steps, in their parts, and the end, where the place was clicked."""
    wish = None
    if not imgui.begin_popup("outline"):
        return wish
    for part, numbers in session.lecture.outline():
        imgui.separator_text(part or session.lecture.title)
        for number in numbers:
            step = session.lecture.steps[number]
            if imgui.selectable(f"{number + 1}  {step.title}", number == session.number)[0]:
                wish = Walk(number)
    imgui.separator()
    if imgui.selectable(END, False)[0]:
        wish = Walk(ends=True)
    imgui.end_popup()
    return wish


def _walking_px() -> float:
    """The width of the buttons that walk the steps."""
    return (2 * STEP_EM + PLACE_EM) * imgui.get_font_size() + 2 * imgui.get_style().item_spacing.x
