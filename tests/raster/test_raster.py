"""The rasterizer's images: analytic answers first, then every kind of camera against float64."""

import gc
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from raster_reference import reference

from renderer.camera import Camera
from renderer.compare import CHANNELS, compare_frames
from renderer.errors import LucidaError
from renderer.raster import prepare
from renderer.scene.flat import flatten
from renderer.scene.model import (
    Checker,
    DirectionalLight,
    Material,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
)

SIZE = (48, 36)
WIDE = Camera(viewport=(-0.8, 0.8, -0.6, 0.6))
CHECKERED = Material((0.6, 0.5, 0.4), (0.5, 0.5, 0.5), 80, Checker((0.1, 0.2, 0.9), 0.35))


def triangle(*corners, **more):
    return Mesh(np.array(corners, np.float32), np.array([[0, 1, 2]], np.int32), **more)


def square(side, z=0.0):
    """Two triangles across the z axis."""
    s = side / 2
    corners = np.array([(-s, -s, z), (s, -s, z), (s, s, z), (-s, s, z)], np.float32)
    return Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]], np.int32))


def still_life():
    """A floor, a turned box, a smooth and coloured roof, two spheres one inside the other."""
    floor = Mesh(
        np.array([(-9, -1, -9), (9, -1, -9), (9, -1, 9), (-9, -1, 9)], np.float32),
        np.array([[0, 1, 2], [0, 2, 3]], np.int32),
    )
    corners = np.array([(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], np.float32)
    sides = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)]
    faces = np.array([f for a, b, c, d in sides for f in ((a, b, c), (a, c, d))], np.int32)
    turned = np.eye(4)
    turned[:3] = [[0.4, -0.3, 0, -1.2], [0.3, 0.4, 0, 0], [0, 0, 0.5, -0.6]]
    roof = triangle(
        (0.4, -0.8, -1),
        (2, -0.6, 0.2),
        (1, 0.9, -0.4),
        normals=np.array([(0, 0, 1), (0.8, 0, 0.6), (0, 0.6, 0.8)], np.float32),
        colors=np.array([(1, 0, 0), (0, 1, 0), (0.2, 0.4, 1)], np.float32),
    )
    return Scene(
        (
            SceneObject(floor, replace(CHECKERED, checker=Checker((0, 0, 0), 1.0))),
            SceneObject(Mesh(corners, faces, transform=turned), CHECKERED),
            SceneObject(roof, Material((0.8, 0.8, 0.8), (0.3, 0.3, 0.3), 20)),
            SceneObject(Sphere((0.2, -0.3, 0.6), 0.7), CHECKERED),
            SceneObject(Sphere((0.2, -0.3, 0.6), 0.3), Material((0.9, 0.1, 0.1))),
        ),
        (PointLight((3, 4, 5)), DirectionalLight((1, -2, -0.5), (0.4, 0.5, 0.6))),
        background=(0.1, 0.2, 0.3),
    )


def agrees(rasterizer, scene, camera, size=SIZE):
    """Draws, and compares with float64: no pixel may differ without a line of the image near it.
    Returns the frame."""
    rasterizer.set_scene(scene)
    frame = rasterizer.render(camera, size, CHANNELS)
    result = compare_frames(flatten(scene), camera, size, frame, reference(scene, camera, size))
    assert result.unexplained == 0, result.summary()
    return frame


class TestAnalytic:
    def test_a_sphere_ahead(self, rasterizer):
        rasterizer.set_scene(Scene((SceneObject(Sphere((0, 0, -5), 3.0)),)))
        frame = rasterizer.render(Camera(), (3, 3), CHANNELS)
        assert frame.depth[1, 1] == pytest.approx(2, rel=1e-6)
        np.testing.assert_allclose(frame.normal[1, 1], (0, 0, 1), atol=1e-6)
        assert frame.id[1, 1] == 0
        assert frame.primitive[1, 1] == 0
        # The corners' rays: |(1/3, 1/3, -1) t - (0, 0, -5)| = 3.
        a, b, c = 11 / 9, -10, 16
        t = (-b - np.sqrt(b * b - 4 * a * c)) / (2 * a)
        np.testing.assert_allclose(frame.depth[::2, ::2], t, rtol=1e-6)

    def test_depth_is_the_ray_parameter_not_a_distance(self, rasterizer):
        """A plane across the view has one depth everywhere; so it has in multiples of d."""
        rasterizer.set_scene(Scene((SceneObject(square(100, -6.0)),)))
        frame = rasterizer.render(replace(WIDE, distance=1.5), SIZE)
        np.testing.assert_allclose(frame.depth, 4, rtol=1e-6)
        np.testing.assert_allclose(frame.normal, np.broadcast_to((0, 0, 1), (36, 48, 3)), atol=1e-6)
        parallel = replace(WIDE, projection="parallel", w=(0, 0, 2))
        np.testing.assert_allclose(rasterizer.render(parallel, SIZE).depth, 3, rtol=1e-6)

    def test_a_triangle_covers_the_pixels_whose_centres_project_into_it(self, rasterizer):
        corners = np.array([(-0.51, -0.38, -1), (0.63, -0.22, -2), (0.1, 0.57, -1.5)])
        rasterizer.set_scene(Scene((SceneObject(triangle(*corners)),)))
        seen = rasterizer.render(WIDE, SIZE).id == 0
        row, column, _ = WIDE.project(corners, SIZE)
        i, j = np.mgrid[: SIZE[1], : SIZE[0]]
        sides = []
        for k in range(3):
            along_i, along_j = row[k - 1] - row[k], column[k - 1] - column[k]
            across = (i - row[k]) * along_j - (j - column[k]) * along_i
            sides.append(across / np.hypot(along_i, along_j))
        inside = np.min(np.multiply(sides, np.sign(np.sum(sides, 0))), axis=0)
        assert seen[inside > 1 / 128].all()
        assert not seen[inside < -1 / 128].any()
        assert 100 < seen.sum() < seen.size / 2

    def test_row_0_is_the_top_and_column_0_the_left(self, rasterizer):
        corner = Sphere((-0.7, 0.5, -1), 0.05)
        rasterizer.set_scene(Scene((SceneObject(corner),)))
        frame = rasterizer.render(WIDE, SIZE)
        rows, columns = np.nonzero(frame.id == 0)
        assert rows.max() < SIZE[1] / 4
        assert columns.max() < SIZE[0] / 4

    def test_an_empty_scene_is_background(self, rasterizer):
        rasterizer.set_scene(Scene((), background=(0.25, 0.5, 2.0)))
        frame = rasterizer.render(WIDE, (5, 3), CHANNELS)
        assert (frame.color == (0.25, 0.5, 2.0)).all()
        assert np.isposinf(frame.depth).all()
        assert (frame.normal == 0).all()
        assert (frame.id == -1).all()
        assert (frame.primitive == -1).all()

    def test_nothing_behind_the_eye_is_seen(self, rasterizer):
        behind = SceneObject(Sphere((0, 0, 3))), SceneObject(square(5, 2.0))
        rasterizer.set_scene(Scene(behind))
        for projection in ("perspective", "parallel"):
            assert (rasterizer.render(replace(WIDE, projection=projection), SIZE).id == -1).all()

    def test_the_first_of_two_equal_surfaces_wins(self, rasterizer):
        rasterizer.set_scene(Scene(tuple(SceneObject(square(5, -2.0)) for _ in range(3))))
        assert (rasterizer.render(WIDE, SIZE).id == 0).all()

    def test_a_triangle_without_area_is_not_seen(self, rasterizer):
        line = triangle((-1, 0, -2), (0, 0, -2), (1, 0, -2))
        point = triangle((0, 0, -2), (0, 0, -2), (0, 0, -2))
        rasterizer.set_scene(Scene((SceneObject(line), SceneObject(point))))
        assert (rasterizer.render(WIDE, (7, 7)).id == -1).all()

    def test_lights_and_materials(self, rasterizer):
        """A plane lit from behind the eye: Lambert's cosine is 1, and so is the highlight."""
        material = Material((0.5, 0.25, 1.0), (0.1, 0.2, 0.3), 7)
        scene = Scene(
            (SceneObject(square(9, -2.0), material),),
            (DirectionalLight((0, 0, -1), (2, 2, 2)), PointLight((0, 0, 5), (1, 0, 0))),
            ambient=(0.2, 0.2, 0.2),
        )
        rasterizer.set_scene(scene)
        color = rasterizer.render(Camera(), (1, 1), ("color",)).color[0, 0]
        expected = 0.2 * np.array((0.5, 0.25, 1)) + 2 * np.array((0.6, 0.45, 1.3)) + (0.6, 0, 0)
        np.testing.assert_allclose(color, expected, rtol=1e-6)


SKEWED = {"u": (1, 0.2, 0), "v": (-0.3, 0.8, 0.1), "w": (0.2, 0.1, 1.3)}
CAMERAS = {
    "canonical": replace(WIDE, eye=(0, 0, 5)),
    "from above": Camera.look_at((4, 5, 6), (0, 0, 0), fov_y_deg=35, aspect=4 / 3),
    "skewed": replace(WIDE, eye=(0.8, 0.3, 5), **SKEWED),
    "left-handed": replace(WIDE, eye=(0, 0.5, 5), u=(-1, 0, 0)),
    "left-handed, skewed, scaled": Camera((1, 0.5, 6), (0.1, 9, 0), (7, 0.2, 1), (0.3, 0.1, 0.4)),
    "off-axis": replace(WIDE, eye=(3, 0, 5), viewport=(-1.2, 0.1, -0.2, 0.5)),
    "inside a sphere": Camera.look_at((0.25, -0.3, 0.2), (0.5, 0, 0), fov_y_deg=100),
    "inside two spheres": Camera.look_at((0.25, -0.3, 0.7), (0.5, 0, 0), fov_y_deg=100),
    "inside the box": Camera.look_at((-1.2, 0.1, -0.6), (0, 0, 0.3), fov_y_deg=110),
    "close to the floor": Camera.look_at((2, -0.998, 3), (0, -0.99, 0), fov_y_deg=50),
    "close to a sphere": Camera.look_at((0.2, -0.3, 1.3005), (0.4, -0.2, 0), fov_y_deg=90),
    "telephoto": Camera.look_at((90, 120, 260), (0, -0.3, 0), fov_y_deg=1),
    "along the floor": replace(WIDE, eye=(0, -1, 5)),
}


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize("name", CAMERAS)
def test_every_camera_agrees_with_float64(rasterizer, name, projection):
    camera = replace(CAMERAS[name], projection=projection)
    if projection == "parallel":
        camera = replace(camera, viewport=tuple(3 * edge for edge in camera.viewport))
    agrees(rasterizer, still_life(), camera)


def test_normals_that_disagree_with_the_winding_are_turned(rasterizer):
    """What counts is the side that is seen: neither the winding nor the normals' sign shows."""
    corners = np.array([(-1, -1, -3), (1, -1, -2.5), (0, 1, -2)])
    normals = np.array([(-0.6, 0, 0.8), (0.6, 0, 0.8), (0, 0.6, 0.8)])
    light = (PointLight((1, 2, 3)),)
    frames = []
    for order in ([0, 1, 2], [0, 2, 1]):
        for sign in (1, -1):
            mesh = Mesh(corners, np.array([order]), normals=sign * normals)
            rasterizer.set_scene(Scene((SceneObject(mesh),), light))
            frames.append(rasterizer.render(WIDE, SIZE))
    assert (frames[0].id == 0).sum() > 200
    assert (frames[0].normal[frames[0].id == 0][:, 2] > 0.5).all()
    for frame in frames[1:]:
        both = (frame.id == 0) & (frames[0].id == 0)
        np.testing.assert_allclose(frame.normal[both], frames[0].normal[both], atol=1e-5)
        np.testing.assert_allclose(frame.color[both], frames[0].color[both], atol=1e-5)


class TestParts:
    """An image drawn in several calls is that of one call."""

    @pytest.mark.parametrize("count", [1, 5, 1000])
    def test_parts_make_the_same_image(self, rasterizer, count):
        rasterizer.set_scene(still_life())
        expected = rasterizer.render(WIDE, SIZE, CHANNELS)
        first, is_seen, other = 0, False, Camera(eye=(1.0, 2.0, 9.0))
        while not is_seen:
            assert first < rasterizer.triangles
            is_seen = rasterizer.see(WIDE, SIZE, "parts", first, count)
            first += count
            rasterizer.draw(other, (20, 10), "another camera's, in between")
        for row in range(0, SIZE[1], 7):
            rasterizer.shade(WIDE, SIZE, "parts", (row, min(row + 7, SIZE[1])))
            rasterizer.draw(other, SIZE, "another camera's, in between")
        for channel, values in rasterizer.read(CHANNELS, place="parts").items():
            np.testing.assert_array_equal(values, expected.channel(channel))

    def test_a_scene_without_triangles_is_one_part(self, rasterizer):
        rasterizer.set_scene(Scene((SceneObject(Sphere((0, 0, -5), 3.0)),)))
        assert rasterizer.triangles == 0
        assert rasterizer.see(WIDE, SIZE, "parts", 0, 0)

    def test_rows_are_shaded_and_no_others(self, rasterizer):
        rasterizer.set_scene(still_life())
        expected = rasterizer.render(WIDE, SIZE, CHANNELS)
        rasterizer.draw(Camera(eye=(1.0, 2.0, 9.0)), SIZE, "rows")
        before = rasterizer.read(CHANNELS, place="rows")
        assert rasterizer.see(WIDE, SIZE, "rows", 0, rasterizer.triangles)
        rasterizer.shade(WIDE, SIZE, "rows", (5, 11))
        after = rasterizer.read(("color",), place="rows")["color"]
        np.testing.assert_array_equal(after[5:11], expected.color[5:11])
        others = [row for row in range(SIZE[1]) if not 5 <= row < 11]
        np.testing.assert_array_equal(after[others], before["color"][others])
        assert (after[others] != expected.color[others]).any()


class TestClipping:
    def test_near_and_far_are_obeyed(self, rasterizer):
        scene = Scene(tuple(SceneObject(square(9, z)) for z in (-1.0, -2.0, -3.0)))
        rasterizer.set_scene(scene)

        def seen(**limits):
            return set(rasterizer.render(replace(WIDE, **limits), (4, 4)).id.ravel().tolist())

        for projection in ("perspective", "parallel"):
            camera = {"distance": 0.5, "projection": projection}
            assert seen(**camera) == {0}
            assert seen(near=0.99, **camera) == {0}
            assert seen(near=1.01, **camera) == {1}
            assert seen(near=1.01, far=1.99, **camera) == {-1}
            assert seen(near=2.5, far=3.5, **camera) == {2}
            assert seen(near=3.01, **camera) == {-1}
            assert seen(far=0.5, **camera) == {-1}

    def test_near_opens_a_sphere_and_shows_its_inside(self, rasterizer):
        scene = Scene((SceneObject(Sphere((0, 0, -3), 1.0)),))
        frame = agrees(rasterizer, scene, replace(WIDE, near=3.0))
        assert frame.depth[18, 24] == pytest.approx(4, rel=1e-2)
        assert frame.normal[18, 24, 2] == pytest.approx(1, abs=1e-2)

    def test_a_surface_is_cut_where_the_ray_parameter_says_so(self, rasterizer):
        for projection in ("perspective", "parallel"):
            camera = Camera.look_at((4, 5, 6), (0, 0, 0), fov_y_deg=35, projection=projection)
            if projection == "parallel":
                camera = replace(camera, viewport=(-2, 2, -2, 2))
            agrees(rasterizer, still_life(), replace(camera, near=8.0, far=10.0))

    def test_parallel_rays_begin_at_the_eyes_plane(self, rasterizer):
        inside = replace(WIDE, eye=(0, 0, 0.3), projection="parallel", viewport=(-2, 2, -2, 2))
        frame = agrees(rasterizer, still_life(), inside)
        assert frame.depth.min() > 0


class TestSizesAndScenes:
    def test_odd_sizes_and_single_pixels(self, rasterizer):
        for size in ((1, 1), (1, 37), (61, 1), (17, 5)):
            agrees(rasterizer, still_life(), CAMERAS["from above"], size)

    def test_a_very_wide_image(self, rasterizer):
        rasterizer.set_scene(still_life())
        frame = rasterizer.render(CAMERAS["from above"], (16384, 2), ("id",))
        assert frame.id.shape == (2, 16384)

    def test_sizes_and_scenes_can_change_at_every_frame_and_leave_nothing(self, rasterizer):
        """moderngl keeps in ctx.objects what Python has dropped without releasing it."""
        camera = CAMERAS["from above"]
        with rasterizer.current() as gl:
            gl.gc_mode = "context_gc"
        for k in range(12):
            if k % 3 == 0:
                rasterizer.set_scene(still_life())
            size = (20 + k, 40 - k)
            assert rasterizer.draw(camera, size).color.size == size
            assert rasterizer.render(camera, size[::-1], ("id",)).id.shape == size
        gc.collect()
        left = [name for thing in gl.objects if (name := type(thing).__name__) != "InvalidObject"]
        gl.gc_mode = None
        assert left == []

    def test_the_same_size_is_not_allocated_again(self, rasterizer):
        rasterizer.set_scene(still_life())
        first = rasterizer.draw(CAMERAS["skewed"], SIZE)
        assert rasterizer.draw(CAMERAS["off-axis"], SIZE) is first

    def test_another_scene_and_back(self, rasterizer):
        camera = CAMERAS["from above"]
        before = agrees(rasterizer, still_life(), camera)
        agrees(rasterizer, Scene((SceneObject(Sphere()),)), camera)
        agrees(rasterizer, Scene((SceneObject(square(2)),)), camera)
        assert (agrees(rasterizer, still_life(), camera).color == before.color).all()

    def test_a_scene_that_is_refused_leaves_the_old_one(self, rasterizer):
        rasterizer.set_scene(Scene((SceneObject(Sphere((0, 0, -5))),)))
        too_far = np.eye(4) * 1e12
        too_far[3, 3] = 1
        huge = Mesh(square(1).vertices * 1e6, square(1).faces, transform=too_far)
        with pytest.raises(LucidaError):
            rasterizer.set_scene(Scene((SceneObject(huge),)))
        assert rasterizer.render(Camera(), (1, 1)).id[0, 0] == 0

    def test_many_objects(self, rasterizer):
        """More than one row of a table: 8 texels an object, 4096 a row."""
        n = 30
        spheres = [
            SceneObject(Sphere((x - n / 2 + 0.5, y - n / 2 + 0.5, -n), 0.4), name=f"{x} {y}")
            for y in range(n)
            for x in range(n)
        ]
        rasterizer.set_scene(Scene(tuple(spheres)))
        ids = rasterizer.render(
            Camera(projection="parallel", viewport=(-15, 15, -15, 15)), (n, n)
        ).id
        np.testing.assert_array_equal(ids, np.arange(n * n).reshape(n, n)[::-1])

    def test_many_triangles(self, rasterizer):
        """More than one row of the table of triangles."""
        n = 70
        y, x = np.mgrid[: n + 1, : n + 1] - n / 2
        corners = np.stack([x, y, np.full_like(x, -1)], axis=-1).reshape(-1, 3)
        a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
        faces = np.stack([[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]], axis=0)
        faces = faces.transpose(2, 0, 1).reshape(-1, 3)
        rasterizer.set_scene(Scene((SceneObject(Mesh(corners, faces)),)))
        camera = Camera(projection="parallel", viewport=(-35 + 0.2, 35 + 0.2, -35, 35))
        frame = rasterizer.render(camera, (n, n), ("primitive", "depth"))
        np.testing.assert_allclose(frame.depth[:, :-1], 1, rtol=1e-6)
        squares = np.arange(n * n).reshape(n, n)[::-1]
        np.testing.assert_array_equal(frame.primitive[:, :-1], 2 * squares[:, :-1])

    @pytest.mark.parametrize(
        ("arguments", "told"),
        [
            ({"size": (0, 5)}, "size"),
            ({"size": (20000, 5)}, "size"),
            ({"size": "big"}, "size"),
            ({"channels": ("colour",)}, "channel"),
            ({"samples": 5}, "samples"),
        ],
    )
    def test_wrong_arguments_are_one_line(self, rasterizer, arguments, told):
        with pytest.raises(LucidaError, match=told) as caught:
            rasterizer.render(**{"camera": WIDE, "size": (4, 4), **arguments})
        assert "\n" not in str(caught.value)

    def test_only_what_is_asked_for(self, rasterizer):
        frame = rasterizer.render(WIDE, (2, 2), channels=("depth",))
        assert frame.color is None
        assert frame.depth is not None
        assert frame.depth.dtype == np.float32
        assert frame.time_s > 0


def test_slivers_keep_to_the_colours_of_their_corners(rasterizer):
    """Vertices are snapped to a fraction of a pixel: a centre may lie outside of what covers it."""
    rng = np.random.default_rng(1)
    corners = rng.uniform(-1, 1, (400, 3, 3)) - (0, 0, 3)
    corners[:, 2] = corners[:, 1] + rng.normal(scale=0.004, size=(400, 3))
    colors = np.tile(np.eye(3), (400, 1))  # the colour is the barycentrics
    mesh = Mesh(corners.reshape(-1, 3), np.arange(1200).reshape(-1, 3), colors=colors)
    white = Material((1, 1, 1))
    rasterizer.set_scene(Scene((SceneObject(mesh, white),), ambient=(1, 1, 1)))
    frame = rasterizer.render(WIDE, (200, 150))
    seen = frame.color[frame.id == 0]
    assert len(seen) > 1000
    assert seen.min() >= 0
    np.testing.assert_allclose(seen.sum(axis=1), 1, atol=1e-6)


def test_samples_are_averaged_in_linear_light(rasterizer):
    scene = still_life()
    rasterizer.set_scene(scene)
    camera = CAMERAS["from above"]
    fine = rasterizer.render(camera, (96, 72), ("color",)).color
    coarse = rasterizer.render(camera, (48, 36), samples=4)
    mean = fine.reshape(36, 2, 48, 2, 3).mean(axis=(1, 3))
    assert np.median(np.abs(coarse.color - mean)) < 1e-6
    assert (np.abs(coarse.color - mean).max(axis=2) < 1e-3).mean() > 0.98
    np.testing.assert_array_equal(coarse.id, rasterizer.render(camera, (48, 36)).id)


def test_a_scene_prepared_in_another_thread_is_drawn_the_same(rasterizer):
    scene = still_life()
    rasterizer.set_scene(scene)
    expected = rasterizer.render(WIDE, SIZE, CHANNELS)
    with ThreadPoolExecutor(1) as pool:
        prepared = pool.submit(prepare, scene).result()
    rasterizer.set_scene(Scene(()))
    rasterizer.set_scene(scene, prepared)
    again = rasterizer.render(WIDE, SIZE, CHANNELS)
    for channel in CHANNELS:
        np.testing.assert_array_equal(again.channel(channel), expected.channel(channel))
