"""The files that a scene names: found, and named shortly, wherever it is read and saved."""

from __future__ import annotations

import pytest
from random_edits import TENT
from textured import noise, saved

from lucida.renderer.editing import changing
from lucida.renderer.editing.documents import ChangedOnDiskError, file_of, save
from lucida.renderer.editing.outline import outline
from lucida.renderer.files import load_scene
from lucida.renderer.system.errors import LucidaError

TEXT = """\
[materials.tiles]
texture = { file = "tiles.png" }

[[objects]]
type = "box"
name = "crate"
material = { texture = "tiles.png" }

[[objects]]
type = "box"
name = "wall"
material = "tiles"

[[objects]]
type = "model"
name = "tent"
file = "tent.obj"
"""


@pytest.fixture
def folder(tmp_path):
    saved(tmp_path, "tiles.png", noise(4, 4))
    (tmp_path / "tent.obj").write_text(TENT)
    (tmp_path / "scene.toml").write_text(TEXT)
    (tmp_path / "below").mkdir()
    return tmp_path


def items(scene):
    return [row.item for row in outline(scene) if not row.is_light]


def test_an_image_of_an_absolute_path_is_refused_although_the_scene_has_it(folder):
    scene = load_scene(folder / "scene.toml")
    with pytest.raises(LucidaError, match="not in the folder of the file that names it"):
        changing.set_field(scene, items(scene)[:1], "material.texture", str(folder / "tiles.png"))


def test_a_scene_that_was_read_by_a_path_that_leads_up_is_saved_where_it_is(folder, monkeypatch):
    monkeypatch.chdir(folder / "below")
    scene = load_scene("../scene.toml")
    assert file_of(scene) == folder / "scene.toml"
    saved_scene = save(changing.set_field(scene, items(scene)[:1], "name", "box"))
    assert set(saved_scene.origin.files) == {
        folder / name for name in ("scene.toml", "tiles.png", "tent.obj")
    }
    (folder / "scene.toml").write_text(TEXT + "# by somebody else\n")
    with pytest.raises(ChangedOnDiskError, match="changed by another program"):
        save(changing.set_field(saved_scene, items(scene)[:1], "name", "crate"))


def test_a_scene_of_a_relative_path_is_edited_from_any_folder(folder, monkeypatch):
    monkeypatch.chdir(folder)
    scene = load_scene("scene.toml")
    monkeypatch.chdir(folder / "below")
    changed = changing.set_field(scene, items(scene)[:1], "name", "box")
    assert changed.objects[0].material.texture is scene.objects[0].material.texture
    save(changed)
    assert (folder / "scene.toml").read_text() == TEXT.replace('"crate"', '"box"')
