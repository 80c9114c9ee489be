"""Lenses against OpenCV and pycolmap, their inverses, and photographs without their lens."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lucida import Camera, LucidaError
from lucida.renderer.camera.lenses import MODELS, Lens
from lucida.renderer.camera.undistort import undistorted, undistorted_camera

DIRECTIONS = np.array([(0.64, 0.48, 1.0), (-0.64, 0.3, 1.0)]).T
# Where these appear: cv2.projectPoints and cv2.fisheye of OpenCV 5.0.0, pycolmap 4.2.1.
SEEN = [
    (
        "brown",
        {"k1": 0.1, "k2": -0.05, "p1": 0.002, "p2": -0.003, "k3": 0.02, "k4": 0.01, "k5": 0.03}
        | {"k6": -0.01, "s1": 0.004, "s2": -0.002, "s3": 0.003, "s4": 0.001},
        (0.6591867578867274, 0.4981340684150456, -0.661412505937882, 0.3127848996683822),
    ),
    (
        "fisheye",
        {"k1": 0.1, "k2": -0.02, "k3": 0.01, "k4": 0.003},
        (0.5627094314700939, 0.4220320736025704, -0.576952104574677, 0.27044629901937983),
    ),
    (
        "fov",
        {"omega": 0.9},
        (0.5848793773892991, 0.43865953304197425, -0.6027704241778001, 0.2825486363333438),
    ),
    (
        "thin_prism_fisheye",
        {"k1": -0.01, "k2": 0.002, "p1": 0.003, "p2": -0.004, "k3": 0.0005, "k4": 0.0006}
        | {"sx1": 0.007, "sy1": -0.008},
        (0.5379443756902332, 0.40015753555910766, -0.5574135985265183, 0.2599270912288938),
    ),
    (
        "equidistant",
        {},
        (0.5397927537788422, 0.4048445653341316, -0.5571208102071965, 0.2611503797846233),
    ),
]
SPREAD = {"k": 0.05, "p": 0.004, "s": 0.002, "r": 0.01, "o": 0.0}  # of random coefficients


@pytest.mark.parametrize(("model", "coefficients", "seen"), SEEN)
def test_a_direction_appears_where_opencv_and_colmap_see_it(model, coefficients, seen):
    a, b = Lens(model, coefficients).image_point(*DIRECTIONS)
    assert np.ravel(np.stack([a, b], axis=1)).tolist() == pytest.approx(seen, abs=1e-14)


def random_lens(model: str, rng: np.random.Generator) -> Lens:
    drawn = {name: rng.normal() * SPREAD[name[0]] for name in MODELS[model]}
    return Lens(model, {"omega": rng.uniform(0.2, 2.5)} if model == "fov" else drawn)


@pytest.mark.parametrize("model", MODELS)
def test_what_a_lens_sees_comes_back(model):
    """Directions all around; those within 85 degrees for lenses that bend the pinhole's plane."""
    rng = np.random.default_rng(7)
    for _ in range(20):
        lens = random_lens(model, rng)
        directions = rng.normal(size=(3, 2000))
        across = np.hypot(*directions[:2])
        if model == "brown":
            directions = directions[:, directions[2] > 0.1 * across]
        a, b = lens.image_point(*directions)
        seen = np.isfinite(a)
        assert seen.mean() > 0.2
        found = np.stack(lens.direction(a[seen], b[seen]))
        lost = np.isnan(found[0])
        assert lost.sum() <= 1  # next to a fold, whose place is interpolated
        seen[seen] = ~lost
        wanted, found = directions[:, seen], found[:, ~lost]
        wanted, found = (d / np.linalg.norm(d, axis=0) for d in (wanted, found))
        again = np.stack(lens.image_point(*found))
        moved = np.hypot(*(again - (a[seen], b[seen])))
        assert (moved / (1 + np.hypot(a[seen], b[seen]))).max() < 1e-12
        assert (wanted * found).sum(axis=0).min() > 1 - 1e-9


def test_the_middle_is_the_axis_and_zeros_are_the_ideal():
    for model in MODELS:
        lens = Lens(model, {"omega": 1.0} if model == "fov" else {})
        assert np.allclose(lens.image_point(0, 0, 2), 0, atol=0), model
        assert np.allclose(lens.direction(0.0, 0.0), (0, 0, 1), atol=0), model
    x, y, z = Lens("brown").direction(0.3, -0.2)
    assert (float(x), float(y), float(z)) == (0.3, -0.2, 1.0)


@pytest.mark.parametrize(
    ("lens", "seen", "unseen"),
    [
        (Lens("brown", {"k1": -0.1}), (1.8, 0, 1), (1.9, 0, 1)),  # r (1 - r^2 / 10) folds at 1.826
        (Lens("brown", {"k4": -0.25}), (1.9, 0, 1), (2.1, 0, 1)),  # divides by 0 at 2
        (Lens("brown"), (9, 0, 1), (1, 0, -1)),
        (Lens("fisheye", {"k1": -0.1}), (9, 0, -1.7), (9, 0, -3)),  # folds at 104.6 degrees
        (Lens("orthographic"), (1, 0, 0), (9, 0, -0.1)),
        (Lens("fov", {"omega": 1.0}), (9, 0, 1), (1, 0, -1)),
        (Lens("stereographic"), (0.01, 0, -1), (0, 0, -1)),
    ],
)
def test_a_lens_ends_where_its_map_folds(lens, seen, unseen):
    point = lens.image_point(*seen)
    assert np.isfinite(point).all() and np.isfinite(lens.direction(*point)).all()
    assert np.isnan(lens.image_point(*unseen)).all()


def test_points_outside_of_a_lens_have_no_direction():
    fold = 2 / 3 * math.sqrt(1 / 0.3)  # r (1 - r^2 / 10) at most
    lens, bent = Lens("brown", {"k1": -0.1}), Lens("brown", {"k1": -0.1, "p1": 1e-3})
    for one in (lens, bent):
        assert np.isfinite(one.direction(0.98 * fold, 0.0)).all()
        assert np.isnan(one.direction(1.05 * fold, 0.0)).all()
    assert np.isnan(Lens("equirectangular").direction(3.2, 0.0)).all()
    assert np.isnan(Lens("orthographic").direction(1.1, 0.0)).all()


@pytest.mark.parametrize(
    ("model", "coefficients", "field"),
    [
        ("bent", {}, "lens.model"),
        ([], {}, "lens.model"),
        ("brown", [0.1], "lens.coefficients"),
        ("fisheye", {"p1": 0.1}, "lens.p1"),
        ("equidistant", {"k1": 0.1}, "lens.k1"),
        ("brown", {"k1": math.inf}, "lens.k1"),
        ("fov", {}, "lens.omega"),
        ("fov", {"omega": 3.2}, "lens.omega"),
    ],
)
def test_a_wrong_lens_names_the_field(model, coefficients, field):
    with pytest.raises(LucidaError) as caught:
        Lens(model, coefficients)
    assert caught.value.field == field and caught.value.remedy


# Undistorting.

# pycolmap.undistort_camera of images of 640 x 480: the size, and fx, fy, cx, cy.
PINHOLES = [
    (
        Lens("brown", {"k1": -0.2, "k2": 0.05, "p1": 0.003, "p2": -0.002}),
        (500.0, 510.0, 330.0, 235.0),
        (699, 501),
        (500.0, 510.0, 360.421875, 245.28125),
    ),
    (
        Lens("brown", {"k1": 0.2}),
        (500.0, 500.0, 320.0, 240.0),
        (578, 433),
        (500.0, 500.0, 289.0, 216.5),
    ),
    (
        Lens("fisheye", {"k1": 0.02, "k2": -0.01, "k3": 0.001}),
        (300.0, 305.0, 330.0, 235.0),
        (1010, 594),
        (300.0, 305.0, 520.78125, 290.8125),
    ),
]
Four = tuple[float, float, float, float]


def camera_of(fx: float, fy: float, cx: float, cy: float) -> Camera:
    K = [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]
    return Camera.from_intrinsics(K, size=(640, 480), pixel_origin="corner")


@pytest.mark.parametrize(("lens", "own", "size", "wanted"), PINHOLES)
def test_the_pinhole_is_colmaps(lens, own, size, wanted):
    camera, found = undistorted_camera(camera_of(*own), lens, (640, 480))
    assert found == size
    (fx, _, cx), (_, fy, cy), _ = camera.intrinsics(size, "corner").K.tolist()
    assert (fx, fy, cx, cy) == pytest.approx(wanted)


@pytest.mark.parametrize(("lens", "own"), [row[:2] for row in PINHOLES])
def test_a_pinholes_pixel_is_the_photographs_of_the_same_direction(lens, own):
    """On a photograph whose colours are linear in the place, interpolation is exact."""
    fx, fy, cx, cy = own
    columns, rows = np.meshgrid(np.arange(640), np.arange(480))
    photograph = np.stack([columns / 640 * 255, rows / 480 * 255], axis=2)
    photograph = np.concatenate([photograph, np.full((480, 640, 1), 9.0)], axis=2)
    camera, size = undistorted_camera(camera_of(*own), lens, (640, 480))
    found = undistorted(photograph.astype(np.uint8), camera_of(*own), lens, (640, 480))
    assert found.shape == (size[1], size[0], 3)
    ray = camera.rays(size).direction  # u is x, v is -y, w is -z
    a, b = lens.image_point(ray[..., 0], ray[..., 1], ray[..., 2])
    x, y = fx * a + cx - 0.5, fy * b + cy - 0.5
    inside = found[..., 2] > 0
    assert inside.mean() > 0.99  # no gap, but for the border's half pixels
    wanted = np.stack([x / 640 * 255, y / 480 * 255], axis=2)
    assert np.abs(found[..., :2] - wanted)[inside].max() < 1.6  # each rounded down at four pixels


def test_a_photograph_of_any_lens_gets_a_picture_of_a_sane_size():
    half = math.pi
    panorama = Camera(viewport=(-half, half, -half / 2, half / 2))
    for camera in (panorama, Camera(viewport=(0.1, 0.9, -2, -1)), Camera(viewport=(-1, 1, -1, 1))):
        for lens in (Lens("equirectangular"), Lens("brown", {"k1": -3.0, "p1": 0.1})):
            _, (width, height) = undistorted_camera(camera, lens, (64, 48))
            assert 12 <= width <= 128 and 9 <= height <= 96
