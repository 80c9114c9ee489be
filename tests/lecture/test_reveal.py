"""The parts that a step covers, and uncovers one by one; links in its text."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_flow import measure

from app.lecture.flow import lay
from app.lecture.model import Lecture
from app.lecture.reading import BUILTIN, lecture_from_toml, load_lecture
from app.lecture.session import LectureSession
from app.lecture.step_options import state_of, taken_back
from app.lecture.text import Question
from app.state.app_state import AppState
from renderer.errors import LucidaError

STEP = "[[steps]]\ntitle = 'T'\n"
LISTED = "text = '''\n- one\n- two\n\n> Why?\n\n1. three\n'''\n"


def read(text: str) -> Lecture:
    return lecture_from_toml(f"title = 'L'\n{text}", Path(), "x.toml")


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("answer = 'a'", "4: steps[0].answer: answers no question; begin a line of the text with"),
        ("text = '> q'\nanswer = '- a'", "5: steps[0].answer: is not one paragraph; give a"),
        ("text = '> q'\nanswer = 'a $b'", "5: steps[0].answer: a formula does not end"),
        ("reveal = true\ntext = 'a'", "4: steps[0].reveal: has no list to uncover; begin lines"),
        ("reveal = 'yes'", "4: steps[0].reveal: is text in quotes; give true or false"),
        ("text = '[a](#b)'", "2: steps[0].links.b: is missing; give options, e.g. links.b.shadows"),
        ("links.b.shadow = true", "4: steps[0].links.b.shadow: is unknown; did you mean 'shadows'"),
    ],
)
def test_wrong_values_cost_one_line(more, said):
    with pytest.raises(LucidaError) as caught:
        read(f"{STEP}{more}\n")
    assert str(caught.value).startswith(f"x.toml:{said}")


def test_items_are_uncovered_in_their_order_and_the_answer_last():
    step = read(f"{STEP}reveal = true\nanswer = 'So.'\n{LISTED}").steps[0]
    assert step.stages == 4
    stages = {p.piece.text: p.stage for p in lay(step.blocks, 300.0, 10.0, measure).pieces}
    assert stages == {"•": 2, "one": 1, "two": 2, "three": 3, "1.": 3, "So.": 4, "Why?": 0}


def test_nothing_moves_when_it_is_uncovered():
    shown, covered = (
        lay(read(f"{STEP}reveal = {on}\n{LISTED}").steps[0].blocks, 300.0, 10.0, measure)
        for on in ("false", "true")
    )
    places = [(p.piece, p.x, p.baseline) for p in shown.pieces]
    assert [(p.piece, p.x, p.baseline) for p in covered.pieces] == places
    assert {p.stage for p in shown.pieces} == {0}


def test_walking_back_takes_back_what_walking_on_has_uncovered():
    lecture = read(3 * f"{STEP}reveal = true\nanswer = 'So.'\n{LISTED}")
    session = LectureSession(lecture, BUILTIN)
    seen = [(session.number, session.uncovered)]
    while session.uncover(1) or session.go(session.number + 1):
        seen.append((session.number, session.uncovered))
    assert seen == [(number, stage) for number in range(3) for stage in range(5)]
    while session.uncover(-1) or session.go(session.number - 1):
        seen.append((session.number, session.uncovered))
    assert seen[15:] == seen[13::-1]
    session.go(2)
    session.go(1)  # not there before, but walked back to: it shows everything
    assert session.uncovered == lecture.steps[1].stages


def test_a_session_keeps_how_much_is_uncovered(tmp_path):
    path = tmp_path / "x.toml"
    path.write_text(f"title = 'L'\n{STEP}reveal = true\n{LISTED}")
    session = LectureSession(load_lecture(path), path)
    session.uncover(2)
    state = state_of(session.step, AppState(session.step.scene, session.step.view, True))
    assert LectureSession.resumed(session.kept(state)).uncovered == 2


def test_a_link_shows_its_options_and_takes_them_back():
    linked = "links.b = { shadows = false, images = { exposure_ev = 2 } }\n"
    step = read(f"{STEP}text = '[a](#b)'\noptions.shadows = true\n{linked}").steps[0]
    own = state_of(step, AppState(step.scene, step.view, True))
    followed = own.with_options(**step.links["b"])
    assert (followed.options.shadows, followed.images.exposure_ev) == (False, 2.0)
    assert followed.with_options(**taken_back(step.links["b"], own.options)) == own


def test_every_question_of_the_built_in_lecture_has_an_answer():
    for step in load_lecture(BUILTIN).steps:
        asked = any(isinstance(block, Question) for block in step.blocks)
        assert not asked or step.stages, step.title
