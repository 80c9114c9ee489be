"""The lecture's exercises, and the formula that grows."""

from dataclasses import replace

import numpy as np
from both_lectures import both_lectures
from lecture_window import answer, item, lecture_of, untraced_drive
from objects_window import handle_px
from outside_window import place
from window_driver import Key, changed

from lucida.app.instruments.objects.choosing import chosen
from lucida.app.instruments.outside.view import OUTSIDE, OutsideView
from lucida.app.lecture.hiding import HideExercise
from lucida.app.lecture.reading import BUILTIN, load_lecture
from lucida.renderer.editing.moving import bounds_of


@untraced_drive
def drive_exercises_say_what_is_right_and_wrong(d):
    lecture = both_lectures()
    titles = [step.title for step in lecture.steps]
    lecture_of(d).give(lecture, BUILTIN, (titles.index("Exercise: a pixel's ray"), 0))
    d.settle()
    session = lecture_of(d).session
    answer(d, "origin", "$, **, `")  # signs of the text's own
    d.click(item(d, "Check"))
    d.settle()  # fails if the view has failed
    assert session.answers.verdict.field == "origin"
    # Pixel (2, 5) of 8 x 8: u = 4.5/8 - 1/2, v = -(1.5/8 - 1/2).
    answer(d, "origin", "0, 0, 0")
    answer(d, "direction", "1/16, -5/16, -1")
    d.click(item(d, "Check"))
    verdict = session.answers.verdict
    assert not verdict.right and "minus sign" in verdict.text
    d.frames()
    outside = d.window.view(OutsideView)
    drawn = outside.extensions.lines
    assert any(item.name == "your d" for item in drawn)  # next to the correct one
    wrong = d.picture()
    d.click(item(d, f"Read again: {verdict.read}"))
    assert session.step.title == verdict.read
    assert session.step.build == session.lecture.count(session.number) - 1  # with its whole text
    d.window.lecture.go(d.window, titles.index("Exercise: a pixel's ray"))
    d.settle()  # the origin is still there
    answer(d, "direction", "1/16, 5/16, -1")
    d.click(item(d, "Check"))
    assert session.answers.verdict.right
    assert changed(wrong, d.picture()) > 0 and not outside.extensions.lines
    d.window.lecture.go(d.window, titles.index("Exercise: which lens?"))
    d.settle()
    d.click(item(d, "option 1"))
    d.settle()
    assert not session.answers.verdict.right
    lens = d.state.camera.lens
    assert lens.coefficients["k1"] == -0.12  # the chosen answer's
    d.click(item(d, "option 0"))
    d.settle()
    assert session.answers.verdict.right
    # The answers are still there after a look elsewhere.
    d.window.lecture.advance(d.window, -1)
    d.settle()
    assert session.answers.verdict is None
    d.window.lecture.advance(d.window, 1)
    d.settle()
    assert session.answers.chosen == 0


def drive_an_object_is_moved_until_it_hides_another(d):
    lecture = load_lecture(BUILTIN)
    number, step = next(
        (k, one) for k, one in enumerate(lecture.steps) if isinstance(one.exercise, HideExercise)
    )
    task = step.exercise
    assert isinstance(task, HideExercise)
    lecture_of(d).give(lecture, BUILTIN, (number, 0))
    d.settle()
    d.until(lambda: not d.window.is_rearranging)
    d.settle()  # the mark finds its image's size
    begun = d.state
    assert chosen(begun) == (task.item,)

    def said():
        watch = lecture_of(d).column.hidden_watch
        return watch.said[1]

    assert said().text == "100 % of the box can still be seen."
    low, high = bounds_of(begun.scene, [task.item])
    middle = (low + high) / 2
    ball, across = place(d, middle), place(d, middle + np.array([0.3, 0.0, 0.0]))
    way = np.subtract(across, ball) / np.linalg.norm(np.subtract(across, ball))
    grip = np.array(ball) + 0.6 * handle_px(d, OUTSIDE) * way
    d.move_to(tuple(grip))
    steps = d.steps
    d.drag(tuple(grip), tuple(grip + 40 * way))
    moved = d.state.scene
    assert moved is not begun.scene and d.steps == steps + 1
    d.settle()
    assert said().text.endswith("can still be seen."), said()
    d.click(item(d, "###solution"))
    d.click(item(d, "Put it there"))
    d.settle()
    assert said().right, said()
    d.undo()
    d.settle()
    assert d.state.scene is moved and not said().right
    d.window.change(replace(d.state, scene=task.solved(moved)))
    camera = d.state.camera
    d.window.change(
        d.state.with_camera(replace(camera, eye=tuple(np.add(camera.eye, (0, 0.1, 0)))))
    )
    d.settle()
    assert not said().right and said().text.startswith("The camera has moved.")
    d.press(Key.backspace)
    d.settle()
    assert d.state == begun
    assert said().text == "100 % of the box can still be seen."
    d.press(Key.page_down)  # and keeps nothing for the next
    d.settle()
    assert chosen(d.state) == ()
