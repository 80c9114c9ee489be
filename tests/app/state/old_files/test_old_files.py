"""Files that earlier versions wrote are still read. One folder for each version that wrote them."""

from dataclasses import fields, is_dataclass
from pathlib import Path

import msgspec
import pytest

from lucida.app.cameras.films.key_file import load_keys
from lucida.app.checking.task_file import load_tasks
from lucida.app.lecture.reading import load_lecture
from lucida.app.lecture.schema import VIEWS
from lucida.app.state import removed
from lucida.app.state.options import Options
from lucida.app.state.session import from_bytes
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files import load_scene, load_view
from lucida.renderer.scene import View

FOLDER = Path(__file__).parent / "2026-11"
CAMERA = Camera(
    eye=(1, 2, 3),
    u=(1, 0.1, 0),
    v=(0, 1, 0.2),
    w=(0, 0, 2),
    distance=0.75,
    viewport=(-0.6, 0.4, -0.5, 0.5),
    near=0.1,
    far=50.0,
    lens=Lens("fisheye", {"k1": 0.05, "k3": -0.01}),
)
VIEW = View(CAMERA, False)


def test_an_old_view_is_read():
    assert load_view(FOLDER / "view.toml") == VIEW


def test_an_old_scene_is_read():
    scene = load_scene(FOLDER / "scene.toml")
    assert (scene.name, scene.notes) == ("Everything", ())
    assert [entry.name for entry in scene.objects][:3] == ["ball", "crate", "ground"]
    assert len(scene.objects) == 8
    assert scene.view.camera.lens == Lens("brown", {"k1": -0.1, "p1": 0.001, "s1": 0.002})
    ball, crate, ground = (entry.material for entry in scene.objects[:3])
    assert (ball.shininess, crate.cutout, crate.single_sided) == (30.0, 0.5, True)
    assert crate.texture is not None and ground.checker is not None
    assert sum(len(entry.shape.faces) for entry in scene.objects if entry.name == "roof") == 3


def test_old_key_cameras_are_read():
    keys = load_keys(FOLDER / "keys.toml")
    assert [(key.seconds, key.timing) for key in keys] == [
        (1.5, "eased"),
        (4.0, "constant"),
        (1.5, "cut"),
    ]
    assert keys[0].view == VIEW
    assert keys[2].view.camera.projection == "parallel"


def test_an_old_task_file_is_read_and_notes_what_has_left():
    file = load_tasks(FOLDER / "tasks.toml")
    said = [note.partition(" is")[0] for note in file.notes]
    assert said == ["network = false", "tasks[1]: to-gray", "tasks[2]: memory-offset"]
    assert (file.limits.seconds, file.limits.memory_mb) == (12.5, 512)
    (ray,) = file.tasks
    assert (ray.function, ray.points, ray.count, ray.seed) == ("camera_ray", 3.0, 40, 7)
    assert ray.notation == "code"
    assert (ray.conventions.base, ray.conventions.rows) == (1, "bottom")
    assert ray.conventions.axes == (1, -1, -1)


def test_an_old_lecture_is_read():
    lecture = load_lecture(FOLDER / "lecture.toml")
    titles = ["A simple camera", "Lenses", "Loops", "A matrix", "A ray", "Hide"]
    assert [step.title for step in lecture.steps] == titles
    assert lecture.steps[1].view == VIEW
    assert [step.exercise is not None for step in lecture.steps] == [False] * 4 + [True] * 2
    assert lecture.steps[0].pixel == (3, 7)
    for step in lecture.steps:
        assert step.views and set(step.views) <= {*VIEWS, "camera"}


def test_an_old_session_is_read(tmp_path):
    session = from_bytes((FOLDER / "session.json").read_bytes())
    state = session.state(load_scene(session.source))
    assert state.view == VIEW
    (tmp_path / "unsaved.toml").write_text(session.unsaved)
    edited = load_scene(tmp_path / "unsaved.toml")
    assert (edited.objects[1].name, edited.objects[-1].name) == ("renamed", "cone 2")
    options = state.options
    assert (options.marked, options.shadows, options.mirrors) == ((10, 20), True, True)
    assert options.one_based is False
    assert options.images.resolution == (320, 180)
    assert (options.preferences.theme, options.preferences.font_scale) == ("light", 1.25)
    assert [mark.number for mark in options.bookmarks] == [1, 4]
    assert options.bookmarks[0].view == VIEW
    assert session.lecture is not None and (session.lecture.number, session.lecture.title) == (
        3,
        "Today",
    )


def test_each_removed_option_of_the_lecture_is_reported_with_its_line():
    notes = load_lecture(FOLDER / "lecture.toml").notes
    named = {
        "outside.see",
        "outside.bundle",
        "images.lens_method",
        "images.lens_splitting",
        "images.lens_enlargement",
        "stepper.form",
        "costs.against",
        "detective",
        "filming",
    }
    assert [note for note in notes if "lecture.toml:5: notation: notation is ignored: " in note]
    for path in named & set(removed.REMOVED):
        (note,) = (note for note in notes if f" {path} is ignored: " in note)
        file, line, field, *_ = note.split(": ")[0].split(":") + note.split(": ")[1:]
        assert file.endswith("lecture.toml") and int(line) > 1
        assert field.startswith("steps[") and field.endswith("options")
    for path, value in removed.REPLACED:
        if path == "language":
            lines = [note for note in notes if f"language = {value!r} is now 'python'" in note]
            assert len(lines) == 1  # a link is ignored as a whole


def test_a_session_says_in_one_line_that_options_have_left():
    (note,) = from_bytes((FOLDER / "session.json").read_bytes()).notes
    assert "an earlier version: " in note


def test_no_removed_key_is_a_present_one():
    for path in removed.REMOVED:
        kind = Options
        *parts, last = path.split(".")
        for part in parts:
            kind = next(f.default_factory for f in fields(kind) if f.name == part)
        assert is_dataclass(kind) and last not in {field.name for field in fields(kind)}, path
    assert not set(removed.REMOVED_VIEWS) & set(VIEWS)


@pytest.mark.parametrize("path_value", removed.REPLACED)
def test_a_replaced_value_is_refused_as_a_present_one(path_value):
    path, value = path_value
    kind = msgspec.inspect.type_info(Options)
    for part in path.split("."):
        kind = next(field.type for field in kind.fields if field.name == part)
    assert value not in kind.values and removed.REPLACED[path_value][0] in kind.values
