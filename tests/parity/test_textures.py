"""Textures: all renderers look up the same place of an image, and find the same light there."""

import itertools

import numpy as np
import pytest
from agreeing import agree
from textured import WHITE, floor, lit, noise, on_ball, on_wall, slopes, wall

from lucida import Camera, Rasterizer, Tracer
from lucida.app.instruments.probe.model import Probe
from lucida.renderer.compare.raster_and_ray import CHANNELS, compare_frames
from lucida.renderer.compare.seen_surfaces import Surfaces, View
from lucida.renderer.images.display import from_srgb
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Checker, Mesh, Scene, SceneObject, Sphere
from lucida.renderer.scene.sampling import between, sampled
from lucida.renderer.scene.texture import WRAPS, Texture, packed_texels

SIZE, SMALL = (96, 64), (24, 16)
SKEWED = Camera(u=(1.1, 0.2, 0.1), v=(-0.1, 0.9, 0.2), w=(0.05, -0.1, 1.0))
PARALLEL = Camera(viewport=(-2.1, 2.1, -1.4, 1.4), projection="parallel")


def ambient_only(scene):
    """Its colours are the textures'."""
    return Scene(scene.objects, (), WHITE)


@pytest.mark.parametrize("u", WRAPS)
@pytest.mark.parametrize("v", WRAPS)
def test_wrap_modes_on_walls_and_balls(u, v):
    texture = Texture(noise(5, 7), (u, v), (1.5, 1.2), (0.3, -0.2))
    objects = on_wall(texture).objects + on_ball(texture).objects
    agree(lit(*objects), Camera(), SIZE)


@pytest.mark.parametrize("camera", [SKEWED, PARALLEL], ids=["skewed", "parallel"])
def test_cameras_of_all_kinds(camera):
    texture = Texture(slopes(37, 23), ("mirror", "repeat"), (3, 2))
    agree(lit(*on_wall(texture).objects, *on_ball(texture).objects), camera, SIZE)


@pytest.mark.parametrize("side", [64, 1024])
def test_noise_of_which_a_pixel_covers_many_texels(side):
    """No mipmaps: both find the same texel among them."""
    agree(on_wall(Texture(noise(side, side))), Camera(), SIZE)


@pytest.mark.parametrize("texels", [slopes(64, 64), noise(16, 16)], ids=["slopes", "noise"])
def test_a_floor_to_the_horizon(texels):
    agree(floor(Texture(texels), 20), Camera(), SIZE)


def test_seams_and_poles_of_a_ball():
    behind = Camera.look_at(eye=(0.2, 3.5, -6), target=(0.2, 0.1, -3), up=(0, 1, 0), fov_y_deg=40)
    for wrap in WRAPS:
        agree(on_ball(Texture(noise(9, 6), (wrap, "clamp"))), behind, SIZE)


def test_coordinates_far_from_the_image():
    texture = Texture(slopes(32, 32))
    agree(on_wall(texture, low=99_999.25, high=100_001.75), Camera(), SIZE)


def test_a_texture_beside_other_patterns_and_vertex_colours():
    mesh = wall(Texture(noise(4, 4)))
    tinted = Mesh(mesh.vertices, mesh.faces, None, np.eye(4)[:, :3] + 0.2, mesh.transform, mesh.uv)
    ball = SceneObject(Sphere((1, 0, -3), 0.5), Material(checker=Checker(size=0.2)))
    plain = SceneObject(Sphere((-1, 0, -3), 0.5), Material((0.9, 0.1, 0.1)))
    scene = lit(
        SceneObject(tinted, Material((0.5, 0.9, 0.7), (0.3,) * 3, texture=Texture(noise(4, 4)))),
        ball,
        plain,
    )
    agree(scene, Camera(), SIZE)


def test_light_is_interpolated_linearly_between_the_middles_of_texels():
    """By hand: black and white texels side by side, in linear light, not in sRGB."""
    texels = np.zeros((1, 2, 3), np.uint8)
    texels[:, 1] = 255
    scene = ambient_only(on_wall(Texture(texels, ("clamp", "clamp")), low=0.0, high=1.0))
    camera = Camera(viewport=(-0.5, 0.5, -0.5, 0.5))
    frame, _, _ = agree(scene, camera, (64, 4))
    u = (np.arange(64) + 0.5) / 64
    expected = np.clip(2 * u - 0.5, 0, 1)
    np.testing.assert_allclose(frame.color[2, :, 0], expected, atol=1e-5)


def test_texels_are_the_images_own_light():
    every = np.arange(256, dtype=np.uint8).reshape(16, 16, 1).repeat(3, axis=2)
    packed = packed_texels(every)
    light = np.square((packed & 1023) / 1023)
    # A fifth of a step of 8 bits.
    shown = from_srgb(np.array([0.2, 0.8]) / 255)
    assert shown[0] > 0
    flat = flatten(ambient_only(on_wall(Texture(every))))
    columns, rows = np.meshgrid(np.arange(16) + 0.5, np.arange(16) + 0.5)
    places = np.stack([columns.ravel(), rows.ravel()], axis=1)
    looked_up = sampled(flat, np.zeros(256, int), places)
    np.testing.assert_allclose(looked_up[:, 0], light.ravel(), atol=1e-12)


def rays_of(camera):
    origins, directions = np.broadcast_arrays(*camera.rays(SIZE))
    return origins.reshape(-1, 3), directions.reshape(-1, 3)


def test_the_probe_the_shaded_rays_and_the_image_tell_the_same_colour():
    texture = Texture(slopes(20, 20), scale=(2, 2))
    scene = lit(*on_wall(texture).objects, *on_ball(texture).objects)
    camera = Camera()
    with Tracer(scene) as tracer:
        image = tracer.render(camera, SIZE)
        origins, directions = rays_of(camera)
        light = tracer.shaded(origins, directions).reshape(image.color.shape)
        np.testing.assert_allclose(light, image.color, atol=2e-3)
    for pixel in ((32, 48), (5, 5), (32, 60)):
        read = Probe(scene).at(pixel, camera, SIZE)
        np.testing.assert_allclose(read.color, image.color[pixel], atol=1e-4)


def test_mirrors_and_shadows_see_textures():
    """A mirror below a textured wall shows it upside down, with the wall's own light."""
    texture = Texture(slopes(16, 16), ("clamp", "clamp"))
    corners = [(-3, -1.0, 0), (3, -1.0, 0), (3, -1.0, -4), (-3, -1.0, -4)]
    mirror = Mesh(corners, [(0, 1, 2), (0, 2, 3)])
    objects = (
        SceneObject(wall(texture, 0.0, 1.0), Material(WHITE, texture=texture)),
        SceneObject(mirror, Material((0, 0, 0), (1, 1, 1))),
    )
    scene = Scene(objects, (), WHITE)
    camera = Camera()
    with Tracer(scene, shadows=True, mirror_depth=1) as tracer:
        frame = tracer.render(camera, SIZE)
        mirrored = frame.id == 1
        assert mirrored.sum() > 100
        origins, directions = (part.reshape(*mirrored.shape, 3) for part in rays_of(camera))
        points = origins + frame.depth[..., None] * directions
        light = tracer.shaded(points[mirrored], directions[mirrored] * (1, -1, 1), 1e-4)
    np.testing.assert_allclose(frame.color[mirrored], light, atol=5e-3)
    assert np.ptp(frame.color[mirrored][:, 0]) > 0.3


def test_a_scene_gets_and_loses_its_textures():
    """The tracer and the rasterizer follow, and moving an object keeps the texels' arrays."""
    texture = Texture(noise(8, 8))
    plain = lit(SceneObject(wall(texture), Material(WHITE)))
    textured = on_wall(texture)
    first = flatten(textured)
    other = flatten(lit(*textured.objects), (textured, first))
    assert other.texels is first.texels and other.uv is first.uv
    with Tracer(plain) as tracer, Rasterizer(plain) as rasterizer:
        for scene in (plain, textured, on_ball(texture), plain):
            tracer.set_scene(scene)
            rasterizer.set_scene(scene)
            ray = tracer.render(Camera(), SIZE, channels=CHANNELS)
            raster = rasterizer.render(Camera(), SIZE, channels=CHANNELS)
            result = compare_frames(flatten(scene), Camera(), SIZE, raster, ray)
            assert result.unexplained == 0, result.summary()


@pytest.mark.parametrize(("part", "cause"), [(0.9, "pattern"), (1.2, "unexplained")])
def test_a_texture_explains_what_it_varies_by_and_no_more(part, cause):
    """The colour alone is changed, by a part of how much the texture's varies near the pixel."""
    scene = ambient_only(on_wall(Texture(noise(1024, 1024))))
    camera, flat = Camera(), flatten(scene)
    with Tracer(scene) as tracer:
        ray = tracer.render(camera, SIZE, channels=CHANNELS)
        raster = tracer.render(camera, SIZE, channels=CHANNELS)
    at = np.array([30]), np.array([40])
    primitive, t = ray.primitive[at], ray.depth[at].astype(float)
    varies = Surfaces(View(flat, camera, SIZE), primitive, t).texture_varies(*at)[0]
    assert (varies > 0.02).any()
    raster.color[30, 40] *= 1 - part * varies
    result = compare_frames(flat, camera, SIZE, raster, ray)
    found = {**result.explained, "unexplained": result.unexplained}
    assert found[cause] == 1 and result.agree == result.pixels - 1


def test_a_plain_surface_is_not_explained_by_textures():
    scene = lit(SceneObject(Sphere((0, 0, -3), 1)))
    seen = Surfaces(View(flatten(scene), Camera(), SIZE), np.array([0, -1]), np.ones(2))
    assert not seen.texture_varies(*np.zeros((2, 2), int)).any()


@pytest.mark.parametrize(
    ("texels", "scale"),
    [(slopes(31, 17), (1000, 1)), (noise(256, 1), (1e4, 0.5)), (noise(64, 64), (3e4, 3e4))],
    ids=["one channel is even", "texels that float32 does not tell apart", "no row is seen twice"],
)
def test_images_of_which_a_hundredth_of_a_pixel_holds_several_texels(texels, scale):
    scene = on_wall(Texture(texels, ("mirror", "repeat"), scale), low=0, high=1)
    with Rasterizer(scene) as rasterizer, Tracer(scene) as tracer:
        for camera in (Camera(), SKEWED, PARALLEL):
            raster, ray = (r.render(camera, SMALL, CHANNELS) for r in (rasterizer, tracer))
            result = compare_frames(flatten(scene), camera, SMALL, raster, ray)
            assert result.unexplained == 0, result.summary()


@pytest.mark.parametrize("wrap", ["repeat", "mirror"])
def test_whole_images_by_which_a_ball_s_is_moved_change_nothing(wrap):
    near, far = (
        ambient_only(on_ball(Texture(noise(16, 9), (wrap, wrap), offset=(away + 0.25, 0.5 - away))))
        for away in (0, 1e5 - 2)
    )
    agree(far, Camera(), SIZE)
    for renderer in (Rasterizer, Tracer):
        with renderer(near) as one, renderer(far) as other:
            images = [r.render(Camera(), SIZE).color for r in (one, other)]
        np.testing.assert_allclose(images[1], images[0], atol=1e-3)


@pytest.mark.parametrize("wraps", [*itertools.product(WRAPS, repeat=2)])
def test_the_least_and_the_most_light_between_places_of_an_image(wraps):
    rng = np.random.default_rng(5)
    flat = flatten(on_wall(Texture(noise(7, 5), wraps)))
    objects = np.zeros(1, int)
    for size in 5 * (0.4, 2.3, 3.9, 40.0):
        low = rng.uniform(-9, 9, 2)
        extent = np.array((size, 0.3 * size))
        corners = np.stack([low, low + extent])[:, None]
        least, most = between(sampled, flat, objects, corners)
        steps = np.stack(np.meshgrid(*[np.linspace(0, 1, 60)] * 2), -1).reshape(-1, 2)
        seen = sampled(flat, np.zeros(len(steps), int), low + steps * extent)
        assert (least <= seen + 1e-9).all() and (most >= seen - 1e-9).all()
        if size < 4:  # no more than there is
            assert np.abs(seen.min(axis=0) - least).max() < 0.03
            assert np.abs(seen.max(axis=0) - most).max() < 0.03
