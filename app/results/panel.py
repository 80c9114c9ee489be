"""The results of a class, drawn: the mistakes to talk about, bars by step, columns over time."""

from __future__ import annotations

import functools
from collections.abc import Sequence

from imgui_bundle import ImVec2, ImVec4, imgui

from app.lecture.slide import Slides
from app.lecture.text import Block, escaped, parse
from app.results.model import ClassResults, MistakeCount, StepCount, Timeline, shown, told
from app.results.page import BY_STEP, KEY, OVER_TIME, TALK, UNREAD, plain
from app.widgets import theme
from app.widgets.lettering import lettering
from app.widgets.messages import wrapped
from app.widgets.rows import tip
from app.widgets.theme import Fonts
from renderer.errors import LucidaError

LATER = 0.45  # opacity
SHORT = ("at once", "later", "not yet")  # in a bar, so that its parts need no colour
BAR_EM, HIGH_EM, INDENT_EM = 1.5, 3.0, 1.5
TITLE_PART = 0.42  # of the width, left of the bars
READABLE_EM = 52.0  # lines are no longer


def panel(results: ClassResults, can_go: bool, slides: Slides, fonts: Fonts) -> str:
    """Draw the results. Return the title of the step to go to, or ""."""
    asked = ""
    if results.to_talk_about:
        _part(TALK, fonts)
    for number, count in enumerate(results.to_talk_about):
        asked = _talk(results, number, count, can_go, slides) or asked
    _part(BY_STEP, fonts)
    _key(((theme.GOOD, 1.0), (theme.GOOD, LATER), (theme.ERROR, 1.0)), KEY)
    for step in results.steps:
        _step(results, step)
    if results.timeline is not None:
        _part(OVER_TIME, fonts)
        _over_time(results.timeline)
    if results.problems:
        _part(UNREAD, fonts)
        for problem in results.problems:
            wrapped(problem, theme.ERROR)
    return asked


def _part(title: str, fonts: Fonts) -> None:
    imgui.dummy(ImVec2(0, 0.5 * imgui.get_font_size()))
    with lettering(fonts.bold, 1.2):
        imgui.text(title)
    imgui.separator()


def _talk(
    results: ClassResults, number: int, count: MistakeCount, can_go: bool, slides: Slides
) -> str:
    """Draw a mistake to talk about. Return the step to go to, or ""."""
    mistake, size = count.mistake, imgui.get_font_size()
    width = min(imgui.get_content_region_avail().x, READABLE_EM * size)
    texts = [mistake.name] + [mistake.reply] * (mistake.reply not in ("", mistake.name))
    imgui.dummy(ImVec2(0, 0.2 * size))
    for text in texts:
        slides.text(_blocks(text, text is mistake.name), width)
    wrapped(results.told(count), theme.DIM)
    if not mistake.read:
        return ""
    name = results.step_name(mistake.read)
    if can_go and mistake.read in results.numbers:
        return mistake.read if imgui.button(f"Go to {name}##{number}") else ""
    wrapped(f"Explained by {name}.")
    return ""


@functools.lru_cache(64)
def _blocks(text: str, is_bold: bool) -> tuple[Block, ...]:
    """Return a lecture's text, parsed; any other text as it is."""
    text = shown(text)
    try:
        return parse(f"**{text.replace('**', '')}**" if is_bold else text)
    except LucidaError:
        return parse(escaped(text))


def _step(results: ClassResults, step: StepCount) -> None:
    """Draw a step's title, its bar, and the mistakes below."""
    size = imgui.get_font_size()
    left, room = imgui.get_cursor_pos_x(), imgui.get_content_region_avail().x
    imgui.begin_group()
    imgui.align_text_to_frame_padding()
    imgui.push_text_wrap_pos(left + TITLE_PART * room - size)
    imgui.text(shown(results.step_name(step.title)))
    imgui.pop_text_wrap_pos()
    imgui.end_group()
    bottom = imgui.get_cursor_pos_y()
    imgui.same_line(left + TITLE_PART * room)
    _bar((step.at_once, step.later, step.not_yet), (1 - TITLE_PART) * room)
    imgui.set_cursor_pos_y(max(bottom, imgui.get_cursor_pos_y()))
    imgui.indent(INDENT_EM * size)
    for one in step.mistakes:
        wrapped(f"{plain(one.mistake.name)}  ({told(one, step.students)})", theme.DIM)
    imgui.unindent(INDENT_EM * size)
    imgui.dummy(ImVec2(0, 0.2 * size))


def _bar(counts: Sequence[int], width: float) -> None:
    size, draw = imgui.get_font_size(), imgui.get_window_draw_list()
    corner, total = imgui.get_cursor_screen_pos(), max(sum(counts), 1)
    colors = (theme.GOOD, 1.0), (theme.GOOD, LATER), (theme.ERROR, 1.0)
    x = corner.x
    for count, short, (color, opacity) in zip(counts, SHORT, colors, strict=True):
        far = x + width * count / total
        if count:
            at, to = ImVec2(x, corner.y), ImVec2(far - theme.px(1), corner.y + BAR_EM * size)
            draw.add_rect_filled(at, to, theme.u32(color, opacity), theme.px(2))
            ink = theme.TEXT if opacity < 1 else theme.BACKGROUND
            words = f"{count} {short}"
            if imgui.calc_text_size(words).x > to.x - at.x:
                words = str(count)
            middle = (at + to) / 2 - imgui.calc_text_size(words) / 2
            draw.add_text(middle, theme.u32(ink), words)
        x = far
    imgui.dummy(ImVec2(width, BAR_EM * size))
    told = ", ".join(f"{name}: {count}" for name, count in zip(KEY, counts, strict=True))
    tip(told)


def _over_time(timeline: Timeline) -> None:
    _key(
        ((theme.GOOD, 1.0), (theme.ERROR, 1.0)), ("correct answers, on top", "wrong answers, below")
    )
    wrapped("All answers")
    _columns(timeline, ((theme.ERROR, timeline.wrong), (theme.GOOD, timeline.right)))
    for mistake, counts in timeline.mistakes:
        wrapped(plain(mistake.name))
        _columns(timeline, ((theme.ERROR, counts),))


def _columns(timeline: Timeline, rows: Sequence[tuple[ImVec4, Sequence[int]]]) -> None:
    """Draw a column per bin, its rows on one another, with the sum above and the time below."""
    size, draw = imgui.get_font_size(), imgui.get_window_draw_list()
    corner, width = imgui.get_cursor_screen_pos(), max(imgui.get_content_region_avail().x, 1.0)
    sums = [sum(counts) for counts in zip(*(counts for _, counts in rows), strict=True)]
    most, step, high = max(*sums, 1), width / len(sums), HIGH_EM * size
    base = corner.y + size + high
    draw.add_rect_filled(
        ImVec2(corner.x, corner.y + size), ImVec2(corner.x + width, base), theme.u32(theme.FRAME)
    )
    labels = timeline.labels
    wide = max(imgui.calc_text_size(label).x for label in labels) + size
    every = max(1, -int(-wide // step))  # labels that have room
    for n, total in enumerate(sums):
        x, y = corner.x + n * step + theme.px(1), base
        for color, counts in rows:
            tall = high * counts[n] / most
            far = ImVec2(x + min(step - theme.px(2), 4 * size), y)
            draw.add_rect_filled(ImVec2(x, y - tall), far, theme.u32(color))
            y -= tall
        if total:
            draw.add_text(ImVec2(x, y - size), theme.u32(theme.TEXT), str(total))
        if n % every == 0 and x + wide - size <= corner.x + width:
            draw.add_text(ImVec2(x, base), theme.u32(theme.DIM), labels[n])
    imgui.dummy(ImVec2(width, high + 2.4 * size))


def _key(colors: Sequence[tuple[ImVec4, float]], words: Sequence[str]) -> None:
    size, draw = imgui.get_font_size(), imgui.get_window_draw_list()
    for number, ((color, opacity), word) in enumerate(zip(colors, words, strict=True)):
        if number:
            imgui.same_line(0, size)
        at = imgui.get_cursor_screen_pos() + ImVec2(0, 0.15 * size)
        far = at + ImVec2(0.8 * size, 0.8 * size)
        draw.add_rect_filled(at, far, theme.u32(color, opacity), theme.px(2))
        imgui.dummy(ImVec2(0.8 * size, size))
        imgui.same_line(0, 0.4 * size)
        imgui.text(word)
