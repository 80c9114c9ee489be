"""An exported scene as pbrt reads it: its grammar, its textures' places, its meshes' files."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
from hypothesis import Phase, given, settings
from mitsuba_formulas import bilinear, ply_arrays
from test_mitsuba_colours import SIZE, scenes

from renderer.camera import Camera
from renderer.scene import Scene
from renderer.scene.model import Sphere
from renderer.scene_export import export_scene
from renderer.trace import Tracer
from tests.conformance.pbrt_grammar import Directive, parse

AMBIENT = (1.0, 1.0, 1.0)


@given(scenes())
@settings(max_examples=40, deadline=None, derandomize=True, phases=[Phase.generate])
def test_textures_and_checkers_are_where_ours_are(scene: Scene):
    """In light from all around, unshaded, a surface has the colour of its pattern."""
    scene = Scene(scene.objects, ambient=AMBIENT)
    camera = Camera.look_at((1, 2, 5), (0, 0, 0), fov_y_deg=45, aspect=1.5)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.pbrt"
        export_scene(path, scene, camera, SIZE)
        found = parse(path.read_text())
        with Tracer(scene, threads=1) as tracer:
            frame = tracer.render(camera, SIZE, ("color", "depth", "id"))
        ray = camera.rays(SIZE)
        blocks = [k for k, part in enumerate(found) if part.name == "AttributeBegin"]
        for number, (first, entry) in enumerate(zip(blocks, scene.objects, strict=True)):
            if getattr(entry.shape, "colors", None) is not None:
                continue  # pbrt has none
            seen = frame.id == number
            point = ray.origin + frame.depth[..., None] * ray.direction
            point = np.column_stack([point[seen], np.ones(seen.sum())])
            color, clear = pattern(found[first:], point, isinstance(entry.shape, Sphere), path)
            np.testing.assert_allclose(color[clear], frame.color[seen][clear], atol=0.012)


def pattern(block: list[Directive], point: np.ndarray, is_sphere: bool, path: Path):
    """The colours at points of a block's shape, and where they are clear of a cell's border."""
    everywhere = np.ones(len(point), bool)
    texture = next((p for p in block[: names(block).index("Shape")] if p.name == "Texture"), None)
    material = block[names(block).index("Material")]
    if texture is None:
        return np.tile(material.parameters["reflectance"], (len(point), 1)), everywhere
    place = before(block, names(block).index("Shape"))
    if texture.kind == "checkerboard":
        cell = point @ np.linalg.inv(before(block, block.index(texture))).T[:, :3]
        odd = np.floor(cell - [0, 1e-3, 0]).sum(axis=1) % 2 == 1
        colors = [np.array(texture.parameters[f"tex{k}"]) for k in (1, 2)]
        clear = (np.abs(cell - np.round(cell))[:, [0, 2]] > 1e-3).all(axis=1)
        return np.where(odd[:, None], colors[1], colors[0]), clear
    x, y, z, _ = np.linalg.inv(place) @ point.T
    shape = block[names(block).index("Shape")]
    if is_sphere:
        radius = float(shape.parameters["radius"][0])
        u = np.arctan2(y, x) / (2 * np.pi) % 1
        v = 1 - np.arccos((z / radius).clip(-1, 1)) / np.pi
    else:
        mesh = ply_arrays(path.parent / shape.parameters["filename"][0])
        corners = np.column_stack([mesh["x"], mesh["y"], mesh["z"], np.ones(len(mesh["x"]))])
        at = np.column_stack([x, y, z, np.ones(len(x))])
        u, v = (at @ np.linalg.lstsq(corners, mesh[name])[0] for name in "uv")
    given = {k: value[0] for k, value in texture.parameters.items()}
    u, v = u * given["uscale"] + given["udelta"], v * given["vscale"] + given["vdelta"]
    color = bilinear(path.parent / given["filename"], u, 1 - v, given["wrap"])
    return color, everywhere


def names(block: list[Directive]) -> list[str]:
    return [part.name for part in block]


def before(block: list[Directive], end: int) -> np.ndarray:
    """The last Transform before a directive: world from its space."""
    last = [part for part in block[:end] if part.name == "Transform"][-1]
    return np.reshape(last.numbers, (4, 4)).T
