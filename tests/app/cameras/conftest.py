"""Fixtures that several of the camera's tests use."""

from __future__ import annotations

import pytest

from lucida.renderer.files import load_scene
from lucida.renderer.scene.model import Scene


@pytest.fixture(scope="module")
def scene() -> Scene:
    return load_scene("spheres")
