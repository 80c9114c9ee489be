"""A lecture's page in a browser has the program's verdicts on answers."""

import random

import numpy as np
import pytest

from lucida.app.lecture.exercises import ChoiceExercise, RayExercise, VectorExercise
from lucida.app.lecture.hidden_pixels import ids_seen
from lucida.app.lecture.hiding import HideExercise
from lucida.app.web.bundle import bundle
from lucida.app.web.lecture import exercises
from lucida.app.web.scene_page import packed_scene
from lucida.renderer.editing.moving import shift

ODD = (
    *("0", "1", "-1", "1/8", "sqrt(2)/2", "1/0", "abc", "", "2**3", "1e400", "pi", "0x10"),
    *("1_000", "01", "1.", "--2", "+-1", "1 2", "sqrt(-1)", "sqrt 2", "\u22121", "(1", "1)"),
    *("1,2", "'a'", "#", ".5", "5e", "1e-3j", "True", "1 # x", "a\\b", "\u221a4", "3\u00b72"),
)
ANSWERS, PLACES = 40, 6  # of each exercise


@pytest.fixture(scope="module")
def tab(browser):
    opened = browser.new_page()
    yield opened
    opened.close()


def _typed(rng, value):
    forms = (repr(value), f"{value:.3g}", f"({value!r})", f"{8 * value!r}/8", f"-({-value!r})")
    return rng.choice(ODD) if rng.random() < 0.05 else rng.choice(forms)


def _vector(rng, values):
    form = rng.choice(("({}, {}, {})", "{},{},{}", "{};{};{}", "[{}, {}, {}]", "{}  {} {}"))
    return form.format(*(_typed(rng, float(value)) for value in np.nan_to_num(values)))


def _rays(task):
    """Return the right ray, and those of all classic mistakes."""
    return [task.camera.ray(*task.pixel, task.size), *(ray for _, ray in task.wrong_rays())]


def _answers(rng, task, rays):
    """Return what a student may type: right, a classic mistake, longer, backwards, off by a bit."""

    def near(values):
        factor, error = rng.choice((1, 1, 1, 2, -1, 0.5)), rng.choice((0, 0, 1e-4, 3e-3, 0.1))
        return [factor * value + rng.gauss(0, error) for value in values]

    if isinstance(task, RayExercise):
        origin, direction = rng.choice(rays).origin, rng.choice(rays).direction
        return {"origin": _vector(rng, origin), "direction": _vector(rng, near(direction))}
    given = {}
    for wanted in task.answers:
        values = [wanted.value] * 3 + [one.value for one in wanted.wrong]
        given[wanted.name] = _vector(rng, near(rng.choice(values)))
    return given


def test_random_answers_have_the_programs_verdicts(tab, lecture):
    rng, cases, verdicts, tasks = random.Random(11), [], [], {}
    for step in lecture.builds:
        if isinstance(step.exercise, RayExercise | VectorExercise):
            tasks[step.title] = exercises.data_of(step, "", (160, 120))
            rays = _rays(step.exercise) if isinstance(step.exercise, RayExercise) else []
            given = [_answers(rng, step.exercise, rays) for _ in range(ANSWERS)]
            cases += [(step.title, texts) for texts in given]
            verdicts += [list(step.exercise.check(texts)) for texts in given]
    script = (
        "([tasks, cases]) => {" + bundle("verdict.js") + "; return cases.map(([name, texts]) => {"
        "const v = checkTexts(tasks[name], texts);"
        "return [v.right, v.text, v.field, v.mistake, v.read, v.isAnswer]; }); }"
    )
    found = tab.evaluate(script, [tasks, cases])
    wrong = [(case, ours, theirs) for case, ours, theirs in zip(cases, verdicts, found, strict=True)
             if ours != theirs]  # fmt: skip
    assert wrong == []
    assert len(tasks) == 4
    assert {(right, is_answer) for right, *_, is_answer in found} == {
        (True, True), (False, True), (False, False)
    }  # fmt: skip


def test_places_have_the_programs_verdicts(tab, lecture):
    step = next(one for one in lecture.builds if isinstance(one.exercise, HideExercise))
    task, rng, size = step.exercise, np.random.default_rng(5), (160, 120)
    start = task.middle(task.moved)
    eye = np.asarray(task.view.camera.eye)
    toward = eye + rng.uniform(0.1, 1.2, (PLACES, 1)) * (task.middle(task.hidden) - eye)
    places = [task.answer, start, eye, *(toward + rng.normal(0, 0.15, (PLACES, 3)))]
    camera = task.view.for_size(size)
    alone = task.pixels(task.without, ids_seen(task.without, camera, size))
    expected = []
    for where in places:
        moved = shift(task.scene, [task.item], where - start)
        judged = task.check(moved, ids_seen(moved, camera, size), alone)
        expected.append([judged.right, judged.text])
    script = (
        "async ([data, packed, start, places]) => {"
        + bundle("hiding.js")
        + """
        const scene = await unpackScene(packed);
        return places.map((place) => {
          const moved = movable(scene);
          shiftObjects(moved, data.hiding.moved, minus(place, start));
          const { right, text } = checkPlace(data.hiding, data.texts, moved, place);
          return [right, text];
        }); }"""
    )
    given = [exercises.data_of(step, "", size), packed_scene(task.scene)]
    found = tab.evaluate(script, [*given, start.tolist(), np.asarray(places).tolist()])
    assert [pair for pair in zip(expected, found, strict=True) if pair[0] != pair[1]] == []
    assert {right for right, _ in found} == {True, False}


def test_a_choice_has_the_programs_verdicts(tab, lecture):
    count = 0
    script = (
        "([task, chosen]) => {" + bundle("verdict.js") + "; const v = checkOption(task, chosen);"
        "return [v.right, v.text, v.field, v.mistake, v.read, v.isAnswer]; }"
    )
    for step in lecture.builds:
        if isinstance(step.exercise, ChoiceExercise):
            data = exercises.data_of(step, "", (160, 120))
            for chosen in range(len(step.exercise.options)):
                found = tab.evaluate(script, [data, chosen])
                assert found == list(step.exercise.check(chosen))
                count += 1
    assert count
