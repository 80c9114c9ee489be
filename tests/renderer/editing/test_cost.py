"""The cost of one change in a scene with a large mesh: nothing of it is copied, built or uploaded.

Measured by which arrays are the same objects, and by what is called, not by a clock.
"""

from __future__ import annotations

import numpy as np
import pytest

from lucida import Rasterizer
from lucida.renderer.editing import changing, objects
from lucida.renderer.editing.moving import shift
from lucida.renderer.editing.outline import outline
from lucida.renderer.files import load_scene
from lucida.renderer.files.models import models
from lucida.renderer.raster.tables import TABLE_WIDTH, Table
from lucida.renderer.scene import Sphere, flatten
from lucida.renderer.trace.bvh import instances
from lucida.renderer.trace.threads.thread_pool import Team

SCENE = """
[[objects]]
type = "box"
name = "first"
size = 0.2
[[objects]]
type = "model"
name = "large"
file = "large.obj"
[[objects]]
type = "torus"
name = "ring"
[[objects]]
type = "sphere"
name = "ball"
center = [0, 2, 0]
"""


@pytest.fixture
def scene(tmp_path):
    rng = np.random.default_rng(1)
    points = "".join(f"v {x} {y} {z}\n" for x, y, z in rng.random((300, 3)))
    faces = "".join(f"f {k} {k + 1} {k + 2}\n" for k in range(1, 299))
    (tmp_path / "large.obj").write_text(points + faces)
    (tmp_path / "scene.toml").write_text(SCENE)
    return load_scene(tmp_path / "scene.toml")


def item(scene, name):
    return next(row.item for row in outline(scene) if row.name == name)


def meshes(scene):
    """Return the identities of the vertices of all meshes."""
    return {id(e.shape.vertices) for e in scene.objects if not isinstance(e.shape, Sphere)}


CHANGES = {
    "move": lambda s: shift(s, [item(s, "first")], (0.1, 0, 0)),
    "turn": lambda s: changing.set_field(s, [item(s, "ring")], "rotate_deg", [20, 30, 0]),
    "move a sphere": lambda s: shift(s, [item(s, "ball")], (0.1, 0, 0)),
    "material": lambda s: changing.set_field(s, [item(s, "first")], "material.diffuse", "#ff0000"),
    "light": lambda s: objects.add(s, objects.new_table(s, "point"))[0],
    "rename": lambda s: objects.rename(s, item(s, "first"), "other"),
    "hide": lambda s: objects.hide(s, [item(s, "first")]),
    "delete": lambda s: objects.delete(s, [item(s, "first")]),
    "add": lambda s: objects.add(s, objects.new_table(s, "cone"))[0],
    "duplicate": lambda s: objects.duplicate(s, [item(s, "ring")], (0, 1, 0))[0],
    "shape": lambda s: changing.set_field(s, [item(s, "first")], "size", 0.3),
}
SAME_LAYOUT = ("move", "turn", "move a sphere", "material", "light", "rename")


@pytest.mark.parametrize("name", CHANGES)
def test_what_does_not_change_is_the_same_objects_and_no_model_is_read_again(
    name, scene, monkeypatch
):
    monkeypatch.setattr(models, "read_model", None)
    before = {entry.name: entry for entry in scene.objects}
    changed = CHANGES[name](scene)
    after = {entry.name: entry for entry in changed.objects}
    assert after["large"] is before["large"]
    kept = sum(after.get(key) is entry for key, entry in before.items())
    assert kept >= len(before) - 1
    for key in before.keys() & after.keys():
        if name != "shape" and key != "ball":
            assert after[key].shape.vertices is before[key].shape.vertices


@pytest.mark.parametrize("name", CHANGES)
def test_flat_arrays_are_taken_over_where_only_places_and_materials_change(name, scene):
    flat = flatten(scene)
    followed = flatten(CHANGES[name](scene), (scene, flat))
    layout = ("vertices", "colors", "faces", "face_object", "object_faces", "object_vertices")
    for array in layout:
        is_same = getattr(followed, array) is getattr(flat, array)
        assert is_same == (name in SAME_LAYOUT), array
    assert (followed.normals is flat.normals) == (name in SAME_LAYOUT and name != "turn")


@pytest.mark.parametrize("name", CHANGES)
def test_no_tree_is_built_again(name, scene, monkeypatch):
    built = []
    right = instances.tree_of_mesh

    def noted(vertices, *rest):
        built.append(id(vertices))
        return right(vertices, *rest)

    trees = instances.Instances(scene, flatten(scene), Team(1))
    monkeypatch.setattr(instances, "tree_of_mesh", noted)
    changed = CHANGES[name](scene)
    new = meshes(changed) - meshes(scene)
    trees.update(changed, flatten(changed))
    assert set(built) == new
    hidden = objects.hide(changed, [item(changed, "large")])
    with_disk = objects.add(hidden, objects.new_table(hidden, "disk"))[0]
    for scene_now in (hidden, with_disk, changed):
        trees.update(scene_now, flatten(scene_now))
    assert len(built) == len(new) + 1  # the disk's


@pytest.mark.parametrize("name", SAME_LAYOUT)
def test_the_rasterizer_uploads_what_has_moved(name, scene, gl_backend, monkeypatch):
    camera, size = scene.view.for_size((32, 24)), (32, 24)
    changed = CHANGES[name](scene)
    with Rasterizer(scene, backend=gl_backend) as rasterizer:
        rasterizer.render(camera, size)
        parts, made = [], []
        right = Table.write_rows
        monkeypatch.setattr(Table, "write_rows", lambda t, *p: parts.append(p) or right(t, *p))
        right_init = Table.__init__
        monkeypatch.setattr(Table, "__init__", lambda t, *p: made.append(p[1]) or right_init(t, *p))
        rasterizer.set_scene(changed)
        rasterizer.render(camera, size)
    if name == "light":  # whose table is longer
        assert made
        return
    assert not made
    total = -(-len(flatten(scene).faces) // TABLE_WIDTH)
    rows = sum(last - first for first, last in parts)
    assert rows < total or name == "turn"
    assert bool(parts) == (name in ("move", "turn"))
