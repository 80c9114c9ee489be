"""Names in any script, composed or decomposed, stay what they are in files, output and pages."""

from __future__ import annotations

import json
import re
import unicodedata
from pathlib import Path

import pytest

from lucida.app.cli import main
from lucida.app.state.app_state import AppState
from lucida.app.state.session import Arrangement, from_bytes, session_of, to_bytes
from lucida.renderer.files import load_scene, save_scene
from lucida.renderer.system.atomic import file_stem

NAMES = (
    "\u8336\u58f6",  # Chinese
    "\u0625\u0628\u0631\u064a\u0642 \u0634\u0627\u064a",  # Arabic
    "\u0645\u06cc\u200c\u0634\u0648\u062f",  # Persian, with a joiner
    unicodedata.normalize("NFC", "\u00e9cole \u1e69"),
    unicodedata.normalize("NFD", "\u00e9cole \u1e69"),
)
OBJECT = '[[objects]]\nname = "{}"\ntype = "sphere"\ncenter = [{}, 0, 0]\nradius = 0.4\n'


@pytest.fixture(params=NAMES, ids=["chinese", "arabic", "persian", "composed", "decomposed"])
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def scene_file(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Write a scene file of that name, whose objects have all names."""
    monkeypatch.chdir(tmp_path)
    objects = "".join(OBJECT.format(one, k) for k, one in enumerate(NAMES))
    Path(f"{name}.toml").write_text(objects, "utf-8")
    return f"{name}.toml"


def test_scene_files_sessions_and_undo(scene_file: str, name: str) -> None:
    state = AppState.for_scene(load_scene(scene_file))
    session = from_bytes(to_bytes(session_of(state, Arrangement())))
    save_scene("copy.toml", load_scene(session.source))
    assert session.source.endswith(scene_file) and load_scene(scene_file).name == name
    assert tuple(one.name for one in load_scene("copy.toml").objects) == NAMES


def test_every_command_takes_and_writes_any_name(
    scene_file: str, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    frame = {
        "file_path": f"{name}.png",
        "transform_matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 4], [0, 0, 0, 1]],
    }
    Path("poses.json").write_text(json.dumps({"camera_angle_x": 0.7, "frames": [frame]}), "utf-8")
    for command in (
        ["scene", scene_file],
        ["page", scene_file, "-o", f"{name}.html"],
        ["export", scene_file, "-o", f"{name}.glb"],
        ["scene", f"{name}.glb"],
        ["camera", "poses.json#0"],
    ):
        assert main(command) == 0
        said = capsys.readouterr().out
        assert name in said
        if command[0] == "scene":
            assert all(one in said for one in NAMES)
    text = Path(f"{name}.html").read_text("utf-8")
    data = re.search(r'id="lucida-data"[^>]*>(.*?)</script>', text, re.DOTALL)
    assert data is not None and tuple(json.loads(data[1])["scene"]["names"]) == NAMES
    assert f"<title>{name}: Lucida</title>" in text
    assert file_stem(name) == name.replace("\u200c", "-")
