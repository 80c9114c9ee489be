"""`lucida scene`: what is in a scene, and what is odd about it."""

from __future__ import annotations

import json

import numpy as np

from lucida.app.cli import main
from lucida.renderer.files import load_scene
from lucida.renderer.files.oddities import oddities
from lucida.renderer.scene import Mesh, shapes


def told(capsys, source) -> dict:
    assert main(["scene", str(source), "--json"]) == 0
    seen = capsys.readouterr()
    assert seen.err == ""
    return json.loads(seen.out)


def test_a_scene_is_told_whole(capsys):
    found, scene = told(capsys, "still-life"), load_scene("still-life")
    assert [entry["name"] for entry in found["objects"]] == [e.name for e in scene.objects]
    assert found["triangles"] == sum(entry["triangles"] for entry in found["objects"]) == 9638
    assert found["objects"][1]["type"] == "sphere"
    np.testing.assert_allclose(
        found["objects"][1]["bounds"], [[-2.45, 0.02, -0.8], [-0.25, 2.22, 1.4]]
    )
    assert found["objects"][1]["material_name"] == "vermilion"
    assert [light["type"] for light in found["lights"]] == ["directional", "point"]
    assert found["camera"]["eye"] == [3.4, 3.1, 8.6] and found["odd"] == []
    assert main(["scene", "still-life"]) == 0
    text = capsys.readouterr().out
    assert "still life: 11 objects, 9638 triangles, 2 lights" in text
    assert "4   torus 'torus': 9216 triangles" in text and "odd" not in text


def test_sound_shapes_are_not_odd():
    sound = [shapes.box(), shapes.torus(), shapes.cylinder(), shapes.cone(smooth=False)]
    small = [
        shapes.transformed(shapes.box(), shapes.placement(scale=1e-6)),
        shapes.transformed(shapes.box(), shapes.placement((1e4, 0, 0))),
    ]
    assert [oddities(shape) for shape in (*sound, *small)] == [[]] * 6


def test_what_is_wrong_with_a_mesh_is_found():
    box = shapes.box()
    one_turned = box.faces.copy()
    one_turned[0] = one_turned[0][::-1]
    for faces, word in (
        (box.faces[:, ::-1], "inwards"),
        (box.faces[1:], "open"),
        (one_turned, "differently"),
    ):
        (told_of,) = oddities(Mesh(box.vertices, faces))
        assert word in told_of


def test_only_models_are_odd(capsys, tmp_path):
    (tmp_path / "t.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    text = "[[objects]]\ntype = 'disk'\n[[objects]]\ntype = 'model'\nfile = 't.obj'\n"
    (tmp_path / "s.toml").write_text(text)
    assert [odd["object"] for odd in told(capsys, tmp_path / "s.toml")["odd"]] == [1]


ODD_LIGHTS = """\
[[objects]]
type = "box"
name = "turned"
rotate_deg = [0, 45, 0]
[[objects]]
type = "cone"
height = 2
segments = 4
rotate_deg = [0, 0, 45]
hidden = true
[[lights]]
type = "point"
name = "off"
position = [1, 2, 3]
color = "#ffffff"
hidden = true
[[lights]]
type = "directional"
name = "sun"
direction = [0, -1, 0]
"""


def test_lights_have_their_names_and_hidden_ones_are_told(capsys, tmp_path):
    path = tmp_path / "odd.toml"
    path.write_text(ODD_LIGHTS)
    sun, off = told(capsys, path)["lights"]
    assert (sun["name"], sun["hidden"], sun["direction"]) == ("sun", False, [0, -1, 0])
    assert (off["name"], off["hidden"], off["position"]) == ("off", True, [1, 2, 3])
    assert off["color"] == [1, 1, 1]
    assert main(["scene", str(path)]) == 0
    text = capsys.readouterr().out
    assert "2 objects, 20 triangles, 1 light;" in text
    assert "light 0: directional 'sun' along (0, -1, 0), color (1, 1, 1)\n" in text
    assert "light -: point 'off' at (1, 2, 3), color (1, 1, 1), hidden\n" in text


def test_bounds_are_what_a_turned_shape_fills(capsys, tmp_path):
    path = tmp_path / "odd.toml"
    path.write_text(ODD_LIGHTS)
    found = told(capsys, path)
    half = 0.5 * 2**0.5
    np.testing.assert_allclose(found["bounds"], [[-half, -0.5, -half], [half, 0.5, half]])
    # The cone's tip is highest, and its box's corner would be higher.
    low, high = np.array(found["objects"][1]["bounds"])
    np.testing.assert_allclose([low[0], high[0], high[1]], [-half, 1.5 * half, half], atol=1e-6)
    path.write_text("objects = []\n")
    assert told(capsys, path)["bounds"] is None
    assert main(["scene", str(path)]) == 0
    assert "2 lights; nothing is visible\n" in capsys.readouterr().out


def test_backs_holes_and_metals_are_told(capsys, tmp_path):
    text = (
        "[[objects]]\ntype = 'rectangle'\n[objects.material]\n"
        "metal = { roughness = 0.5 }\ncutout = 0.25\nsingle_sided = true\n"
    )
    (tmp_path / "s.toml").write_text(text)
    assert main(["scene", str(tmp_path / "s.toml")]) == 0
    shown = capsys.readouterr().out
    assert "metal everywhere, holes below opacity 0.25, single-sided" in shown
    material = told(capsys, str(tmp_path / "s.toml"))["objects"][0]["material"]
    assert (material["cutout"], material["single_sided"]) == (0.25, True)
