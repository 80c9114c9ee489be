"""The note in the lecture's column that answers are kept, with the field for a name."""

from __future__ import annotations

from imgui_bundle import imgui

from lucida.app.ui import theme
from lucida.app.ui.messages import wrapped
from lucida.app.ui.rows import button_width

from .answer_log import LONGEST_NAME, AnswerLog


def note(log: AnswerLog, is_asked: bool) -> bool:
    """Draw the note; in a step with an exercise, with the name. Return True to stop."""
    text = log.problem or f"Answers are kept in {log.path.name}: {log.count} so far"
    wrapped(text, theme.legible(theme.ERROR if log.problem else theme.MARK))
    imgui.set_item_tooltip(str(log.path.absolute()))
    if not is_asked:
        return False
    button = button_width("Stop")
    imgui.set_next_item_width(-button - imgui.get_style().item_spacing.x)
    _, name = imgui.input_text_with_hint("##name", "name (may stay empty)", log.name)
    log.name = name[:LONGEST_NAME]
    imgui.same_line()
    stopped = bool(imgui.button("Stop"))
    imgui.set_item_tooltip("Keep no more answers; the file stays")
    return stopped
