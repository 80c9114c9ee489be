"""The counters and variables of the loop stepper, in columns. plan.py sets their room."""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from app.explaining import symbols
from app.state.options import Notation
from app.stepper.model import Moment, describe
from app.stepper.plan import NEXT_EM, NUMBERS_EM, StepperPlan
from app.widgets import theme
from app.widgets.lettering import underline
from app.widgets.rows import follow
from app.widgets.theme import Fonts
from renderer.pixels import Indexing

TEXTS = ("object", "triangle", "a", "b", "c", "ray", "hit", "closest")  # take a whole line
INDICES = ("i", "j", "rows", "columns")  # the variables that count pixels

STALE = 0.45  # the opacity of values of the turn before


def numbers(
    moment: Moment,
    indexing: Indexing,
    notation: Notation,
    room: ImVec2,
    made: StepperPlan,
    fonts: Fonts,
    counted: bool,
) -> None:
    """Draw the variables, in columns side by side if there is the width. counted: and the
    counters, before them.
    """
    imgui.begin_child("numbers", room)
    flags = imgui.TableFlags_.sizing_stretch_prop | imgui.TableFlags_.no_saved_settings
    rows = [*(_counters(moment) if counted else ()), *_rows(moment, indexing, notation)]
    short = [row for row in rows if row.name not in TEXTS]
    each = -(-len(short) // made.columns)
    if imgui.begin_table("columns", made.columns, flags):
        for number in range(made.columns):
            part = NEXT_EM if number else NUMBERS_EM
            imgui.table_setup_column("", imgui.TableColumnFlags_.width_stretch, part)
        imgui.table_next_row()
        for number in range(made.columns):
            imgui.table_next_column()
            _table(f"numbers {number}", short[number * each : (number + 1) * each], fonts)
        imgui.end_table()
    _table("texts", [row for row in rows if row.name in TEXTS], fonts)
    imgui.end_child()


@dataclass(frozen=True)
class _Row:
    """A number and its name. note: text after it; tip: its meaning."""

    name: str
    text: str
    changed: bool = False
    stale: bool = False
    note: str = ""
    tip: str = ""


def _counters(moment: Moment) -> list[_Row]:
    counters = moment.counters
    counted = (
        ("tests", counters.tests, "how often an object or a triangle was tested at a pixel"),
        ("writes", counters.writes, "how often a pixel of the canvas was set"),
        ("overwrites", counters.overwrites, "writes to a pixel that had been set before"),
    )
    return [_Row(name, f"{count:>6}", tip=tip) for name, count, tip in counted]


def _rows(moment: Moment, indexing: Indexing, notation: Notation) -> list[_Row]:
    rows = []
    for one in moment.variables:
        text, note = one.text, one.note
        if one.name in INDICES:  # as the code next to it
            text, note = describe(one.value, indexing.value), indexing.told
        name = symbols.program(one.name, notation)
        rows.append(_Row(name, text, one.changed, one.stale, note))
    return rows


def _table(name: str, rows: list[_Row], fonts: Fonts) -> None:
    if not rows or not imgui.begin_table(name, 2, imgui.TableFlags_.no_saved_settings):
        return
    widest = max(imgui.calc_text_size(row.name).x for row in rows)
    imgui.table_setup_column("", imgui.TableColumnFlags_.width_fixed, widest)
    imgui.table_setup_column("", imgui.TableColumnFlags_.width_stretch)
    for row in rows:
        color = theme.TEXT * (1, 1, 1, STALE) if row.stale else theme.TEXT
        if row.changed:
            color = theme.legible(theme.MARK)
        imgui.table_next_row()
        imgui.table_next_column()
        imgui.text_colored(theme.DIM, row.name)
        if row.tip:
            imgui.set_item_tooltip(row.tip)
        imgui.table_next_column()
        imgui.push_text_wrap_pos(0.0)
        imgui.push_font(fonts.mono, 0.0)
        imgui.text_colored(color, row.text)
        if row.changed:
            underline(color)
        if row.stale:
            imgui.set_item_tooltip("of the turn before: not set in this one yet")
        imgui.pop_font()
        if row.note:
            follow(imgui.calc_text_size(row.note).x)
            imgui.text_colored(theme.DIM, row.note)
        imgui.pop_text_wrap_pos()
    imgui.end_table()
