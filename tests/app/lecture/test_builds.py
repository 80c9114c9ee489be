"""The builds of a step: read from the file, walked in the session, in the older format too."""

import re
from dataclasses import replace

import pytest
from both_lectures import first_lecture
from plain_text import plain_text
from sample_lecture import read as read_text

from lucida.app.lecture.old_format import FIELDS
from lucida.app.lecture.reading import BUILDS, BUILTIN, load_lecture
from lucida.app.lecture.session import LectureSession
from lucida.app.lecture.step_options import state_of
from lucida.app.lecture.text import ItemList, Paragraph, Question, extended, parse
from lucida.app.state.app_state import AppState
from lucida.renderer.system.errors import LucidaError

STEP = "[[steps]]\ntitle = 'T'\n"
BUILD = "[[steps.builds]]\n"


def read(text):
    return read_text(f"title = 'L'\n{text}")


def test_a_build_has_what_it_leaves_out_from_the_one_before():
    lecture = read(
        f"{STEP}text = 'One.'\nscene = 'spheres'\nviews = ['raster', 'outside']\n"
        "camera = { eye = [1, 2, 5], target = [0, 0, 0] }\npixel = [2, 3]\n"
        "options.images.resolution = [8, 6]\noptions.outside.grid = false\nnotes = 'Say it.'\n"
        "exercise = { kind = 'ray', question = 'Which?', pixel = [1, 1], size = [8, 6] }\n"
        f"{BUILD}text = 'Two.'\ncamera.projection = 'parallel'\nmove_s = 4\n"
        f"{BUILD}instead = 'Three.'\nscene = 'columns'\nviews = ['ray']\npixel = [1, 1]\n"
        "options.outside.volume = true\nloop = true\n"
        f"{STEP}"
    )
    one, two, three, other = lecture.builds
    places = [(step.number, step.build) for step in lecture.builds]
    assert places == [(0, 0), (0, 1), (0, 2), (1, 0)]
    assert lecture.steps == (one, other) and [lecture.count(k) for k in (0, 1)] == [3, 1]
    shown = [plain_text(step.blocks) for step in lecture.builds]
    assert shown == ["One.", "One.\nTwo.", "Three.", ""]
    assert (one.before, two.before, three.before) == ((), one.blocks, ())
    assert (two.scene, two.views, two.pixel, two.changes) == (
        one.scene, one.views, one.pixel, one.changes,
    )  # fmt: skip
    assert two.view == replace(one.view, camera=replace(one.view.camera, projection="parallel"))
    assert (one.move_s, two.move_s, three.move_s, three.loop) == (0, 4, 0.5, True)
    assert (three.views, three.pixel) == (("ray",), (0, 0))
    assert three.scene is not one.scene and three.view == two.view
    assert three.changes["outside"] == {"grid": False, "volume": True}
    # Notes are the step's; its exercise is asked last, about what is then seen.
    assert one.notes == three.notes and one.exercise is two.exercise is None
    assert three.exercise is not None and three.exercise.camera.is_parallel
    assert lecture.explaining(other) == "T"


@pytest.mark.parametrize(
    ("first", "change", "eye"),
    [
        ("{ eye = [0, 0, 5] }", "{ target = [0, 1, 0] }", (0, 0, 5)),
        ("{ eye = [0, 0, 5], target = [0, 1, 0] }", "{ w = [0, 0, 1] }", (0, 0, 5)),
        ("{ eye = [0, 0, 5], target = [0, 1, 0] }", "{ eye = [0, 0, 6] }", (0, 0, 6)),
    ],
)
def test_a_camera_changes_by_its_target_or_by_its_basis(first, change, eye):
    for name in ("camera", "options.outside.camera"):
        steps = read(f"{STEP}{name} = {first}\n{BUILD}{name} = {change}\n").builds
        step = steps[1]
        camera = step.view.camera if name == "camera" else step.changes["outside"]["camera"]
        assert camera.eye == eye
        assert (camera.w == (0, 0, 1)) is ("w" in change)


def test_a_camera_that_the_scene_has_changes_too():
    one, two = read(f"{STEP}{BUILD}camera.projection = 'parallel'\n").builds
    assert two.view == replace(one.view, camera=replace(one.view.camera, projection="parallel"))


@pytest.mark.parametrize(
    ("text", "more", "kinds"),
    [
        ("1. a", "2. b", [ItemList]),
        ("- a\n  b\n", "- c\n\nd", [ItemList, Paragraph]),
        ("- a", "1. b", [ItemList, ItemList]),
        ("- a\n\nb", "- c", [ItemList, Paragraph, ItemList]),
        ("a", "b", [Paragraph, Paragraph]),
        ("> a", "> b", [Question, Question]),
        ("", "b", [Paragraph]),
    ],
)
def test_a_list_goes_on_across_builds_and_nothing_else_does(text, more, kinds):
    assert [type(block) for block in parse(extended(text, more))] == kinds


@pytest.mark.parametrize(
    ("more", "said"),
    [
        (
            "text = 'a'\ninstead = 'b'",
            "6: steps[0].builds[0].instead: cannot be used together with text; ",
        ),
        ("move_s = -1", "5: steps[0].builds[0].move_s: -1 is out of range; give 0 to 60"),
        ("move_s = 0\nloop = true", "6: steps[0].builds[0].loop: has no movement to repeat; give"),
        ("text = 'a $b'", "5: steps[0].builds[0].text: a formula does not end"),
        ("shadow = 1", "5: steps[0].builds[0].shadow: is unknown"),
        ("views = ['rya']", "5: steps[0].builds[0].views[0]: 'rya' is unknown; did you mean"),
        ("options.shadow = 1", "5: steps[0].builds[0].options.shadow: is unknown; did you mean"),
        ("camera.eyes = [0, 0, 1]", "5: steps[0].builds[0].camera.eyes: is unknown"),
        ("scene = 'x'", "5: steps[0].builds[0].scene: 'x' is unknown"),
    ],
)
def test_wrong_values_cost_one_line(more, said):
    with pytest.raises(LucidaError) as caught:
        read(f"{STEP}{BUILD}{more}\n")
    assert str(caught.value).startswith(f"x.toml:{said}")


def test_an_unknown_field_is_not_told_to_be_one_that_left():
    for near in ("revael = true", "answers = 'So.'", "hilight = []", "zzz = 1"):
        with pytest.raises(LucidaError) as caught:
            read(f"{STEP}{near}\n")
        _, told, remedy = str(caught.value).partition(": is unknown; ")
        assert told and set(re.findall(r"\w+", remedy)).isdisjoint(FIELDS)


def test_a_step_has_so_many_builds():
    assert len(read(STEP + (BUILDS - 1) * BUILD).builds) == BUILDS
    with pytest.raises(LucidaError, match=rf"builds: holds {BUILDS}; give fewer than {BUILDS}"):
        read(STEP + BUILDS * BUILD)


def test_walking_back_is_walking_on_backwards():
    lecture = read(3 * (STEP + 2 * BUILD))
    session = LectureSession(lecture, BUILTIN)
    seen = [session.place[1:]]
    while session.walk(1):
        seen.append(session.place[1:])
    assert seen == [(number, build) for number in range(3) for build in range(3)]
    while session.walk(-1):
        seen.append(session.place[1:])
    assert seen[9:] == seen[7::-1]
    for wanted, found in (((1, 2), (1, 2)), ((1, 7), (1, 2)), ((9, 0), (2, 0)), ((-1, 3), (0, 2))):
        session.go(*wanted)
        assert session.place[1:] == found


def test_a_session_keeps_the_build(tmp_path):
    path = tmp_path / "x.toml"
    path.write_text(f"title = 'L'\n{STEP}{BUILD}{BUILD}")
    session = LectureSession(load_lecture(path), path)
    session.walk(2)
    state = state_of(session.step, AppState(session.step.scene, session.step.view, True))
    assert LectureSession.resumed(session.kept(state)).place == session.place


def test_the_last_session_s_end_is_offered_until_another_step_is_shown(tmp_path):
    path = tmp_path / "x.toml"
    path.write_text(f"title = 'L'\n{STEP}{BUILD}{STEP}{STEP.replace('T', 'Last')}")
    ended = LectureSession(load_lecture(path), path, (2, 0))
    kept = ended.kept(AppState(ended.step.scene, ended.step.view, True))
    session = LectureSession(load_lecture(path), path, left=kept)
    assert session.walk(1) and session.left is kept
    assert session.walk(1) and session.left is None


def test_lists_and_answers_are_builds():
    text = "text = '''\n- one\n- two\n\n> Why?\n\n1. three\n'''\n"
    lecture = read(f"{STEP}reveal = true\nanswer = 'So.'\n{text}{STEP}low = true\n")
    shown = [plain_text(step.blocks).split() for step in lecture.builds if step.number == 0]
    words = ["Why?"], ["one", "Why?"], ["one", "two", "Why?"], ["one", "two", "Why?", "three"]
    assert shown == [*words, [*words[-1], "So."]]


def test_one_line_says_what_to_change():
    lecture = read(
        f"{STEP}{STEP}answer = 'a'\nlow = true\n{STEP}links.b.c = 1\nhighlight = ['eye']\n"
    )
    (note,) = lecture.summary
    assert note.startswith("x.toml:6: steps[1].answer: is of an older format: write later")
    one = f"{STEP}answer = 'a'\noptions.outside.see = 'all'\noptions.pair.value = 'r'\n"
    (note,) = read(one).summary
    assert note.endswith("are ignored (and 2 more: lucida lecture x.toml --check)")
    assert first_lecture().notes == ()


def test_a_link_is_its_words():
    assert plain_text(read(f"{STEP}text = 'They [meet](#lines).'\n").steps[0].blocks) == (
        "They meet."
    )
