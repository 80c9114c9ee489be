"""Ray images through lenses: against the reference, against brute force, and against the pinhole.

Packets are float32: a pixel may differ from the float64 reference only where a thousandth of a
pixel, in some direction, decides what is seen.
"""

from dataclasses import replace

import numpy as np
import pytest
from both_engines import Both
from scenes import crowd
from textured import noise, on_wall
from trace_reference import ball, closest, random_basis, random_scene, scene_of

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import MODELS, Lens
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.texture import Texture
from lucida.renderer.trace import Tracer
from lucida.renderer.trace.arguments.image import Rows
from lucida.renderer.trace.threads.thread_pool import new_control
from lucida.renderer.trace.tiles.lens_table import lens_table

COEFFICIENTS = {
    "brown": {"k1": -0.2, "k2": 0.05, "p1": 0.01, "p2": -0.01, "s1": 0.002},
    "fisheye": {"k1": 0.02, "k2": -0.01},
    "fov": {"omega": 0.9},
    "thin_prism_fisheye": {"k1": 0.02, "p1": 0.003, "sx1": 0.002},
}
LENSES = [Lens(model, COEFFICIENTS.get(model, {})) for model in MODELS]
EVERYTHING = (-np.pi, np.pi, -np.pi / 2, np.pi / 2)
WIDE = {  # 190 degrees, and all around
    "equidistant": (-1.66, 1.66, -1.66, 1.66),
    "stereographic": (-2.2, 2.2, -2.2, 2.2),
    "equirectangular": EVERYTHING,
    "cylindrical": (-np.pi, np.pi, -1.5, 1.5),
}
FROM = Camera.look_at((1.2, 0.9, 1.7), (0.0, 0.2, 0.0))
VISIBILITY = ("depth", "primitive")


def seen_through(lens, camera=FROM):
    viewport = WIDE.get(lens.model, (-0.8, 0.75, -0.55, 0.6))
    return replace(camera, lens=lens, distance=1.0, viewport=viewport)


@pytest.fixture(scope="module")
def both():
    pair = Both(crowd())
    yield pair
    pair.close()


def check(pair, camera, size):
    """Return the packets' image, which must be the reference's."""
    reference, packets = pair.frames(camera, size)
    same = packets.primitive == reference.primitive
    for rows, columns in ((0, 1e-3), (1e-3, 0), (0, -1e-3), (-1e-3, 0)) if not same.all() else ():
        beside = pair.frames(camera.shifted(rows, columns, size), size, ("primitive",))[0]
        same |= packets.primitive == beside.primitive
    assert same.all()
    hit = (packets.primitive == reference.primitive) & (reference.primitive >= 0)
    assert hit.any()
    assert packets.depth[hit] == pytest.approx(reference.depth[hit], rel=1e-4)
    assert np.isinf(packets.depth[packets.primitive < 0]).all()
    assert np.isfinite(packets.color).all()
    for channel in ("normal", "color"):
        error = np.abs(packets.channel(channel) - reference.channel(channel)).max(axis=2)
        assert (error[hit] > 2e-3).mean() < 2e-3  # on the borders of a checker
    return packets


@pytest.mark.parametrize("size", [(86, 75), (47, 22), (5, 3)], ids=str)
@pytest.mark.parametrize("lens", LENSES, ids=lambda lens: lens.model)
def test_packets_see_what_the_reference_sees(lens, size, both):
    """A small panorama's tile sees all around, and is divided."""
    check(both, seen_through(lens), size)


@pytest.mark.parametrize("seed", range(6))
def test_skewed_bases_and_clip_planes(seed, both):
    random = np.random.default_rng(seed)
    camera = seen_through(LENSES[seed % 2 * 4 + random.integers(4)])
    u, v, w = random_basis(random).tolist()
    camera = replace(camera, u=u, v=v, w=w, eye=tuple(0.7 * random.normal(size=3)))
    camera = replace(camera, distance=2.0, viewport=tuple(2 * side for side in camera.viewport))
    frame = check(both, replace(camera, near=0.2, far=1.6), (90, 70))
    hit = frame.primitive >= 0
    assert ((frame.depth > 0.1) & (frame.depth < 0.8))[hit].all()


@pytest.mark.parametrize("lens", LENSES, ids=lambda lens: lens.model)
def test_images_match_brute_force(lens):
    size = (24, 17)
    scene = random_scene(np.random.default_rng(5))
    camera = seen_through(lens, Camera.look_at((0.3, 0.5, 1.2), (0.0, 0.0, 0.0)))
    origin, direction = (part.reshape(-1, 3) for part in camera.rays(size))
    seen = np.isfinite(direction[:, 0])
    hits = closest(flatten(scene), origin[seen], direction[seen])
    with Tracer(scene) as tracer:
        frame = tracer.render(camera, size, VISIBILITY)
    assert (frame.primitive.ravel()[~seen] == -1).all()
    same = frame.primitive.ravel()[seen] == hits.primitive
    assert (~same & ~hits.doubtful).sum() == 0
    hit = same & (hits.primitive >= 0)
    assert frame.depth.ravel()[seen][hit] == pytest.approx(hits.t[hit], rel=1e-4)


def test_outside_of_the_lens_nothing_is_hit():
    scene = scene_of(ball())
    inside = Camera(viewport=(-2.0, 2.0, -2.0, 2.0), lens=Lens("orthographic"))
    size = (120, 120)
    outside = np.isnan(inside.lens_directions(size)[..., 0])
    for method in ("packets", "reference"):
        with Tracer(scene, method=method) as tracer:
            frame = tracer.render(inside, size, ("color", *VISIBILITY))
        assert np.array_equal(frame.primitive < 0, outside)
        assert (frame.color[outside] == np.float32(scene.background)).all()
    assert 0.7 < outside.mean() < 0.9


@pytest.mark.parametrize("size", [(640, 320), (33, 20)], ids=str)
def test_no_ray_leaves_a_closed_mesh(size):
    """Through edges and corners of tiles, and from one tile to another of another frame."""
    mesh = ball(90, 130)
    with Tracer(scene_of(mesh)) as tracer:
        for lens in (Lens("equirectangular"), Lens("equidistant")):
            for eye in ((0.0, 0.0, 0.0), (0.3, -0.2, 0.5)):
                camera = replace(seen_through(lens), eye=eye)
                frame = tracer.render(camera, size, VISIBILITY)
                seen = np.isfinite(camera.lens_directions(size)[..., 0])
                assert (frame.primitive[seen] >= 0).all()


@pytest.mark.parametrize("name", ["crowd", "textured"])
def test_a_lens_that_bends_nothing_shows_the_pinholes_picture(name):
    """With shadows, mirrors, textures and several samples."""
    texture = Texture(noise(37, 23))
    scene = crowd() if name == "crowd" else on_wall(texture)
    pinhole = FROM if name == "crowd" else Camera((0.3, -0.2, 0.5), distance=0.6)
    with Tracer(scene, shadows=True, mirror_depth=2) as tracer:
        wanted, image = (
            tracer.render(camera, (101, 83), ("color", *VISIBILITY), samples=4)
            for camera in (pinhole, replace(pinhole, lens=Lens("brown")))
        )
    assert (wanted.primitive != image.primitive).sum() <= 2
    error = np.abs(wanted.color - image.color).max(axis=2)
    assert np.quantile(error, 0.99) < 1e-3
    assert (error > 0.02).mean() < 4e-3  # where a mirrored ray just meets an edge


def test_a_table_is_made_once_for_a_lens_and_a_size():
    camera, size = seen_through(Lens("stereographic")), (70, 50)
    rows = Rows(size, 0, 50)
    table = lens_table(camera, rows, new_control())
    moved = replace(camera, eye=(9.0, 8.0, 7.0), u=(0.0, 1.0, 0.5), v=(-1.0, 0.0, 0.0))
    assert lens_table(moved, rows, new_control()) is table
    assert lens_table(moved.shifted(0.5, 0.0, size), rows, new_control()) is not table
