"""Outlines against their definition: the edges between visible and hidden surfaces."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
import pytest
import trimesh

from lucida.app.instruments.objects import silhouette
from lucida.app.instruments.objects.silhouette import outer, outline_of, outlines_of
from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Mesh, SceneObject, Sphere
from lucida.renderer.scene.shapes import box

CAMERAS = (
    Camera.look_at((3, 2, 5), (0.1, 0, 0.2), fov_y_deg=40),
    Camera.look_at((-4, 1.5, 0.7), (0, 0, 0), projection="parallel"),
)


def sheet(rng: np.random.Generator, turned: float, shared: bool = True) -> Mesh:
    """Return a bumpy grid of triangles. turned: the share that is wound the other way. shared: True
    if neighbours share vertices, not only positions."""
    count = 9
    x, z = np.meshgrid(np.linspace(-1, 1, count), np.linspace(-1, 1, count))
    y = rng.normal(scale=0.3, size=x.shape)
    places = np.stack([x, y, z], axis=-1).reshape(-1, 3).astype(np.float32)
    at = np.arange(count * count).reshape(count, count)
    a, b, c, d = at[:-1, :-1], at[:-1, 1:], at[1:, :-1], at[1:, 1:]
    faces = np.concatenate(
        [np.stack([a, b, c], -1).reshape(-1, 3), np.stack([b, d, c], -1).reshape(-1, 3)]
    )
    return wound(rng, places, faces, turned, shared)


def wound(
    rng: np.random.Generator, places: np.ndarray, faces: np.ndarray, turned: float, shared: bool
) -> Mesh:
    back = rng.uniform(size=len(faces)) < turned
    faces = np.where(back[:, None], faces[:, ::-1], faces)
    if not shared:
        places, faces = places[faces.ravel()], np.arange(faces.size).reshape(-1, 3)
    transform = np.eye(4)
    transform[:3, :3] = np.linalg.qr(rng.normal(size=(3, 3)))[0] * (1.0, 2.0, 0.5)
    transform[:3, 3] = (0.2, -0.1, 0.3)
    return Mesh(places, faces.astype(np.int32), transform=transform)


def by_definition(mesh: Mesh, camera: Camera) -> tuple[set, set]:
    """Return the borders, and the edges whose triangles' third corners are all on one side of the
    plane through the edge and the eye, however the triangles are wound."""
    world = mesh.vertices.astype(float) @ mesh.transform[:3, :3].T + mesh.transform[:3, 3]
    sides = defaultdict(list)
    for face in mesh.faces:
        for k in range(3):
            ends = [tuple(mesh.vertices[face[(k + n) % 3]].tolist()) for n in range(3)]
            start, end, third = (world[face[(k + n) % 3]] for n in range(3))
            toward_eye = camera.w if camera.is_parallel else np.asarray(camera.eye) - start
            if ends[0] > ends[1]:
                start, end = end, start
            normal = np.cross(end - start, toward_eye)
            sides[tuple(sorted(ends[:2]))].append(bool(normal @ (third - start) > 0))
    borders = {edge for edge, found in sides.items() if len(found) == 1}
    turning = {edge for edge, found in sides.items() if len(set(found)) == 1}
    return borders, turning


def drawn(mesh: Mesh, camera: Camera) -> set:
    segments, _ = outline_of(SceneObject(mesh, Material()), camera)
    back = np.linalg.inv(mesh.transform)
    local = segments @ back[:3, :3].T + back[:3, 3]
    places = {tuple(place) for place in mesh.vertices.tolist()}
    known = np.array(sorted(places))
    found = set()
    for ends in local:
        near = [known[np.abs(known - end).sum(axis=1).argmin()] for end in ends]
        assert np.allclose(near, ends, atol=1e-9)
        found.add(tuple(sorted(tuple(end.tolist()) for end in near)))
    return found


@pytest.mark.parametrize("camera", CAMERAS, ids=["perspective", "parallel"])
@pytest.mark.parametrize("turned", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("shared", [True, False], ids=["shared", "apart"])
def test_a_surface_s_outline_is_by_definition_however_it_is_wound(camera, turned, shared):
    rng = np.random.default_rng(7)
    for _ in range(3):
        mesh = sheet(rng, turned, shared)
        borders, turning = by_definition(mesh, camera)
        assert turning - borders  # the surface folds
        assert drawn(mesh, camera) == borders | turning


def test_flat_and_degenerate_triangles_have_a_finite_outline():
    places = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, 0]], np.float32)
    faces = np.array([[0, 1, 2], [0, 1, 3], [0, 4, 3], [1, 1, 1]], np.int32)
    for camera in CAMERAS:
        segments, _ = outline_of(SceneObject(Mesh(places, faces), Material()), camera)
        assert np.isfinite(segments).all()
        assert len(segments)


def test_the_outline_of_a_large_mesh_is_its_box():
    mesh = sheet(np.random.default_rng(3), 0.0)
    segments, _ = outline_of(SceneObject(mesh, Material()), CAMERAS[0], len(mesh.faces) - 1)
    assert segments.shape == (12, 2, 3)
    back = np.linalg.inv(mesh.transform)
    corners = segments.reshape(-1, 3) @ back[:3, :3].T + back[:3, 3]
    assert np.allclose(corners.min(axis=0), mesh.vertices.min(axis=0))
    assert np.allclose(corners.max(axis=0), mesh.vertices.max(axis=0))


@pytest.mark.parametrize("camera", CAMERAS, ids=["perspective", "parallel"])
def test_a_sphere_s_ring_is_where_rays_graze_it(camera):
    ball = Sphere(center=(0.2, 0.1, -0.3), radius=0.8)
    segments, _ = outline_of(SceneObject(ball, Material()), camera)
    points = segments.reshape(-1, 3)
    normal = points - ball.center
    assert np.allclose(np.linalg.norm(normal, axis=1), 0.8, atol=1e-6)
    toward_eye = np.asarray(camera.w) if camera.is_parallel else np.asarray(camera.eye) - points
    assert np.allclose(np.sum(normal * toward_eye, axis=1), 0, atol=1e-5)


def test_the_outlines_of_many_objects_are_their_boxes():
    entries = [SceneObject(box(), Material())] * (silhouette.MOST_EXACT + 1)
    for number, edges in ((len(entries), 12), (silhouette.MOST_EXACT, 6)):
        outlines = outlines_of(entries[:number], CAMERAS[0])
        assert [len(outline.segments) for outline in outlines] == [edges] * number


@pytest.mark.parametrize("height", [1.2, 9.0])
def test_on_the_screen_one_side_of_an_outline_is_free(height):
    torus = trimesh.creation.torus(1.0, 0.5)
    mesh = Mesh(np.float32(torus.vertices), np.int32(torus.faces))
    camera = Camera.look_at((0, height, 3), (0, 0, 0), fov_y_deg=50)
    screen, size = OutsideScreen(camera, (480, 480)), (480, 480)
    corners = screen.seen(mesh.vertices.astype(float)[mesh.faces]).points
    segments, layers = outline_of(SceneObject(mesh, Material()), camera)
    lines, _, numbers = screen.segments(segments)
    left, right = (covered(lines, corners, aside) for aside in (-1.5, 1.5))
    assert (left & right).any() == (height > 2)  # the near side covers the hole's edge
    pieces = outer(lines, layers[numbers], size)
    left, right = (covered(pieces, corners, aside) for aside in (-1.5, 1.5))
    assert (left != right).mean() > 0.97


def covered(pieces: np.ndarray, triangles: np.ndarray, aside: float) -> np.ndarray:
    """Return True for pieces (n, 2, 2) next to whose middle is a triangle (m, 3, 2)."""
    along = pieces[:, 1] - pieces[:, 0]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    spots = pieces.mean(axis=1) + aside * np.stack([-along[:, 1], along[:, 0]], axis=1)
    start, side = triangles, np.roll(triangles, -1, axis=1) - triangles
    to = spots[:, None, None] - start
    signs = determinant(side, to)
    return ((signs > 0).all(axis=2) | (signs < 0).all(axis=2)).any(axis=1)


def determinant(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    return one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]


def test_a_piece_is_outer_if_a_pixel_next_to_it_is_free():
    """Compare with two overlapping random triangles, partly beyond the image."""
    rng, size = np.random.default_rng(4), (40, 30)
    for _ in range(20):
        corners = rng.uniform(-15, 45, (2, 3, 2))
        side = determinant(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        corners[side < 0] = corners[side < 0, ::-1]  # both wound alike
        lines = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2, 2)
        pieces = outer(lines, np.zeros(6), size)  # all
        along = pieces[:, 1] - pieces[:, 0]
        aside = silhouette.ASIDE_PX * along[:, ::-1] * (-1, 1)
        aside /= np.linalg.norm(along, axis=1, keepdims=True)
        spots = pieces.mean(axis=1) + np.stack([aside, -aside])
        pixels = np.clip(spots, 0, np.subtract(size, 1)).astype(int) + 0.5
        to = pixels[:, :, None, None] - corners
        edges = np.roll(corners, -1, axis=1) - corners
        inside = (determinant(edges, to) > 0).all(axis=-1).any(axis=-1)
        assert np.array_equal(outer(lines, np.ones(6), size), pieces[~inside.all(axis=0)])


def test_an_outline_that_is_partly_behind_the_eye_is_drawn_whole():
    lines = np.array([[(10, 0), (10, 30)], [(20, 0), (20, 30)]], float)
    assert np.array_equal(*(outer(lines, np.full(2, layers), (40, 30)) for layers in (0, 1)))


def test_a_sphere_has_no_outline_from_inside():
    ball = SceneObject(Sphere((0.1, 0, 0.2), 10.0), Material())
    assert outline_of(ball, CAMERAS[0])[0].shape == (0, 2, 3)
    assert len(outline_of(ball, CAMERAS[1])[0])  # parallel rays come from outside
