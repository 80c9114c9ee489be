"""The flat scene: world-space arrays, primitive numbers, materials."""

from dataclasses import replace

import numpy as np
import pytest
from textured import noise

from lucida.renderer.scene.flat import flatten, same_meshes, same_places
from lucida.renderer.scene.flat_textures import on_sphere
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.metal import Metal
from lucida.renderer.scene.model import (
    Checker,
    DirectionalLight,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
)
from lucida.renderer.scene.positions import lights_from, near_point, world_corners, world_vertices
from lucida.renderer.scene.shapes import placement
from lucida.renderer.scene.texture import WRAPS, Texture, packed_texels
from lucida.renderer.system.errors import LucidaError

TRIANGLE = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def mesh(**changes):
    return Mesh(**{"vertices": TRIANGLE, "faces": [[0, 1, 2]], **changes})


def test_objects_keep_their_order_and_primitives_their_numbers():
    ball = SceneObject(Sphere((1, 2, 3), 0.5))
    two = mesh(faces=[[0, 1, 2], [2, 1, 0]])
    flat = flatten(Scene((SceneObject(mesh()), ball, SceneObject(two))))
    np.testing.assert_array_equal(flat.object_faces, [[0, 1], [1, 0], [1, 2]])
    np.testing.assert_array_equal(flat.object_sphere, [-1, 0, -1])
    np.testing.assert_array_equal(flat.face_object, [0, 2, 2])
    np.testing.assert_array_equal(flat.faces, [[0, 1, 2], [3, 4, 5], [5, 4, 3]])
    np.testing.assert_array_equal(flat.spheres, [[1, 2, 3, 0.5]])
    np.testing.assert_array_equal(flat.bounds, [[0, 0, 0], [1.5, 2.5, 3.5]])
    assert not any(array.flags.writeable for array in flat)


def test_vertices_are_in_the_objects_space_and_normals_in_the_worlds():
    transform = np.diag([2.0, 1.0, -4.0, 1.0])
    transform[:3, 3] = 10, 0, 0
    tilted = np.tile(np.array([1.0, 0.0, 1.0]) / np.sqrt(2), (3, 1))
    flat = flatten(Scene((SceneObject(mesh(normals=tilted, transform=transform)),)))
    np.testing.assert_array_equal(flat.vertices, TRIANGLE)
    world = [[10, 0, 0], [12, 0, 0], [10, 1, 0]]
    np.testing.assert_array_equal(world_vertices(flat), world)
    np.testing.assert_array_equal(world_vertices(flat, (9, 0, 0)), np.array(world) - (9, 0, 0))
    np.testing.assert_array_equal(world_corners(flat, np.array([0, 0])), [world, world])
    np.testing.assert_array_equal(flat.bounds, [[10, 0, 0], [12, 1, 0]])
    expected = np.array([0.5, 0, -0.25]) / np.linalg.norm([0.5, 0, -0.25])
    np.testing.assert_allclose(flat.normals, np.tile(expected, (3, 1)), rtol=1e-6)


def test_the_same_meshes_are_found_in_another_scene():
    here, there = mesh(), mesh(transform=placement((1, 0, 0)))
    there = replace(there, vertices=here.vertices, faces=here.faces)
    other, ball = SceneObject(mesh()), SceneObject(Sphere())
    one, moved, gone = SceneObject(here), SceneObject(there), SceneObject(here, hidden=True)
    old = Scene((other, gone, one, ball))
    assert same_places(Scene((one, moved, ball, other, gone)), old) == [2, -1, -1, 0, -1]
    assert same_meshes(Scene((one, moved, ball, other, gone)), old) == [2, 2, -1, 0, -1]
    assert same_places(Scene((one,)), Scene((gone,))) == [-1]


def test_a_mesh_without_normals_or_colours_is_flat_and_white():
    flat = flatten(Scene((SceneObject(mesh()),)))
    np.testing.assert_array_equal(flat.normals, 0)
    np.testing.assert_array_equal(flat.colors, 1)


def test_checker_cells_are_centred_on_the_objects_origin():
    checkered = Material(checker=Checker(size=2.0))
    flat = flatten(Scene((SceneObject(Sphere((10, 0, 0)), checkered),)))
    cell = flat.cells[0] @ np.array([[10, 0, 0, 1], [11.1, 0, 0, 1]]).T
    np.testing.assert_allclose(cell, [[0.5, 1.05], [0.5, 0.5], [0.5, 0.5]], atol=1e-5)
    np.testing.assert_array_equal(flat.materials[0, 1, 3], 1)


def test_each_light_is_a_row_of_place_and_colour():
    lights = (PointLight((1, 2, 3), (0.5, 0.5, 0.5)), DirectionalLight((0, -2, 0)))
    flat = flatten(Scene((), lights))
    places, colors = [[1, 2, 3, 1], [0, 1, 0, 0]], [[0.5, 0.5, 0.5, 0], [1, 1, 1, 0]]
    np.testing.assert_allclose(flat.lights, np.stack([places, colors], axis=1))


def test_a_metal_maps_texels_are_the_specular_colours():
    material = Material(specular=(0.2, 0.3, 0.4))
    shiny = replace(material, metal=Metal())
    flat = flatten(Scene((SceneObject(Sphere(), material), SceneObject(Sphere(), shiny))))
    np.testing.assert_allclose(flat.materials[:, 1, :3], [[0.2, 0.3, 0.4], [1, 1, 1]])


def test_lights_and_hits_are_relative_to_the_scenes_point_nearest_to_the_eye():
    at = 1e9 + 0.25
    lights = (PointLight((at + 1, 0, 0)), DirectionalLight((0, -2, 0)))
    flat = flatten(Scene((SceneObject(Sphere((at, 0, 0), 0.5)),), lights))
    for eye, point in (((at, 0.25, 9), (at, 0.25, 0.5)), ((0, 0, 0), (at - 0.5, 0, 0))):
        near = near_point(flat, eye)
        np.testing.assert_array_equal(near, point)
        rows = lights_from(flat, near)
        np.testing.assert_array_equal(
            rows[:, 0], [[*(at + 1 - near[0], *-near[1:]), 1], [0, 1, 0, 0]]
        )
        assert rows.dtype == np.float32


def test_an_empty_scene_is_legal():
    flat = flatten(Scene(()))
    assert flat.faces.shape == (0, 3)
    assert flat.spheres.shape == (0, 4)
    np.testing.assert_array_equal(flat.bounds, 0)


@pytest.mark.parametrize("side", [-1, 1])
def test_a_mesh_that_leaves_the_range_of_float32_is_refused(side):
    def scene(x):
        far = mesh(vertices=[[1e9 * side, 0, 0], [0, 1, 0], [0, 0, 1]])
        far = replace(far, transform=np.diag([x / 1e9, 1, 1, 1]))
        return Scene((SceneObject(mesh()), SceneObject(far, name="far")))

    flatten(scene(0.9e15))
    with pytest.raises(LucidaError, match=r"object 1 \(far\): its transform is too large"):
        flatten(scene(1.1e15))


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: mesh(faces=[[0, 1, 3]]), "faces"),
        (lambda: mesh(faces=[[0, 1, -1]]), "faces"),
        (lambda: mesh(faces=np.zeros((0, 3))), "faces"),
        (lambda: mesh(vertices=[[0, 0, np.nan]] * 3), "vertices"),
        (lambda: mesh(vertices=[[0, 0]] * 3), "vertices"),
        (lambda: mesh(normals=[[0, 0, 1]]), "normals"),
        (lambda: mesh(colors=[[0, np.inf, 1]] * 3), "colors"),
        (lambda: mesh(transform=np.diag([1.0, 0, 1, 1])), "transform"),
        (lambda: mesh(transform=np.ones((4, 4))), "transform"),
        (lambda: Sphere(center=(0, 0)), "center"),
        (lambda: Material(specular=(0, float("nan"), 0)), "specular"),
        (lambda: PointLight("abc"), "position"),
        (lambda: Scene((), ambient=(0, 0)), "ambient"),
    ],
)
def test_what_cannot_be_drawn_is_refused_by_name(make, field):
    with pytest.raises(LucidaError) as error:
        make()
    assert error.value.field == field
    assert error.value.remedy


def test_arrays_that_may_change_are_copied_and_others_shared():
    points, texels = np.array(TRIANGLE, np.float32), np.zeros((2, 2, 3), np.uint8)
    view = points.view()
    view.setflags(write=False)  # but not its base
    meshes, texture = [mesh(vertices=points), mesh(vertices=view)], Texture(texels)
    points[:], texels[:] = 9, 9
    assert all(made.vertices.max() == 1 for made in meshes) and not texture.texels.any()
    assert mesh(vertices=meshes[0].vertices).vertices is meshes[0].vertices
    assert Texture(texture.texels).texels is texture.texels


def test_equal_vertices_of_a_mesh_stay_equal_in_the_world():
    rng = np.random.default_rng(7)
    points = np.repeat(rng.normal(size=(1, 3)), 37, axis=0)
    transform = np.eye(4)
    transform[:3] = rng.normal(size=(3, 4)) * 1e3
    flat = flatten(Scene((SceneObject(Mesh(points, [[0, 1, 2]], transform=transform)),)))
    world = world_vertices(flat, (0.1, 0.2, 0.3))
    np.testing.assert_array_equal(world, world[:1].repeat(37, axis=0))


@pytest.mark.parametrize("along_v", WRAPS)
@pytest.mark.parametrize("along_u", WRAPS)
def test_behind_a_textures_last_column_and_row_is_what_follows_them(along_u, along_v):
    """The first ones again where it repeats, else the last ones."""
    image = noise(5, 3)
    image_and_border = flatten(
        Scene((SceneObject(Sphere(), Material(texture=Texture(image, (along_u, along_v)))),))
    ).texels.reshape(4, 6)
    column, row = (0 if way == "repeat" else -1 for way in (along_u, along_v))
    right = np.concatenate([image, image[:, [column]]], axis=1)
    wanted = packed_texels(np.concatenate([right, right[[row]]]))
    np.testing.assert_array_equal(image_and_border, wanted)


def test_a_spheres_texture_is_looked_up_near_the_image():
    """However far it is shifted by whole periods, where an image repeats; a clamped one is not
    moved."""
    rng = np.random.default_rng(2)
    for _ in range(50):
        wrap = tuple(rng.choice(["repeat", "mirror"], 2).tolist())
        scale, offset = rng.uniform(-3, 3, 2), rng.uniform(-1, 1, 2)
        near, far = (
            on_sphere(Texture(noise(7, 4), wrap, tuple(scale), tuple(moved)), (7, 4))
            for moved in (offset, offset + 2 * rng.integers(-50, 50, 2))
        )
        assert far == pytest.approx(near, abs=1e-9)
        a, b, c, d = far
        assert 0 <= b + a / 2 < 14 and 0 <= d + c / 2 < 8
        whole = Texture(noise(7, 4), wrap, tuple(scale), tuple(offset)).in_texels((7, 4))[:, 2]
        periods = (whole - (b, d)) / (14, 8)
        assert periods == pytest.approx(np.round(periods), abs=1e-9)
        texture = Texture(noise(7, 4), ("clamp", "clamp"), tuple(scale), tuple(offset + 9))
        rows = texture.in_texels((7, 4))
        assert on_sphere(texture, (7, 4)) == pytest.approx((*rows[0, [0, 2]], *rows[1, [1, 2]]))
