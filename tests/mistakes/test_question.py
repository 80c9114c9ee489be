"""The quiz: what is asked, that the camera can tell it, and what is said to the answer."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from option_changes import with_options

from app.images.ray_pictures import RayPainter
from app.instruments.mistakes import model
from app.instruments.mistakes import question as quiz
from app.lecture.step_options import options_from_table
from app.state.app_state import AppState
from app.state.options.mistakes import MistakesOptions
from app.state.session import Arrangement, from_bytes, session_of, to_bytes
from renderer.files import load_scene
from renderer.scene.model import Scene
from renderer.system.errors import LucidaError
from renderer.trace import Tracer

SIZE = (64, 48)
STATE = AppState.for_scene(load_scene("still-life"))
PARALLEL = STATE.with_camera(
    replace(STATE.camera, projection="parallel", viewport=(-2.0, 2.0, -1.5, 1.5))
)


@pytest.fixture(scope="module")
def painter():
    with Tracer(STATE.scene) as tracer:
        yield RayPainter(STATE.scene, tracer, lambda: True)


def situation(state: AppState = STATE):
    return model.situation_of(with_options(state, mistakes={"columns": 64}), SIZE)


@pytest.mark.parametrize("state", [STATE, PARALLEL])
@pytest.mark.parametrize("seed", range(1, 9))
def test_four_pictures_differ_and_one_of_them_is_it(painter, state, seed) -> None:
    now, options = situation(state), MistakesOptions(seed=seed)
    asked = quiz.question(painter, now, options)
    assert len(set(asked.names)) == len(asked.pictures) == quiz.CHOICES and not asked.problem
    assert asked.right_at == quiz.right_at(options)
    looks = [model.shown(light, 0.0) for light in (asked.right, *asked.pictures)]
    assert all(quiz.are_apart(*pair) for pair in combinations(looks, 2))
    assert not any(quiz.is_blank(look) for look in looks)
    for name, light in zip(asked.names, asked.pictures, strict=True):
        rays = model.rays_of(now, model.named(now.program, (name,)))
        assert np.array_equal(painter.picture(*rays, now.camera.t_range), light)


def test_a_seed_asks_the_same_again_and_others_ask_others(painter) -> None:
    now = situation()
    asked = [quiz.question(painter, now, MistakesOptions(seed=seed)) for seed in (3, 3, 4, 5)]
    assert asked[0].names == asked[1].names
    assert len({one.names for one in asked}) == 3
    assert {quiz.right_at(MistakesOptions(seed=seed)) for seed in range(40)} == {0, 1, 2, 3}


def test_a_lecture_s_own_question_is_asked(painter) -> None:
    for seed in range(1, 6):
        options = MistakesOptions(seed=seed, asked="rows count upwards")
        asked = quiz.question(painter, situation(), options)
        assert asked.names[asked.right_at] == "rows count upwards"
        assert asked.names.count("rows count upwards") == 1


def test_no_two_of_them_look_the_same(painter) -> None:
    """These two lines do the same, in other words."""
    tiny = model.situation_of(with_options(STATE, mistakes={"columns": 16}), SIZE)
    for seed in range(30):
        asked = quiz.question(painter, tiny, MistakesOptions(seed=seed, asked="rows count upwards"))
        assert "v the wrong way round" not in asked.names and len(asked.names) == quiz.CHOICES


def test_a_question_stays_though_the_camera_moves(painter) -> None:
    options = MistakesOptions(seed=2)
    names = quiz.question(painter, situation(), options).names
    eye = tuple(np.add(STATE.camera.eye, (0.4, 0.1, 0.2)).tolist())
    moved = situation(STATE.with_camera(replace(STATE.camera, eye=eye)))
    again = quiz.question(painter, moved, options, names)
    assert again.names == names and again.right_at == quiz.right_at(options)


def test_it_is_told_where_the_camera_cannot_tell(painter) -> None:
    asked = quiz.question(painter, situation(), MistakesOptions(asked="normalised"))
    assert not asked.names and "normalised" in asked.problem
    scene = Scene(())
    with Tracer(scene) as tracer:
        empty = RayPainter(scene, tracer, lambda: True)
        asked = quiz.question(empty, situation(), MistakesOptions())
    assert not asked.names and "too few" in asked.problem


def test_edges_alone_are_no_difference() -> None:
    one = np.zeros((120, 160, 3), np.uint8)
    one[:, ::16] = 255
    assert not quiz.are_apart(one, np.roll(one, 1, axis=1))
    assert quiz.are_apart(one, one[..., ::-1]) is False
    other = one.copy()
    other[:40] = 200
    assert quiz.are_apart(one, other)
    tiny = np.zeros((6, 8, 3), np.uint8)
    assert quiz.are_apart(tiny, np.roll(tiny + 60 * np.eye(6, 8, dtype=np.uint8)[..., None], 1, 0))


def test_answers_are_kept_counted_and_only_once() -> None:
    names = ("a", "b", "c", "d")
    options = MistakesOptions(seed=1)
    right = quiz.right_at(options)
    after = quiz.answered(options, names, right)
    assert after.score == (1, 1) and after.revealed and after.answer == names[right]
    assert after.names == names
    assert quiz.answered(after, names, 0) == after == quiz.revealed(after, names)
    wrong = quiz.answered(options, names, (right + 1) % 4)
    assert wrong.score == (0, 1)
    assert quiz.answered(options, names, 4) == options == quiz.answered(options, (), 0)
    assert quiz.answered(options, names, -1) == options
    assert [quiz.answered(options, names, n).answer for n in range(4)] == list(names)
    shown = quiz.revealed(options, names)
    assert shown.revealed and shown.score == (0, 0)
    assert quiz.answered(shown, names, right) == shown  # who has looked does not score
    assert not quiz.revealed(shown, names).revealed
    again = quiz.next_question(after)
    assert (again.seed, again.names, again.answer, again.revealed) == (2, (), "", False)
    assert again.score == (1, 1)


def test_what_is_said_names_the_line_and_why() -> None:
    program = situation().program
    names = ("no eye", "along +w", "rows count upwards", "columns count leftwards")
    right = quiz.reason(program, names, 2, "rows count upwards")
    assert right.startswith("Correct: C, rows count upwards.") and "minus sign" in right
    wrong = quiz.reason(program, names, 2, "along +w")
    assert wrong.startswith("Not B, along +w. It is C, rows count upwards.")
    assert quiz.reason(program, names, 2, "").startswith("It is C,")


def test_a_session_keeps_the_question_and_the_score() -> None:
    options = {
        "mode": "which-picture", "seed": 7, "names": ("a", "b", "c", "d"), "answer": "b",
        "revealed": True, "score": (3, 4), "chosen": ("no eye", "along +w"),
    }  # fmt: skip
    state = with_options(STATE, mistakes=options)
    kept = from_bytes(to_bytes(session_of(state, Arrangement("Lecture", (), ""))))
    assert kept.options.mistakes == state.options.mistakes
    assert state.options.mistakes.score == (3, 4)


def test_a_lecture_s_options_are_checked() -> None:
    good = {"mode": "which-line", "chosen": ["no eye"], "columns": 16}
    changes = options_from_table({"mistakes": good})
    assert with_options(STATE, **changes).options.mistakes.columns == 16
    for bad in ({"mode": "exam"}, {"columns": 17}, {"chosen": ["a", "b", "c"]}, {"seed": -1}):
        with pytest.raises(LucidaError, match=f"mistakes.{next(iter(bad))}"):
            options_from_table({"mistakes": bad})


def test_the_other_quiz_does_not_ask_what_the_first_has_shown() -> None:
    options = MistakesOptions(mode="laboratory", seed=7, asked="no eye")
    first = quiz.switched_to(options, "which-line")
    assert (first.mode, first.seed, first.asked) == ("which-line", 7, "no eye")
    answered = quiz.answered(first, ("a", "b", "c", "d"), 0)
    other = quiz.switched_to(answered, "which-picture")
    assert (other.mode, other.seed, other.asked) == ("which-picture", 8, "")
    assert (other.names, other.answer, other.revealed) == ((), "", False)
    assert other.score == answered.score
    back = quiz.switched_to(other, "laboratory")
    again = quiz.switched_to(back, "which-picture")
    assert again.seed == 9
    assert quiz.switched_to(again, "which-picture") == again
