"""A lecture in a session: step, answers and changes come back, whatever became of its file."""

from dataclasses import replace

import pytest
from both_lectures import first_lecture
from option_changes import with_options

from lucida.app.lecture.reading import BUILTIN, load_lecture
from lucida.app.lecture.session import LectureSession
from lucida.app.lecture.view import LectureView
from lucida.app.state.kept_lecture import KeptLecture
from lucida.app.state.session import Arrangement, session_of
from lucida.app.window.start import begin_lecture, begin_session
from lucida.renderer.files import load_scene
from lucida.renderer.system.errors import LucidaError

LECTURE = """
title = "Two"

[scenes.ball]
camera = { eye = [0, 0, 9], target = [0, 0, 0] }
objects = [{ type = "sphere" }]

[[steps]]
title = "First"
text = "one"
scene = "spheres"

[[steps]]
title = "Second"
text = "two"
scene = "ball"

[steps.exercise]
kind = "choice"
question = "?"
options = [{ text = "a", feedback = "no" }, { text = "b", feedback = "yes", right = true }]
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "two.toml"
    path.write_text(LECTURE)
    return path


@pytest.fixture
def folder(tmp_path):
    return tmp_path / "sessions"


def given(file, folder):
    """A window in which the second step was changed and answered; it is closed. What it began with,
    and its state at the end."""
    start = begin_lecture(load_lecture(file), (1, 0), folder)
    session = LectureSession(load_lecture(file), file, (1, 0))
    scene = session.step.scene
    state = replace(start.state, scene=scene, step=session.place)
    state = state.with_camera(replace(state.camera, eye=(1.0, 2.0, 9.0)))
    state = with_options(state, shadows=True)
    session.answers.chosen = 1
    session.answers.verdict = session.step.exercise.check(1)
    session.answers.solved = True
    close(start, session_of(state, Arrangement(), session.kept(state)))
    return replace(start, state=state)


def close(start, session):
    assert start.keeper is not None
    start.keeper.close(session)


def test_the_step_with_its_changes_and_answers_comes_back(file, folder):
    left = given(file, folder)
    start = begin_session(folder=folder)
    assert start.message == ""
    lecture = start.lecture
    assert lecture is not None
    assert lecture.number == 1
    assert start.state.scene is lecture.step.scene
    assert start.state.step == lecture.place == (str(file), 1, 0)
    assert start.state.view == left.state.view
    assert start.state.options == left.state.options
    answers = lecture.answers
    assert (answers.chosen, answers.verdict.right, answers.solved) == (1, True, True)


def test_the_built_in_lecture_is_found_wherever_it_is_installed():
    session = LectureSession(first_lecture(), BUILTIN, (3, 0))
    session.answers.texts["origin"] = "0, 0"
    state = begin_session(folder=BUILTIN).state  # no place for sessions there: the default
    kept = session.kept(state)
    assert (kept.file, kept.number, kept.in_step) == ("", 3, False)
    again = LectureSession.resumed(kept)
    assert again.path == BUILTIN
    assert again.answers.texts == {"origin": "0, 0"}


def test_a_lecture_that_is_gone_is_told_and_kept_until_it_is_back(file, folder):
    left = given(file, folder)
    file.rename(file.with_suffix(".away"))
    start = begin_session(folder=folder)
    assert start.lecture is None
    assert "two.toml" in start.message
    assert "are kept" in start.message
    assert start.state.view == left.state.view
    view = LectureView([])
    assert start.session is not None
    view.put_off(start.session.lecture, start.session.scene)
    close(start, session_of(start.state, Arrangement(), view.kept(start.state)))
    file.with_suffix(".away").rename(file)
    start = begin_session(folder=folder)
    assert start.message == ""
    assert start.lecture is not None
    assert start.lecture.answers.chosen == 1
    assert start.state.scene is start.lecture.step.scene
    assert start.state.view == left.state.view
    start.keeper.close(start.session)


def test_a_lecture_that_is_put_off_gives_way_to_another_scene(file, folder):
    given(file, folder)
    file.unlink()
    start = begin_session(folder=folder)
    view = LectureView([])
    view.put_off(start.session.lecture, start.session.scene)
    assert view.kept(start.state).in_step
    other = begin_session(folder=folder / "other").state
    spheres = replace(other, scene=load_scene("spheres"))
    kept = view.kept(spheres)
    assert (kept.in_step, kept.number) == (False, 1)
    start.keeper.close(start.session)


def test_a_lecture_that_has_changed_goes_on_at_the_step_of_that_title(file, folder):
    left = given(file, folder)
    new = '[[steps]]\ntitle = "New"\ntext = "new"\nscene = "spheres"\n\n[[steps]]\ntitle = "First"'
    file.write_text(LECTURE.replace('[[steps]]\ntitle = "First"', new))
    start = begin_session(folder=folder)
    assert "has changed" in start.message
    assert start.lecture.number == 2
    assert start.state.scene is start.lecture.step.scene
    assert start.state.view == left.state.view  # nothing that was changed is lost
    assert start.lecture.answers.chosen == 1
    assert start.lecture.answers.verdict is None  # what was said may not hold any more
    start.keeper.close(start.session)


def test_a_lecture_begins_with_what_is_the_users_own(file, folder):
    start = begin_session(folder=folder)
    state = with_options(start.state, preferences={"theme": "light", "font_scale": 1.25})
    close(start, session_of(with_options(state, shadows=True), Arrangement()))
    start = begin_lecture(load_lecture(file), folder=folder)
    preferences = start.state.preferences
    assert (preferences.theme, preferences.font_scale) == ("light", 1.25)
    assert preferences.presentation
    assert not start.state.options.shadows
    start.keeper.close(session_of(start.state, Arrangement()))


def test_a_newer_version_goes_on_at_the_step_and_its_files_are_watched(file):
    session = LectureSession(load_lecture(file), file, (1, 0))
    session.error = "an older mistake"
    ball = file.parent / "ball.toml"
    ball.write_text("[[objects]]\ntype = 'sphere'\n")
    new = '[[steps]]\ntitle = "New"\ntext = "new"\nscene = "ball.toml"\n\n[[steps]]'
    file.write_text(LECTURE.replace('[[steps]]\ntitle = "First"', f'{new}\ntitle = "First"'))
    session.take(load_lecture(file))
    assert (session.number, session.step.title, session.error) == (2, "Second", "")
    ball.write_text("[[objects]]\ntype = 'sphere'\nradius = 2\n")
    session.watch.know(load_lecture(file).files | {ball: None})
    assert not session.watch.changed(1.0)
    assert session.watch.changed(2.0)


@pytest.mark.parametrize(
    "kept",
    [
        KeptLecture(file="no\0file"),
        KeptLecture(file="/nowhere/at.all"),
        KeptLecture(file="x" * 5000),
    ],
)
def test_no_such_file_is_one_clear_error(kept):
    with pytest.raises(LucidaError, match=r"does not exist|cannot be read|name"):
        LectureSession.resumed(kept)


@pytest.mark.parametrize("number", [-(10**9), 10**9])
def test_a_number_of_no_step_is_the_nearest(number):
    session = LectureSession.resumed(KeptLecture(number=number))
    assert session.number == (0 if number < 0 else len(session.lecture.steps) - 1)


def test_what_the_user_agreed_to_read_elsewhere_comes_back_and_nothing_else(file, folder, tmp_path):
    lecture = file.parent / "inside" / "two.toml"
    lecture.parent.mkdir()
    for name in ("one.off", "other.off"):
        (tmp_path / name).write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    named = LECTURE.replace('scene = "spheres"', 'scene = "../one.off"')
    lecture.write_text(named)
    with pytest.raises(LucidaError, match="outside of its folder"):
        load_lecture(lecture)
    session = LectureSession(load_lecture(lecture, None), lecture)
    kept = session.kept(begin_session(folder=BUILTIN).state)
    assert LectureSession.resumed(kept).path == lecture
    lecture.write_text(named.replace("one.off", "other.off"))
    with pytest.raises(LucidaError, match="outside of its folder"):
        LectureSession.resumed(kept)


@pytest.mark.parametrize("is_edited", [False, True])
def test_a_lecture_begun_anew_offers_the_step_where_it_was_left(file, folder, is_edited):
    given(file, folder)
    if is_edited:
        new = '[[steps]]\ntitle = "New"\ntext = "new"\n\n[[steps]]\ntitle = "First"'
        file.write_text(LECTURE.replace('[[steps]]\ntitle = "First"', new))
    left = begin_lecture(load_lecture(file), folder=folder).left
    session = LectureSession(load_lecture(file), file, left=left)
    assert (session.number, session.answers.chosen) == (0, None)
    session.go_on(session.left)
    assert session.number == 1 + is_edited
    assert session.answers.chosen == 1
    assert (session.answers.verdict is None) == is_edited
    assert session.left is None
    walked = LectureSession(load_lecture(file), file, left=left)
    walked.go(1)
    assert walked.left is None
    assert (
        LectureSession(load_lecture(file), file, (1 + is_edited, 0), left).left is None
    )  # is there
    assert LectureSession(first_lecture(), BUILTIN, left=left).left is None  # another one
