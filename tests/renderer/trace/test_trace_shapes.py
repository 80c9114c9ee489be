"""Single shapes with known images, and scenes at the limits."""

import math
from dataclasses import replace

import numpy as np
import pytest
from trace_reference import cast, scene_of, tree_of

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Checker, Mesh, Scene, SceneObject, Sphere
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.trace import Tracer
from lucida.renderer.trace.tracer import METHODS

ALL = ("color", "depth", "normal", "id", "primitive")
FRONT = Camera.look_at((0, 0, 5), (0, 0, 0), fov_y_deg=40)
QUAD = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]


def quad(scale=1.0, z=0.0):
    vertices = np.array(QUAD, float) * scale + (0, 0, z)
    return Mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]]))


def draw(scene, camera=FRONT, size=(48, 48), method="packets"):
    with Tracer(scene, threads=2, method=method) as tracer:
        frame = tracer.render(camera, size, ALL)
    assert frame.complete
    assert frame.size == size
    assert not any(np.isnan(getattr(frame, channel)).any() for channel in ALL)
    hit = frame.id >= 0
    assert np.array_equal(hit, frame.primitive >= 0)
    assert np.array_equal(hit, np.isfinite(frame.depth))
    np.testing.assert_allclose(np.linalg.norm(frame.normal, axis=-1), hit, atol=1e-6)
    return frame


@pytest.mark.parametrize("faces", [[(0, 1, 2)], [(0, 1, 2), (1, 3, 2)]])
def test_vertex_weights_belong_to_the_triangle_object_and_image(faces):
    """Nothing is kept from the previous triangle, object or camera."""
    corners = np.array([[-1, -1, 0], [0, -1, 0], [-1, 1, 0], [0, 1, 0]], float)
    right = np.eye(4)
    right[0, 3] = 1
    mesh = Mesh(corners, faces, colors=[*np.eye(3), (1, 1, 1)])
    meshes = [mesh, replace(mesh, transform=right)][: len(faces)]
    objects = tuple(SceneObject(each, Material((1, 1, 1))) for each in meshes)
    scene = Scene(objects, ambient=(1, 1, 1))
    with Tracer(scene, threads=1) as tracer, Tracer(scene, 1, "reference") as exact:
        for eye in ((0, 0, 2.1), (0.4, -0.3, 2.1), (0, 0, 2.1)):
            image, expected = (t.render(Camera(eye), (16, 16)) for t in (tracer, exact))
            same = (image.id == expected.id) & (image.id >= 0)
            assert same.sum() > 15
            np.testing.assert_allclose(image.color[same], expected.color[same], atol=1e-5)


def test_nothing_is_hit_in_an_empty_scene():
    frame = draw(Scene((), background=(0.25, 0.5, 0.75)))
    assert (frame.color == np.float32([0.25, 0.5, 0.75])).all()
    assert np.isinf(frame.depth).all()
    assert (frame.id == -1).all()
    assert (frame.primitive == -1).all()


def test_near_and_far_bound_the_rays_parameter():
    scene = scene_of(quad(1, 0), Sphere((0, 0, -2), 0.5))
    camera = Camera((0, 0, 5), distance=2, viewport=(-0.1, 0.1, -0.1, 0.1))
    for near, far, want in (
        (None, None, 2.5),
        (4.99, 5.01, 2.5),
        (5.0, None, 3.25),  # t > t_min, not >=
        (6.6, None, 3.75),  # inside the sphere: its far side is hit
        (None, 5.0, math.inf),
        (7.6, 9.0, math.inf),
    ):
        cut = replace(camera, near=near, far=far)
        exact = draw(scene, cut, (1, 1), method="reference").depth[0, 0]
        assert exact == np.float32(want)
        assert draw(scene, cut, (1, 1)).depth[0, 0] == pytest.approx(want, rel=1e-6)


def test_a_tangent_ray_hits_a_sphere():
    camera = Camera((0, 0, 5), viewport=(0.5, 1.5, -0.5, 0.5), projection="parallel")
    for method in METHODS:
        frame = draw(scene_of(Sphere()), camera, (1, 1), method)
        assert frame.depth[0, 0] == 5  # x = 1: tangent
        assert frame.id[0, 0] == 0
        missed = replace(camera, viewport=(0.5 + 1e-6, 1.5 + 1e-6, -0.5, 0.5))
        assert draw(scene_of(Sphere()), missed, (1, 1), method).id[0, 0] == -1
    draw(scene_of(Sphere()), Camera((0, 0, 1)))  # the eye on the sphere
    outwards = Camera((0, 0, 1), w=(0, 0, -1), u=(-1, 0, 0))
    assert (draw(scene_of(Sphere()), outwards).id == -1).all()


def test_triangles_without_area_are_never_hit():
    vertices = [[0, 0, 0], [1, 1, 0], [2, 2, 0], [-1, 0, 0], [-1, 0, 0], [-1, 2, 0]]
    faces = [[0, 1, 2], [3, 4, 5], [0, 0, 0]]
    mesh = Mesh(np.array(vertices, float), np.array(faces))
    assert (draw(scene_of(mesh), FRONT, (49, 49)).id == -1).all()
    flat = flatten(scene_of(mesh))
    targets = np.array(vertices, float) * 0.5
    origins = np.broadcast_to([0.3, 0.2, 4.0], targets.shape)
    _, primitive, _, _ = cast(tree_of(flat), origins, targets - origins, 0.0, np.inf)
    assert (primitive == -1).all()
    both = scene_of(mesh, quad(0.5, -1))
    assert (draw(both, FRONT).id == 1).any()


def test_rays_in_the_planes_of_bounding_boxes_hit():
    # Axis-parallel rays, from origins on the planes of the triangles' bounding boxes.
    flat = flatten(scene_of(quad(1, 0), quad(1, -1), Sphere((0, 0, -4), 1.0)))
    grid = np.array([-1.0, -0.5, 0.0, 0.5, 1.0])
    x, y = (part.ravel() for part in np.meshgrid(grid, grid))
    for zero in (0.0, -0.0):
        origins = np.stack([x, y, np.full_like(x, 3)], axis=-1)
        directions = np.broadcast_to([zero, zero, -2.0], origins.shape)
        t, primitive, _, _ = cast(tree_of(flat, 1), origins, directions, 0.0, np.inf)
        assert (t == 1.5).all()
        assert (primitive < 2).all()
        t, _, _, _ = cast(tree_of(flat, 1), origins, directions, 1.5, np.inf)
        assert (t == 2.0).all()


@pytest.mark.parametrize("eye", [1e6, 1e9, 1e12])
@pytest.mark.parametrize("radius", [1e-9, 1e-3, 1e9])
def test_sizes_beyond_precision_give_no_nan(eye, radius):
    shapes = Sphere((1, 0, 0), radius), Sphere((0, 0, 0), radius), quad(radius, 0)
    for projection in ("perspective", "parallel"):
        edge = 1e-12 * eye
        camera = Camera((1, 0, eye), viewport=(-edge, edge, -edge, edge), projection=projection)
        draw(scene_of(*shapes, material=Material(checker=Checker())), camera, (9, 9))


def test_a_face_on_the_border_of_checker_cells_stays_in_one_cell():
    checker = Material((1, 1, 1), checker=Checker((0, 0, 0), 1.0))
    scene = Scene((SceneObject(quad(2, 0.5), checker),), ambient=(1, 1, 1))
    camera = Camera((0, 0, 3), viewport=(-2, 2, -2, 2), projection="parallel")
    color = draw(scene, camera, (64, 64)).color[..., 0]
    x, y = camera.image_point(*np.indices((64, 64)), (64, 64))
    odd = (np.floor(x + 0.5) + np.floor(y + 0.5)) % 2
    assert np.array_equal(color, 1 - odd)


def test_the_first_of_equally_near_faces_is_hit():
    frame = draw(scene_of(quad(1, 0), quad(1, 0)), method="reference")
    assert set(np.unique(frame.id)) == {-1, 0}


def test_wrong_settings_of_the_tracer_are_refused():
    with pytest.raises(LucidaError, match="threads: 0 is not in"):
        Tracer(scene_of(quad()), threads=0)
    with Tracer(scene_of(quad())) as tracer:
        with pytest.raises(LucidaError, match="channel: 'colour' is unknown"):
            tracer.render(FRONT, (8, 8), ("colour",))
        with pytest.raises(LucidaError, match="size: 0x8 has no pixels"):
            tracer.start(FRONT, (0, 8))
        with pytest.raises(LucidaError, match="samples: 5 is not a square"):
            tracer.render(FRONT, (8, 8), samples=5)
    with pytest.raises(LucidaError, match="tracer: is closed"):
        tracer.render(FRONT, (8, 8))
    huge = np.eye(4) * 1e12
    huge[3, 3] = 1
    mesh = Mesh(np.array(QUAD, float) * 1e12, np.array([[0, 1, 2]]), transform=huge)
    with Tracer(scene_of(mesh)) as tracer, pytest.raises(LucidaError, match="too large"):
        tracer.render(FRONT, (8, 8))
