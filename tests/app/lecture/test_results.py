"""A class's answers: kept line by line, read whatever else is in the files, counted."""

from __future__ import annotations

import json
from datetime import UTC, datetime
from html.parser import HTMLParser
from pathlib import Path

import msgspec
import pytest
from both_lectures import both_lectures

from lucida.app.cli import main
from lucida.app.lecture.answer_log import AnswerLog, KeptAnswer
from lucida.app.lecture.results import counts, mistakes, page, read_answers, summary
from lucida.app.state.kept_lecture import Answers
from lucida.renderer.system.errors import LucidaError

FLIPPED, MIDDLE = "rows count upwards", "corners, not middles"


@pytest.fixture(scope="module")
def lecture():
    return both_lectures()


def answer(lecture, log: AnswerLog, title: str, **fields) -> None:
    """Answer a step as the column does."""
    step = next(step for step in lecture.steps if step.title == title)
    answers = Answers(**fields)
    asked = answers.texts if answers.chosen is None else answers.chosen
    answers.verdict = step.exercise.check(asked)
    log.exercise(lecture, step, answers)


RAY = "Exercise: a pixel's ray"


def test_what_is_answered_is_read_with_the_step_that_explains_it(lecture, tmp_path):
    log = AnswerLog(tmp_path / "answers.jsonl")
    first = {"origin": "0 0 0", "direction": "0.0625, -0.3125, -1"}
    answer(lecture, log, RAY, texts=first)
    answer(lecture, log, RAY, texts={"origin": "here", "direction": "there"})  # no answer
    answer(lecture, log, "Exercise: which lens?", chosen=1)
    log.name = "Ada"
    right = {"origin": "0 0 0", "direction": "1/16, 5/16, -1"}
    answer(lecture, log, RAY, texts=right, solved=True)
    lines = [json.loads(line) for line in (tmp_path / "answers.jsonl").read_text().splitlines()]
    assert log.count == len(lines) and log.problem == ""
    assert {line["sitting"] for line in lines} == {lines[0]["sitting"]}
    assert [line.get("name", "") for line in lines[:3]] == ["", "", "Ada"]
    answers, problems = read_answers([tmp_path / "answers.jsonl"])
    assert problems == []
    choice = next(one for one in answers if one.step == "Exercise: which lens?")
    assert choice.read == "Everything around the eye"
    titles = {step.title for step in lecture.steps}
    assert {one.read for one in answers} - {""} <= titles
    assert answers[2].right and answers[2].after_solution and answers[2].name == "Ada"


def test_a_file_of_something_else_is_not_written_to(tmp_path):
    path = tmp_path / "thesis.txt"
    path.write_text("Chapter 1\n")
    with pytest.raises(LucidaError, match="another kind"):
        AnswerLog(path)
    assert path.read_text() == "Chapter 1\n"
    path.write_text("")
    AnswerLog(path)


def test_an_answer_follows_a_line_that_a_crash_cut(lecture, tmp_path):
    path = tmp_path / "answers.jsonl"
    answer(lecture, AnswerLog(path), "Exercise: which lens?", chosen=1)
    path.write_bytes(path.read_bytes() + b'{"lucida": "ans')
    answer(lecture, AnswerLog(path), "Exercise: which lens?", chosen=2)
    answers, problems = read_answers([path])
    assert len(answers) == 2
    assert problems == [f"{path}:2: is no JSON; delete the line"]


LINE = {"lucida": "answer", "time": "2026-11-24T10:00:00Z", "sitting": "s", "step": "One"}


def written(path: Path, *lines: object) -> Path:
    path.write_text("\n".join(json.dumps(line) for line in lines))
    return path


def test_broken_and_foreign_lines_cost_a_line_each(tmp_path):
    good = {**LINE, "right": True}
    foreign = {"score": 3}
    path = written(tmp_path / "a.jsonl", good, foreign, {**good, "time": "noon"}, [1], good)
    other = tmp_path / "b.bin"
    other.write_bytes(b"\xff\xfe\n" * 100)
    answers, problems = read_answers([path, other, tmp_path / "none", path])
    assert len(answers) == 2
    assert [line.split(": ")[0] for line in problems[:3]] == [f"{path}:{n}" for n in (2, 3, 4)]
    assert all("; " in line for line in problems if "more lines" not in line)
    assert 3 < len(problems) < 30  # a file of nothing else does not flood the terminal


def made(student: str, step: str, minute: int, mistake: str = "", helped: bool = False):
    time = datetime(2026, 11, 24, 10, minute, tzinfo=UTC)
    reply, read = ("why", "Two") if mistake else ("", "")
    answer = KeptAnswer(time, student, step, not mistake, mistake=mistake, reply=reply, read=read)
    return msgspec.structs.replace(answer, after_solution=helped)


def test_counts_by_step_and_mistake():
    two = [
        made("a", "Two", 0),
        made("b", "Two", 1, FLIPPED),
        made("b", "Two", 2, FLIPPED),
        made("b", "Two", 3),
        made("c", "Two", 4, MIDDLE),
        made("c", "Two", 5, FLIPPED),
        made("c", "Two", 6, helped=True),
    ]
    assert counts(two) == (1, 1, 1)
    assert [(answer.mistake, students) for answer, students in mistakes(two)] == [
        (FLIPPED, 2),
        (MIDDLE, 1),
    ]
    others = [made("c", "Other", 7), made("c", "One", 8, MIDDLE)]
    text = page([*two, *others], ["One", "Two"])
    assert text.index("step 1, One") < text.index("step 2, Two") < text.index("<td>Other")
    assert summary(two) == "7 answers by 3 students" and "9 answers by 3 students" in text


class Tags(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.tags: set[str] = set()
        self.attributes: set[str] = set()
        self.text = ""

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        self.attributes |= {name for name, _ in attrs}

    def handle_data(self, data):
        self.text += data


def test_the_page_is_plain_and_all_text_is_escaped(tmp_path):
    evil = '<script>alert(1)</script><img src=x onerror="1">\x1b[31m'
    line = {**LINE, "right": False, "mistake": evil, "reply": evil, "read": evil, "step": evil}
    formula = {**LINE, "right": False, "mistake": r"$R\mathbf{e}$ is **0**", "name": "Ada Secret"}
    unset = {**LINE, "right": False, "mistake": r"no formula: $\nope"}
    path = written(tmp_path / f"{'x' * 9}<b>.jsonl", line, formula, unset, {"a": "<i>"})
    text = page(read_answers([path])[0], ["One"])
    tags = Tags()
    tags.feed(text)
    assert not tags.tags & {"script", "img", "link", "iframe"}
    assert not any(name.startswith("on") or name in ("src", "href") for name in tags.attributes)
    assert "Ada" not in text and "\x1b" not in text and "<strong>0</strong>" in text
    assert "<script>alert(1)</script>" in tags.text
    assert r"no formula: $\nope" in tags.text


def test_the_command_writes_the_page(tmp_path, capsys):
    wrong = {**LINE, "right": False, "mistake": FLIPPED, "read": "From pixel to (u, v)"}
    lines = written(tmp_path / "a.jsonl", wrong, {"no": "answer"})
    result = tmp_path / "class.html"
    assert main(["lecture", "--results", str(lines), "-o", str(result)]) == 0
    said = capsys.readouterr()
    assert said.err.count("\n") == 1 and ":2: " in said.err
    tags = Tags()
    tags.feed(result.read_text())
    assert "1 answer by 1 student" in tags.text and "From pixel to (u, v)" in tags.text
    assert main(["lecture", "--results", str(tmp_path / "none"), "-o", str(result)]) == 2
    capsys.readouterr()
    assert main(["lecture", "--results", str(lines)]) == 2
    assert capsys.readouterr().err == "lucida: --results: has no page to write; add -o class.html\n"


def test_a_log_that_ends_with_a_whole_line_is_continued_as_it_is(lecture, tmp_path):
    path = tmp_path / "answers.jsonl"
    answer(lecture, AnswerLog(path), RAY, texts={"origin": "0 0 0", "direction": "0 0 -1"})
    before = path.read_bytes()
    AnswerLog(path)
    assert path.read_bytes() == before
