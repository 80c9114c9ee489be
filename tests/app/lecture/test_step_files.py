"""The files that a step's options name: found in the lecture's folder, or refused."""

import pytest

from lucida.app.lecture.step_options import files_named, with_files
from lucida.renderer.system.errors import LucidaError


def test_files_are_found_in_the_lectures_folder(tmp_path):
    (tmp_path / "photo.png").touch()
    (tmp_path / "set").mkdir()
    tables = {
        "photograph": {"file": "photo.png", "opacity": 0.5},
        "poses": {"file": "set"},
        "your_code": {"file": ""},
        "shadows": True,
    }
    found = with_files(tables, tmp_path)
    assert found["photograph"]["file"] == str(tmp_path / "photo.png")
    assert found["poses"]["file"] == str(tmp_path / "set")
    assert found["photograph"]["opacity"] == 0.5 and found["shadows"]
    assert found["your_code"] == {"file": ""}  # none
    assert tables["poses"]["file"] == "set", "the step's own table has changed"


def test_a_file_that_is_missing_is_refused_with_its_field(tmp_path):
    with pytest.raises(LucidaError, match=r"poses\.file: 'gone\.json' does not exist"):
        with_files({"poses": {"file": "gone.json"}}, tmp_path)


def test_files_are_named_though_something_else_is_wrong():
    tables = {
        "photograph": {"file": "a.png", "opacity": "?"},
        "poses": {"file": 3},
        "your_code": {},
        "nothing": {"file": "b.png"},
        "outside": 3,
    }
    assert list(files_named(tables)) == ["a.png"] and list(files_named(None)) == []
