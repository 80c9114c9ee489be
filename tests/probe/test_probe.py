"""The pixel probe's numbers against arithmetic written out here and the tracer's images."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from trace_reference import closest, random_camera, random_scene

from app.explaining.notation import latex_number, number
from app.probe.bundles import MOST_RAYS, bundle, column_of, row_of
from app.probe.color_formulas import color_lines
from app.probe.copying import all_lines, as_latex, as_python, as_text
from app.probe.formulas import hit_lines, ray_lines
from app.probe.model import Probe
from app.probe.reading import BEHIND, FAR, HIDDEN, NEAR, SEEN, Reading
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.images.display import encode_srgb, to_srgb8
from renderer.pixels import Indexing
from renderer.scene import BUILTIN_SCENES, load_scene, shapes
from renderer.scene.flat import flatten
from renderer.scene.model import (
    DirectionalLight,
    Material,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
)
from renderer.trace import Tracer

SIZE = (64, 48)
ALL = ("color", "depth", "normal", "id", "primitive")
BALL = Scene(
    (SceneObject(Sphere((0, 0, -3), 1), Material((0.5, 0.4, 0.3), (0.2, 0.2, 0.2), 20), "ball"),),
    (PointLight((2, 3, 1), (0.9, 0.8, 0.7)),),
    ambient=(0.1, 0.1, 0.2),
    background=(0.25, 0.5, 0.75),
)


def line(lines, key):
    return next(line for line in lines if line.key == key)


# The ray, in the lecture's words.


def test_the_lectures_camera_in_the_lectures_words() -> None:
    """Row 2, column 3 of 4 x 4: u = (3 - 0.5) / 4 - 0.5, v = -((2 - 0.5) / 4 - 0.5)."""
    reading = Probe(BALL).at((1, 2), Camera.canonical(), (4, 4))
    lines = ray_lines(reading)
    u, v = line(lines, "u"), line(lines, "v")
    assert u.text == "u = (j - 0.5) / W - 0.5"
    assert u.text_numbers == "= (3 - 0.5) / 4 - 0.5 = 0.125"
    assert u.latex == r"u = \frac{j - 0.5}{W} - 0.5"
    assert u.latex_numbers == r"= \frac{3 - 0.5}{4} - 0.5 = 0.125"
    assert v.text == "v = -((i - 0.5) / H - 0.5)"
    assert v.latex_numbers == r"= -\left(\frac{2 - 0.5}{4} - 0.5\right) = 0.125"
    assert line(lines, "camera direction").value == (0.125, 0.125, -1)
    assert line(lines, "direction").value == (0.125, 0.125, -1)
    assert line(lines, "direction").latex == (
        r"\mathbf{d} = u\,\mathbf{u} + v\,\mathbf{v} - d\,\mathbf{w}"
    )
    assert line(lines, "origin").value == (0, 0, 0)
    assert line(lines, "ray").latex == r"\mathbf{r}(t) = \mathbf{p} + t\,\mathbf{d}"
    assert line(lines, "range").latex == "t > 0"


def test_counted_from_0_the_same_pixel_has_the_same_ray() -> None:
    reading = Probe(BALL).at((1, 2), Camera.canonical(), (4, 4))
    arrays = ray_lines(reading, Indexing.ARRAY)
    assert line(arrays, "u").text_numbers == "= (2 + 0.5) / 4 - 0.5 = 0.125"
    assert line(arrays, "v").text == "v = -((i + 0.5) / H - 0.5)"
    lecture = ray_lines(reading, Indexing.LECTURE)
    assert [one.value for one in arrays] == [one.value for one in lecture]
    assert "row 2, column 3 of 4 x 4" in as_text(reading)
    assert "row 1, column 2 of 4 x 4" in as_text(reading, Indexing.ARRAY)


def test_any_viewport_skewed_and_parallel() -> None:
    """The formulas written out, with 1-based i, j."""
    basis = ((1.0, 0.2, 0.0), (-0.3, 1.5, 0.1), (0.2, 0.1, 2.0))
    left, right, bottom, top = viewport = (-0.3, 1.1, -0.7, 0.2)
    i, j, (width, height) = 17, 40, SIZE
    x = left + (right - left) * (j - 0.5) / width
    y = top - (top - bottom) * (i - 0.5) / height
    u, v, w = (np.array(vector) for vector in basis)
    eye = np.array([0.3, -0.2, 5.0])
    for projection in ("perspective", "parallel"):
        camera = Camera(tuple(eye), *basis, 1.7, viewport, projection)
        lines = ray_lines(Probe(BALL).at((i - 1, j - 1), camera, SIZE))
        assert line(lines, "u").value == pytest.approx((x,))
        assert line(lines, "v").value == pytest.approx((y,))
        assert r"\mathrm{left}" in line(lines, "u").latex
        if projection == "parallel":
            origin, direction, own = eye + x * u + y * v, -w, (0, 0, -1)
        else:
            origin, direction, own = eye, x * u + y * v - 1.7 * w, (x, y, -1.7)
        assert line(lines, "camera direction").value == pytest.approx(own)
        assert line(lines, "origin").value == pytest.approx(tuple(origin))
        assert line(lines, "direction").value == pytest.approx(tuple(direction))
        assert line(lines, "ray").value == pytest.approx((*origin, *direction))


# Where it meets the objects.


def test_a_sphere_in_front_one_behind_one_hidden_one_missed() -> None:
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
def test_near_and_far_cut_and_the_reading_says_so(projection: str) -> None:
    """distance 0.5: in perspective the ray parameter counts in halves of w's length."""
    scene = Scene(tuple(SceneObject(Sphere((0, 0, -z), 0.25)) for z in (1, 3, 5, 7)))
    camera = Camera(distance=0.5, projection=projection, near=3, far=6)
    reading = Probe(scene).at((0, 0), camera, (1, 1))
    unit = 1.0 if projection == "parallel" else 0.5
    assert reading.t_range == (3 / unit, 6 / unit)
    assert line(ray_lines(reading), "range").value == reading.t_range
    assert line(ray_lines(reading), "range").text_numbers == f"{3 / unit:g} < t < {6 / unit:g}"
    standing = {
        meeting.object: [crossing.standing for crossing in meeting.crossings]
        for meeting in reading.meetings
    }
    # The second sphere's front lies before near: one sees its inside.
    assert standing == {0: [NEAR, NEAR], 1: [NEAR, SEEN], 2: [HIDDEN, HIDDEN], 3: [FAR, FAR]}
    assert reading.hit is not None and reading.hit.t == pytest.approx(3.25 / unit)
    assert "+ \\sqrt" in line(hit_lines(reading), "t").latex


def test_the_eye_inside_a_sphere_and_a_box() -> None:
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
    run(reading)


def test_the_background() -> None:
    reading = Probe(BALL).at((0, 0), Camera.canonical(), SIZE)
    assert reading.hit is None and reading.shading is None
    assert reading.color == (0.25, 0.5, 0.75)
    assert hit_lines(reading) == []
    assert [one.key for one in color_lines(reading)] == ["background", "display", "bytes"]
    assert reading.bytes == tuple(to_srgb8(reading.color).tolist())
    run(reading)


# Against the tracer's images.


def cameras(scene: Scene):
    """The scene's own, a parallel one, a skewed one and a clipped one."""
    own = scene.view.for_size(SIZE)
    reach = float(np.abs(flatten(scene).bounds).max())
    wide = (-reach / 3, reach / 3, -reach / 4, reach / 4)
    yield own
    yield Camera(own.eye, own.u, own.v, own.w, 1.0, wide, "parallel")
    skewed = np.array(own.u) + 0.3 * np.array(own.w), 1.4 * np.array(own.v) - 0.2 * np.array(own.u)
    yield Camera(own.eye, *map(tuple, skewed), own.w, own.distance, own.viewport)
    depth = float(np.linalg.norm(own.eye)) or 4.0
    yield Camera(
        own.eye, own.u, own.v, own.w, own.distance, own.viewport, near=0.7 * depth, far=1.2 * depth
    )


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_readings_are_what_the_tracer_draws(name: str) -> None:
    scene = load_scene(name)
    probe, rng = Probe(scene), np.random.default_rng(4)
    with Tracer(scene, method="reference") as reference, Tracer(scene) as tracer:
        for camera in cameras(scene):
            frame = reference.render(camera, SIZE, ALL)
            fast = tracer.render(camera, SIZE, ALL)
            for pixel in zip(rng.integers(0, 48, 80), rng.integers(0, 64, 80), strict=True):
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


@pytest.mark.parametrize("seed", range(6))
def test_random_scenes_against_trying_every_primitive(seed: int) -> None:
    random = np.random.default_rng(seed)
    scene, camera = random_scene(random), random_camera(random, near_far=seed % 2 == 0)
    probe, size = Probe(scene), (12, 9)
    rays = camera.rays(size)
    hits = closest(probe.flat, *(part.reshape(-1, 3) for part in rays), camera.t_range)
    for pixel in np.ndindex(9, 12):
        at = pixel[0] * 12 + pixel[1]
        if hits.doubtful[at]:
            continue
        hit = probe.at(pixel, camera, size).hit
        assert (hit.primitive if hit else -1) == hits.primitive[at]
        if hit:
            assert hit.t == pytest.approx(hits.t[at], rel=1e-9)


# The colour.


def test_a_colour_term_by_term() -> None:
    """Blinn and Phong on paper: a sphere lit by a point and a directional light."""
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
    assert reading.display == pytest.approx(tuple(1.055 * exposed ** (1 / 2.4) - 0.055), rel=1e-5)
    assert reading.bytes == tuple(to_srgb8(total, 0.5).tolist())

    lines = color_lines(reading)
    assert [one.key for one in lines] == [
        "reflectance", "specular", "ambient",
        "light 1", "diffuse 1", "halfway 1", "specular 1",
        "light 2", "diffuse 2", "halfway 2", "specular 2",
        "sum", "exposure", "display", "bytes",
    ]  # fmt: skip
    terms = [line(lines, key).value for key in ("ambient", "diffuse 1", "specular 1", "diffuse 2")]
    terms.append(line(lines, "specular 2").value)
    assert tuple(map(sum, zip(*terms, strict=True))) == pytest.approx(line(lines, "sum").value)
    assert f"max(0, {number(shading.lamps[0].n_dot_l)})" in line(lines, "diffuse 1").text_numbers


def test_a_linear_display_leaves_out_the_curve() -> None:
    probe = Probe(BALL)
    curved = probe.at((0, 0), Camera.canonical(), SIZE)
    linear = probe.at((0, 0), Camera.canonical(), SIZE, transfer="linear")
    assert curved.display == pytest.approx(tuple(encode_srgb((0.25, 0.5, 0.75)).tolist()))
    assert linear.display == (0.25, 0.5, 0.75)
    assert linear.bytes == (64, 128, 191)


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


def test_shadows_and_mirrors_are_the_tracers() -> None:
    scene = floor_and_ball(0.4)
    camera, probe = Camera.look_at((1, 4, 6), (0, 0.4, 0), fov_y_deg=50), None
    probe = Probe(scene)
    with Tracer(scene, shadows=True, mirror_depth=2) as tracer:
        frame = tracer.render(camera, SIZE)
    dark = wrong = mirrored = 0
    for pixel in np.ndindex(48, 64):
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
    # At a shadow's outline, a ray in float32 may pass on the other side.
    assert wrong <= 5
    assert dark > 100 and mirrored > 50


# Copies.


def run(reading: Reading, indexing: Indexing = Indexing.LECTURE) -> dict:
    """Executes the copied program, and checks what it computes."""
    names: dict = {"print": lambda *_: None}
    exec(compile(as_python(reading, indexing), "copied", "exec"), names)
    np.testing.assert_allclose(names["origin"], reading.origin, rtol=1e-12)
    np.testing.assert_allclose(names["direction"], reading.direction, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(names["color"], reading.color, rtol=1e-7, atol=1e-9)
    assert np.abs(names["rgb"] - reading.bytes).max() <= 1
    if reading.hit is not None:
        assert names["t"] == pytest.approx(reading.hit.t, rel=1e-7)
        np.testing.assert_allclose(names["point"], reading.hit.point, rtol=1e-6, atol=1e-7)
    return names


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_the_copied_program_computes_the_pixel(name: str) -> None:
    scene = load_scene(name)
    probe, rng = Probe(scene), np.random.default_rng(1)
    for camera in cameras(scene):
        for pixel in zip(rng.integers(0, 48, 12).tolist(), rng.integers(0, 64, 12).tolist()):  # noqa: B905
            reading = probe.at(pixel, camera, SIZE, 0.5, "srgb", shadows=True, mirror_depth=2)
            run(reading, Indexing.LECTURE)
            run(reading, Indexing.ARRAY)


def test_copies_hold_every_line() -> None:
    scene = load_scene("still-life")
    camera = scene.view.for_size(SIZE)
    reading = Probe(scene).at((24, 32), camera, SIZE)
    lines = all_lines(reading)
    assert len({one.key for one in lines}) == len(lines)
    text, latex = as_text(reading), as_latex(reading)
    for one in lines:
        assert one.text in text and one.text_numbers in text
    assert all(entry.name in text for entry in scene.objects)
    assert latex.count(r"\begin{align*}") == latex.count(r"\end{align*}") == 1
    assert latex.count("{") == latex.count("}")
    rows = latex.splitlines()[2:-1]
    assert len(rows) == sum(1 + bool(one.latex_numbers) for one in lines)
    assert all(row.count("&") == 1 for row in rows)
    assert all(row.endswith(r"\\") for row in rows[:-1]) and not rows[-1].endswith("\\")


# Numbers.


def test_how_numbers_are_written() -> None:
    assert [number(x) for x in (0.5, -0.25, 3.0, 1 / 3, -0.0)] == [
        "0.5",
        "-0.25",
        "3",
        "0.3333",
        "0",
    ]
    assert number(0.5, fixed=True) == "0.5000"
    assert number(1.5e-7) == "1.5e-07"
    assert latex_number(1.5e-7) == r"1.5 \cdot 10^{-7}"
    assert latex_number(math.inf) == r"\infty"
    assert number(-2e9) == "-2e+09"


@given(st.floats(-1e12, 1e12))
def test_numbers_read_back(value: float) -> None:
    assert abs(float(number(value)) - value) <= max(5.1e-5, 6e-3 * abs(value))


# Bundles.


def test_rows_and_columns_of_pixels() -> None:
    assert row_of(3, (4, 9)).tolist() == [[3, 0], [3, 1], [3, 2], [3, 3]]
    assert column_of(2, (4, 3)).tolist() == [[0, 2], [1, 2], [2, 2]]


def test_a_bundles_rays_are_the_pixels() -> None:
    scene = load_scene("primitives")
    probe, camera = Probe(scene), load_scene("primitives").view.for_size(SIZE)
    pixels = row_of(20, SIZE)
    slow = bundle(probe, pixels, camera, SIZE)
    with Tracer(scene) as tracer:
        fast = bundle(probe, pixels, camera, SIZE, tracer)
        frame = tracer.render(camera, SIZE, ALL)
    assert np.array_equal(slow.origins, fast.origins)
    assert np.array_equal(slow.directions, camera.rays(SIZE).direction[20])
    np.testing.assert_allclose(slow.t, frame.depth[20], rtol=1e-5)
    assert (slow.primitive == fast.primitive).mean() > 0.95
    with pytest.raises(LucidaError, match="too many"):
        bundle(probe, np.zeros((MOST_RAYS + 1, 2), int), camera, SIZE)
