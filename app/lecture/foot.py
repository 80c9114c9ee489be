"""The foot of the lecture's column: back, position, next step, the outline."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from .session import LectureSession

BACK, NEXT = "back", "next"
END = "End the lecture"
STEP_EM, PLACE_EM = 1.6, 3.6  # the widths of the step buttons, and of the position between them


def foot(session: LectureSession, typed: str = "") -> int | str | None:
    """Draw the foot. Return the number of the step to go to, BACK, NEXT, END, or None.

    typed: the typed digits of a step's number.
    """
    count, size, asked = len(session.lecture.steps), imgui.get_font_size(), None
    if imgui.button("<##back", ImVec2(STEP_EM * size, 0)):
        asked = BACK
    imgui.same_line()
    place = f"{typed or session.number + 1} / {count}###outline"
    if imgui.button(place, ImVec2(PLACE_EM * size, 0)):
        imgui.open_popup("outline")
    imgui.same_line()
    if imgui.button(">##next", ImVec2(STEP_EM * size, 0)):
        asked = NEXT
    chosen = _outline(session)
    return asked if chosen is None else chosen


def foot_height() -> float:
    return float(imgui.get_frame_height_with_spacing() + imgui.get_style().item_spacing.y)


def _outline(session: LectureSession) -> int | str | None:
    """Draw the list of all steps. Return the selected one."""
    chosen: int | str | None = None
    if not imgui.begin_popup("outline"):
        return chosen
    for part, numbers in session.lecture.outline():
        imgui.separator_text(part or session.lecture.title)
        for number in numbers:
            step = session.lecture.steps[number]
            is_present = number == session.number
            if imgui.selectable(f"{number + 1}  {step.title}", is_present)[0]:
                chosen = number
            if is_present and imgui.is_window_appearing():
                imgui.set_scroll_here_y()
    imgui.separator()
    if imgui.selectable(END, False)[0]:
        chosen = END
    imgui.end_popup()
    return chosen
