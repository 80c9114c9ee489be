from __future__ import annotations

from pathlib import Path

import pytest
from random_edits import SCENE, TENT

from lucida.renderer.files import load_scene
from lucida.renderer.scene import Scene


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    (tmp_path / "tent.obj").write_text(TENT)
    (tmp_path / "scene.toml").write_text(SCENE)
    return load_scene(tmp_path / "scene.toml")
