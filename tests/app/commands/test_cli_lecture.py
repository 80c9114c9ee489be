"""`lucida lecture`: mistakes by line, checking, and pictures of all steps without a display."""

from __future__ import annotations

import numpy as np
import pytest
from launching import launch
from PIL import Image

from lucida.app.cli import main
from lucida.app.commands.lecture import EXPORT_SIZE
from lucida.app.ui import formula
from lucida.app.window import lecturing
from tests.support.refusals import refused

LECTURE = '''\
title = "Two steps"
[[steps]]
title = "Spheres"
text = """
They are **exact**: $|\\\\mathbf{x} - \\\\mathbf{c}| = r$.
"""
scene = "spheres"
[[steps]]
title = "The array"
scene = "canonical"
views = ["laboratory"]
options.laboratory.page = "array"
'''


def test_checking_the_built_in_lecture(capsys):
    assert main(["lecture", "--check"]) == 0
    said = capsys.readouterr().out
    assert said.startswith("Images, rays and cameras: ") and "exercises" in said


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('"spheres"', '"sphere"', ":7: steps[0].scene: 'sphere' is unknown; did you mean"),
        ("r$", "r", ":5: steps[0].text: a formula does not end"),
        ('"array"', '"arrey"', ":12: steps[1].options.laboratory.page: 'arrey' is unknown"),
    ],
)
def test_mistakes_are_one_line_and_exit_status_2(old, new, told, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "x.toml"
    path.write_text(LECTURE.replace(old, new, 1))
    for more in ([], ["--check"], ["--export", str(tmp_path / "out")]):
        assert refused(capsys, "lecture", str(path), *more).startswith(f"{path}{told}")
    assert not (tmp_path / "out").exists()


def test_a_formula_that_cannot_be_set_is_told_by_checking(tmp_path, capsys):
    path = tmp_path / "x.toml"
    exercise = """[steps.exercise]
kind = "choice"
question = "Which?"
options = [
    { text = "$v$", feedback = "yes", right = true },
    { text = "$\\\\left( \\\\vau \\\\right)$", feedback = "no" },
]
"""
    path.write_text(LECTURE + exercise)
    assert main(["lecture", str(path), "--check"]) == (2 if formula.available() else 0)
    said = capsys.readouterr()
    if formula.available():
        told = r":16: steps[1].exercise.options[1].text: \vau is no command that formulas know"
        assert said.err.startswith(f"lucida: {path}{told}") and said.err.count("\n") == 1
    else:
        assert "formulas not checked" in said.out


@pytest.mark.parametrize("text", [LECTURE, LECTURE.replace('"spheres"', '"spheres')])
def test_a_lecture_in_the_place_of_a_scene(text, tmp_path, capsys):
    path = tmp_path / "x.toml"
    path.write_text(text)
    for command in ([], ["render", "-o", str(tmp_path / "x.png")], ["compare"]):
        assert main([*command, str(path)]) == 2
        said = capsys.readouterr().err
        assert said == f"lucida: {path}: is a lecture, not a scene; lucida lecture {path}\n"


def test_every_step_is_exported_without_a_display(tmp_path):
    path = tmp_path / "x.toml"
    path.write_text(LECTURE)
    command = "-m lucida lecture x.toml --export out --size 900x600"
    done = launch(command.split(), tmp_path)
    assert done.returncode == 0, done.stderr[-2000:]
    assert done.stdout == "out: 2 pictures, 900x600\n"
    pictures = [np.asarray(Image.open(tmp_path / "out" / f"{k:02}.png")) for k in (1, 2)]
    for picture in pictures:
        assert picture.shape == (600, 900, 3) and picture.std() > 15
    assert np.abs(pictures[0].astype(int) - pictures[1]).mean() > 5


def test_no_name_is_not_this_folder(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = refused(capsys, "lecture", "--export", "")
    assert told.startswith("--export: names no folder; give one")


def test_a_full_disk_leaves_no_folder(tmp_path):
    resource = pytest.importorskip("resource")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, hard))
    try:
        assert main(["lecture", "--export", str(tmp_path / "out"), "--size", "320x240"]) == 2
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(("given", "size"), [("", EXPORT_SIZE), ("--size 900x600", (900, 600))])
def test_pictures_have_the_size_that_is_given_or_one_for_all(given, size, monkeypatch, capsys):
    monkeypatch.setattr(
        lecturing, "export_lecture", lambda *called: ["0.png"] * (called[3] == size)
    )
    assert main(f"lecture --export out {given}".split()) == 0
    assert capsys.readouterr().out == f"out: 1 picture, {size[0]}x{size[1]}\n"
