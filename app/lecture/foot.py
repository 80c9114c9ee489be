"""The foot of the lecture's column: back, position, next step, the outline, reset."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app.lecture.session import LectureSession

BACK, NEXT = "back", "next"
RESTORE = "Reset step"
BRIEF = "Reset"  # its name where all buttons would not be in one row
END = "End the lecture"
STEP_EM, PLACE_EM = 1.6, 3.6  # the widths of the buttons that walk, and of the place between them


def foot(session: LectureSession, typed: str = "") -> int | str | None:
    """Draw the foot. Return the number of the step to go to, BACK, NEXT, RESTORE, END, or None.

    typed: digits of the step to go to.
    """
    count, size, asked = len(session.lecture.steps), imgui.get_font_size(), None
    is_first, is_last = session.ends
    restore, rows = _label(imgui.get_content_region_avail().x)
    imgui.begin_disabled(is_first)
    if imgui.button("<##back", ImVec2(STEP_EM * size, 0)):
        asked = BACK
    imgui.end_disabled()
    imgui.set_item_tooltip("Back (Page Up)")
    imgui.same_line()
    place = f"{typed or session.number + 1} / {count}###outline"
    if imgui.button(place, ImVec2(PLACE_EM * size, 0)):
        imgui.open_popup("outline")
    imgui.set_item_tooltip("All steps")
    imgui.same_line()
    imgui.begin_disabled(is_last)
    if imgui.button(">##next", ImVec2(STEP_EM * size, 0)):
        asked = NEXT
    imgui.end_disabled()
    imgui.set_item_tooltip("On (Page Down)")
    if rows == 1:
        imgui.same_line()
    if imgui.button(f"{restore}###restore"):
        asked = RESTORE
    imgui.set_item_tooltip("Its own scene, camera and views (Backspace)")
    chosen = _outline(session)
    return asked if chosen is None else chosen


def foot_height(width: float) -> float:
    """Return the height of the foot in a column of that width."""
    rows = _label(width)[1]
    spacing = imgui.get_style().item_spacing.y
    return float(rows * imgui.get_frame_height_with_spacing() + spacing)


def _outline(session: LectureSession) -> int | str | None:
    """Draw the list of all steps. Return the selected one."""
    chosen: int | str | None = None
    if not imgui.begin_popup("outline"):
        return chosen
    for part, numbers in session.lecture.outline():
        imgui.separator_text(part or session.lecture.title)
        for number in numbers:
            step = session.lecture.steps[number]
            if imgui.selectable(f"{number + 1}  {step.title}", number == session.number)[0]:
                chosen = number
    imgui.separator()
    if imgui.selectable(END, False)[0]:
        chosen = END
    imgui.end_popup()
    return chosen


def _walking_px() -> float:
    """Return the width of the buttons that walk the steps."""
    return (2 * STEP_EM + PLACE_EM) * imgui.get_font_size() + 2 * imgui.get_style().item_spacing.x


def _label(width: float) -> tuple[str, int]:
    """Return the name of the last button in a foot of that width, and the number of rows."""
    style = imgui.get_style()
    for name in (RESTORE, BRIEF):
        other = imgui.calc_text_size(name).x + 2 * style.frame_padding.x + style.item_spacing.x
        if _walking_px() + other <= width:
            return name, 1
    return RESTORE, 2
