"""What the README shows is taken: its commands, its files, its Python."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import numpy as np
import pytest

from app.commands import COMMANDS, view
from app.commands.arguments import Parser
from renderer.scene import view_from_toml
from renderer.scene.files import scene_from_toml

TEXT = (Path(__file__).parent.parent / "README.md").read_text("utf-8")


def section(name: str) -> list[str]:
    """The indented blocks of a section, without their indentation."""
    text = TEXT.partition(f"\n## {name}\n")[2].partition("\n## ")[0]
    assert text, name
    blocks = re.findall(r"(?:^    .*\n(?:\n(?=    ))*)+", text, re.MULTILINE)
    return [re.sub(r"^    ", "", block, flags=re.MULTILINE) for block in blocks]


def commands() -> list[str]:
    found = re.findall(r"^    (lucida\b.*)$", TEXT, re.MULTILINE)
    return [re.split(r"\s{2,}", line)[0] for line in found]


def test_every_command_is_shown():
    shown = {line.split()[1] for line in commands() if " " in line}
    assert {command.NAME for command in COMMANDS} - {"scenes"} <= shown


@pytest.mark.parametrize("line", commands())
def test_a_command_is_taken(line):
    words = shlex.split(line)[1:]
    command = next((c for c in COMMANDS if words[:1] == [c.NAME]), view)
    parser = Parser("lucida")
    command.configure(parser)
    parser.parse_args(words if command is view else words[1:])


def test_the_view_file():
    blocks = section("The command line")
    shown = view_from_toml(next(block for block in blocks if "[camera]" in block))
    assert shown.camera.far == 100.0


def test_the_scene_file(tmp_path):
    (tmp_path / "bunny.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    scene = scene_from_toml(section("Scene files")[0], tmp_path)
    assert len(scene.objects) == 2


def test_python(tmp_path, monkeypatch, capsys, gl_backend):
    if gl_backend != "egl":
        pytest.skip("once is enough")
    monkeypatch.chdir(tmp_path)
    names: dict = {}
    exec(section("From Python")[0], names)
    assert float(capsys.readouterr().out) == pytest.approx(float(names["t"]), rel=1e-6)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["corner.toml", "depth.png"]
    assert names["shown"].shape == (480, 640, 3)
    assert np.isfinite(names["frame"].depth).any()
