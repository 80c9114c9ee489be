"""`lucida scene`: what is in a scene, and what is odd about it."""

from __future__ import annotations

from lucida.app.cli import main
from lucida.renderer.files.oddities import oddities
from lucida.renderer.scene import Mesh, shapes


def told(capsys, source) -> str:
    assert main(["scene", str(source)]) == 0
    seen = capsys.readouterr()
    assert seen.err == ""
    return seen.out


def test_a_scene_is_told_whole(capsys):
    text = told(capsys, "still-life")
    lines = text.splitlines()
    assert lines[0].startswith("still life: 11 objects, 9638 triangles, 2 lights; from (")
    assert lines[2] == (
        "  1   sphere 'matte sphere': exact; from (-2.45, 0.02, -0.8) to (-0.25, 2.22, 1.4); "
        "material 'vermilion'"
    )
    assert "4   torus 'torus': 9216 triangles" in text and "odd" not in text
    assert "light 1: point, position (6, 4, 5), color (0.2, 0.21, 0.24)\n" in text
    assert lines[-1] == "  camera: perspective from (3.4, 3.1, 8.6)"


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
        (text,) = oddities(Mesh(box.vertices, faces))
        assert word in text


def test_only_models_are_odd(capsys, tmp_path):
    (tmp_path / "t.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    text = "[[objects]]\ntype = 'disk'\n[[objects]]\ntype = 'model'\nfile = 't.obj'\n"
    (tmp_path / "s.toml").write_text(text)
    (odd,) = (
        line
        for line in told(capsys, tmp_path / "s.toml").splitlines()
        if line.startswith("  odd: ")
    )
    assert "object 1 is open" in odd


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


def test_hidden_things_and_the_bounds_of_turned_shapes(capsys, tmp_path):
    path = tmp_path / "odd.toml"
    path.write_text(ODD_LIGHTS)
    text = told(capsys, path)
    bounds = "from (-0.7071, -0.5, -0.7071) to (0.7071, 0.5, 0.7071)"
    assert f"2 objects, 20 triangles, 1 light; {bounds}\n" in text
    # The cone's tip is highest, and its box's corner would be higher.
    assert "to (1.061, 0.7071, " in text
    assert ", hidden\n" in text.splitlines(keepends=True)[2]
    assert "light 0: directional, direction (0, -1, 0), color (1, 1, 1)\n" in text
    assert "light 'off', hidden\n" in text
    path.write_text("objects = []\n")
    assert "2 lights; nothing is visible\n" in told(capsys, path)
