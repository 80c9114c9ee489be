"""The probe's lines for a pixel, word for word; its formulas say what is computed."""

from __future__ import annotations

import numpy as np
import pytest
from hard_readings import (
    ALL,
    BALL,
    DOWN,
    FLOOR,
    SMOOTH,
    grazing,
    in_the_shell,
    leaf,
    on_the_floor,
)

from lucida.app.instruments.probe.color_formulas import color_lines
from lucida.app.instruments.probe.copying import all_lines, as_latex
from lucida.app.instruments.probe.formulas import LEAST_COSINE, hit_lines, ray_lines
from lucida.app.instruments.probe.model import Probe
from lucida.app.instruments.probe.reading import Reading
from lucida.app.lecture.typesetting import mistake
from lucida.app.ui import formula
from lucida.app.ui.explaining.plain import plain_math
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.scene.model import (
    DirectionalLight,
    Scene,
    SceneObject,
    Sphere,
)
from lucida.renderer.trace.reference.shade import GRAZING

ON_THE_FLOOR = """\
along u:
    u = left + (right - left) (j + 0.5) / W
      = -1 + (1 - (-1)) (0 + 0.5) / 1 = 0
along v:
    v = top - (top - bottom) (i + 0.5) / H
      = 0.5 - (0.5 - (-3.5)) (2 + 0.5) / 4 = -2
direction, camera:
    vec(d)_uvw = (u, v, -d)
      = (0, -2, -2)
direction, world:
    vec(d) = u vec(u) + v vec(v) - d vec(w)
      = 0 (1, 0, 0) + (-2) (0, 1, 0) - 2 (0, 0, 1) = (0, -2, -2)
origin:
    vec(p) = vec(e)
      = (0, 2, 0)
ray:
    vec(r)(t) = vec(p) + t vec(d)
      = (0, 2, 0) + t (0, -2, -2)
clipped by near and far:
    near / d < t < ∞
      0.5 < t < ∞
the plane of triangle 0:
    t = (vec(n) · (vec(a) - vec(p))) / (vec(n) · vec(d))
      = ((0, 1, 0) · ((-9, 0, -9) - (0, 2, 0))) / ((0, 1, 0) · (0, -2, -2)) = 1
inside: no weight of a corner is negative:
    vec(x) = b_0 vec(a) + b_1 vec(b) + b_2 vec(c)
      = 0.5 (-9, 0, -9) + 0.3889 (9, 0, 9) + 0.1111 (9, 0, -9) = (0, 0, -2)
hit point:
    vec(x) = vec(r)(t) = vec(p) + t vec(d)
      = (0, 2, 0) + 1 (0, -2, -2) = (0, 0, -2)
normal of the triangle, towards the viewer:
    vec(n) = ((vec(b) - vec(a)) \u00d7 (vec(c) - vec(a))) / |...|
      = (0, 1, 0)
diffuse reflectance of the surface:
    vec(k)_d
      = (0.5000, 0.2500, 0.5000)
specular reflectance:
    vec(k)_s
      = (0.5000, 0.5000, 0.5000)
ambient:
    vec(L)_a = vec(k)_d vec(I)_a
      = (0.5000, 0.2500, 0.5000) (0.1000, 0.1000, 0.1000) = (0.0500, 0.0250, 0.0500)
towards light 1, a point light:
    vec(l)_1 = (vec(q)_1 - vec(x)) / |vec(q)_1 - vec(x)|
      = (0.0000, 0.9701, 0.2425)
light 1, diffuse:
    vec(L)_d1 = vec(k)_d vec(I)_1 max(0, vec(n) · vec(l)_1)
      = (0.5000, 0.2500, 0.5000) (1.0000, 1.0000, 1.0000) max(0, 0.9701) = (0.4851, 0.2425, 0.4851)
halfway between light 1 and the viewer:
    vec(h)_1 = (vec(l)_1 - vec(d)/|vec(d)|) / (|vec(l)_1 - vec(d)/|vec(d)||)
      = (0.0000, 0.8702, 0.4927)
light 1, specular:
    vec(L)_s1 = vec(k)_s vec(I)_1 max(0, vec(n) · vec(h)_1)^s
      = (0.5000, 0.5000, 0.5000) (1.0000, 1.0000, 1.0000) max(0, 0.8702)^50 = (0.0005, 0.0005,\
 0.0005)
towards light 2, a directional light:
    vec(l)_2 = vec(c)_2
      = (0, -1, 0)
light 2 is shadowed: something is between, or the surface faces away:
    vec(L)_2 = (0, 0, 0)
mirrored ray 1 sees mirror ball, t = 0.6464:
    vec(L)_m1 = vec(k)_s vec(L)(vec(r)_1)
      = (0.5000, 0.5000, 0.5000) (0.1000, 0.0500, 0.0250) = (0.0500, 0.0250, 0.0125)
mirrored ray 2 sees floor, t = 0.6466:
    vec(L)_m2 = vec(w)_2 vec(L)(vec(r)_2)
      = (0.1250, 0.2500, 0.2500) (0.6137, 0.3461, 0.6137) = (0.0767, 0.0865, 0.1534)
the sum:
    vec(L) = vec(L)_a + vec(L)_d1 + vec(L)_s1 + vec(L)_m1 + vec(L)_m2
      = (0.0500, 0.0250, 0.0500) + (0.4851, 0.2425, 0.4851) + (0.0005, 0.0005, 0.0005) + (0.0500,\
 0.0250, 0.0125) + (0.0767, 0.0865, 0.1534) = (0.6623, 0.3795, 0.7015)
sRGB's curve (up to 0.0031308: 12.92 L):
    vec(C) = 1.055 vec(L)^(1/2.4) - 0.055
      = 1.055 (0.6623, 0.3795, 0.7015)^(1/2.4) - 0.055 = (0.8335, 0.6496, 0.8551)
8 bits:
    vec(B) = floor( 255 vec(C) + 0.5 )
      = floor( 255 (0.8335, 0.6496, 0.8551) + 0.5 ) = (213, 166, 218)
"""


def by_key(reading: Reading, indexing: Indexing = Indexing.LECTURE) -> dict[str, list[str]]:
    """Return each line as plain text, and the same with numbers."""
    return {
        one.key: [plain_math(one.latex), plain_math(one.latex_numbers)]
        for one in all_lines(reading, indexing)
    }


def test_a_mirror_that_sees_a_mirror_word_for_word():
    reading = on_the_floor()
    lines = all_lines(reading, Indexing.ARRAY)
    written = [
        (f"{one.name}:", f"    {plain_math(one.latex)}", f"      {plain_math(one.latex_numbers)}")
        for one in lines
    ]
    text = "\n".join(row for rows in written for row in rows if row.strip())
    assert text + "\n" == ON_THE_FLOOR
    (shadowed,) = (one for one in color_lines(reading) if one.key == "shadow 2")
    assert shadowed.value == (0, 0, 0)


@pytest.mark.parametrize("name", ALL)
def test_every_formula_can_be_set(name):
    for line in all_lines(ALL[name]()):
        for form in filter(None, (line.latex, line.latex_numbers)):
            assert not formula.available() or mistake(form) is None


def test_the_range_of_t_is_that_of_near_and_far():
    found = {name: by_key(make())["range"] for name, make in ALL.items()}
    assert found["near and far"] == ["near / d < t < far / d", "0.5 < t < 6"]
    assert found["parallel, far"] == ["0 < t < far", "0 < t < 6"]
    assert found["parallel, near"] == ["near < t < ∞", "0.5 < t < ∞"]
    assert found["smooth"] == ["t > 0", ""]
    (line,) = (one for one in ray_lines(in_the_shell(far=6)) if one.key == "range")
    assert line.latex == r"0 < t < \frac{\mathrm{far}}{d}"
    (line,) = (one for one in ray_lines(in_the_shell("parallel", near=0.5)) if one.key == "range")
    assert line.latex == r"\mathrm{near} < t < \infty" and line.value == (0.5, np.inf)


def test_a_sphere_from_within():
    lines = by_key(in_the_shell())
    assert lines["direction"][1] == (
        "= (-0.75) (1, 0.5, 0) + (-0.75) (-0.5, 1, 0.25) - 1 (0, 0, 2) = (-0.375, -1.125, -2.1875)"
    )
    assert lines["sphere"] == [
        "|vec(p) + t vec(d) - vec(c)|² = R²",
        "|(0.5, 0, 0) + t (-0.375, -1.125, -2.1875) - (0, 0, 0)|² = 2²",
    ]
    assert lines["t"] == [
        "t = (-b + sqrt(b² - a · c)) / a",
        "= (-(-0.1875) + sqrt((-0.1875)² - 6.1914 · (-3.75))) / 6.1914 = 0.8091",
    ]
    assert lines["geometric"] == [
        "vec(n) = (vec(c) - vec(x)) / |vec(c) - vec(x)|",
        "= ((0, 0, 0) - (0.1966, -0.9103, -1.77)) / |(0, 0, 0) - (0.1966, -0.9103, -1.77)|"
        " = (-0.0983, 0.4551, 0.8850)",
    ]
    assert hit_lines(in_the_shell())[4].name == "normal, towards the viewer"
    lines = by_key(in_the_shell("parallel"))
    assert lines["camera direction"] == ["vec(d)_uvw = (0, 0, -1)", "= (0, 0, -1)"]
    assert lines["direction"] == ["vec(d) = -vec(w)", "= -(0, 0, 2) = (0, 0, -2)"]
    assert lines["origin"] == [
        "vec(p) = vec(e) + u vec(u) + v vec(v)",
        "= (0.5, 0, 0) + (-0.75) (1, 0.5, 0) + (-0.75) (-0.5, 1, 0.25) = (0.125, -1.125, -0.1875)",
    ]


def test_a_sphere_from_without_and_its_inside_where_near_cuts_it_open():
    """The formula's normal points to where the surface is seen from."""
    ball = Probe(Scene((SceneObject(Sphere((0, 0, -3), 0.5)),)))
    whole, cut = (
        {one.key: one for one in hit_lines(ball.at((0, 0), Camera(near=near), (1, 1)))}
        for near in (None, 3.0)
    )
    assert plain_math(whole["t"].latex_numbers) == "= (-(-3) - sqrt((-3)² - 1 · 8.75)) / 1 = 2.5"
    assert plain_math(whole["geometric"].latex) == "vec(n) = (vec(x) - vec(c)) / |vec(x) - vec(c)|"
    assert plain_math(cut["t"].latex_numbers) == "= (-(-3) + sqrt((-3)² - 1 · 8.75)) / 1 = 3.5"
    assert plain_math(cut["geometric"].latex) == "vec(n) = (vec(c) - vec(x)) / |vec(c) - vec(x)|"
    assert whole["geometric"].value == cut["geometric"].value == (0, 0, 1)
    far = Probe(Scene((SceneObject(Sphere((0, 0, -1e9), 1e-9)),))).at((0, 0), Camera(), (1, 1))
    assert plain_math(hit_lines(far)[4].latex).startswith("vec(n) = (vec(x) - vec(c))")


def test_a_light_behind_the_surface_and_one_that_is_too_bright():
    reading = in_the_shell()
    lines, names = by_key(reading), {one.key: one.name for one in color_lines(reading)}
    assert list(names) == [
        "reflectance", "ambient", "light 1", "diffuse 1", "light 2", "diffuse 2",
        "sum", "exposure", "display", "bytes",
    ]  # fmt: skip
    assert names["diffuse 1"] == "light 1, diffuse"
    assert names["diffuse 2"] == "light 2, diffuse: it is behind the surface"
    assert lines["sum"][0] == "vec(L) = vec(L)_a + vec(L)_d1 + vec(L)_d2"
    assert lines["exposure"] == [
        "vec(L)' = 2^EV vec(L)",
        "= 2^(-1) (3.9979, 0.5372, 0.2686) = (1.9990, 0.2686, 0.1343)",
    ]
    # What is shown is the least of it and 1: without that the equation would be none.
    assert names["display"] == "display value, linear; values above 1 are cut off"
    assert lines["display"] == [
        "vec(C) = min(1, vec(L)')",
        "= min(1, (1.9990, 0.2686, 0.1343)) = (1.0000, 0.2686, 0.1343)",
    ]
    assert by_key(leaf(False))["display"][0] == "vec(C) = 1.055 min(1, vec(L)')^(1/2.4) - 0.055"
    floor = Scene((SceneObject(FLOOR),), (DirectionalLight((1, 0, 0)),))  # along it
    diffuse = color_lines(Probe(floor).at((2, 0), DOWN, (1, 4)))[3]
    assert diffuse.name == "light 1, diffuse: it is behind the surface"
    white = Scene((), background=(1, 0.5, 0))
    nothing = Probe(white).at((0, 0), Camera(), (1, 1))
    assert hit_lines(nothing) == []
    (_, display, _) = color_lines(nothing)
    assert display.name == "sRGB's curve (up to 0.0031308: 12.92 L)"


@pytest.mark.parametrize(("behind", "sign"), [(False, ""), (True, "-")])
def test_normals_of_a_smooth_triangle_are_turned_to_the_viewer(behind, sign):
    """The formula of what is interpolated as that of the plane's."""
    reading = leaf(behind)
    lines, towards = by_key(reading), -1 if behind else 1
    assert lines["t"][0] == "t = (vec(g) · (vec(a) - vec(p))) / (vec(g) · vec(d))"
    assert lines["geometric"] == [
        f"vec(g) = {sign}((vec(b) - vec(a)) \u00d7 (vec(c) - vec(a))) / |...|",
        f"= (0, 0, {towards})",
    ]
    text, numbers = lines["normal"]
    assert text == f"vec(n) = {sign}(b_0 vec(n)_a + b_1 vec(n)_b + b_2 vec(n)_c) / |...|"
    mean = np.array([0.5, 0.25, 0.25]) @ SMOOTH.normals * towards
    assert numbers == "= ({:.4f}, {:.4f}, {:.4f})".format(*(mean / np.linalg.norm(mean)))
    assert hit_lines(reading)[4].name == "normal for the light, between the corners'"


@pytest.mark.parametrize("name", ["along a triangle", "along a sphere"])
def test_a_normal_that_hardly_faces_the_viewer_is_bent_to_it(name):
    """Nothing is interpolated there, and nothing is said of corners' normals."""
    assert LEAST_COSINE == GRAZING
    reading = ALL[name]()
    g, d = np.array(reading.hit.geometric), np.array(reading.direction)
    bent = g - (g @ d + 0.001) * d
    assert reading.hit.normal == pytest.approx(tuple(bent / np.linalg.norm(bent)), abs=1e-12)
    line = next(one for one in hit_lines(reading) if one.key == "normal")
    assert (
        plain_math(line.latex)
        == "vec(n) = (vec(g) - (vec(g) · vec(d)/|vec(d)| + 0.001) vec(d)/|vec(d)|) / |...|"
    )
    assert by_key(reading)["geometric"][0].startswith("vec(g) = ")


def test_copied_formulas_stand_below_one_another():
    """At their equals signs, where they have one; the last line is not ended."""
    rows = as_latex(grazing(BALL, 0.0)).splitlines()
    assert rows[0] == "% Pixel in row 1, column 1 of 1 x 1, from 1"
    assert rows[2:4] == [
        r"  u &= \frac{j - 0.5}{W} - 0.5 \\",
        r"  &= \frac{1 - 0.5}{1} - 0.5 = 0 \\",
    ]
    assert r"  & t > 0 \\" in rows
    at = rows.index(r"  |\mathbf{p} + t\,\mathbf{d} - \mathbf{c}|^2 &= R^2 \\")
    assert rows[at + 1].startswith("  & |(0,")
    assert rows[-2].startswith(r"  &= \lfloor 255\,") and not rows[-2].endswith("\\")
    assert rows[-1] == r"\end{align*}"
