"""The command line at its borders: special files, a full disk, hostile names."""

from __future__ import annotations

import contextlib
import json
import os
import re
import socket
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from lucida.app.cli import main
from lucida.app.window.opening import open_sources
from lucida.renderer.system.errors import LucidaError
from tests.support.refusals import refused

posix = pytest.mark.skipif(sys.platform == "win32", reason="POSIX's special files and limits")
VIEW = "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n"
SPHERE = '[[objects]]\ntype = "sphere"\ncenter = [0, 0, -3]\nradius = 1.0\n'
MODEL = 'lucida = 1\n[[objects]]\ntype = "model"\nfile = "{}"\n'
TEXTURED = f'lucida = 1\n{SPHERE}material = {{ texture = "f.png" }}\n'
KINDS = ("folder", "pipe", "socket", "/dev/zero", "/dev/full", "link to a folder", "link to a pipe")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def make(kind: str, path: Path) -> None:
    """Make a special file."""
    if kind.startswith("link to a "):
        make(kind.removeprefix("link to a "), path.with_name("target"))
        path.symlink_to("target")
    elif kind == "folder":
        path.mkdir()
    elif kind == "pipe":
        os.mkfifo(path)
    elif kind == "socket":
        with socket.socket(socket.AF_UNIX) as server:
            server.bind(path.name)
    else:
        path.symlink_to(kind)


# What is given the special file: a command line with its name, or other files that name it.
BORDERS = [
    "check f.py",
    "check right.py --tasks f.toml",
    "tasks --tasks f.toml",
    *[f"scene f.{ending}" for ending in ("toml", "obj", "ply", "stl", "off", "glb", "gltf")],
    "scene model.toml",
    "pick canonical 0 0 --view f.json",
    "camera f.json",
    "lecture f.toml --check",
]


@posix
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("line", BORDERS)
def test_a_special_file_is_refused(
    capsys: pytest.CaptureFixture[str], folder: Path, line: str, kind: str
) -> None:
    (folder / "view.toml").write_text(VIEW, "utf-8")
    (folder / "model.toml").write_text(MODEL.format("f.obj"), "utf-8")
    (folder / "right.py").write_text("def lerp(): ...\n", "utf-8")
    found = re.search(r"\bf\.\w+", line)
    make(kind, folder / (found[0] if found else "f.obj"))
    told = refused(capsys, *line.split())
    assert re.search(r"\bf\.", told)
    assert re.search(
        "is a folder|not an ordinary file|no file|no camera|is a link out of its folder", told
    ), told


@posix
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ["f.toml", "f.obj", "f.py", "f.png", "f.json", "f"])
def test_a_special_file_is_not_opened_in_the_window(folder: Path, name: str, kind: str) -> None:
    make(kind, folder / name)
    with pytest.raises(LucidaError, match=name):
        open_sources([name], False)


RAYS = (
    "def viewing_ray(i, j, width, height, camera):\n    return camera.eye, [-x for x in camera.w]\n"
)
WRITERS = [
    "check --starter all -o out.py",
    "check rays.py --task viewing-ray --json out.json",
    "camera view.toml --size 640x480 -o out.yml --to opencv",
    "export spheres -o out.glb",
    "render canonical --renderer ray --size 9x9 -o out.png",
    "render canonical --renderer ray --size 9x9 --channel depth -o out.exr",
]


@contextlib.contextmanager
def files_up_to(most: int) -> Iterator[None]:
    """Let files have that many bytes, as a full disk does."""
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@posix
@pytest.mark.parametrize("most", [0, 100])
@pytest.mark.parametrize("line", WRITERS)
def test_a_full_disk_leaves_nothing(
    capsys: pytest.CaptureFixture[str], folder: Path, line: str, most: int
) -> None:
    (folder / "view.toml").write_text(VIEW, "utf-8")
    (folder / "rays.py").write_text(RAYS, "utf-8")
    before = sorted(folder.rglob("*"))
    with files_up_to(most):
        assert main(line.split()) == 2
    assert re.search(r"out[^\n]*: cannot be written: file too large\n$", capsys.readouterr().err)
    assert sorted(folder.rglob("*")) == before
    assert main(line.split()) != 2, "it is the disk alone that kept it from being written"


@posix
def test_no_earlier_results_stay_if_new_ones_cannot_be_written(
    capsys: pytest.CaptureFixture[str], folder: Path
) -> None:
    (folder / "view.toml").write_text(VIEW, "utf-8")
    (folder / "rays.py").write_text(RAYS, "utf-8")
    line = WRITERS[1].split()
    assert main(line) != 2
    assert (folder / "out.json").exists()
    with files_up_to(0):
        assert main(line) == 2
    assert not (folder / "out.json").exists()


HOSTILE = "\\u001b[31mred\\u009b2J\\u202e"
TASKS = f"""lucida = 1
title = "{HOSTILE}"
[[tasks]]
kind = "viewing-ray"
name = "{HOSTILE}"
text = "{HOSTILE}"
"""
SCENE = f"""lucida = 1
name = "{HOSTILE}"
[materials."{HOSTILE}"]
diffuse = [1, 0, 0]
[[objects]]
type = "sphere"
name = "{HOSTILE}"
center = [0, 0, 0]
radius = 1.0
material = "{HOSTILE}"
[[lights]]
type = "point"
name = "{HOSTILE}"
position = [0, 0, 0]
"""
LECTURE = f"""lucida = 1
title = "{HOSTILE}"
[[steps]]
title = "{HOSTILE}"
text = "{HOSTILE}"
"""


@pytest.mark.parametrize("line", [
    "tasks --tasks tasks.toml",
    "tasks --tasks tasks.toml \x1b[31mred\x9b2J\u202e",
    "check rays.py --tasks tasks.toml",
    "check --starter all --tasks tasks.toml",
    "scene scene.toml",
    "pick scene.toml 360 640",
    "lecture \x1b[31m.toml --check",
    "camera transforms.json",
    "camera transforms.json#0",
    "camera transforms.json#0 --to opencv -o \x1b[31m.yml",
    "export scene.toml -o \x1b[31m.glb",
])  # fmt: skip
def test_nothing_that_a_terminal_would_obey_is_printed(
    capsys: pytest.CaptureFixture[str], folder: Path, line: str
) -> None:
    files = {"tasks": TASKS, "scene": SCENE, "\x1b[31m": LECTURE, "view": VIEW}
    for name, text in files.items():
        (folder / f"{name}.toml").write_text(text, "utf-8")
    (folder / "rays.py").write_text(RAYS, "utf-8")
    pose = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    frame = {"file_path": "\x1b[31mred\x9b2J\u202e.png", "transform_matrix": pose}
    table = {"w": 64, "h": 48, "fl_x": 50.0, "frames": [frame]}
    (folder / "transforms.json").write_text(json.dumps(table), "utf-8")
    assert main(line.split()) in (0, 1), capsys.readouterr().err
    output = capsys.readouterr()
    assert (output.out + output.err).replace("\n", "").isprintable()
    assert "red" in output.out or "[31m" in output.out
