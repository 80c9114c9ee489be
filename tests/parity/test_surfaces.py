"""Backs, holes and metals: all renderers, single rays, shadows and the probe see the same."""

from dataclasses import replace

import numpy as np
import pytest
from agreeing import agree
from hypothesis import given, settings
from hypothesis import strategies as st
from textured import WHITE, noise, wall

from lucida import Camera, Rasterizer, Tracer
from lucida.app.instruments.probe.crossings import Index
from lucida.app.instruments.probe.model import Probe
from lucida.renderer.compare.raster_and_ray import CHANNELS, compare_frames
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.metal import METAL_DIFFUSE, Metal
from lucida.renderer.scene.model import DirectionalLight, Mesh, PointLight, Scene, SceneObject
from lucida.renderer.scene.shapes import torus
from lucida.renderer.scene.texture import Texture

SIZE = (96, 64)
LIGHTS = (PointLight((4, 5, 3), (0.8, 0.7, 0.6)), DirectionalLight((-1, -2, -1), (0.3, 0.3, 0.5)))
TURNED = np.array([[0.9, 0.1, -0.3, 0.1], [0, 0.8, 0.2, 0], [0.3, -0.2, 0.9, -4], [0, 0, 0, 1.0]])
MIRRORED = TURNED @ np.diag([-1, 1, 1, 1.0])
PARALLEL = Camera(viewport=(-2.1, 2.1, -1.4, 1.4), projection="parallel")
LEFT_HANDED = Camera(u=(-1, 0.1, 0), v=(0, 1, 0.1), w=(0.1, 0, 1))
CAMERAS = pytest.mark.parametrize("camera", [Camera(), PARALLEL, LEFT_HANDED], ids=range(3))


def speckled(size, seed=5):
    """An image whose opacity is noise."""
    alpha = np.random.default_rng(seed).integers(0, 256, (size, size, 1)).astype(np.uint8)
    return Texture(np.concatenate([noise(size, size), alpha], axis=2))


def sheet(z, is_front, side=1.0, transform=TURNED, **material):
    """A square; is_front: its front faces +z in its own space."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * side + (0, 0, z)
    faces = [[0, 1, 2], [0, 2, 3]] if is_front else [[0, 2, 1], [0, 3, 2]]
    mesh = Mesh(corners, faces, None, None, transform, uv=[[0, 0], [1, 0], [1, 1], [0, 1]])
    return SceneObject(mesh, Material((0.8, 0.6, 0.4), (0.04,) * 3, 30, **material))


def scene_of(*objects):
    return Scene(objects, LIGHTS)


@CAMERAS
@pytest.mark.parametrize("transform", [TURNED, MIRRORED], ids=["turned", "mirrored"])
def test_backs_are_not_seen(camera, transform):
    """The front is that of the object's own space, whatever its place mirrors."""
    front = sheet(0, True, 0.7, transform, single_sided=True)
    back = sheet(0.1, False, 0.9, transform, single_sided=True)
    both = sheet(-0.5, False, 1.0, transform)
    image, _, _ = agree(scene_of(front, back, both), camera, SIZE)
    assert set(np.unique(image.id)) == {-1, 0, 2}
    image, _, _ = agree(scene_of(back), camera, SIZE)
    assert (image.id == -1).all()


@settings(max_examples=8)
@given(st.tuples(*[st.floats(-1.5, 1.5)] * 3), st.booleans())
def test_a_closed_surface_has_no_backs_to_be_seen(eye, is_mirrored):
    """From outside. Inside of the tube, a camera sees through its wall."""
    mesh = torus(0.8, 0.3, 24, 12)
    matrix = np.diag([1, 1, -1, 1.0]) if is_mirrored else np.eye(4)
    away = np.hypot(np.hypot(eye[0], eye[2]) - 0.8, eye[1])
    thing = SceneObject(mesh.placed(matrix), Material())
    single = replace(thing, material=replace(thing.material, single_sided=True))
    camera = Camera.look_at(eye=eye, target=(0.1, 0.05, 0.2), fov_y_deg=60)
    if abs(away - 0.3) < 0.02:
        return
    with Rasterizer(scene_of(thing)) as rasterizer:
        before = rasterizer.render(camera, SIZE)
        rasterizer.set_scene(scene_of(single))  # the same triangles: only what is seen changes
        after = rasterizer.render(camera, SIZE)
        with Tracer(scene_of(thing)) as tracer:
            tracer.set_scene(scene_of(single))
            ray = tracer.render(camera, SIZE)
    if away > 0.3:
        assert (before.id != after.id).mean() < 0.005
    else:
        assert not np.isclose(after.depth, before.depth)[before.id == 0].any()
    assert (after.id != ray.id).mean() < 0.01


@CAMERAS
@pytest.mark.parametrize("size", [3, 16, 512])
def test_holes_are_cut_out(camera, size):
    """One, also where a pixel covers many texels, or a texel many pixels."""
    texture = speckled(size)
    holed = [sheet(-0.2 * k, k != 1, texture=texture, cutout=0.5) for k in range(3)]
    holed[2] = sheet(
        -0.4, False, transform=MIRRORED, texture=texture, cutout=0.3, single_sided=True
    )
    behind = sheet(-1, True, 1.5)
    image, _, _ = agree(scene_of(*holed, behind), camera, SIZE)
    seen = np.bincount(image.id.ravel() + 1, minlength=5)
    assert seen[1] > 300 and seen[2] > 30 and seen[4] > 300


def test_a_hole_is_where_opacity_is_less_than_the_cutout():
    """By hand: half of the wall is there, up to the middle between two texels."""
    texels = np.full((1, 2, 4), 255, np.uint8)
    texels[:, 0, 3] = 0
    entry = SceneObject(
        wall(Texture(texels, ("clamp", "clamp")), 0.0, 1.0),
        Material(WHITE, texture=Texture(texels, ("clamp", "clamp")), cutout=0.25),
    )
    image, _, _ = agree(scene_of(entry), Camera(), (64, 4))
    u = (np.arange(64) + 0.5) / 64
    np.testing.assert_array_equal(image.id[2] == 0, np.clip(2 * u - 0.5, 0, 1) >= 0.25)


def surface_scene():
    floor = sheet(-1, True, 1.4)
    holed = sheet(0, True, 0.8, texture=speckled(6), cutout=0.6)
    back = sheet(0.3, False, 0.5, single_sided=True)
    return Scene((floor, holed, back), (DirectionalLight((0.2, -0.1, -1)),))


def test_shadows_single_rays_and_the_probe_see_through_them():
    scene, camera = surface_scene(), Camera()
    flat, rays = flatten(scene), camera.rays(SIZE)
    origins = np.broadcast_to(rays.origin, rays.direction.shape)
    with Tracer(scene, shadows=True) as tracer:
        image = tracer.render(camera, SIZE, channels=CHANNELS)
        t, primitive = tracer.closest_hits(origins.reshape(-1, 3), rays.direction.reshape(-1, 3))
    same = primitive.reshape(image.primitive.shape) == image.primitive
    assert same.mean() > 0.995
    hit = np.isfinite(image.depth) & same
    np.testing.assert_allclose(t.reshape(image.depth.shape)[hit], image.depth[hit], rtol=1e-4)
    floor, lit = image.id == 0, image.color[..., 0] > 0.3
    assert (floor & lit).sum() > 100 and (floor & ~lit).sum() > 100
    index = Index(flat)
    for i, j in ((32, 48), (20, 40), (45, 60), (30, 30), (35, 55)):
        found = index.crossings(origins[i, j], rays.direction[i, j])
        ahead = found.primitive[found.t > 0]
        assert (ahead[0] if len(ahead) else -1) == image.primitive[i, j]


@pytest.mark.parametrize("is_front", [True, False])
@pytest.mark.parametrize(("cutout", "is_dark"), [(0.3, True), (0.7, False)])
def test_shadows_fall_from_both_sides_and_not_from_holes(is_front, cutout, is_dark):
    floor = sheet(-1, True, 2.0, np.eye(4))
    half = Texture(np.full((2, 2, 4), 128, np.uint8))
    surface = {"texture": half, "cutout": cutout, "single_sided": True}
    lid = sheet(-0.5, is_front, 0.3, np.eye(4), **surface)
    scene = Scene((floor, lid), (DirectionalLight((0, 0, -1)),))
    beside = Camera.look_at(eye=(1.5, 0, 0.2), target=(0, 0, -1), fov_y_deg=50)
    with Tracer(scene, shadows=True) as tracer:
        image = tracer.render(beside, SIZE)
    on_floor = image.id == 0
    assert (image.color[on_floor][:, 0] < 0.2).any() == is_dark
    probe = Probe(scene)
    dark = [
        probe.index.closest(point, (0, 0, 1), 1e-6, np.inf) < np.inf
        for point in ((0.05, 0.1, -1), (0.9, 0.9, -1))
    ]
    assert dark == [is_dark, False]


@CAMERAS
def test_metals_shine_in_their_base_colour(camera):
    rng = np.random.default_rng(3)
    metal = Metal(rng.integers(0, 256, (16, 24, 3)).astype(np.uint8), 0.9, 0.8)
    objects = [
        sheet(0, True, texture=Texture(noise(8, 8)), metal=metal),
        sheet(-0.3, True, 1.3, metal=metal),
        sheet(0.4, True, 0.3, texture=Texture(noise(4, 4))),
    ]
    scene = scene_of(*objects)
    image, _, _ = agree(scene, camera, SIZE)
    assert set(np.unique(image.id)) == {-1, 0, 1, 2}
    with Tracer(scene) as tracer:
        rays = np.broadcast_arrays(*camera.rays(SIZE))
        light = tracer.shaded(*(part.reshape(-1, 3) for part in rays)).reshape(image.color.shape)
    assert (np.abs(light - image.color).max(axis=2) < 5e-3).mean() > 0.999
    read = Probe(scene).at((32, 48), camera, SIZE)
    np.testing.assert_allclose(read.color, image.color[32, 48], atol=1e-4)


def test_a_metal_s_light_by_hand():
    """Light straight from the front: the whole highlight, and what of the colour is diffuse."""
    smooth = Metal(np.array([[[0, 0, 255]]], np.uint8))
    entry = sheet(-1, True, 1.0, np.eye(4), metal=smooth)
    scene = Scene((entry,), (DirectionalLight((0, 0, -1)),), ambient=(0, 0, 0))
    image, _, _ = agree(scene, Camera(), (65, 65))
    expected = (1 + METAL_DIFFUSE) * np.array(entry.material.diffuse)
    np.testing.assert_allclose(image.color[32, 32], expected, rtol=3e-3)


def test_arrays_follow_all_that_they_depend_on():
    """One image gets other wraps, another cutout, another colour under a metal, another metal."""
    texture, metal = speckled(4), Metal(np.full((4, 4, 3), 200, np.uint8))
    material = Material((0.5, 0.6, 0.7), texture=texture)
    changes = [
        {"texture": replace(texture, wrap=("mirror", "repeat"))},
        {"texture": replace(texture, rotate_deg=30.0)},
        {"cutout": 0.4},
        {"cutout": 0.6},
        {"metal": metal},
        {"metal": metal, "diffuse": (0.1, 0.2, 0.3)},
        {"metal": replace(metal, roughness=0.3)},
        {"metal": metal, "specular": (0.3, 0.3, 0.3)},
    ]
    scenes = [
        scene_of(SceneObject(wall(texture), replace(material, **change))) for change in changes
    ]
    together = scene_of(*(scene.objects[0] for scene in scenes))
    first = flatten(scenes[0])
    for scene in scenes[1:]:
        followed, alone = flatten(scene, (scenes[0], first)), flatten(scene)
        for name in ("uv", "textures", "texels", "materials"):
            np.testing.assert_array_equal(getattr(followed, name), getattr(alone, name))
    with Rasterizer(together) as rasterizer, Tracer(together) as tracer:
        ray = tracer.render(Camera(), SIZE, channels=CHANNELS)
        raster = rasterizer.render(Camera(), SIZE, channels=CHANNELS)
        assert not compare_frames(flatten(together), Camera(), SIZE, raster, ray).unexplained
    # Side by side, no image of one scene takes another's place.
    flat = flatten(together)
    for number, scene in enumerate(scenes):
        alone = flatten(scene)
        width, height = alone.textures[0, 0, 1:3]
        count = (width + 1) * (height + 1)
        for row, column in ((0, 0), (1, 0), (1, 1)):
            mine, his = flat.textures[number, row, column], alone.textures[0, row, column]
            assert (mine < 0) == (his < 0)
            if his >= 0:
                ours, its = flat.texels[mine : mine + count], alone.texels[his : his + count]
                np.testing.assert_array_equal(ours, its)
