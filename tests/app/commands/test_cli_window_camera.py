"""`lucida FILE` with one camera of another program: its lens is never dropped in silence."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from lucida.app.cli import main
from lucida.app.window import launch
from lucida.renderer.camera.lenses import Lens
from tests.support.refusals import refused

LENS = {"image_width": 20, "image_height": 16, "K": [9, 9, 10, 8], "D": [0.5, 0, 0, 0]}


@pytest.fixture
def begun(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[dict[str, Any]]:
    """Return what the window would have begun with."""
    monkeypatch.chdir(tmp_path)
    found: list[dict[str, Any]] = []
    monkeypatch.setattr(launch, "run_viewer", lambda *_, **named: found.append(named) or 0)
    Path("lens.json").write_text(json.dumps(LENS))
    Path("plain.json").write_text(json.dumps({**LENS, "D": [0, 0, 0, 0]}))
    return found


def test_a_camera_keeps_its_lens(begun: list[Any], capsys: pytest.CaptureFixture) -> None:
    assert main(["lens.json"]) == 0
    assert begun[0]["view"].camera.lens == Lens("brown", {"k1": 0.5})
    assert not capsys.readouterr().err


def test_a_photograph_is_laid_over_the_images(begun: list[Any], capsys: Any) -> None:
    Image.new("RGB", (8, 6)).save("photo.png")
    assert main(["photo.png"]) == 0
    assert begun[0]["photograph"] == str(Path("photo.png").absolute()) and not begun[0]["code"]
    Path("broken.jpg").write_text("x")
    for name, problem in {
        "phot.png": "does not exist; check its name and folder",
        "broken.jpg": "is not a readable picture",
    }.items():
        assert f"{name}: {problem}" in refused(capsys, name)
