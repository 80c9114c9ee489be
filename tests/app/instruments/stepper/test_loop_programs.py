"""The stepper's loops: in all languages they draw the same."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from both_lectures import first_lecture
from option_changes import with_options
from recorded_runs import SCENES

from lucida.app.instruments.stepper import julia, loop_parts, raster_parts
from lucida.app.instruments.stepper.loop_parts import Model
from lucida.app.instruments.stepper.loops import PROGRAMS
from lucida.app.instruments.stepper.source import shown_lines, source_of
from lucida.app.lecture.step_options import state_of
from lucida.app.state.app_state import AppState
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.pixels import Indexing

# The stepper's loops.


def loops_read_back(lines: tuple[str, ...]) -> str:
    """Julia's loops as Python: the indents are there already."""
    text = []
    for line in lines:
        if line.strip() == "end":
            continue
        line = re.sub(r"\b1:(\w+)$", r"range(1, \1 + 1)", line)
        line = re.sub(r"\b0:(\w+) - 1$", r"range(\1)", line)
        line = line.replace("&&", "and").replace("||", "or").replace("function ", "def ")
        opens = line.strip().startswith(("def ", "for ", "if ", "while ", "else"))
        text.append(line + ":" if opens else line)
    return "\n".join(text)


class FromOne:
    """A canvas or a depth buffer whose rows and columns are counted from 1."""

    def __init__(self, made: Any) -> None:
        self.made = made

    def __getitem__(self, pixel: tuple[int, int]) -> Any:
        assert min(pixel) >= 1
        return self.made[pixel[0] - 1, pixel[1] - 1]

    def __setitem__(self, pixel: tuple[int, int], value: Any) -> None:
        assert min(pixel) >= 1
        self.made[pixel[0] - 1, pixel[1] - 1] = value


def counted_from_one(ranges: tuple[range, range]) -> tuple[range, ...]:
    return tuple(range(one.start + 1, one.stop + 1) for one in ranges)


@pytest.mark.parametrize("indexing", list(Indexing))
@pytest.mark.parametrize("language", ["python", "julia"])
@pytest.mark.parametrize("program", PROGRAMS)
def test_the_loops_draw_the_same_however_they_are_shown(program, language, indexing):
    lines = source_of(program).lines
    if language == "python":
        text = "\n".join(shown_lines(lines, indexing))
    else:
        shown = "\n".join(shown_lines(lines))
        text = loops_read_back(julia.loops(shown, indexing).lines)
    from_one = counted_from_one if indexing is Indexing.LECTURE else tuple
    array = FromOne if language == "julia" else lambda made: made
    names = {name: getattr(raster_parts, name) for name in dir(raster_parts)}
    names |= {name: getattr(loop_parts, name) for name in dir(loop_parts)}
    names |= {
        "prepared": lambda *given: tuple(map(array, raster_parts.prepared(*given))),
        "box_around": lambda *given: from_one(raster_parts.box_around(*given)),
        "Canvas": lambda *given: array(loop_parts.Canvas(*given)),
    }
    exec(compile(text, language, "exec"), names)
    model, size, camera = Model(SCENES[program]), (12, 9), Camera.canonical()
    drawn = names[program.__name__](model, camera, size)
    told = program(model, camera, size)
    np.testing.assert_array_equal(getattr(drawn, "made", drawn).array, told.array)


@pytest.mark.parametrize("program", PROGRAMS)
def test_every_line_has_its_line_in_julia(program):
    lines = source_of(program).lines
    written = julia.loops("\n".join(lines))
    assert len(written.line_of) == len(lines)
    ends = [line for line in written.lines if line.strip() == "end"]
    blocks = sum(line.rstrip().endswith(":") for line in lines)
    assert len(ends) == blocks and len(written.lines) == len(lines) + blocks
    for line, number in zip(lines, written.line_of, strict=True):
        twin = written.lines[number]
        assert len(twin) - len(twin.lstrip()) == len(line) - len(line.lstrip())
        kept = set(re.findall(r"\w+", line)) - {"def", "range", "0", "5"}
        assert kept <= set(re.findall(r"\w+", twin)), (line, twin)
    assert "j - 0.5" in "".join(written.lines) and "j + 0.5" in "".join(lines)


def test_the_language_stays_from_step_to_step():
    lecture = first_lecture()
    step = lecture.steps[3]
    base = with_options(AppState.for_scene(step.scene), language="julia", shadows=True)
    options = state_of(step, base).options
    assert options.language == "julia" and not options.shadows
