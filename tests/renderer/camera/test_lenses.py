"""Lenses against OpenCV and pycolmap, and their inverses."""

import math

import numpy as np
import pytest

from lucida import LucidaError
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import MODELS, Lens

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


def random_lens(model, rng):
    drawn = {name: rng.normal() * SPREAD[name[0]] for name in MODELS[model]}
    return Lens(model, {"omega": rng.uniform(0.2, 2.5)} if model == "fov" else drawn)


@pytest.mark.parametrize("model", MODELS)
def test_what_a_lens_sees_comes_back(model):
    """Directions all around; those within 85 degrees for lenses that bend the pinhole's plane."""
    rng = np.random.default_rng(7)
    for _ in range(8):
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


@pytest.mark.parametrize("model", ["fov", "equisolid", "orthographic", "equirectangular"])
def test_the_images_axes_end_where_directions_do(model):
    lens = Lens(model, {"omega": 0.9} if model == "fov" else {})
    for axis in np.eye(2):
        for end in lens.ends(int(axis[1])):
            assert np.isfinite(lens.direction(*(0.999 * end * axis))).all()
            assert np.isnan(lens.direction(*(1.001 * end * axis))).all()


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


def test_a_lens_is_a_lens():
    with pytest.raises(LucidaError, match="lens: is of type str, not a Lens"):
        Camera(lens="fisheye")
