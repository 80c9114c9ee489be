"""Images and scenes with textures, for several rooms' tests."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import DirectionalLight, Mesh, Scene, SceneObject, Sphere
from lucida.renderer.scene.texture import Texture

WHITE = (1.0, 1.0, 1.0)


def noise(width: int, height: int, seed: int = 1) -> NDArray[np.uint8]:
    """No two texels alike: whatever is looked up a texel off is seen."""
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3), np.uint8)


def slopes(width: int, height: int) -> NDArray[np.uint8]:
    """Red grows to the right, green downwards."""
    texels = np.full((height, width, 3), 60, np.uint8)
    texels[..., 0] = np.linspace(0, 255, width)
    texels[..., 1] = np.linspace(0, 255, height)[:, None]
    return texels


def wall(texture: Texture, low: float = -0.75, high: float = 1.75, z: float = -4.0) -> Mesh:
    """A square that faces +z, with coordinates from low to high in both directions."""
    corners = [(-2.0, -2.0, z), (2.0, -2.0, z), (2.0, 2.0, z), (-2.0, 2.0, z)]
    uv = [(low, low), (high, low), (high, high), (low, high)]
    return Mesh(corners, [(0, 1, 2), (0, 2, 3)], uv=uv)


def lit(*objects: SceneObject) -> Scene:
    return Scene(objects, (DirectionalLight((0.2, -0.3, -1)),))


def on_wall(texture: Texture, diffuse=WHITE, **places: float) -> Scene:
    return lit(SceneObject(wall(texture, **places), Material(diffuse, texture=texture)))


def on_ball(texture: Texture) -> Scene:
    return lit(SceneObject(Sphere((0.2, 0.1, -3), 1), Material(WHITE, texture=texture)))


def floor(texture: Texture, repeats: float, size: float = 50.0) -> Scene:
    """A floor to the horizon, just below the eye, seen along itself."""
    corners = [(-size, -0.3, 1), (size, -0.3, 1), (size, -0.3, -size), (-size, -0.3, -size)]
    uv = np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) * repeats
    mesh = Mesh(corners, [(0, 1, 2), (0, 2, 3)], uv=uv)
    return lit(SceneObject(mesh, Material(WHITE, texture=texture)))


def png(texels: NDArray[np.uint8]) -> bytes:
    file = io.BytesIO()
    Image.fromarray(texels).save(file, format="PNG")
    return file.getvalue()


def saved(folder: Path, name: str, texels: NDArray[np.uint8]) -> Path:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(png(texels))
    return path
