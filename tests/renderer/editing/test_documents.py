"""A scene and its file: what is unsaved, what saving writes, and what it must not write over."""

from __future__ import annotations

import tomllib
from dataclasses import replace
from pathlib import Path

import pytest
from random_edits import SCENE, TENT

from lucida.renderer.camera.lenses import Lens
from lucida.renderer.editing import changing, documents, objects
from lucida.renderer.editing.changing import set_field
from lucida.renderer.editing.documents import ChangedOnDiskError, is_unsaved, save
from lucida.renderer.editing.moving import shift
from lucida.renderer.editing.outline import outline
from lucida.renderer.files import load_scene, rewriting, save_scene
from lucida.renderer.scene import Scene, SceneObject, shapes
from lucida.renderer.scene.framing import framing_view
from lucida.renderer.system.errors import LucidaError


@pytest.fixture
def scene(tmp_path):
    (tmp_path / "tent.obj").write_text(TENT)
    (tmp_path / "scene.toml").write_text(SCENE)
    return load_scene(tmp_path / "scene.toml")


def ball(scene):
    return next(row.item for row in outline(scene) if row.name == "ball")


def test_unsaved_is_what_differs_from_the_file(scene):
    assert not is_unsaved(scene)
    changed = changing.set_field(scene, [ball(scene)], "radius", 0.9)
    assert is_unsaved(changed)
    assert not is_unsaved(changing.set_field(changed, [ball(scene)], "radius", 0.6))
    saved = save(changed)
    assert not is_unsaved(saved) and not is_unsaved(changed)
    assert is_unsaved(scene)  # undo has brought back what is not in the file any more


def test_another_name_or_camera_is_unsaved(tmp_path):
    (tmp_path / "one.toml").write_text("[[objects]]\ntype = 'sphere'\n")
    scene = load_scene(tmp_path / "one.toml")
    named = changing.set_scene_field(scene, "name", "two")
    assert is_unsaved(named)
    assert not is_unsaved(save(named)) and is_unsaved(scene)
    assert not is_unsaved(save(scene, tmp_path / "three.toml"))  # which names it then
    assert not is_unsaved(scene) and is_unsaved(named)
    seen = changing.set_scene_field(scene, "camera", {"eye": [0, 0, 9], "target": [0, 0, 0]})
    assert is_unsaved(seen)


def test_versions_are_what_editing_has_made(scene):
    one = set_field(scene, [outline(scene)[0].item], "hidden", True)
    two = set_field(one, [outline(scene)[0].item], "hidden", None)
    assert documents.are_versions(one, two)
    assert documents.are_versions(scene, two)
    assert documents.are_versions(scene, scene)
    assert not documents.are_versions(scene, load_scene("spheres"))
    assert not documents.are_versions(scene, Scene(()))


def test_one_value_that_changes_is_all_that_changes_in_the_file(scene):
    save(changing.set_field(scene, [ball(scene)], "center", (-0.7, 0.25, 0)))
    path = documents.file_of(scene)
    assert path.read_text() == SCENE.replace("center = [-0.7, 0, 0]", "center = [-0.7, 0.25, 0]")


def test_a_byte_order_mark_and_windows_line_ends_stay(scene):
    path = documents.file_of(scene)
    before = ("\ufeff" + SCENE.replace("\n", "\r\n")).encode()
    path.write_bytes(before)
    scene = load_scene(path)
    save(changing.set_field(scene, [ball(scene)], "radius", 0.75))
    assert path.read_bytes() == before.replace(b"radius = 0.6", b"radius = 0.75")


def test_a_file_that_somebody_else_has_written_is_not_written_over(scene):
    path = documents.file_of(scene)
    changed = changing.set_field(scene, [ball(scene)], "radius", 0.9)
    path.write_text(theirs := SCENE + "# theirs\n")
    with pytest.raises(ChangedOnDiskError, match=r"scene\.toml: was changed by another program"):
        save(changed)
    assert path.read_text() == theirs and is_unsaved(changed)
    save(changed, force=True)
    assert "radius = 0.9" in path.read_text()
    path.unlink()
    save(changing.set_field(changed, [ball(scene)], "radius", 1.0))  # it is gone: nothing is lost
    assert "radius = 1.0" in path.read_text()


def test_a_file_that_would_lose_its_comments_is_not_written_over(scene, monkeypatch):
    """Only an arrangement of tables that rewriting does not know: it reads what it has written."""
    monkeypatch.setattr(rewriting, "parse_toml", lambda text: {})
    path = documents.file_of(scene)
    changed = changing.set_field(scene, [ball(scene)], "radius", 0.9)
    for write in (save, lambda scene: save_scene(path, scene)):
        with pytest.raises(rewriting.CommentsLostError, match=r"lose its comme.*as a new file"):
            write(changed)
        assert path.read_text() == SCENE and is_unsaved(changed)
    save(changed, path.with_name("new.toml"))
    assert "radius = 0.9" in path.with_name("new.toml").read_text() and path.read_text() == SCENE


def test_saved_elsewhere_models_are_still_found_and_the_new_file_is_the_scene_s(scene, tmp_path):
    folder = tmp_path / "other"
    folder.mkdir()
    changed = shift(scene, [ball(scene)], (1, 0, 0))
    saved = save(changed, folder / "new.toml")
    assert documents.file_of(saved) == documents.file_of(scene) == folder / "new.toml"
    assert saved.origin.source == str(folder / "new.toml")
    assert [e.shape for e in saved.objects] == [e.shape for e in changed.objects]
    again = load_scene(folder / "new.toml")
    assert len(again.objects) == len(changed.objects) and again.name == "small"
    assert not is_unsaved(changed) and is_unsaved(scene)
    assert (tmp_path / "scene.toml").read_text() == SCENE
    text = (folder / "new.toml").read_text()
    assert "# --- the objects ---" in text and str(tmp_path / "tent.obj") in text
    save(saved, tmp_path / "beside.toml")
    tables = tomllib.loads((tmp_path / "beside.toml").read_text())
    assert tables["objects"][3]["file"] == "tent.obj"


def test_a_model_alone_is_saved_as_a_scene_beside_it(tmp_path):
    (tmp_path / "tent.obj").write_text(TENT)
    scene = load_scene(tmp_path / "tent.obj")
    assert not is_unsaved(scene) and documents.file_of(scene) is None
    assert documents.suggested_file(scene) == tmp_path / "tent.toml"
    row = outline(scene)[0]
    assert row.kind == "model" and row.triangles == 4
    moved = shift(scene, [row.item], (1, 2, 3))
    assert is_unsaved(moved)
    with pytest.raises(LucidaError, match="no file yet"):
        save(moved)
    saved = save(moved, documents.suggested_file(moved))
    assert tomllib.loads((tmp_path / "tent.toml").read_text())["objects"] == [
        {"type": "model", "file": "tent.obj", "translate": [1.0, 2.0, 3.0]}
    ]
    assert load_scene(tmp_path / "tent.toml").view == scene.view
    assert not is_unsaved(saved)


def test_a_built_in_scene_is_saved_with_its_comments_and_never_over_itself(tmp_path):
    scene = load_scene("still-life")
    assert documents.file_of(scene) is None
    assert documents.suggested_file(scene) == Path("still life.toml")
    item = outline(scene)[1].item
    saved = save(changing.set_field(scene, [item], "radius", 1.0), tmp_path / "mine.toml")
    assert "# Nothing touches: all things float" in (tmp_path / "mine.toml").read_text()
    assert documents.file_of(saved) == tmp_path / "mine.toml"
    assert load_scene("still-life").objects[1].shape.radius == 1.1


def test_without_a_camera_in_its_file_a_scene_keeps_the_view_that_it_had(tmp_path):
    path = tmp_path / "bare.toml"
    path.write_text('[[objects]]\ntype = "box"\n')
    scene = load_scene(path)
    item = outline(scene)[0].item
    painted = save(changing.set_field(scene, [item], "material.diffuse", "#ff0000"))
    assert "camera" not in path.read_text()  # it would be the same one
    moved = shift(painted, [item], (5, 0, 0))
    assert moved.view == scene.view != framing_view(moved.objects)
    save(moved)
    assert load_scene(path).view == scene.view


def test_a_view_can_become_the_file_s_camera(scene):
    view = load_scene("spheres").view
    saved = save(scene, view=view)
    assert saved.view == view == load_scene(documents.file_of(scene)).view
    assert "# A scene to edit" in documents.file_of(scene).read_text()


@pytest.mark.parametrize(
    "lens",
    [
        'lens = { model = "brown", k1 = 0.1 } # mine\n',
        'lens.model = "brown" # mine\nlens.k1 = 0.1\n',
        '[camera.lens] # mine\nmodel = "brown"\nk1 = 0.1\n',
    ],
)
def test_a_view_s_lens_becomes_the_file_s_among_its_comments(lens, tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(f"objects = [] # none\n[camera] # here\neye = [0, 0, 5] # far\n{lens}")
    scene = load_scene(path)
    assert scene.view.camera.lens == Lens("brown", {"k1": 0.1})
    for other in (Lens("brown", {"k1": -0.3, "p1": 0.01}), Lens("equisolid"), None):
        seen = replace(scene.view, camera=replace(scene.view.camera, lens=other))
        scene = save(scene, view=seen)
        assert load_scene(path).view == seen
        kept = ("# none", "# here", "# far", *(["# mine"] if other is not None else []))
        assert all(comment in path.read_text() for comment in kept)


def test_nothing_is_lost_where_nothing_can_be_written(scene, tmp_path):
    changed = changing.set_field(scene, [ball(scene)], "radius", 0.9)
    with pytest.raises(LucidaError, match="does not exist"):
        save(changed, tmp_path / "nowhere" / "a.toml")
    assert is_unsaved(changed) and documents.file_of(changed) == tmp_path / "scene.toml"


def test_meshes_made_in_python_cannot_be_edited_and_it_is_said():
    scene = Scene((SceneObject(shapes.box(), name="crate"),))
    assert [(row.item, row.shown) for row in outline(scene)] == [(None, "crate")]
    with pytest.raises(LucidaError, match=r"crate.*made in Python"):
        objects.add(scene, {"type": "sphere"})
    assert not is_unsaved(scene)
