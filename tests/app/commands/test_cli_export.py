"""`lucida export`: what it writes and says, and how it fails."""

from __future__ import annotations

from pathlib import Path

import pytest

from lucida.app.cli import main
from tests.support.refusals import refused


@pytest.fixture(autouse=True)
def in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_a_scene_is_written_and_what_is_left_out_is_said(capsys):
    assert main(["export", "still-life", "-o", "a.glb"]) == 0
    told = capsys.readouterr()
    first, *left_out = told.out.splitlines()
    assert first == "a.glb: 11 objects, 2 lights"
    assert left_out and all(line.startswith("  ") for line in left_out)
    assert not told.err
    assert Path("a.glb").stat().st_size


def test_what_is_hidden_does_not_count(capsys):
    text = '[[objects]]\ntype = "box"\n[[objects]]\ntype = "box"\nhidden = true\n'
    Path("a.toml").write_text("lights = []\n" + text)
    assert main(["export", "a.toml", "-o", "a.glb"]) == 0
    assert capsys.readouterr().out.splitlines()[0] == "a.glb: 1 object, 0 lights"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["-o", "a.obj"], "a.obj: ends in '.obj'; give .glb"),
        (["-o", "a.glb", "--u=-1,0,0"], "u: (-1, 0, 0) is left-handed"),
        (
            ["-o", "a.glb", "--u=1,0.5,0", "--v=0,1,0"],
            "w: (0, 0.164399, 0.986394) is not at right angles to the others, as "
            "gltf requires; make it orthonormal (Keep orthonormal, --up, ",
        ),
    ],
)
def test_a_mistake_is_one_line_and_nothing_is_written(arguments, told, capsys):
    assert refused(capsys, "export", "spheres", *arguments).startswith(told)


def test_scene_lists_a_model_s_cameras(capsys):
    assert main(["export", "spheres", "-o", "a.glb", "--eye", "0,2,9"]) == 0
    capsys.readouterr()
    assert main(["scene", "a.glb"]) == 0
    (line,) = (line for line in capsys.readouterr().out.splitlines() if "camera '" in line)
    assert line == "  camera 'camera': perspective from (0, 2, 9)"
