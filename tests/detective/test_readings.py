"""Among the readings of a matrix is the camera that it was made of, whatever the convention."""

from __future__ import annotations

from itertools import combinations, product

import numpy as np
import pytest

from app.detective import example, ranking
from app.detective.printed import Pasted, pasted
from app.detective.ranking import SceneSeen, ranked
from app.detective.readings import (
    AXES,
    MIRRORED,
    TURNS,
    Convention,
    MatrixReading,
    ReadAs,
    is_same,
    readings,
    up_of,
)
from app.detective.writing import code, formula
from renderer.camera import Camera
from renderer.focus import scene_focus
from renderer.scene import BUILTIN_SCENES, load_scene
from renderer.scene.model import View

SIZE = (64, 48)
K = np.array([[70.0, 0, 30.2], [0, 72.0, 24.9], [0, 0, 1]])
WAYS = ("camera-to-world", "world-to-camera")
POSES = [
    Convention(way, columns, axes, turned)
    for way, columns, axes, turned in product(WAYS, (False, True), AXES, (False, True))
]
BY_ROWS = [one for one in POSES if one.axes in example.PROGRAMS and not one.columns]
RIGHT_HANDED = [convention for convention in POSES if convention.axes in example.PROGRAMS]


def cameras(count, seed=1):
    chance = np.random.default_rng(seed)
    for _ in range(count):
        eye, target, up = chance.normal(0, (5, 1, 1), (3, 3)).T.reshape(3, 3)
        left, bottom = chance.uniform(-0.9, -0.1, 2)
        camera = Camera.look_at(eye * 3, target, up, fov_y_deg=chance.uniform(20, 90))
        right, top = chance.uniform(0.1, 0.9, 2)
        yield camera, (float(left), float(right), float(bottom), float(top))


def around(camera, up="y", pixel_origin="center"):
    lens = Camera(distance=camera.distance, viewport=camera.viewport, projection=camera.projection)
    return ReadAs(View(lens, fit=False), up, pixel_origin, SIZE)


def apart(a, b, size=SIZE):
    """Return the distance in pixels between points that both cameras see."""
    ray = a.ray(*np.array([[3.0, 40, 20], [5, 60, 30]]), size)
    points = ray.origin + np.array([[1.0], [3], [10]]) * ray.direction
    one, other = a.project(points, size), b.project(points, size)
    gaps = np.abs([one.row - other.row, one.column - other.column])
    return float(gaps.max()) if np.isfinite(gaps).all() else np.inf


def nearest(found, camera, size=SIZE):
    """The reading that is that camera, and how far apart their pixels are."""
    gaps = [apart(camera, reading.view.camera, size) for reading in found]
    return (found[int(np.argmin(gaps))], min(gaps)) if found else (None, np.inf)


def names(reading):
    return (reading.convention, *reading.also)


@pytest.mark.parametrize("convention", POSES, ids=lambda c: ranking.name(c, "y"))
@pytest.mark.parametrize("up", ["y", "z"])
def test_a_pose_is_among_its_readings(convention, up):
    for camera, _ in cameras(3):
        matrix = example.matrix_of(camera, convention, up)
        texts = [repr(matrix.tolist())]
        texts += [] if convention.columns else [repr(matrix[:3].tolist())]
        for text in texts:
            found = readings(pasted(text), around(camera, up)).found
            reading, gap = nearest(found, camera)
            assert gap < 1e-6 and convention in names(reading)


@pytest.mark.parametrize("convention", RIGHT_HANDED, ids=lambda c: ranking.name(c, "y"))
@pytest.mark.parametrize("pixel_origin", ["center", "corner"])
def test_with_k_the_image_is_that_of_k(convention, pixel_origin):
    for camera, _ in cameras(4, 2):
        pose = np.column_stack([camera.basis, camera.eye])
        wanted = Camera.from_intrinsics(
            K, world_from_camera=pose, size=SIZE, axes="opengl", pixel_origin=pixel_origin
        )
        matrix = example.matrix_of(camera, convention, "y")
        text = f"K = {K.tolist()}\n{matrix.tolist()}\n64x48"
        found = readings(pasted(text), around(camera, "y", pixel_origin)).found
        reading, gap = nearest(found, wanted)
        assert gap < 1e-6 and convention in names(reading) and reading.size == SIZE
        assert reading.view.fit  # in the window's images, of another shape, nothing is stretched


def test_half_a_pixel_is_between_centres_and_corners():
    camera, _ = next(cameras(1))
    text = f"{K.tolist()}\n{example.matrix_of(camera, POSES[0], 'y').tolist()}\n64x48"
    one, other = (
        readings(pasted(text), around(camera, "y", origin)).found[0].view.camera
        for origin in ("center", "corner")
    )
    point = camera.eye + 3 * (-np.asarray(camera.w))
    a, b = one.project(point, SIZE), other.project(point, SIZE)
    assert a.column - b.column == pytest.approx(0.5) and a.row - b.row == pytest.approx(0.5)


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("times", [1.0, -3.5])
def test_p_is_taken_apart(turned, times):
    for camera, viewport in cameras(5, 3):
        wanted = Camera(camera.eye, camera.u, camera.v, camera.w, 1.3, viewport)
        k, rotation, t = wanted.intrinsics(SIZE)
        turn = TURNS["y"] if turned else np.eye(3)  # into the matrix's own world
        p = times * k @ np.column_stack([rotation @ turn, t])
        for text in (f"{p.tolist()} {SIZE[0]}x{SIZE[1]}", f"{p.T.tolist()} 64 x 48"):
            found = readings(pasted(text), around(camera)).found
            reading, gap = nearest(found, wanted)
            assert gap < 1e-6
            assert Convention("P = K [R | t]", "64 x" in text, turned=turned) in names(reading)


@pytest.mark.parametrize("far", [40.0, np.inf])
@pytest.mark.parametrize("program", ["OpenGL", "Direct3D", "Vulkan"])
def test_projection_times_view_is_taken_apart(program, far):
    for camera, viewport in cameras(5, 4):
        wanted = Camera(camera.eye, camera.u, camera.v, camera.w, 1.3, viewport)
        clip = wanted.clip_from_camera(0.1, min(far, 1e9))
        if program == "Direct3D":  # depth from 0 to 1
            clip[2] = (clip[2] + clip[3]) / 2
        elif program == "Vulkan":
            clip[1] *= -1
        product_ = clip @ wanted.camera_from_world
        for columns, matrix in ((False, product_), (True, product_.T)):
            found = readings(pasted(repr(matrix.tolist())), around(camera)).found
            reading, gap = nearest(found, wanted)
            assert gap < 1e-6
            flipped = program == "Vulkan"
            assert Convention("clip from world", columns, flipped=flipped) in names(reading)


def test_a_parallel_projection_times_view():
    for camera, viewport in cameras(5, 5):
        wanted = Camera(camera.eye, camera.u, camera.v, camera.w, 1, viewport, "parallel")
        matrix = wanted.clip_from_camera(-5.0, 40.0) @ wanted.camera_from_world
        for text in (repr(matrix.tolist()), repr(matrix.T.tolist())):
            reading, gap = nearest(readings(pasted(text), around(camera)).found, wanted)
            assert gap < 1e-6 and reading.view.camera.is_parallel


def test_rotation_and_translation_apart():
    for camera, _ in cameras(8, 6):
        world, eye = camera.basis, np.asarray(camera.eye)
        for rotation, t in (
            (world, eye),
            (world.T, -world.T @ eye),
            (world.T, eye),  # R is the world's, and t the camera's place: a usual mixture
            (world, -world.T @ eye),
        ):
            text = f"R = {rotation.tolist()}, t = {t.tolist()}"
            assert nearest(readings(pasted(text), around(camera)).found, camera)[1] < 1e-6


def test_a_scaled_pose_is_the_camera_without_its_scale():
    camera, _ = next(cameras(1, 7))
    pose = np.eye(4)
    pose[:3] = np.column_stack([camera.basis * 2.5, camera.eye])
    for matrix in (pose, np.linalg.inv(pose)):
        reading, gap = nearest(
            readings(pasted(repr(matrix.tolist())), around(camera)).found, camera
        )
        assert gap < 1e-6
        assert np.linalg.norm(reading.view.camera.u) == pytest.approx(1)


@pytest.mark.parametrize("turn", [np.eye(3), next(cameras(1, 8))[0].basis])
def test_readings_that_make_one_camera_are_merged(turn):
    """A camera in the world's origin: rows and columns are each other's inverses. Each name of a
    merged reading makes its camera.
    """
    matrix = np.eye(4)
    matrix[:3, :3] = turn
    found = readings(pasted(repr(matrix.tolist())), around(Camera())).found
    assert any(reading.also for reading in found) and len(found) <= 12
    assert sum(len(names(reading)) for reading in found) == 24  # of both orders
    for reading in found:
        for convention in names(reading):
            made = example.matrix_of(reading.view.camera, convention, "y")
            assert np.allclose(made, matrix, atol=1e-9)
    for one, other in combinations(found, 2):
        assert not is_same(one.view.camera, other.view.camera)


def test_what_cannot_be_is_told():
    camera, _ = next(cameras(1))
    found = readings(
        pasted(repr(example.matrix_of(camera, POSES[0], "y").tolist())), around(camera)
    )
    reasons = dict(found.left_out)
    assert "not (0, 0, 0, 1)" in reasons["by columns"]
    assert MIRRORED in reasons.values()
    found = readings(Pasted(np.arange(16.0)), around(camera))
    assert not found.found and set(dict(found.left_out)) == {"by rows", "by columns"}
    for numbers in (np.zeros(16), np.ones(16), np.zeros(12), np.ones(12), np.eye(4).ravel() * 0):
        assert not readings(Pasted(numbers), around(camera)).found


def test_any_numbers_are_cameras_or_reasons():
    chance = np.random.default_rng(3)
    for trial in range(200):
        numbers = chance.normal(size=(16, 12)[trial % 2]) * 10.0 ** chance.integers(-12, 12)
        numbers[chance.integers(0, len(numbers), 4)] = 0
        found = readings(Pasted(numbers), around(Camera()))
        assert found.found or found.left_out


@pytest.mark.parametrize("scene", ["still-life", "columns"])
@pytest.mark.parametrize("text", ["pose", "short", "K", "R and t", "P", "product", "scaled"])
def test_what_is_written_down_makes_the_camera(scene, text):
    shown = load_scene(scene).view
    for camera, viewport in cameras(3, 9):
        pose = np.eye(4)
        pose[:3] = np.column_stack([camera.basis, camera.eye])
        own = Camera(camera.eye, camera.u, camera.v, camera.w, 1.3, viewport)
        k, rotation, t = own.intrinsics(SIZE)
        product_ = own.clip_from_camera(0.1, 30) @ own.camera_from_world
        given = pasted(
            {
                "pose": repr(pose.T.tolist()),
                "short": repr(pose[:3].tolist()),
                "K": f"{K.tolist()} {pose.tolist()} 64x48",
                "R and t": f"R = {pose[:3, :3].tolist()} t = {pose[:3, 3].tolist()}",
                "P": repr((k @ np.column_stack([rotation, t])).tolist()),
                "product": repr(product_.tolist()),
                "scaled": f"{K.tolist()} {(pose * (3, 3, 3, 1)).tolist()}",
            }[text]
        )
        for up in ("y", "z"):
            for reading in readings(given, ReadAs(shown, up, "corner", SIZE)).found:
                made: dict[str, object] = {}
                exec(code(reading, given, up, "corner"), made)  # as who copies it would
                camera_made = made["camera"]
                assert isinstance(camera_made, Camera)
                assert is_same(camera_made, reading.view.camera)
                assert formula(reading.convention, up)


def test_which_axis_is_up():
    for eye in ((3, 2, 5), (-3, 6, -4), (0.1, 9, -0.2)):
        assert up_of(View(Camera.look_at(eye, (0, 0, 0)))) == "y"
        x, y, z = eye
        assert up_of(View(Camera.look_at((x, z, y), (0, 0, 0), (0, 0, 1)))) == "z"


@pytest.mark.parametrize("scene", BUILTIN_SCENES)
def test_the_true_reading_comes_first(scene):
    """The cameras are such as somebody could set: around the scene, above the ground, looking at
    it.
    """
    loaded = load_scene(scene)
    subject = SceneSeen(ranking.sample(scene_focus(loaded).framed), up_of(loaded.view))
    chance = np.random.default_rng(11)
    first = count = 0
    for _ in range(8):
        fov = chance.uniform(25, 70)
        height, turn = np.radians(chance.uniform((-5, -180), (75, 180)))
        way = (np.cos(height) * np.sin(turn), np.sin(height), np.cos(height) * np.cos(turn))
        far = subject.radius / np.sin(np.radians(fov) / 2) * chance.uniform(0.6, 1.6)
        eye = subject.middle + far * np.array(way)
        target = subject.middle + 0.3 * subject.radius * chance.uniform(-1, 1, 3)
        camera = Camera.look_at(eye, target, fov_y_deg=fov, aspect=4 / 3)
        for convention in BY_ROWS:
            matrix = example.matrix_of(camera, convention, subject.up)
            found = readings(pasted(repr(matrix.tolist())), around(camera, subject.up)).found
            best = ranked(found, subject, SIZE)[0]
            first += is_same(best.reading.view.camera, camera)
            count += 1
    assert first / count > 0.95


def test_an_example_is_found_out():
    loaded = load_scene("still-life")
    subject = SceneSeen(ranking.sample(scene_focus(loaded).framed), "y")
    drawn = {example.drawn(seed) for seed in range(24)}
    assert len(drawn) > 10
    for convention in drawn:
        text = example.printed_matrix(example.matrix_of(loaded.view.camera, convention, "y"))
        found = readings(pasted(text), around(loaded.view.camera)).found
        best = ranked(found, subject, SIZE)[0]
        assert best.reading.convention == convention
        assert "sees 99 % of the scene, upright" in ranking.sentence(best, "y")
        assert ranking.name(convention, "y") in ranking.sentence(best, "y")


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(("skew", "is_read"), [(0.04, True), (0.06, False), (3.0, False)])
def test_a_matrix_with_much_skew_is_no_product(sign, skew, is_read):
    camera, _ = next(cameras(1, 7))
    _, rotation, t = camera.intrinsics(SIZE)
    pose = np.column_stack([rotation, t])
    k = np.array([[70.0, sign * skew * 70, 30], [0, 72, 25], [0, 0, 1]])
    found = readings(pasted(f"{(k @ pose).tolist()} 64x48"), around(camera))
    by_rows = [one for one in found.found if Convention("P = K [R | t]", False) in names(one)]
    assert bool(by_rows) == is_read
    assert is_read or any("skew" in reason for _, reason in found.left_out)
    clip = camera.clip_from_camera(0.1, 50.0)
    clip[0] += sign * skew * clip[0, 0] / clip[1, 1] * clip[1]
    found = readings(pasted(repr((clip @ camera.camera_from_world).tolist())), around(camera))
    by_rows = [one for one in found.found if not one.convention.columns]
    assert bool(by_rows) == is_read


@pytest.mark.parametrize(
    ("ratio", "is_read"), [(9, True), (1 / 9, True), (11, False), (1 / 11, False)]
)
def test_a_matrix_of_very_oblong_pixels_is_no_product(ratio, is_read):
    camera, _ = next(cameras(1, 7))
    _, rotation, t = camera.intrinsics(SIZE)
    k = np.array([[70.0 * ratio, 0, 30], [0, 70, 25], [0, 0, 1]])
    text = f"{(k @ np.column_stack([rotation, t])).tolist()} 64x48"
    found = readings(pasted(text), around(camera)).found
    assert any(not one.convention.columns for one in found) == is_read


@pytest.mark.parametrize("size", [(90, 30), (30, 90)])
def test_what_a_reading_sees_is_what_lies_in_its_image(size):
    """Counted by hand, at every edge and behind the eye."""
    camera = Camera(viewport=(-size[0], size[0], -size[1], size[1]), distance=100.0)
    x, y, z = np.random.default_rng(2).uniform(-150, 150, (3, 2000))
    reading = MatrixReading(Convention("camera-to-world", False, "OpenGL"), View(camera))
    (one,) = ranked([reading], SceneSeen(np.column_stack([x, y, z]), "y"), size)
    with np.errstate(divide="ignore"):
        inside = (z < 0) & (abs(100 * x / z) <= size[0]) & (abs(100 * y / z) <= size[1])
    assert one.sees == pytest.approx(inside.mean(), abs=1e-12)
