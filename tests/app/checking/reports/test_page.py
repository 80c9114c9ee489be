"""The page of results: one file, well formed, with nothing in it that the feedback keeps back."""

from __future__ import annotations

import base64
import io
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lucida.app.checking.builtin import BUILTIN
from lucida.app.checking.checked import TaskResult, checked
from lucida.app.checking.mistakes.diagnosis import Diagnosis
from lucida.app.checking.reports.page import page
from lucida.app.checking.reports.picture import (
    MARK,
    Pictured,
    changed_pixels,
    pictured,
)
from lucida.app.checking.running.file import FileStudent
from lucida.app.checking.tasks import FEEDBACK
from lucida.app.cli import main
from lucida.app.ui.explaining import symbols

TASK = next(task for task in BUILTIN if task.name == "viewing-ray")
UPSIDE_DOWN = """
print("<script>alert('printed')</script> \\x1b[31mred\\x00 & \\u202e")

def viewing_ray(i, j, width, height, camera):
    x = camera.left + (j + 0.5) / width * (camera.right - camera.left)
    y = camera.bottom + (i + 0.5) / height * (camera.top - camera.bottom)
    return camera.eye, [
        x * camera.u[k] + y * camera.v[k] - camera.distance * camera.w[k] for k in range(3)
    ]
"""
SENTENCE = "Rows count downwards <b>here</b>."
VOID = {"meta", "img"}


class WellFormed(HTMLParser):
    """Every element is closed, in order; attributes are known afterwards."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data if "style" not in self.open else ""

    def pictures(self) -> list[np.ndarray]:
        sources = [str(attributes["src"]) for tag, attributes in self.seen if tag == "img"]
        assert all(source.startswith("data:image/png;base64,") for source in sources)
        content = (base64.b64decode(source.partition(",")[2]) for source in sources)
        return [np.array(Image.open(io.BytesIO(data))) for data in content]


@pytest.fixture(scope="module")
def tried(tmp_path_factory: pytest.TempPathFactory) -> tuple[TaskResult, Pictured]:
    path = tmp_path_factory.mktemp("student") / "rays.py"
    path.write_text(UPSIDE_DOWN, "utf-8")
    with FileStudent(path) as student:
        result = checked(student, replace(TASK, count=1))
        found = pictured(student, result)
    assert found is not None
    return replace(result, diagnosis=Diagnosis((SENTENCE,))), found


def shown(tried: tuple[TaskResult, Pictured], feedback: str) -> str:
    result = replace(tried[0], task=replace(tried[0].task, feedback=feedback))
    return page([result], [result.task], "rays.py", "", {result.task.name: tried[1]})


def test_the_page_stands_alone_and_the_students_text_is_text(tried) -> None:
    text = shown(tried, "diagnosis")
    parsed = WellFormed(text)
    tags = {tag for tag, _ in parsed.seen}
    assert not tags & {"script", "link", "iframe", "object", "base"}
    assert not re.search(r"https?:|url\(|@import|\bon\w+=", text)
    assert "<script>alert('printed')</script> \\x1b[31mred\\x00 & \\u202e" in parsed.text
    assert SENTENCE in parsed.text and "<b>" not in text
    assert all(sign.isprintable() or sign == "\n" for sign in text)


def test_pictures_are_what_was_given_what_is_right_and_where_they_differ(tried) -> None:
    given, right, apart = WellFormed(shown(tried, "diagnosis")).pictures()
    assert given.shape == right.shape == apart.shape and max(given.shape) >= 64
    upside_down = np.abs(given[::-1].astype(int) - right).max(axis=-1)
    assert np.mean(upside_down > 8) < 0.02  # but for pixels that an edge goes through
    changed = changed_pixels(right, given)
    marked = (apart == MARK).all(axis=-1)
    assert (marked == changed).all() and changed.any() and not changed.all()


@pytest.mark.parametrize("feedback", FEEDBACK)
def test_what_the_feedback_keeps_back_is_not_in_the_file(tried, feedback: str) -> None:
    text = shown(tried, feedback)
    level = FEEDBACK.index(feedback)
    first = tried[0].first
    assert first is not None
    parsed = WellFormed(text)
    body = text.partition("</style>")[2]
    assert ("wrong" in body) is (level >= 1)
    assert ("points" in parsed.text) is (level >= 1)
    assert ("printed" in parsed.text) is (level >= 1)
    for part in (
        first.right,
        first.given,
        symbols.arguments(first.arguments, "book"),
        "data:image",
        "cases are",
    ):
        assert (part in text or part in parsed.text) is (level >= 2), part
    assert (SENTENCE in parsed.text) is (level >= 3)


def test_the_command_writes_the_page_with_the_files_name_only(tmp_path: Path, capsys) -> None:
    code, out = tmp_path / "rays.py", tmp_path / "report.html"
    code.write_text(UPSIDE_DOWN, "utf-8")
    arguments = ["check", str(code), "--task", "viewing-ray", "--html", str(out), "--size", "8x6"]
    assert main(arguments) == 1
    text = out.read_text("utf-8")
    parsed = WellFormed(text)
    assert "Lucida check: rays.py" in parsed.text and tmp_path.name not in text
    assert [image.shape for image in parsed.pictures()] == [(72, 96, 3)] * 3
    code.write_text("def viewing_ray(:\n", "utf-8")
    assert main(arguments) == 2
    parsed = WellFormed(out.read_text("utf-8"))
    assert "line 1" in parsed.text and "rays.py" in parsed.text and tmp_path.name not in parsed.text
