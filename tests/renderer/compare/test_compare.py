"""The disagreements that are explained, and those that are not: on images with known flaws."""

from dataclasses import replace

import numpy as np
import pytest
from flawed_images import CAMERA, SIZE, changed, counts, image, wall

from lucida.renderer.camera.lenses import Lens
from lucida.renderer.compare.raster_and_ray import SHADING, UNEXPLAINED, compare, compare_frames
from lucida.renderer.files import load_scene
from lucida.renderer.images.frame import CHANNELS
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Checker, Mesh, Scene, SceneObject, Sphere
from lucida.renderer.scene.texture import Texture
from lucida.renderer.trace import Tracer


@pytest.mark.parametrize(
    "values",
    [
        {"id": 3},
        {"depth": 2.001},
        {"depth": np.nan},
        {"normal": (0, 0.01, 1)},
        {"normal": np.nan},
        {"color": 0.55},
        {"color": np.nan},
        {"depth": np.inf, "id": -1, "primitive": -1},
    ],
)
def test_a_wrong_value_in_the_middle_of_a_surface_is_unexplained(values):
    flat = flatten(Scene((wall(-2),)))
    frame = image(2, 0, 0)
    wrong = changed(frame, (12, 20), **values)
    for first, second in ((wrong, frame), (frame, wrong)):
        comparison = compare_frames(flat, CAMERA, SIZE, first, second)
        assert counts(comparison) == {"unexplained": 1}
        only_color = set(values) == {"color"}
        assert comparison.labels[12, 20] == (SHADING if only_color else UNEXPLAINED)
        assert comparison.shading == only_color
        assert comparison.verdict() == "1 pixel differs without an explanation"


def test_differences_within_the_tolerances_agree():
    flat = flatten(Scene((wall(-2),)))
    frame = image(2, 0, 0)
    near = replace(frame, depth=frame.depth * np.float32(1 + 5e-5), color=frame.color + 0.003)
    comparison = compare_frames(flat, CAMERA, SIZE, near, frame)
    assert counts(comparison) == {}
    assert comparison.max_depth_error == pytest.approx(5e-5, rel=0.01)


@pytest.mark.parametrize(("offset_px", "explained"), [(0.9 / 128, True), (1.2 / 128, False)])
def test_an_outline_explains_pixels_within_one_128th(offset_px, explained):
    """The wall's right edge passes offset_px to the left of the centres of column 20."""
    at = CAMERA.image_point(0, 20 - offset_px, SIZE)[0] * 2
    flat = flatten(Scene((wall(-2, right=float(at)), wall(-3))))
    exact = changed(image(2, 0, 0), np.s_[:, 20:], depth=3, id=1, primitive=2)
    snapped = changed(exact, np.s_[:, 20], depth=2, id=0, primitive=0)
    comparison = compare_frames(flat, CAMERA, SIZE, snapped, exact)
    assert counts(comparison) == {"edge" if explained else "unexplained": 24}


@pytest.mark.parametrize(("part", "cause"), [(0.9, "pattern"), (1.2, "unexplained")])
def test_a_hole_explains_pixels_within_one_128th(part, cause):
    """Its edge is where an opaque texel meets a clear one, to the left of column 20."""
    at = CAMERA.image_point(0, 20 - part / 128, SIZE)[0] * 2
    texture = Texture(np.array([[[9, 9, 9, 255], [9, 9, 9, 0]]], np.uint8), ("clamp", "clamp"))
    square = wall(-2, at - 1, at + 1).shape
    mesh = Mesh(square.vertices, square.faces, uv=[[0, 0], [1, 0], [1, 1], [0, 1]])
    holed = SceneObject(mesh, Material(texture=texture, cutout=0.5))
    seen = changed(image(2, 0, 0), np.s_[:, 20:], depth=3, id=1, primitive=2)
    missed = changed(seen, np.s_[:, 20], depth=2, id=0, primitive=0)
    comparison = compare_frames(flatten(Scene((holed, wall(-3)))), CAMERA, SIZE, missed, seen)
    assert counts(comparison) == {cause: 24}


def test_a_hidden_edge_explains_nothing():
    """An edge behind the wall passes through the very centres that are wrong."""
    at = CAMERA.image_point(0, 20, SIZE)[0] * 3
    flat = flatten(Scene((wall(-2), wall(-3, right=float(at)), wall(-1.5, 8, 9))))
    frame = image(2, 0, 0)
    wrong = changed(frame, np.s_[:, 20], depth=1.5, id=2, primitive=4)
    assert counts(compare_frames(flat, CAMERA, SIZE, wrong, frame)) == {"unexplained": 24}


@pytest.mark.parametrize(("part", "explained"), [(0.9, True), (1.2, False)])
@pytest.mark.parametrize("side", [1, -1])
def test_a_sphere_s_outline(part, explained, side):
    """The outline passes the pixel's centre at a part of 1/128 pixel."""
    center, at = np.array([0.1, 0.05, -4.0]), (12, 20 + side * part / 128)
    direction = CAMERA.ray(*at, SIZE).direction
    radius = np.linalg.norm(np.cross(center, direction)) / np.linalg.norm(direction)
    flat = flatten(Scene((SceneObject(Sphere(tuple(center), float(radius))), wall(-9))))
    frame = image(9, 1, 0)
    other = changed(frame, (12, 20), depth=4, id=0, primitive=2)
    found = counts(compare_frames(flat, CAMERA, SIZE, other, frame))
    assert found == {"edge" if explained else "unexplained": 1}


@pytest.mark.parametrize(("part", "explained"), [(0.9, True), (1.2, False)])
def test_where_two_surfaces_meet(part, explained):
    x = CAMERA.image_point(20, 20 + part / 128, SIZE)[0] * 2
    flat = flatten(Scene((wall(-2), wall(-2 - 0.3 * float(x), tilt=0.3))))
    frame = image(2, 0, 0)
    other = changed(frame, (20, 20), id=1, primitive=2)
    found = counts(compare_frames(flat, CAMERA, SIZE, other, frame))
    assert found == {"edge" if explained else "unexplained": 1}


def test_beyond_its_end_an_edge_explains_nothing():
    """The line through the edge passes the centres of column 20; the edge ends above row 12."""
    x = float(CAMERA.image_point(0, 20, SIZE)[0] * 2)
    mesh = Mesh([(x, 0.1, -2), (x, 9, -2), (x + 9, 5, -2)], [[0, 1, 2]])
    flat = flatten(Scene((SceneObject(mesh), wall(-3))))
    exact = image(3, 1, 1)
    wrong = changed(exact, np.s_[16:, 20], depth=2, id=0, primitive=0)
    assert counts(compare_frames(flat, CAMERA, SIZE, wrong, exact)) == {"unexplained": 8}


@pytest.mark.parametrize(("part", "explained"), [(0.9, True), (1.1, False)])
def test_an_edge_that_float32_does_not_know_better(part, explained):
    """In a narrow view: 2^-21 of the distance of its ends."""
    half = 1e-6
    camera, size = replace(CAMERA, viewport=(-half, half, -half, half)), (33, 33)
    end = 1000
    x = part * 2.0**-21 * end
    mesh = Mesh([(x, -end, -1), (x, end, -1), (x - end, 0, -1)], [[0, 1, 2]])
    flat = flatten(Scene((SceneObject(mesh), wall(-2, left=-20.0))))
    frame = image(2, 1, 1, (33, 33))
    other = changed(frame, (16, 16), depth=1, id=0, primitive=0)
    found = counts(compare_frames(flat, camera, size, other, frame))
    assert found == {"edge" if explained else "unexplained": 1}


WRONG = {
    "shifted by a pixel": lambda frame: {
        name: np.roll(frame.channel(name), 1, axis=1) for name in CHANNELS
    },
    "another object": lambda frame: {"id": np.where(frame.id == 3, 5, frame.id)},
    "depth": lambda frame: {"depth": frame.depth * np.float32(1.001)},
    "colour": lambda frame: {"color": frame.color * np.float32(1.05)},  # displayed: 2 %
}


@pytest.mark.parametrize("lens", [None, Lens("fisheye", {"k1": 0.05})], ids=["pinhole", "fisheye"])
@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_renderer_is_not_explained(name, lens):
    scene, size = load_scene("still-life"), (96, 64)
    camera = replace(scene.view.for_size(size), lens=lens)
    with Tracer(scene) as tracer:
        right = tracer.render(camera, size, CHANNELS)
    wrong = replace(right, **WRONG[name](right))
    result = compare_frames(flatten(scene), camera, size, wrong, right, enlargement=2)
    differing = result.pixels - result.agree
    assert differing > 100
    assert result.unexplained > 0.7 * differing, result.summary()


@pytest.mark.parametrize("lens", [None, Lens("fisheye", {"k1": 0.05})], ids=["pinhole", "fisheye"])
def test_a_triangle_left_out_is_not_explained(lens):
    scene = Scene((wall(-2), wall(-3)))
    less = replace(scene.objects[0].shape, faces=scene.objects[0].shape.faces[:1])
    camera, size = replace(CAMERA, lens=lens), (64, 48)
    with Tracer(scene) as tracer:
        right = tracer.render(camera, size, CHANNELS)
        tracer.set_scene(Scene((SceneObject(less), wall(-3))))
        wrong = tracer.render(camera, size, CHANNELS)
    wrong = replace(wrong, primitive=wrong.primitive + (wrong.id == 1))  # numbers of the scene
    result = compare_frames(flatten(scene), camera, size, wrong, right, enlargement=2)
    differing = result.pixels - result.agree
    assert differing > 1000
    assert result.unexplained > 0.9 * differing, result.summary()


@pytest.mark.parametrize(("height", "cause"), [(1e-5, "clip"), (1e-3, "unexplained")])
def test_what_gl_clips_right_before_the_eye(height, cause):
    """A floor that reaches 400 units behind the eye and before it."""
    corners = [(-400, -height, 400), (400, -height, 400), (0, -height, -400)]
    flat = flatten(Scene((SceneObject(Mesh(corners, [[0, 1, 2]])), wall(-2))))
    t = -height / CAMERA.ray(20, 9, SIZE).direction[1]
    floor = changed(image(2, 1, 2), (20, 9), depth=t, id=0, primitive=0, normal=(0, 1, 0))
    assert counts(compare_frames(flat, CAMERA, SIZE, image(2, 1, 2), floor)) == {cause: 1}
    parallel = replace(CAMERA, projection="parallel")
    assert counts(compare_frames(flat, parallel, SIZE, image(2, 1, 2), floor)) == {"unexplained": 1}


@pytest.mark.parametrize(("size", "cause"), [(0.01, "edge"), (10.0, "unexplained")])
@pytest.mark.parametrize(
    ("given", "wrong"),
    [
        ({"normals": [(0.6, 0, 0.8), (-0.6, 0, 0.8), (0, 0.6, 0.8)]}, {"normal": (0.002, 0, 1)}),
        # The depths agree within the tolerance, and leave the colours' cause as it is.
        ({"colors": np.eye(3) * 0.8 + 0.1}, {"color": (0.53, 0.48, 0.5), "depth": 2.00018}),
    ],
    ids=["normals", "colours"],
)
def test_interpolation_explains_differences_only_in_triangles_smaller_than_a_pixel(
    size, cause, given, wrong
):
    corners = np.array([(0, 0, -2), (size, 0, -2), (0, size, -2)]) - (size / 3, size / 3, 0)
    flat = flatten(Scene((SceneObject(Mesh(corners, [[0, 1, 2]], **given)),)))
    frame = image(2, 0, 0, (33, 33))
    other = changed(frame, (16, 16), **wrong)
    camera = replace(CAMERA, viewport=(-0.5, 0.5, -0.5, 0.5))
    assert counts(compare_frames(flat, camera, (33, 33), other, frame)) == {cause: 1}


def test_edges_in_the_eyes_plane_are_quiet():
    floor = SceneObject(Mesh([(-1, -1, 0), (1, -1, 0), (0, -1, -9)], [[0, 1, 2]]))
    flat = flatten(Scene((floor, wall(-20))))
    frame = image(20, 1, 1)
    wrong = changed(frame, (3, 4), depth=1, id=0, primitive=0)
    assert counts(compare_frames(flat, CAMERA, SIZE, wrong, frame)) == {"unexplained": 1}


def test_checker_borders_explain_colours_only_where_there_are_checkers():
    at = CAMERA.image_point(0, 20 + 0.5 / 128, SIZE)[0] * 2
    frame = image(2, 0, 0)
    wrong = changed(frame, np.s_[:, 20], color=0.1)
    # Cells are centred on the object's origin: a border lies at half a cell.
    for material, cause in (
        ({"checker": Checker(size=2 * float(at))}, "pattern"),
        ({}, "unexplained"),
    ):
        flat = flatten(Scene((wall(-2, **material),)))
        assert counts(compare_frames(flat, CAMERA, SIZE, wrong, frame)) == {cause: 24}


@pytest.mark.parametrize(("normal", "agrees"), [(0.001, True), (0.001001, False)])
def test_a_difference_of_the_tolerance_still_agrees(normal, agrees):
    flat = flatten(Scene((wall(-2),)))
    frame = image(2, 0, 0)
    other = changed(frame, (1, 1), normal=(0, normal, 1))
    comparison = compare_frames(flat, CAMERA, SIZE, other, frame)
    assert (comparison.unexplained == 0) == agrees
    assert comparison.max_normal_error == (np.float32(normal) if agrees else 0)


def test_with_effects_no_line_is_looked_for_where_only_the_colour_differs():
    at = CAMERA.image_point(0, 20 + 0.5 / 128, SIZE)[0] * 2
    flat = flatten(Scene((wall(-2, checker=Checker(size=2 * float(at))),)))
    frame = image(2, 0, 0)
    wrong = changed(changed(frame, np.s_[:, 20], color=0.1), (3, 4), id=7)
    comparison = compare_frames(flat, CAMERA, SIZE, wrong, frame, effects=True)
    assert counts(comparison) == {"unexplained": 25}
    assert comparison.shading == 24
    assert compare_frames(flat, CAMERA, SIZE, wrong, frame).shading == 0


@pytest.mark.parametrize("missing", ["raster", "ray"])
def test_a_surface_that_one_image_misses_at_its_clip_line(missing):
    """t is the one of whoever hits: near passes within the tolerance of column 20's centres."""
    j = np.arange(32)
    t = np.broadcast_to(2 / (1 + (j - 15.5) / 32), (24, 32))
    flat = flatten(Scene((wall(-2, tilt=1.0), wall(-9))))
    frame = image(9, 1, 2)
    frame = changed(frame, np.s_[:], depth=t.astype(np.float32), id=0, primitive=0)
    other = changed(frame, np.s_[:, 20], depth=9, id=1, primitive=2)
    camera = replace(CAMERA, near=float(t[0, 20]))
    pair = (other, frame) if missing == "raster" else (frame, other)
    assert counts(compare_frames(flat, camera, SIZE, *pair)) == {"clip": 24}


def test_both_renderers_are_compared(gl_backend):
    scene = Scene((wall(-2, left=-0.3, right=0.4), wall(-3)))
    seen = []
    comparison = compare(scene, CAMERA, SIZE, gl_backend, seen.append)
    assert comparison.unexplained == 0
    assert comparison.agree > 600
    assert seen and seen[-1] == 1.0


@pytest.mark.parametrize(("part", "cause"), [(0.95, "edge"), (1.05, "unexplained")])
@pytest.mark.parametrize("side", [1, -1])
def test_the_depth_of_an_oblique_surface(part, cause, side):
    """t = 2 / (1 + x) changes by 2 / 32 / (1 + x)^2 a pixel."""
    across = 1 + (np.arange(32) - 15.5) / 32
    flat = flatten(Scene((wall(-2, tilt=1.0),)))
    depth = np.broadcast_to(2 / across, (24, 32)).astype(np.float32)
    frame = changed(image(2, 0, 0), np.s_[:], depth=depth)
    wrong = depth[12, 10] + side * part * 2 / 32 / across[10] ** 2 / 128
    other = changed(frame, (12, 10), depth=wrong)
    for pair in ((frame, other), (other, frame)):
        assert counts(compare_frames(flat, CAMERA, SIZE, *pair)) == {cause: 1}
    turned = changed(other, (12, 10), normal=(0, 0.1, 1))  # which is nowhere on a flat one
    assert counts(compare_frames(flat, CAMERA, SIZE, frame, turned)) == {"unexplained": 1}


def test_more_differing_pixels_than_edges_have_are_not_examined(monkeypatch):
    flat = flatten(Scene((wall(-2), wall(-2))))  # surfaces that coincide meet everywhere
    pair = image(2, 0, 0), image(2, 1, 2)
    for most, cause in ((768, "edge"), (767, "unexplained")):
        monkeypatch.setattr("lucida.renderer.compare.raster_and_ray.MOST_EXAMINED", most)
        assert counts(compare_frames(flat, CAMERA, SIZE, *pair)) == {cause: 768}
