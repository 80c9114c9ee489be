"""Single edits: what they change, what they refuse, and what others see of them."""

from __future__ import annotations

import numpy as np
import pytest
from random_edits import TENT, item, table

from lucida import Rasterizer, Tracer
from lucida.renderer.compare.why_black import why_nothing_is_hit
from lucida.renderer.editing import changing, materials, moving, objects
from lucida.renderer.editing.outline import outline
from lucida.renderer.files import load_scene
from lucida.renderer.scene import Scene, SceneObject, Sphere, flatten
from lucida.renderer.scene.shapes import box
from lucida.renderer.system.errors import LucidaError


def names(scene):
    return [row.shown for row in outline(scene)]


def test_the_outline_lists_objects_then_lights_with_what_they_are(scene):
    rows = outline(scene)
    assert [row.shown for row in rows] == [
        "rectangle 0",
        "ball",
        "box",
        "tent",
        "directional light 0",
        "point light 1",
    ]
    assert [row.kind for row in rows][2:5] == ["box", "model", "directional"]
    assert [row.triangles for row in rows] == [2, 0, 12, 4, 0, 0]
    assert [row.material for row in rows] == ["floor", "red", "", "", "", ""]
    assert [list(row.ids) for row in rows] == [[0], [1], [2], [3], [], []]
    for number, row in enumerate(rows[:4]):
        assert changing.item_of(scene, number) == row.item
        assert changing.ids_of(scene, row.item) == row.ids
    assert changing.item_of(scene, -1) is None and changing.item_of(scene, 4) is None


def test_a_model_of_several_parts_is_one_item(tmp_path):
    obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\nf 1 3 2\n"
    material = "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n"
    (tmp_path / "two.mtl").write_text(material)
    (tmp_path / "two.obj").write_text("mtllib two.mtl\n" + obj)
    scene = load_scene(tmp_path / "two.obj")
    row = outline(scene)[0]
    assert row.ids == range(2)
    assert changing.item_of(scene, 1) == row.item
    hidden = objects.hide(scene, [row.item])
    assert [entry.hidden for entry in hidden.objects] == [True, True]


@pytest.mark.parametrize(
    ("field", "value", "problem"),
    [
        ("radius", -1.0, r"objects\[1\].*radius"),
        ("radius", "x", r"objects\[1\]\.radius: is text"),
        ("radios", 1.0, r"objects\[1\]\.radios: is unknown; did you mean 'radius'"),
        ("material", "gold", r"objects\[1\]\.material: 'gold' is unknown"),
        ("material.diffuse", "red", r"objects\[1\]\.material.*diffuse"),
        ("center", [1, 2], r"objects\[1\]\.center: has 2 entries"),
    ],
)
def test_a_wrong_value_is_one_clear_line_and_the_scene_stays(scene, field, value, problem):
    before = table(scene, "ball").copy()
    with pytest.raises(LucidaError, match=problem):
        changing.set_field(scene, [item(scene, "ball")], field, value)
    assert table(scene, "ball") == before


def test_fields_have_their_defaults_and_go_back_to_them(scene):
    box = item(scene, "box")
    fields = changing.fields_of(scene, box)
    assert (fields.scale, fields.rotate_deg) == (1.0, (0, 30, 0))
    reset = changing.set_field(scene, [box], "rotate_deg", None)
    assert "rotate_deg" not in table(reset, "box")
    assert changing.fields_of(reset, box).rotate_deg == (0, 0, 0)
    light = changing.fields_of(scene, item(scene, "directional light 0"))
    assert light.color == (1.0, 1.0, 1.0)


# Coming and going.


@pytest.mark.parametrize("kind", [*objects.SHAPES, *objects.LIGHTS])
def test_every_kind_can_be_added_and_gets_a_name_of_its_own(scene, kind):
    first, (one,) = objects.add(scene, objects.new_table(scene, kind, (1, 2, 3), 2.0))
    second, (two,) = objects.add(first, objects.new_table(first, kind))
    assert one != two and len(outline(second)) == len(outline(scene)) + 2
    assert len(set(names(second))) == len(names(second))
    if kind in objects.SHAPES:
        low, high = moving.bounds_of(first, [one])
        assert ((low >= 0) & (high <= 4)).all()
        np.testing.assert_allclose((low + high) / 2, (1, 2, 3))
    assert objects.delete(second, [one, two]).objects == scene.objects


def test_a_model_is_added_and_its_file_is_watched(scene, tmp_path):
    (tmp_path / "more").mkdir()
    file = tmp_path / "more" / "roof.obj"
    file.write_text(TENT)
    found, (key,) = objects.add(scene, objects.model_table(scene, str(file), (0, 1, 0)))
    assert changing.table_of(found, key)["name"] == "roof"
    assert file in found.origin.files
    with pytest.raises(LucidaError, match=r"objects\[4\].*nothing\.obj.*does not exist"):
        objects.add(scene, objects.model_table(scene, "nothing.obj"))


def test_a_selection_survives_what_happens_to_others(scene):
    ball, box = item(scene, "ball"), item(scene, "box")
    deleted = objects.delete(scene, [ball])
    assert changing.present(deleted, [ball, box]) == (box,)
    assert changing.present(scene, [ball, box]) == (ball, box)
    assert changing.ids_of(deleted, box) == range(1, 2)
    with pytest.raises(LucidaError, match="not in this scene any more"):
        changing.set_field(deleted, [ball], "radius", 1.0)


def test_the_default_lights_are_written_down_once_they_are_edited(tmp_path):
    (tmp_path / "bare.toml").write_text('[[objects]]\ntype = "box"\n')
    scene = load_scene(tmp_path / "bare.toml")
    key, fill = (row.item for row in outline(scene) if row.is_light)
    dim = changing.set_field(scene, [fill], "color", [0.1, 0.1, 0.1])
    assert dim.lights[0] == scene.lights[0] and dim.lights[1].color == (0.1, 0.1, 0.1)
    assert len(objects.delete(scene, [key]).lights) == 1
    assert objects.delete(scene, [key, fill]).lights == ()


# What is hidden.


def test_what_is_hidden_is_hidden_from_both_renderers_and_ids_stay(scene, gl_backend):
    camera, size = scene.view.for_size((48, 36)), (48, 36)
    hidden = objects.hide(scene, [item(scene, "ball"), item(scene, "rectangle 0")])
    with Rasterizer(scene, backend=gl_backend) as rasterizer, Tracer(scene) as tracer:
        for renderer in (rasterizer, tracer):
            assert set(np.unique(renderer.render(camera, size).id)) == {-1, 0, 1, 2, 3}
            renderer.set_scene(hidden)
            assert set(np.unique(renderer.render(camera, size).id)) == {-1, 2, 3}
            renderer.set_scene(objects.hide(hidden, [item(scene, "ball")], False))
            assert set(np.unique(renderer.render(camera, size).id)) == {-1, 1, 2, 3}
    assert [number for number, _ in hidden.visible] == [2, 3]


def test_of_what_is_hidden_nothing_is_left_in_bounds_or_reasons(scene):
    far = moving.shift(scene, [item(scene, "box")], (1e6, 0, 0))
    assert flatten(far).bounds[1, 0] > 1e5
    hidden = objects.hide(far, [item(scene, "box")])
    np.testing.assert_array_equal(flatten(hidden).bounds[1, 0], 2.0)
    everything = objects.hide(scene, [row.item for row in outline(scene)])
    assert (
        why_nothing_is_hit(flatten(everything), scene.view.camera).text == "all objects are hidden"
    )
    assert everything.lights == () and not flatten(everything).bounds.any()


# Materials.


def test_an_object_that_shares_a_material_gets_its_own_once_it_is_changed(scene):
    ball, box = item(scene, "ball"), item(scene, "box")
    scene = changing.set_field(scene, [box], "material", "red")
    one = materials.set_material(scene, [ball], "diffuse", [0, 1, 0])
    assert one.objects[1].material.diffuse == (0, 1, 0) and one.objects[2] is scene.objects[2]
    assert one.objects[1].material.specular == scene.objects[1].material.specular
    assert "material" in table(one, "ball") and table(one, "box")["material"] == "red"


def test_of_a_model_the_material_of_its_file_is_begun_with(scene):
    tent, own = item(scene, "tent"), scene.objects[3].material
    shiny = materials.set_material(scene, [tent], "shininess", 100.0)
    assert shiny.objects[3].material.diffuse == own.diffuse
    back = changing.set_field(shiny, [tent], "material", None)
    assert back.objects[3].material == own


def test_a_model_alone_is_edited_without_being_read_again(tmp_path):
    (tmp_path / "tent.obj").write_text(TENT)
    scene = load_scene(tmp_path / "tent.obj")
    (tmp_path / "tent.obj").unlink()
    edited, (new,) = objects.add(scene, objects.new_table(scene, "sphere"))
    for one in (edited, changing.as_tables(scene)):
        assert np.shares_memory(one.objects[0].shape.vertices, scene.objects[0].shape.vertices)
    assert [row.shown for row in outline(edited)][:2] == ["tent", "sphere"]
    assert changing.ids_of(edited, new) == range(1, 2)


def test_a_scene_made_in_python_is_edited_or_listed_as_it_is():
    balls = tuple(SceneObject(Sphere((k, 0, 0)), name="ball" * k) for k in range(2))
    edited, (new,) = objects.add(Scene(balls), objects.new_table(Scene(balls), "box"))
    assert len(edited.objects) == 3 and changing.ids_of(edited, new) == range(2, 3)
    rows = outline(Scene((*balls, SceneObject(box()))))
    assert [
        (row.item, row.shown, row.kind, row.ids, row.triangles, row.locked) for row in rows
    ] == [
        (None, "sphere 0", "sphere", range(1), 0, True),
        (None, "ball", "sphere", range(1, 2), 0, True),
        (None, "mesh 2", "mesh", range(2, 3), 12, True),
    ]


def test_new_things_are_as_large_as_asked_and_where_asked():
    scene, at = Scene(()), (1.0, 2.0, 3.0)
    for kind in objects.SHAPES:
        added, items = objects.add(scene, objects.new_table(scene, kind, at, 0.5))
        low, high = moving.bounds_of(added, items)
        assert (low <= at).all() and (at <= high).all(), kind
        assert np.ptp([low, high], axis=0).max() == pytest.approx(0.5, rel=0.01), kind
    gray, other = (0.8, 0.8, 0.8), {"point": at, "directional": tuple(-x for x in at)}
    for kind, place in other.items():
        light = objects.add(scene, objects.new_table(scene, kind, at))[0].lights[-1]
        assert light.color == gray
        assert (light.position if kind == "point" else light.direction) == place
