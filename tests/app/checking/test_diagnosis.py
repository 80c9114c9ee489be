"""Wrong answers by name: one mistake, two at once, never another; right answers never."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from asked_rays import KINDS as CAMERAS
from asked_rays import made_camera, made_case, made_cases, whole_image
from numpy.typing import NDArray

from lucida.app.checking.kinds import KINDS
from lucida.app.checking.mistakes.diagnosis import MOST, diagnosis
from lucida.app.checking.mistakes.program import Mistakes, Program
from lucida.app.checking.mistakes.programs import case_values, known_values, program_of
from lucida.app.checking.mistakes.rays import ray_task, run_rays
from lucida.app.checking.mistakes.trials import candidates, trials_of
from lucida.app.checking.task_file import BUILTIN
from lucida.app.checking.tasks import CheckCase, CheckTask
from lucida.renderer.camera.camera import Camera

# test_course_words.py names the mistakes in perspective, and in the courses' own words.
RAY_TASKS = {
    "parallel": {"projection": "parallel"},
    "inverse matrix": {
        "projection": "parallel",
        "arguments": (
            "i", "j", "width", "height", "world_to_camera", "left", "right", "bottom", "top",
        ),
    },
}  # fmt: skip
TASKS = {task.name: task for task in BUILTIN}
VALUES = [task for task in BUILTIN if task.kind != "viewing-ray" and "parallel" not in task.name]
SHARES = 4  # of the mistakes in rays, each of which takes a search through all others
LOOPS = 30  # mistakes in the lines of both loops; the others are those of rays


def ray_task_of(projection: str = "perspective", **conventions: Any) -> CheckTask:
    """Return a task of viewing rays."""
    task = replace(TASKS["viewing-ray"], projection=projection)
    if "arguments" in conventions:
        conventions["arguments"] = tuple((word, word) for word in conventions["arguments"])
    return replace(task, conventions=replace(task.conventions, **conventions))


def known_in(task: CheckTask, cases: list[CheckCase]) -> dict[str, NDArray[np.float64]]:
    """Return the values that the lines of a task's program use, of all cases at once."""
    made = [case_values(case, *case.pixel, ray_task(task)) for case in cases]
    return {name: np.array([np.atleast_1d(one[name]) for one in made], float) for name in made[0]}


def rays_with(program: Program, known: Any, mistakes: Mistakes) -> NDArray[np.float64]:
    """Return the rays of a program with mistakes, (N, 2, 3)."""
    return np.stack(run_rays(program, known, mistakes), axis=1)


def right_rays(cases: list[CheckCase]) -> NDArray[np.float64]:
    return np.array([case.right for case in cases])


def same(rays: NDArray[np.float64], others: NDArray[np.float64]) -> bool:
    """By numbers of its own: origins, and directions up to a positive factor."""
    with np.errstate(all="ignore"):
        along, along_others = (
            each[:, 1] / np.linalg.norm(each[:, 1], axis=1)[:, None] for each in (rays, others)
        )
    near = 1e-9 * (1 + np.abs(others[:, 0]).max())
    clear = (np.linalg.norm(others[:, 1], axis=1) > 1e-9) & np.isfinite(along).all(axis=1)
    return bool(
        (np.abs(rays[:, 0] - others[:, 0]) <= near).all()
        and (np.abs(along - along_others)[clear] <= 1e-9).all()
    )


@pytest.mark.parametrize("name", RAY_TASKS)
def test_each_mistake_in_rays_is_named(name):
    """Use four cameras together, with rays of length 1, one mistake in float32. Each task has its
    share of the mistakes."""
    task = ray_task_of(**RAY_TASKS[name])
    program, cases = program_of(task), made_cases(2, 4, task.projection)
    right, named, unseen = right_rays(cases), 0, 0
    known = known_in(task, cases)
    all_rays = {one: rays_with(program, known, (one,)) for one in program.mistakes}
    share = list(program.mistakes)[list(RAY_TASKS).index(name) % SHARES :: SHARES]
    for mistake in share:
        rays = all_rays[mistake]
        if same(rays, right):
            unseen += 1
            continue
        named += 1
        length = np.linalg.norm(rays[:, 1:], axis=2, keepdims=True)
        given = rays.copy()
        given[:, 1:] /= np.where(length > 0, length, 1)
        if named == 4:
            given = given.astype(np.float32).astype(float)
        found = candidates(program, trials_of(task, cases, given))
        assert (mistake,) in found, mistake.name
        for (other,) in found:
            assert same(rays, all_rays[other]), (mistake.name, other)
    assert unseen <= 3 and named > 10


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_two_mistakes_at_once_are_named(projection):
    """Some pairs, of eight cameras together: by their names, or by those of what is the same."""
    task = ray_task_of(projection)
    program, cases = program_of(task), made_cases(2, 8, projection)
    known, right = known_in(task, cases), right_rays(cases)
    pairs, exactly = list(program.pairs()), 0
    assert len(pairs) > 200
    chosen = np.random.default_rng(5).choice(len(pairs), 2, replace=False)
    for pair in (pairs[number] for number in chosen):
        rays = rays_with(program, known, pair)
        if same(rays, right):
            continue
        found = candidates(program, trials_of(task, cases, rays))
        assert found, [mistake.name for mistake in pair]
        exactly += pair in found
        for others in found:
            assert same(rays, rays_with(program, known, others)), (pair, others)
    assert exactly == 2


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_right_answers_of_200_cameras_have_no_name(projection):
    """A pixel of each, computed in float32: even if they were handed over as wrong."""
    random = np.random.default_rng(7)
    task = ray_task_of(projection)
    program, cases = program_of(task), []
    for number in range(200):
        camera = made_camera(random, CAMERAS[number % len(CAMERAS)], projection)
        width, height = random.integers(2, 2000, 2).tolist()
        pixel = (int(random.integers(height)), int(random.integers(width)))
        cases.append(made_case(camera, (width, height), pixel))
    length = random.uniform(1e-3, 1e3, len(cases))
    given = right_rays(cases)
    given[:, 1] *= length[:, None]
    given = given.astype(np.float32).astype(float)
    assert candidates(program, trials_of(task, cases, given)) == ()


@pytest.mark.parametrize("odd", [np.nan, np.inf, 1e300])
def test_rays_without_a_length_have_no_name_and_cost_no_warning(odd):
    task = ray_task_of("perspective")
    cases = made_cases(2, 4, "perspective")
    given = right_rays(cases)
    given[1] = odd
    assert candidates(program_of(task), trials_of(task, cases, given)) == ()


def answering(task, cases):
    """Return a task's program, and a function from mistakes to its answers with these, in the
    kind's own form."""
    program, known = program_of(task), [known_values(task, case) for case in cases]

    def answers(mistakes):
        made = []
        for case, its in zip(cases, known, strict=True):
            (answer,) = program.run(its, mistakes)
            if isinstance(answer, tuple):
                answer = [np.ravel(part) for part in answer]
            made.append(np.reshape(np.asarray(answer, float), np.shape(case.right)))
        return made if task.kind == "render" else np.array(made)

    return program, answers


@pytest.mark.parametrize("task", VALUES, ids=lambda task: task.name)
def test_each_classic_mistake_is_wrong_and_named(task):
    task = replace(task, count=max(task.count, 20))
    task = task if task.kind != "render" else replace(task, count=4, cameras=("off-axis",))
    kind = KINDS[task.kind]
    cases, missed = kind.cases(task), []
    program, answers = answering(task, cases)
    mistakes = program.mistakes
    for mistake in mistakes if task.kind != "render" else mistakes[:LOOPS] + mistakes[LOOPS::20]:
        given = answers((mistake,))
        wrong = kind.wrong(task, cases, given)
        if not wrong.any():
            missed.append(mistake.name)
        elif len(np.unique(np.concatenate([np.ravel(one) for one in given]))) > 1:
            found = diagnosis(task, cases, given, wrong)
            assert (mistake,) in found.candidates, (mistake.name, found)
            for others in found.candidates:
                for pair in zip(given, answers(others), strict=True):
                    assert np.allclose(*pair, 1e-5, equal_nan=True), (mistake.name, others)
    assert len(missed) <= (4 if task.kind == "render" else 0), missed


@pytest.mark.parametrize("name", ["basis", "hit-sphere"])
def test_two_mistakes_in_values_at_once(name):
    task = TASKS[name]
    kind = KINDS[task.kind]
    cases = kind.cases(task)
    program, answers = answering(task, cases)
    pairs = list(program.pairs())
    for number in np.random.default_rng(1).choice(len(pairs), 5, replace=False):
        given = answers(pairs[number])
        wrong = kind.wrong(task, cases, given)
        if np.isnan(given).any() or not wrong.any():
            continue
        found = diagnosis(task, cases, given, wrong)
        assert found.candidates or "All your answers" in found.sentences[0]
        for others in found.candidates:
            assert np.allclose(given, answers(others), 1e-9)


def diagnosed(make, cases=None, **conventions):
    """Return the diagnosis of a function from a ray and its case to origin and direction."""
    task = TASKS["viewing-ray"]
    task = replace(task, conventions=replace(task.conventions, **conventions), notation="code")
    cases = cases or made_cases(5, 6)
    given = np.array([make(*case.right, case) for case in cases], float)
    return diagnosis(task, cases, given, KINDS[task.kind].wrong(task, cases, given))


def names(found):
    return [{one.name for one in candidate} for candidate in found.candidates]


def upside_down(o, d, case):
    return case.camera.ray(case.size[1] - 1 - case.pixel[0], case.pixel[1], case.size)


def transposed(o, d, case):
    return case.camera.ray(*case.pixel[::-1], case.size)


def test_one_mistake_is_named_with_its_line_and_the_right_one():
    found = diagnosed(upside_down)
    assert names(found) == [{"rows count upwards"}]
    assert found.sentences == (
        "Rows count downwards, `camera.v` points up: `y` needs its minus sign.",
        "Your code behaves like "
        "`y = camera.bottom + (i + 0.5) / height * (camera.top - camera.bottom)`, not "
        "`y = camera.top - (i + 0.5) / height * (camera.top - camera.bottom)`.",
        "Read again: From pixel to (u, v).",
    )


def test_all_mistakes_with_the_same_numbers_are_named():
    """In square images of a square viewport, the image transposed and rows for columns."""
    cases = whole_image(Camera((1, 2, 3), distance=2.0), (5, 5))
    found = diagnosed(transposed, cases)
    assert names(found) == [{"row and column exchanged"}, {"the image transposed"}]
    assert any(sentence.startswith("Or, with the same numbers:") for sentence in found.sentences)


def test_of_a_large_image_some_rays_are_looked_at():
    cases = whole_image(Camera.look_at((3, 2, 4), (0, 0, 0)), (40, 30))
    assert len(cases) > MOST
    # Of one symmetric camera, other mistakes look the same.
    assert {"rows count upwards"} in names(diagnosed(upside_down, cases))


def bent(o, d, case):
    """In images of 3 x 4 pixels, all directions but the first are wrong."""
    is_right = case.size != (3, 4) or case.pixel == (0, 0)
    return o, d if is_right else d + np.sin(case.pixel[0] + 1)


IMAGES = [
    case
    for camera in (one.camera for one in made_cases(5, 40)[::25])
    for size in ((3, 3), (3, 4))
    for case in whole_image(camera, size)
]
IMAGES += whole_image(IMAGES[0].camera, (4, 3))
SAID = {
    "All your rays are the same: they do not depend on i and j.":
        (lambda o, d, case: ((1, 2, 3), (4, 5, 6)), None),
    "162 of 162 rays have NaN or inf: look for a division by 0.":
        (lambda o, d, case: ((np.nan, 0, 0), (0, 0, 0)), None),
    "Your rays are correct in square images, and wrong elsewhere.": (bent, IMAGES[:-12]),
    "Your origins are correct, your directions are not.": (bent, IMAGES),  # not elsewhere: 4 x 3
}  # fmt: skip


@pytest.mark.parametrize("said", SAID)
def test_what_is_said_without_a_name(said):
    found = diagnosed(*SAID[said])
    assert found.sentences[-1] == said and not found.candidates


def test_right_directions_that_are_not_of_unit_length():
    task = replace(TASKS["viewing-ray"], count=3)
    task = replace(task, conventions=replace(task.conventions, unit=True))
    cases = KINDS[task.kind].cases(task)
    given = np.array([case.right for case in cases]) * [[1], [2]]
    found = diagnosis(task, cases, given, np.ones(len(cases), bool))
    assert found.sentences[0].endswith("not of length 1: normalise them.")


@pytest.mark.parametrize(
    ("name", "answer", "said"),
    [
        ("hit-sphere", np.inf, "You never find a hit."),
        ("closest-hit", [-1, np.inf], "You never find a hit."),
        ("hit-triangle", 2.5, "All your answers are 2.5, whatever is asked."),
    ],
)
def test_one_answer_to_everything(name, answer, said):
    cases = KINDS[name].cases(TASKS[name])
    found = diagnosis(TASKS[name], cases, np.array([answer] * len(cases)), np.ones(len(cases)) > 0)
    assert found.sentences == (said,)
