"""The pixel probe's numbers against the tracer's images, and its colour against arithmetic."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from read_pixels import ALL, BALL, SIZE, cameras, line

from lucida.app.instruments.probe.color_formulas import color_lines
from lucida.app.instruments.probe.model import Probe
from lucida.app.ui.explaining.notation import number
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.images.display import to_srgb8
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
    DirectionalLight,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
)
from lucida.renderer.trace import Tracer

# Against the tracer's images.


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_readings_are_what_the_tracer_draws(name):
    scene = load_scene(name)
    probe, rng = Probe(scene), np.random.default_rng(4)
    with Tracer(scene, method="reference") as reference, Tracer(scene) as tracer:
        for camera in cameras(scene):
            frame = reference.render(camera, SIZE, ALL)
            fast = tracer.render(camera, SIZE, ALL)
            for pixel in zip(rng.integers(0, 48, 30), rng.integers(0, 64, 30), strict=True):
                reading = probe.at((int(pixel[0]), int(pixel[1])), camera, SIZE)
                hit = reading.hit
                assert (hit.object if hit else -1) == frame.id[pixel]
                assert (hit.primitive if hit else -1) == frame.primitive[pixel]
                assert np.float32(hit.t if hit else math.inf) == frame.depth[pixel]
                normal = hit.normal if hit else (0, 0, 0)
                np.testing.assert_allclose(normal, frame.normal[pixel], atol=1e-6)
                np.testing.assert_allclose(reading.color, frame.color[pixel], rtol=1e-6, atol=1e-7)
                shown = tuple(to_srgb8(frame.color[pixel]).tolist())
                assert max(abs(a - b) for a, b in zip(reading.bytes, shown, strict=True)) <= 1
                if fast.primitive[pixel] == frame.primitive[pixel]:
                    np.testing.assert_allclose(reading.color, fast.color[pixel], atol=1e-3)


# The colour.


def test_a_colour_is_the_sum_of_its_terms():
    """Compute Blinn-Phong by hand for a sphere lit by a point and a directional light."""
    sun = DirectionalLight((-1, -2, -2), (0.3, 0.2, 0.1))
    scene = Scene(BALL.objects, (*BALL.lights, sun), BALL.ambient, BALL.background)
    reading = Probe(scene).at((22, 30), Camera.canonical(), SIZE, exposure_ev=0.5)
    shading, hit = reading.shading, reading.hit
    assert shading is not None and hit is not None

    d = np.array(reading.direction)
    # |t d - c|^2 = 1 with c = (0, 0, -3)
    c = np.array([0, 0, -3.0])
    b = -(d @ c)
    t = (-b - math.sqrt(b * b - (d @ d) * (c @ c - 1))) / (d @ d)
    x = t * d
    n = x - c
    assert hit.t == pytest.approx(t)
    assert hit.point == pytest.approx(tuple(x))
    assert hit.normal == pytest.approx(tuple(n))
    total = np.array([0.1, 0.1, 0.2]) * (0.5, 0.4, 0.3)
    assert shading.ambient == pytest.approx(tuple(total))
    lights = [np.array([2, 3, 1]) - x, np.array([1.0, 2, 2])]
    for lamp, to_light, color in zip(
        shading.lamps, lights, ((0.9, 0.8, 0.7), (0.3, 0.2, 0.1)), strict=True
    ):
        unit = to_light / np.linalg.norm(to_light)
        half = unit - d / np.linalg.norm(d)
        half /= np.linalg.norm(half)
        assert lamp.n_dot_l == pytest.approx(n @ unit)
        assert lamp.n_dot_h == pytest.approx(n @ half)
        diffuse = np.array(color) * (0.5, 0.4, 0.3) * max(0, n @ unit)
        specular = np.array(color) * 0.2 * max(0, n @ half) ** 20
        assert lamp.diffuse == pytest.approx(tuple(diffuse), rel=1e-6)
        assert lamp.specular == pytest.approx(tuple(specular), rel=1e-6)
        total = total + diffuse + specular
    assert reading.color == pytest.approx(tuple(total), rel=1e-6)
    exposed = math.sqrt(2) * total
    assert reading.exposed == pytest.approx(tuple(exposed), rel=1e-6)
    display = 1.055 * exposed ** (1 / 2.4) - 0.055
    assert reading.display == pytest.approx(tuple(display), rel=1e-5)
    assert reading.bytes == tuple(np.rint(255 * display))

    lines = color_lines(reading)
    assert [entry.key for entry in lines] == [
        "reflectance", "specular", "ambient",
        "light 1", "diffuse 1", "halfway 1", "specular 1",
        "light 2", "diffuse 2", "halfway 2", "specular 2",
        "sum", "exposure", "display", "bytes",
    ]  # fmt: skip
    terms = [line(lines, key).value for key in ("ambient", "diffuse 1", "specular 1", "diffuse 2")]
    terms.append(line(lines, "specular 2").value)
    assert tuple(map(sum, zip(*terms, strict=True))) == pytest.approx(line(lines, "sum").value)
    cosine = number(shading.lamps[0].n_dot_l)
    assert rf"\max(0,\ {cosine})" in line(lines, "diffuse 1").latex_numbers


def floor_and_ball(mirror: float) -> Scene:
    floor = Mesh([[-9, 0, -9], [9, 0, -9], [9, 0, 9], [-9, 0, 9]], [[0, 2, 1], [0, 3, 2]])
    material = Material((0.6, 0.6, 0.6), (mirror,) * 3)
    return Scene(
        (
            SceneObject(floor, material, "floor"),
            SceneObject(Sphere((0.2, 1.3, -0.3), 0.8), Material((0.9, 0.4, 0.2)), "ball"),
        ),
        (PointLight((2, 5, 1)), DirectionalLight((1, -1, 0.2), (0.3, 0.3, 0.3))),
        background=(0.1, 0.2, 0.3),
    )


def test_shadows_and_mirrors_are_the_tracers():
    scene = floor_and_ball(0.4)
    camera, probe = Camera.look_at((1, 4, 6), (0, 0.4, 0), fov_y_deg=50), Probe(scene)
    with Tracer(scene, shadows=True, mirror_depth=2) as tracer:
        frame = tracer.render(camera, SIZE)
    dark = wrong = mirrored = 0
    for pixel in itertools.product(range(0, 48, 4), range(0, 64, 4)):
        reading = probe.at(pixel, camera, SIZE, shadows=True, mirror_depth=2)
        wrong += not np.allclose(reading.color, frame.color[pixel], atol=2e-4)
        if reading.shading is None:
            continue
        shadowed = [lamp for lamp in reading.shading.lamps if not lamp.is_lit]
        dark += bool(shadowed)
        lines = color_lines(reading)
        for lamp in shadowed:
            assert lamp.diffuse == lamp.specular == (0, 0, 0)
            assert "shadowed" in line(lines, f"shadow {lamp.number + 1}").name
        if reading.bounces and reading.bounces[0].hit is not None:
            mirrored += 1
            assert "sees ball" in line(lines, "mirror 1").name
    # At a shadow's outline, a float32 ray may pass on the other side.
    assert wrong <= 2
    assert dark > 6 and mirrored > 3
