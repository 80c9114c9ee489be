"""The foot of the lecture's column: previous step, position, next step, the outline, reset."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app.lecture.session import LectureSession

BACK, NEXT, SHOW_ALL = "back", "next", "Show all"
RESTORE = "Reset step"
END = "End the lecture"
STEP_EM, PLACE_EM = 1.6, 3.6  # the widths of the buttons that walk, and of the place between them


def foot(session: LectureSession, is_as_given: bool) -> int | str | None:
    """Draw the foot. Return the number of the step to go to, BACK, NEXT, SHOW_ALL, RESTORE, END, or
    None.

    is_as_given: state and views are the step's own, so that there is nothing to reset.
    """
    number, count = session.number, len(session.lecture.steps)
    uncovered, covers = session.uncovered, session.uncovered < session.step.stages
    size, asked = imgui.get_font_size(), None
    fits = _fits_a_row(imgui.get_content_region_avail().x)
    imgui.begin_disabled(number == uncovered == 0)
    if imgui.button("<##back", ImVec2(STEP_EM * size, 0)):
        asked = BACK
    imgui.end_disabled()
    imgui.set_item_tooltip(f"{'Cover the last again' if uncovered else 'Previous step'} (Page Up)")
    imgui.same_line()
    if imgui.button(f"{number + 1} / {count}##outline", ImVec2(PLACE_EM * size, 0)):
        imgui.open_popup("outline")
    imgui.set_item_tooltip("All steps")
    imgui.same_line()
    imgui.begin_disabled(number == count - 1 and not covers)
    if imgui.button(">##next", ImVec2(STEP_EM * size, 0)):
        asked = NEXT
    imgui.end_disabled()
    more = f"{session.step.stages - uncovered} more to uncover" if covers else "Next step"
    imgui.set_item_tooltip(f"{more} (Page Down)")
    if fits:
        imgui.same_line(0, size)
    imgui.begin_disabled(not covers)
    if imgui.button(f"{SHOW_ALL}##all"):
        asked = SHOW_ALL
    imgui.end_disabled()
    imgui.set_item_tooltip("Uncover all of this step (Shift+Page Down)")
    imgui.same_line()
    imgui.begin_disabled(is_as_given)
    if imgui.button(f"{RESTORE}##restore"):
        asked = RESTORE
    imgui.end_disabled()
    imgui.set_item_tooltip("Its own scene, camera and views (Backspace)")
    chosen = _outline(session)
    return asked if chosen is None else chosen


def foot_height(width: float) -> float:
    """Return the height of the foot in a column of that width."""
    rows = 1 if _fits_a_row(width) else 2
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


def _fits_a_row(width: float) -> bool:
    """Return True if all buttons have room in one row."""
    style = imgui.get_style()
    texts = sum(imgui.calc_text_size(name).x for name in (SHOW_ALL, RESTORE))
    others = texts + 4 * style.frame_padding.x + style.item_spacing.x
    return bool(_walking_px() + imgui.get_font_size() + others <= width)
