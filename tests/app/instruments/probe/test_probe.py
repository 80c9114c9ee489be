"""The pixel probe's numbers against arithmetic written out here: the ray, and what it meets."""

from __future__ import annotations

import pytest
from read_pixels import BALL, SIZE, line

from lucida.app.instruments.probe.color_formulas import color_lines
from lucida.app.instruments.probe.formulas import hit_lines, ray_lines
from lucida.app.instruments.probe.model import Probe
from lucida.app.instruments.probe.reading import BEHIND, FAR, HIDDEN, NEAR, SEEN
from lucida.renderer.camera.camera import Camera
from lucida.renderer.images.display import to_srgb8
from lucida.renderer.scene import shapes
from lucida.renderer.scene.model import (
    Scene,
    SceneObject,
    Sphere,
)

# The ray, in the lecture's words.


def test_the_lectures_camera_in_the_lectures_words():
    """Row 2, column 3 of 4 x 4: u = (3 - 0.5) / 4 - 0.5, v = -((2 - 0.5) / 4 - 0.5)."""
    reading = Probe(BALL).at((1, 2), Camera.canonical(), (4, 4))
    lines = ray_lines(reading)
    u, v = line(lines, "u"), line(lines, "v")
    assert u.latex == r"u = \frac{j - 0.5}{W} - 0.5"
    assert u.latex_numbers == r"= \frac{3 - 0.5}{4} - 0.5 = 0.125"
    assert v.latex_numbers == r"= -\left(\frac{2 - 0.5}{4} - 0.5\right) = 0.125"
    assert line(lines, "camera direction").value == (0.125, 0.125, -1)
    assert line(lines, "direction").value == (0.125, 0.125, -1)
    assert line(lines, "direction").latex == (
        r"\mathbf{d} = u\,\mathbf{u} + v\,\mathbf{v} - d\,\mathbf{w}"
    )
    assert line(lines, "origin").value == (0, 0, 0)
    assert line(lines, "ray").latex == r"\mathbf{r}(t) = \mathbf{p} + t\,\mathbf{d}"
    assert line(lines, "range").latex == "t > 0"


# Where it meets the objects.


def test_a_sphere_in_front_one_behind_one_hidden_one_missed():
    """Along -z from the origin through the middle: t counts in units of z."""
    spheres = [((0, 0, -3), 1.0), ((0, 0, 4), 1.0), ((0, 0, -8), 2.0), ((5, 0, -3), 1.0)]
    names = ["near", "behind", "hidden", "beside"]
    scene = Scene(
        tuple(
            SceneObject(Sphere(*sphere), name=name)
            for sphere, name in zip(spheres, names, strict=True)
        )
    )
    reading = Probe(scene).at((0, 0), Camera.canonical(), (1, 1))
    assert [meeting.name for meeting in reading.meetings] == ["near", "hidden", "behind", "beside"]
    found = {
        meeting.name: [(crossing.t, crossing.standing) for crossing in meeting.crossings]
        for meeting in reading.meetings
    }
    assert found == {
        "near": [(2, SEEN), (4, HIDDEN)],
        "hidden": [(6, HIDDEN), (10, HIDDEN)],
        "behind": [(-5, BEHIND), (-3, BEHIND)],
        "beside": [],
    }
    assert reading.hit is not None and reading.meetings[0].name == "near"
    behind = reading.meetings[2].nearest
    assert behind is not None and behind.t == -3
    assert not reading.meetings[2].is_on_ray
    assert reading.meetings[3].nearest is None


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_near_and_far_cut_and_the_reading_says_so(projection):
    """distance 0.5: in perspective the ray parameter counts in halves of w's length."""
    scene = Scene(tuple(SceneObject(Sphere((0, 0, -z), 0.25)) for z in (1, 3, 5, 7)))
    camera = Camera(distance=0.5, projection=projection, near=3, far=6)
    reading = Probe(scene).at((0, 0), camera, (1, 1))
    unit = 1.0 if projection == "parallel" else 0.5
    assert reading.t_range == (3 / unit, 6 / unit)
    assert line(ray_lines(reading), "range").value == reading.t_range
    assert line(ray_lines(reading), "range").latex_numbers == f"{3 / unit:g} < t < {6 / unit:g}"
    standing = {
        meeting.object: [crossing.standing for crossing in meeting.crossings]
        for meeting in reading.meetings
    }
    # The second sphere's front lies before near: one sees its inside.
    assert standing == {0: [NEAR, NEAR], 1: [NEAR, SEEN], 2: [HIDDEN, HIDDEN], 3: [FAR, FAR]}
    assert reading.hit is not None and reading.hit.t == pytest.approx(3.25 / unit)
    assert "+ \\sqrt" in line(hit_lines(reading), "t").latex


def test_the_eye_inside_a_sphere_and_a_box():
    box = SceneObject(shapes.box(4.0), name="box")
    scene = Scene((SceneObject(Sphere((0, 0, 0), 1), name="ball"), box))
    reading = Probe(scene).at((0, 0), Camera.canonical(), (1, 1))
    assert [meeting.name for meeting in reading.meetings] == ["ball", "box"]
    assert [c.t for c in reading.meetings[0].crossings] == [-1, 1]
    # The ray goes through the box's diagonals: each side is met once, not once a triangle.
    assert [c.t for c in reading.meetings[1].crossings] == [-2, 2]
    assert reading.hit is not None
    assert reading.hit.geometric == (0, 0, 1)
    assert line(hit_lines(reading), "t").value == (1,)
    assert line(hit_lines(reading), "geometric").name == "normal, towards the viewer"


def test_a_ray_without_a_hit_reads_the_background():
    reading = Probe(BALL).at((0, 0), Camera.canonical(), SIZE)
    assert reading.hit is None and reading.shading is None
    assert reading.color == (0.25, 0.5, 0.75)
    assert hit_lines(reading) == []
    assert [one.key for one in color_lines(reading)] == ["background", "display", "bytes"]
    assert reading.bytes == tuple(to_srgb8(reading.color).tolist())
