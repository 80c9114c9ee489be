"""Opening photographs: by name, by a drop, in a lecture and in a session."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lucida.app.images.photograph.model import with_photograph
from lucida.app.lecture.reading import load_lecture
from lucida.app.state.app_state import AppState
from lucida.app.state.session import Arrangement, from_bytes, session_of, to_bytes
from lucida.app.window.opening import OpenedPhotograph, OpenedScene, open_sources
from lucida.renderer.files import load_scene
from lucida.renderer.system.errors import LucidaError

STEP = 'title = "Photographs"\n[[steps]]\ntitle = "one"\nviews = ["raster", "ray"]\n'


@pytest.fixture
def photo(tmp_path):
    path = tmp_path / "photo.PNG"
    Image.fromarray(np.full((3, 4, 3), 7, np.uint8)).save(path)
    return path


def test_a_picture_is_opened_as_a_photograph(photo):
    for dropped in (False, True):
        opened = open_sources([str(photo)], dropped)
        assert opened.things == (OpenedPhotograph(str(photo)),)
        assert opened.sources == (str(photo),)


def test_a_scene_and_a_photograph_are_opened_together(photo):
    opened = open_sources(["still-life", str(photo)], dropped=True)
    assert opened.find(OpenedScene) is not None
    assert opened.find(OpenedPhotograph) == OpenedPhotograph(str(photo))


def test_an_unreadable_picture_does_not_stop_the_others(photo, tmp_path):
    bad = tmp_path / "bad.jpg"
    bad.write_text("no picture")
    with pytest.raises(LucidaError, match="is not a readable picture"):
        open_sources([str(bad)])
    opened = open_sources([str(bad), str(photo)])
    assert opened.things == (OpenedPhotograph(str(photo)),)
    assert "bad.jpg" in opened.problems[0]


def test_a_lecture_names_a_photograph_in_its_folder(photo):
    file = photo.parent / "lecture.toml"
    file.write_text(STEP + f'options.photograph.file = "{photo.name}"\n')
    options = load_lecture(file).steps[0].changes["photograph"]
    assert Path(options["file"]) == photo
    file.write_text(STEP + "options.photograph.opacity = 2\n")
    with pytest.raises(LucidaError, match="opacity"):
        load_lecture(file)


def test_a_session_keeps_the_photograph(photo):
    state = with_photograph(
        AppState.for_scene(load_scene("still-life")),
        str(photo) + "\udcff",
        opacity=0.25,
        follows=True,
    )
    kept = from_bytes(to_bytes(session_of(state, Arrangement())))
    assert kept.options.photograph == state.options.photograph
