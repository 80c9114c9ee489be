"""A class's answers: dropped on the window, drawn, followed to a step, saved as a page."""

from __future__ import annotations

import json
from pathlib import Path

from imgui_bundle import imgui
from window_driver import Driver

from app.lecture.reading import BUILTIN, load_lecture
from app.lecture.view import LECTURE
from app.results.view import RESULTS, ResultsView

ASKED = "Exercise: a pixel's ray"
READ = "From pixel to ray"
MISTAKE = "rows count upwards"
HINT = "Rows count downwards, **v** points up."


def answers(d: Driver, name: str, count: int = 3) -> Path:
    """Write a sitting of wrong answers, and a line that is none."""
    lines = [
        {
            "lucida": "answer",
            "time": f"2026-11-24T10:{minute:02}:00Z",
            "sitting": f"{name} {minute}",
            "step": ASKED,
            "right": False,
            "mistake": MISTAKE,
            "reply": HINT,
            "read": READ,
        }
        for minute in range(count)
    ]
    path = d.folder / f"{name}.jsonl"
    path.write_text("".join(json.dumps(line) + "\n" for line in lines) + "none\n")
    return path


def checked(d: Driver) -> Path:
    path = d.folder / "results.json"
    test = {"name": "viewing-ray: viewing_ray()", "status": "passed"}
    path.write_text(json.dumps({"extra_data": {"lucida": "check"}, "tests": [test]}))
    return path


def dropped(d: Driver, *paths: Path) -> ResultsView:
    d.drop([str(path) for path in paths])
    d.until(lambda: not d.window.files.loading)
    d.settle()
    return d.window.view(ResultsView)


def drive_dropped_answers_are_drawn_and_lead_to_a_step(d: Driver) -> None:
    view = dropped(d, answers(d, "monday"), checked(d), answers(d, "tuesday", 2))
    assert RESULTS in d.window.shell.stage.rects
    results = view.results
    assert results is not None and (results.students, results.answers) == (6, 6)
    assert [one.mistake.name for one in results.to_talk_about] == [MISTAKE]
    assert len(results.problems) == 2 and "monday.jsonl:4" in results.problems[0]
    assert not d.window.files.message  # it is in the view
    number = results.numbers[READ]
    d.ctx.item_click(f"//###{RESULTS}/Go to step {number}, {READ}##0")
    d.settle()
    session = d.window.lecture.session
    assert session is not None and (session.path, session.number) == (BUILTIN, number - 1)
    d.window.lecture.leave(d.window)
    d.settle()


def drive_answers_belong_to_the_lecture_that_is_open(d: Driver) -> None:
    path = d.folder / "own.toml"
    path.write_text(f'title = "Own"\n[[steps]]\ntitle = "Begin"\n[[steps]]\ntitle = "{READ}"\n')
    d.window.lecture.give(load_lecture(path), path)
    d.settle()
    given = d.window.lecture.session
    view = dropped(d, answers(d, "wednesday"))
    assert view.results is not None and view.results.numbers == {"Begin": 1, READ: 2}
    d.ctx.item_click(f"//###{RESULTS}/Go to step 2, {READ}##0")
    d.settle()
    assert d.window.lecture.session is given and given.number == 1  # it was not begun anew
    assert LECTURE in d.window.shell.stage.rects
    d.window.lecture.leave(d.window)
    d.settle()


def drive_results_are_saved_as_a_page(d: Driver) -> None:
    view = dropped(d, answers(d, "thursday"))
    d.ctx.item_click(f"//###{RESULTS}/Save as a page...")
    d.ctx.yield_(3)
    page = d.folder / "class.html"
    d.ctx.key_chars_replace_enter(str(page))
    d.until(page.exists)
    assert view.results is not None and view.results.summary in page.read_text()
    d.settle()


def drive_a_file_without_answers_is_told_and_the_results_stay(d: Driver) -> None:
    view = dropped(d, answers(d, "friday"))
    before = view.results
    empty = d.folder / "empty.jsonl"
    empty.write_text('{"lucida": "answer"}\n')
    dropped(d, empty)
    assert "empty.jsonl" in d.window.files.message and "have no answers" in d.window.files.message
    assert d.window.files.message.count("\n") == 0 and view.results is before
    assert not imgui.get_io().want_text_input
