"""The outside view's geometry: the camera as a solid thing, the camera that looks, the diagram on
the screen. Against the camera's own arithmetic."""

from __future__ import annotations

import math
import threading
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from app.outside.diagram import Arrow, Label, RayEnd, Segments, diagram, polyline
from app.outside.extent import end_parameter, framed, outside_camera
from app.outside.frustum import (
    MOST_GRID_LINES,
    bundle_pixels,
    grid,
    grid_step,
    pixel_corners,
    pixel_seen,
    plane_corners,
    plane_parameter,
    point_at,
    rectangle,
)
from app.outside.gizmo import (
    gl_matrices,
    motion,
    nearest_rotation,
    rotation_between,
    rotation_of,
)
from app.outside.hits import RayHits, RayQuery
from app.outside.options import OutsideOptions
from app.outside.projected import Shape, Strokes, Text, project
from app.outside.screen import OutsideScreen
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.raster.overlay import plane_on_screen, screen_from_world
from renderer.scene.model import Scene

SIZE = (64, 48)
LOOKING = Camera.look_at((4.0, 3.0, 6.0), (0.0, 0.0, -1.0), fov_y_deg=40.0, aspect=4 / 3)

numbers = st.floats(-2, 2, allow_nan=False)
vectors = st.tuples(numbers, numbers, numbers)


@st.composite
def cameras(draw: st.DrawFn) -> Camera:
    """Skewed, scaled, left-handed, off-axis ones too; none that is nearly singular."""
    left, bottom = draw(numbers), draw(numbers)
    try:
        camera = Camera(
            eye=draw(vectors),
            u=draw(vectors),
            v=draw(vectors),
            w=draw(vectors),
            distance=draw(st.floats(0.1, 5)),
            viewport=(
                left,
                left + draw(st.floats(0.1, 3)),
                bottom,
                bottom + draw(st.floats(0.1, 3)),
            ),
            projection=draw(st.sampled_from(["perspective", "parallel"])),
        )
    except LucidaError:
        assume(False)
        raise
    lengths = np.linalg.norm(camera.basis, axis=0)
    assume(lengths.min() > 0.1 and abs(camera.determinant) > 0.05 * lengths.prod())
    return camera


def looking_cameras() -> list[Camera]:
    parallel = replace(LOOKING, projection="parallel", viewport=(-5, 5, -4, 4))
    skewed = replace(LOOKING, u=(1.0, 0.3, -0.5), w=(0.5, 0.4, 0.9))
    mirrored = replace(LOOKING, u=tuple(-np.asarray(LOOKING.u)))
    return [LOOKING, parallel, skewed, mirrored]


class TestSolid:
    @given(cameras(), st.floats(0.2, 20))
    def test_the_volumes_corners_are_the_images(self, camera: Camera, t: float) -> None:
        row, column, parameter = camera.project(rectangle(camera, t), SIZE)
        assert np.allclose(row, [-0.5, -0.5, 47.5, 47.5], atol=1e-5)
        assert np.allclose(column, [-0.5, 63.5, 63.5, -0.5], atol=1e-5)
        assert np.allclose(parameter, t, rtol=1e-7)

    @given(cameras(), st.integers(0, 47), st.integers(0, 63), st.floats(0, 10))
    def test_points_lie_on_rays(self, camera: Camera, i: int, j: int, t: float) -> None:
        ray = camera.ray(i, j, SIZE)
        x, y = camera.image_point(i, j, SIZE)
        assert np.allclose(point_at(camera, x, y, t), ray.origin + t * ray.direction)
        middle = pixel_corners(camera, (i, j), SIZE).mean(axis=0)
        assert np.allclose(middle, ray.origin + plane_parameter(camera) * ray.direction)

    @given(cameras(), st.integers(0, 47), st.integers(0, 63), vectors)
    def test_a_pixel_is_found_from_anywhere(
        self, camera: Camera, i: int, j: int, origin: tuple[float, float, float]
    ) -> None:
        target = pixel_corners(camera, (i, j), SIZE).mean(axis=0)
        way = target - np.asarray(origin)
        corners = plane_corners(camera)
        normal = np.cross(corners[1] - corners[0], corners[3] - corners[0])
        steep = abs(normal @ way) / (np.linalg.norm(normal) * max(np.linalg.norm(way), 1e-9))
        assume(steep > 0.05)
        assert pixel_seen(camera, SIZE, np.asarray(origin), way) == (i, j)
        assert pixel_seen(camera, SIZE, np.asarray(origin), -way) is None
        # The plane is met at 1: something that stands before it hides it.
        assert pixel_seen(camera, SIZE, np.asarray(origin), way, lambda: 0.99) is None
        assert pixel_seen(camera, SIZE, np.asarray(origin), way, lambda: 1.01) == (i, j)

    def test_no_pixel_beside_the_plane_nor_along_it(self) -> None:
        camera = Camera.canonical()
        away = np.array([0.0, 0.0, -1.0])
        assert pixel_seen(camera, SIZE, np.array([0.51, 0.0, 0.0]), away) is None
        assert pixel_seen(camera, SIZE, np.array([0.0, 0.0, -1.0]), np.array([1.0, 0, 0])) is None

    @pytest.mark.parametrize(
        ("size", "step"),
        [((4, 3), 1), ((32, 32), 1), ((33, 20), 2), ((640, 480), 20), ((4096, 2160), 200)],
    )
    def test_the_grid_is_thinned_to_round_steps(self, size: tuple[int, int], step: int) -> None:
        assert grid_step(size) == step
        lines = grid(Camera.canonical(), size)
        columns, rows = math.ceil(size[0] / step) - 1, math.ceil(size[1] / step) - 1
        assert len(lines) == columns + rows
        assert max(columns, rows) <= MOST_GRID_LINES
        if columns:  # a line stands at the left edge of the column `step`
            _, at, _ = Camera.canonical().project(lines[0], size)
            assert np.allclose(at, step - 0.5)

    def test_a_bundle_covers_the_image_evenly(self) -> None:
        assert bundle_pixels((100, 60), (2, 4)).tolist() == [
            [15, 12], [15, 37], [15, 62], [15, 87], [45, 12], [45, 37], [45, 62], [45, 87],
        ]  # fmt: skip
        assert len(bundle_pixels((3, 2), (16, 16))) == 6  # no pixel twice
        assert len(bundle_pixels((3, 2), (0, 5))) == 0


class TestTheCameraThatLooks:
    @given(
        st.lists(vectors, min_size=1, max_size=20),
        cameras(),
        st.floats(0.3, 3),
        st.sampled_from([1e-6, 1.0, 1e6]),
    )
    def test_sees_all_points(
        self, points: list[Any], home: Camera, aspect: float, scale: float
    ) -> None:
        world = np.array(points) * scale
        camera = outside_camera([world], home, aspect)
        row, column, parameter = camera.project(world, (1000, 1000))
        assert (parameter > 0).all()
        assert (np.abs(row - 499.5) <= 500.5).all()
        assert (np.abs(column - 499.5) <= 500.5).all()

    @pytest.mark.parametrize("projection", ["perspective", "parallel"])
    def test_is_as_near_as_it_can_be(self, projection: str) -> None:
        points = np.array([[x, y, z] for x in (-1, 1) for y in (-2, 2) for z in (-3, 3)], float)
        for way in ((1.0, 0, 0), (0, 1.0, 0), (0, 0, -1.0), (0.6, 0, 0.8)):
            camera = framed(points, np.array(way), 1.5, projection)
            assert np.allclose(camera.w, way)
            row, column, _ = camera.project(points, (1000, 1000))
            extent = max(np.ptp(row), np.ptp(column))
            assert 850 < extent < 1000

    def test_nothing_to_see_is_no_error(self) -> None:
        camera = outside_camera([np.zeros((0, 3)), np.full((2, 3), np.nan)], LOOKING, 1.0)
        assert np.isfinite(camera.basis).all()

    def test_the_scene_ends_behind_its_last_point(self) -> None:
        points = np.array([[0, 0, -3.0], [1, 1, -8.0], [0, 0, 5.0]])
        assert 8.0 < end_parameter(Camera.canonical(), points) < 8.5
        parallel = replace(Camera.canonical(), projection="parallel", w=(0, 0, 2.0))
        assert 4.0 < end_parameter(parallel, points) < 4.3
        assert end_parameter(Camera.canonical(), np.zeros((0, 3))) > 1
        assert end_parameter(Camera.canonical(), -points[:2]) > 1


class TestScreen:
    @pytest.mark.parametrize("camera", looking_cameras())
    def test_points_are_where_the_camera_has_them(self, camera: Camera) -> None:
        screen = OutsideScreen(camera, SIZE)
        for point in np.random.default_rng(1).uniform(-1, 1, (20, 3)):
            row, column, parameter = camera.project(point, SIZE)
            found = screen.spot(point)
            assert found is not None
            at, depth = found
            assert np.allclose(at, (column + 0.5, row + 0.5))
            assert np.isclose(depth, parameter if camera.is_parallel else 1 / parameter)

    @given(cameras(), st.lists(st.tuples(vectors, vectors), min_size=1, max_size=10))
    def test_segments_are_cut_to_the_guard(self, camera: Camera, ends: list[Any]) -> None:
        screen = OutsideScreen(camera, SIZE, 1e-3)
        world = 3 * np.array(ends)
        points, depth, numbers = screen.segments(world)
        assert np.isfinite(points).all()
        assert np.isfinite(depth).all()
        assert (np.abs(points - np.array(SIZE) / 2) <= 4.001 * np.array(SIZE) / 2).all()
        assert (depth > 0).all()
        for segment, number in zip(points, numbers, strict=True):
            inside = [screen.spot(end) for end in world[number]]
            for end, spot in zip(segment, inside, strict=True):
                if spot is not None:
                    assert np.allclose(end, spot[0], atol=1e-6 * (1 + np.abs(spot[0]).max()))
        seen = {k for k, pair in enumerate(world) if any(screen.spot(p) is not None for p in pair)}
        assert seen <= set(numbers.tolist())

    def test_what_comes_from_behind_is_cut_where_it_appears(self) -> None:
        screen = OutsideScreen(Camera.canonical(), (100, 100), 0.5)
        points, depth, _ = screen.segments(np.array([[[0, 0, 5.0], [0.5, 0, -5.0]]]))
        # At t = 0.5 the segment is at x = 0.275; seen from the eye, 0.55 to the right of it.
        assert np.allclose(points[0, 0], (50 + 55, 50))
        assert np.allclose(depth[0], (2.0, 0.2))

    def test_a_polygon_round_the_viewer_is_cut(self) -> None:
        corners = np.array([[-9, -1, 9], [9, -1, 9], [9, -1, -9], [-9, -1, -9]], float)
        points, depth = OutsideScreen(Camera.canonical(), (100, 100), 0.1).polygon(corners)
        assert len(points) >= 3
        assert np.isfinite(points).all()
        assert (depth > 0).all()
        assert (points[:, 1] > 50).all()  # all of a floor is below the horizon

    def test_dashes_go_on_from_segment_to_segment(self) -> None:
        path = polyline(np.array([[-0.2, 0, -1], [0, 0, -1], [0.2, 0.1, -1]], float))
        (strokes,) = project(
            [Segments("l", "extra", path)], OutsideScreen(Camera.canonical(), (100, 100))
        )
        assert isinstance(strokes, Strokes)
        assert np.allclose(strokes.before, [0, 20])

    @pytest.mark.parametrize("camera", looking_cameras())
    def test_arrows_end_at_their_vectors_tips(self, camera: Camera) -> None:
        start, end = np.array([0, 0, -1.0]), np.array([0.4, 0.9, -0.5])
        screen = OutsideScreen(camera, (640, 480))
        parts = project([Arrow("u", "u", start, end)], screen)
        tip = screen.spot(end)
        assert tip is not None
        heads = [p for p in parts if isinstance(p, Shape) and p.name == "u head"]
        assert np.linalg.norm(heads[0].points - tip[0], axis=1).min() < 1e-6
        (shaft,) = (p for p in parts if isinstance(p, Strokes) and p.name == "u")
        assert np.linalg.norm(shaft.points[0, 1] - tip[0]) < 20

    def test_letters_stand_off_the_arrow_and_go_with_short_ones(self) -> None:
        screen = OutsideScreen(Camera.canonical(), (100, 100))
        origin = np.array([0.0, 0, -1])
        label = Label("v", "v", "v", np.array([0, 0.3, -1]), away=origin, strong=True, least=8.0)
        (text,) = project([label], screen)
        assert isinstance(text, Text)
        assert np.allclose(text.toward, (0, -1))  # up on the screen
        assert np.allclose(text.at, (50, 20))
        short = replace(label, point=np.array([0, 0.05, -1]))
        assert project([short], screen) == []
        behind = replace(label, point=np.array([0, 0, 1.0]))
        assert project([behind], screen) == []


class TestDiagram:
    def names(self, camera: Camera, options: OutsideOptions, **more: Any) -> set[str]:
        return {item.name for item in diagram(camera, SIZE, options, 9.0, **more)}

    def test_each_switch_has_its_lines(self) -> None:
        camera, none = Camera.canonical(), OutsideOptions(None, False, False, False, False, False)
        hit = RayEnd((3, 4), 2.5)
        assert self.names(camera, none, marked=hit) == {"eye"}
        for field, names in {
            "volume": {"edges", "side 0", "end"},
            "image": {"image plane"},
            "grid": {"grid", "image plane"},
            "basis": {"u", "v", "w"},
            "ray": {"ray", "pixel", "hit", "beyond"},
        }.items():
            assert names <= self.names(camera, replace(none, **{field: True}), marked=hit), field

    def test_near_and_far_are_drawn_where_they_are_set(self) -> None:
        camera = replace(Camera.canonical(), near=2.0, far=4.0)
        items = diagram(camera, SIZE, OutsideOptions(), 9.0)
        at = {item.name: item for item in items if isinstance(item, Segments)}
        assert np.allclose(at["near"].segments[..., 2], -2)
        assert np.allclose(at["far"].segments[..., 2], -4)
        assert {at["edges"].segments[..., 2].min(), at["edges"].segments[..., 2].max()} == {-4, -2}
        assert "end" not in at

    def test_a_ray_ends_where_it_hits_and_goes_on_pale(self) -> None:
        camera = Camera.canonical()
        items = diagram(camera, SIZE, OutsideOptions(), 9.0, marked=RayEnd((10, 20), 2.5))
        at = {item.name: item for item in items if isinstance(item, Segments)}
        ray = camera.ray(10, 20, SIZE)
        reached = ray.origin + 2.5 * ray.direction
        assert np.allclose(at["ray"].segments, [[ray.origin, reached]])
        assert np.allclose(at["beyond"].segments[0, 0], reached)
        for t in (None, math.inf):
            names = self.names(camera, OutsideOptions(), marked=RayEnd((10, 20), t))
            assert "hit" not in names
            assert "ray" in names

    def test_a_parallel_camera_has_a_box_and_rays_from_its_plane(self) -> None:
        camera = replace(Camera.canonical(), projection="parallel")
        items = diagram(camera, SIZE, OutsideOptions(), 9.0, marked=RayEnd((10, 20), 2.5))
        at = {item.name: item for item in items if isinstance(item, Segments)}
        edges = at["edges"].segments
        assert np.allclose(edges[:, 1] - edges[:, 0], (0, 0, -9))
        assert np.allclose(at["ray"].segments[0, 0, 2], 0)
        assert "distance" not in at

    @given(cameras(), cameras(), st.sampled_from([1e-5, 1.0, 1e7]))
    def test_any_camera_looks_at_any_other(
        self, camera: Camera, looking: Camera, scale: float
    ) -> None:
        try:
            camera = replace(camera, eye=tuple(scale * np.asarray(camera.eye)))
        except LucidaError:
            assume(False)
        options = OutsideOptions(bundle=(2, 2))
        hits = [RayEnd((1, 1), 2.0), RayEnd((5, 5), math.inf)]
        items = diagram(camera, SIZE, options, 5.0, hits, RayEnd((2, 2), 0.5))
        for at in (looking, camera):
            for part in project(items, OutsideScreen(at, SIZE, 1e-4)):
                if isinstance(part, Text):
                    assert np.isfinite((*part.at, *part.toward)).all()
                else:
                    assert np.isfinite(part.points).all()
                    assert np.isfinite(part.depth).all()


class TestPlane:
    @pytest.mark.parametrize("camera", looking_cameras())
    def test_the_screen_finds_the_places_of_the_picture(self, camera: Camera) -> None:
        inner = Camera.canonical()
        corners = plane_corners(inner)
        plane = plane_on_screen(camera, SIZE, corners[[0, 1, 3]], np.asarray(inner.eye))
        assert plane is not None
        matrix = screen_from_world(camera, SIZE)
        for x, y in ((0, 0), (1, 0), (0, 1), (0.3, 0.8)):
            point = corners[0] + x * (corners[1] - corners[0]) + y * (corners[3] - corners[0])
            spot = matrix @ [*point, 1]
            at = spot[:2] if camera.is_parallel else spot[:2] / spot[2]
            found = plane.from_screen @ [*at, 1]
            assert np.allclose(found[:2] / found[2], (x, y))
            depth = plane.depth @ [*at, 1]
            assert np.isclose(depth, spot[2] if camera.is_parallel else 1 / spot[2])

    def test_its_sides(self) -> None:
        inner = Camera.canonical()
        corners, eye = plane_corners(inner)[[0, 1, 3]], np.asarray(inner.eye)
        behind = Camera.look_at((0, 0, -3), (0, 0, 0))
        for camera, front in ((LOOKING, True), (behind, False)):
            plane = plane_on_screen(camera, SIZE, corners, eye)
            assert plane is not None
            assert plane.is_front == front
        edge_on = Camera.look_at((3, 0, -1), (0, 0, -1))
        assert plane_on_screen(edge_on, SIZE, corners, eye) is None


class TestHandles:
    @given(cameras(), vectors, st.floats(-3, 3))
    def test_a_turn_is_found_again_from_any_basis(
        self, camera: Camera, axis: tuple[float, float, float], angle: float
    ) -> None:
        assume(np.linalg.norm(axis) > 0.1)
        x, y, z = np.asarray(axis) / np.linalg.norm(axis)
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        turn = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
        basis = {name: tuple(turn @ getattr(camera, name)) for name in "uvw"}
        assert np.allclose(rotation_between(camera, replace(camera, **basis)), turn, atol=1e-6)

    @given(cameras())
    def test_handles_stand_in_a_right_handed_frame(self, camera: Camera) -> None:
        frame = rotation_of(camera)
        assert np.allclose(frame.T @ frame, np.eye(3))
        assert np.linalg.det(frame) > 0
        assert frame[:, 2] @ camera.w > 0

    def test_a_noisy_rotation_is_mended(self) -> None:
        noise = 1e-6 * np.random.default_rng(2).standard_normal((3, 3))
        mended = nearest_rotation(np.eye(3) + noise)
        assert np.allclose(mended.T @ mended, np.eye(3), atol=1e-14)
        assert np.allclose(mended, np.eye(3), atol=1e-5)

    def test_there_are_none_where_the_eye_is_not_well_in_front(self) -> None:
        for camera in looking_cameras():
            eye = np.asarray(camera.eye)
            assert gl_matrices(camera, eye - 5 * np.asarray(camera.w), 3.0) is not None
            assert gl_matrices(camera, eye, 3.0) is None
            assert gl_matrices(camera, eye + 5 * np.asarray(camera.w), 3.0) is None


class FakeTracer:
    """Answers when it is let to."""

    def __init__(self) -> None:
        self.go = threading.Event()
        self.asked: list[int] = []

    def closest_hits(
        self, origins: np.ndarray, directions: np.ndarray, t_min: float, t_max: float
    ) -> tuple[np.ndarray, np.ndarray]:
        assert self.go.wait(30)
        self.asked.append(len(origins))
        return np.full(len(origins), 7.0, np.float32), np.zeros(len(origins), np.int32)


def test_rays_are_asked_for_without_waiting() -> None:
    came, tracer = threading.Event(), FakeTracer()
    hits = RayHits(came.set)
    question = RayQuery(Scene(()), Camera.canonical(), SIZE, ((1, 2), (3, 4)))
    assert hits.ask(question, tracer) == {(1, 2): None, (3, 4): None}
    assert hits.busy
    tracer.go.set()
    assert came.wait(30)
    assert hits.ask(question, tracer) == {(1, 2): 7.0, (3, 4): 7.0}
    assert not hits.busy
    assert tracer.asked == [2]  # once
    came.clear()
    moved = replace(question, camera=LOOKING, pixels=((3, 4), (5, 6)))
    assert hits.ask(moved, tracer) == {(3, 4): 7.0, (5, 6): None}  # the last known, until it comes
    assert came.wait(30)
    assert hits.ask(moved, tracer) == {(3, 4): 7.0, (5, 6): 7.0}
    other = replace(question, scene=Scene(()))
    assert hits.ask(other, tracer) == {(1, 2): None, (3, 4): None}
    hits.close()


def test_a_motion_is_told_in_the_letters_of_the_basis() -> None:
    camera = Camera.look_at((2.0, 1.5, 5.0), (0.3, 0.0, 1.0))
    moved = replace(camera, eye=tuple(np.asarray(camera.eye) + 0.604 * np.asarray(camera.v)))
    assert motion(camera, moved) == "Δv 0.604"
    both = np.asarray(camera.eye) - 2 * np.asarray(camera.u) + 0.25 * np.asarray(camera.w)
    assert motion(camera, replace(camera, eye=tuple(both))) == "Δu -2  Δw 0.25"
    assert motion(camera, camera) == ""
    # In units of the basis, as the formulas have it: e + v with v twice as long.
    long = replace(camera, v=tuple(2 * np.asarray(camera.v)))
    assert motion(long, replace(long, eye=tuple(np.add(long.eye, long.v)))) == "Δv 1"


def test_a_turn_is_told_with_its_axis() -> None:
    camera = Camera(eye=(0.0, 0.0, 5.0))
    cosine, sine = np.cos(np.radians(30)), np.sin(np.radians(30))
    about_v = replace(camera, u=(cosine, 0.0, -sine), w=(sine, 0.0, cosine))
    assert motion(camera, about_v) == "about v: 30.0°"
    assert motion(about_v, camera) == "about v: -30.0°"
    about_w = replace(camera, u=(cosine, sine, 0.0), v=(-sine, cosine, 0.0))
    assert motion(camera, about_w) == "about w: 30.0°"
    askew = Camera.look_at((0.0, 0.0, 5.0), (5.0, 5.0, 0.0))
    assert motion(camera, askew).startswith("turned by ")
