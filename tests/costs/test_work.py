"""The counts of the cost plot, by hand where possible, and the words for them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.costs.growth import count_growth, per_doubling
from app.costs.model import Case, count, steps, torus_of
from app.costs.work import Counter, Work, pixels_tested
from app.explaining.projected import mesh_extent, pixels_of
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.scene.flat import flatten
from renderer.scene.model import Mesh, Scene, SceneObject
from renderer.scene.positions import world_vertices
from renderer.trace.jobs import counting
from renderer.trace.jobs.counting import counting_tree, trace_counts


def triangles(*corners: tuple[tuple[float, float, float], ...]) -> Scene:
    """A scene of one mesh."""
    points = np.array(corners, np.float32).reshape(-1, 3)
    faces = np.arange(len(points), dtype=np.int32).reshape(-1, 3)
    return Scene((SceneObject(Mesh(points, faces)),))


def work_of(scene: Scene, size: tuple[int, int], camera: Camera | None = None) -> Work:
    return Counter().work(scene, camera or Camera.canonical(), size)


# The canonical camera's image plane is z = -1, from -0.5 to 0.5: with 8 x 8 pixels, one is 0.125.
LEFT_HALF = ((-0.5, -0.5, -1), (0, -0.5, -1), (-0.5, 0.5, -1))
QUARTER = ((0, 0, -1), (0.5, 0, -1), (0, 0.5, -1))


def test_the_steps_of_one_triangle() -> None:
    # Its bounding box is the left half: 4 x 8 centres. The tree is a leaf, which each ray visits.
    assert work_of(triangles(LEFT_HALF), (8, 8)) == Work(1, 64, 1, 32, 64, 64, 64)


def test_what_lies_beside_the_image_is_set_up_but_not_tested() -> None:
    beside = ((3, 0, -1), (4, 0, -1), (3, 1, -1))
    half_out = ((0.25, -0.5, -1), (9, -0.5, -1), (0.25, 0.5, -1))
    between_centers = ((0.01, 0.01, -1), (0.05, 0.01, -1), (0.01, 0.05, -1))
    scene = triangles(beside, half_out, between_centers)
    work = work_of(scene, (8, 8))
    assert (work.set_up, work.tested) == (3, 2 * 8)


def test_centres_on_the_box_count() -> None:
    """From the second column's centre to the fourth's, from the fifth row's to the eighth's."""
    left, right, top, bottom = -0.3125, -0.0625, -0.0625, -0.4375
    scene = triangles(((left, bottom, -1), (right, bottom, -1), (left, top, -1)))
    assert pixels_tested(scene, Camera.canonical(), (8, 8)) == 3 * 4


def test_the_tree_of_a_scene_is_made_once(monkeypatch) -> None:
    made = []
    monkeypatch.setattr(counting, "counting_tree", lambda scene: made.append(scene))
    monkeypatch.setattr(counting, "trace_counts", lambda *_: counting.TraceCounts(1, 2, 3))
    counter, one, other = Counter(), triangles(LEFT_HALF), triangles(QUARTER)
    for scene in (one, one, other, other, one):
        counter.work(scene, Camera.canonical(), (8, 8))
    assert list(map(id, made)) == [id(one), id(other), id(one)]


def test_no_step_without_objects_but_the_rays() -> None:
    assert work_of(Scene(()), (8, 6)) == Work(0, 48, 0, 0, 48, 0, 0)


def test_nodes_of_two_heaps_apart() -> None:
    # Four triangles a leaf: two leaves and a root. Each ray visits the root; the 32 of the left
    # half meet the left box, 32 the right one, and none meets both.
    def heap(x: float) -> list:
        box = ((x, -0.49, -1), (x + 0.48, -0.49, -1), (x, 0.49, -1))
        return [tuple((a, b, c - 0.001 * k) for a, b, c in box) for k in range(4)]

    tree = counting_tree(triangles(*heap(-0.49), *heap(0.01)))
    assert len(tree.links) == 3
    counts = trace_counts(tree, Camera.canonical(), (8, 8))
    assert counts == (64, 64 + 64, 4 * 64)


def test_pixels_tested_are_those_that_the_stepper_would_visit() -> None:
    scene, size = torus_of(300), (31, 22)
    camera = Camera.canonical().fitted(size)
    skewed = replace(camera, distance=2.0, viewport=(0.0, 3.0, -2.0, 4.0))
    parallel = replace(camera, projection="parallel")
    look = Camera.look_at((0.4, 2, 3), (0, 0, -2)).fitted(size)
    for turned in (camera, look, skewed, parallel):
        flat = flatten(scene)
        points, expected = world_vertices(flat), 0
        for face in flat.faces:
            extent = mesh_extent(points[face], np.array([[0, 1, 2]]), turned)
            rows, columns = pixels_of(extent, turned, size)
            expected += len(rows) * len(columns)
        assert pixels_tested(scene, turned, size) == expected > 0


@pytest.mark.parametrize("z", [0, 1])
def test_a_scene_behind_the_eye_is_an_error(z: float) -> None:
    with pytest.raises(LucidaError, match="behind the eye"):
        work_of(triangles(((0, 0, -1), (1, 0, -1), (0, 0, z))), (8, 8))


def test_the_same_numbers_everywhere() -> None:
    case = Case("ray", 5000, 4800)
    work = work_of(torus_of(5000), case.size, Camera.canonical().fitted(case.size))
    assert work == work_of(torus_of(5000), case.size, Camera.canonical().fitted(case.size))
    assert work == Work(4970, 4800, 4970, 11701, 4800, 58873, 22411)


def test_what_both_loops_grow_with() -> None:
    counter, by_triangles, by_pixels = Counter(), [], []
    for n in steps(100, 200_000, 5):
        case = Case("ray", n, 4800)
        camera = Camera.canonical().fitted(case.size)
        by_triangles.append(counter.work(torus_of(n), camera, case.size))
        assert by_triangles[-1].triangles == count(torus_of(n))
    for pixels in steps(1200, 100_000, 5):
        case = Case("ray", 2000, pixels)
        camera = Camera.canonical().fitted(case.size)
        by_pixels.append(counter.work(torus_of(2000), camera, case.size))

    def growth(work: list[Work], n: str, of: str) -> str:
        return count_growth([(getattr(one, n), getattr(one, of)) for one in work], n)

    said = {of: growth(by_triangles, "triangles", of) for of in ("set_up", "tested", "rays")}
    assert said == {"set_up": "~ triangles", "tested": "the same", "rays": "the same"}
    assert growth(by_triangles, "triangles", "nodes") == "~ log triangles"
    nodes = [(one.triangles, one.nodes / one.rays) for one in by_triangles]
    assert 0.3 < per_doubling(nodes) < 1.5
    assert growth(by_pixels, "pixels", "set_up") == "the same"
    for of in ("tested", "rays", "nodes"):
        assert growth(by_pixels, "pixels", of) == "~ pixels"
