"""The ways of a Python file into the window: named, dropped, in a lecture, in a session."""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from opened_things import found
from option_changes import with_options

from lucida.app.lecture.reading import load_lecture
from lucida.app.state.app_state import AppState
from lucida.app.state.paths import restored, stored
from lucida.app.state.session import Arrangement, from_bytes, session_of, to_bytes
from lucida.app.window.opening import OpenedCode, OpenedScene, open_sources
from lucida.renderer.files import load_scene
from lucida.renderer.files.outside import OutsideError
from lucida.renderer.system.errors import LucidaError

STEP = """
title = "Code"
[[steps]]
title = "yours"
views = ["your-code", "outside"]
"""


def lecture(folder: Path, line: str):
    file = folder / "lecture.toml"
    file.write_text(STEP + line)
    return load_lecture(file)


def test_a_lecture_names_a_file_beside_itself(tmp_path: Path):
    (tmp_path / "rays.py").write_text("")
    options = lecture(tmp_path, 'options.your_code = { file = "rays.py", canvas = [8, 6] }').steps[
        0
    ]
    assert options.views == ("your-code", "outside")
    assert options.changes["your_code"]["file"] == str(tmp_path / "rays.py")
    assert options.changes["your_code"]["canvas"] == (8, 6)
    assert (
        lecture(tmp_path, 'options.your_code.file = ""').steps[0].changes["your_code"]["file"] == ""
    )


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ('options.your_code.file = "away.py"', "your_code.file: 'away.py' does not exist"),
        ('options.your_code.file = "rays.txt"', "your_code.file: 'rays.txt' is no such file"),
        ("options.your_code.file = 3", "your_code.file"),
        ("options.your_code.canvas = [65, 1]", "your_code.canvas[0]"),
    ],
)
def test_a_lecture_s_mistakes_name_line_and_field(tmp_path: Path, line: str, problem: str):
    (tmp_path / "rays.txt").write_text("")
    with pytest.raises(LucidaError) as caught:
        lecture(tmp_path, line)
    assert f"lecture.toml:6: steps[0].options.{problem}" in str(caught.value)


def test_a_file_outside_of_the_lecture_s_folder_is_asked_about(tmp_path: Path):
    inside = tmp_path / "inside"
    inside.mkdir()
    (tmp_path / "rays.py").write_text("")
    with pytest.raises(OutsideError, match="outside of its folder"):
        lecture(inside, 'options.your_code.file = "../rays.py"')


def test_a_python_file_is_never_read_as_a_scene(tmp_path: Path):
    file = tmp_path / "Rays.PY"
    file.write_text("objects = []")
    opened = open_sources([str(file)], dropped=True)
    assert opened.things == (OpenedCode(str(file)),)
    assert opened.sources == (str(file),)
    both = open_sources(["spheres", str(file), str(tmp_path / "other.py")])
    assert both.find(OpenedScene) is not None
    assert found(both, OpenedCode).path == str(file)
    for name, problem in (("away.py", "does not exist"), ("folder.py", "is a folder")):
        (tmp_path / "folder.py").mkdir(exist_ok=True)
        with pytest.raises(LucidaError, match=problem):
            open_sources([str(tmp_path / name)])


def test_a_session_keeps_the_file_whatever_its_name(tmp_path: Path):
    path = os.fsdecode(b"/caf\xe9/rays.py") if sys.platform != "win32" else "C:\\rays.py"
    state = AppState.for_scene(load_scene("spheres"))
    state = with_options(state, your_code={"file": stored(path), "canvas": (8, 6)})
    kept = from_bytes(to_bytes(session_of(state, Arrangement()))).options.your_code
    assert restored(kept.file) == path
    assert kept == replace(state.options.your_code)


def test_a_file_of_tasks_is_for_the_command(tmp_path: Path):
    file = tmp_path / "hw2.toml"
    file.write_text('lucida = 1\n[[tasks]]\nkind = "basis"\n')
    with pytest.raises(LucidaError, match="holds tasks"):
        open_sources([str(file)], dropped=True)
