"""The camera that was written: exact for every affine generator, and none for any other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from asked_rays import KINDS, made_camera

from app.checking.mistakes.difference import Fit
from app.checking.mistakes.differences import told_differences
from app.checking.mistakes.fitted import affine_rays
from renderer.camera import Camera


def pixels(size):
    return np.broadcast_arrays(np.arange(size[1])[:, None], np.arange(size[0]))


def units(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def fitted(camera, size, lengths=None, form=np.float64):
    """Fit a camera to a camera's rays, with directions of these lengths, in this precision."""
    origin, direction = camera.rays(size)
    direction = direction if lengths is None else units(direction) * lengths
    i, j = pixels(size)
    given = origin.astype(form), direction.astype(form)
    return affine_rays(i, j, *given, float(np.linalg.norm(camera.eye)))


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize("kind", KINDS)
def test_every_camera_is_found_exactly(kind, projection):
    """From its own rays, and asked for another: its rays come back, whatever the lengths."""
    random = np.random.default_rng(11)
    for number in range(60):
        camera = made_camera(random, kind, projection)
        asked = made_camera(random, KINDS[number % len(KINDS)], projection)
        size = tuple(random.integers(2, 9, 2).tolist())
        lengths = None if number % 2 else random.uniform(0.1, 10, (size[1], size[0], 1))
        found = fitted(camera, size, lengths)
        assert found.is_parallel == camera.is_parallel and found.starts_there
        assert found.error < 1e-13
        again, right = found.camera(asked, size).rays(size), camera.rays(size)
        assert np.abs(again.origin - right.origin).max() < 1e-11
        assert np.abs(units(again.direction) - units(right.direction)).max() < 1e-11
        assert told_differences([Fit(camera, size, found)]) == ()


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_float32_is_found_and_is_no_difference(projection):
    random = np.random.default_rng(12)
    for number in range(60):
        camera = made_camera(random, KINDS[number % len(KINDS)], projection)
        size = tuple(random.integers(3, 9, 2).tolist())
        found = fitted(camera, size, form=np.float32)
        assert found.error < 1e-6
        assert told_differences([Fit(camera, size, found)]) == ()
        halved = replace(camera, distance=camera.distance / 2)
        if not camera.is_parallel:
            told = told_differences([Fit(camera, size, fitted(halved, size, form=np.float32))])
            assert told == ("your d is 0.5 d",)


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize("world", [1e-5, 1e5])
def test_a_world_of_another_size(world, projection):
    """All of it is as much larger, roundings too; where it is no camera, it is none at any size."""
    random = np.random.default_rng(13)
    for number in range(20):
        camera = made_camera(random, KINDS[number % len(KINDS)], projection)
        size = tuple(random.integers(3, 9, 2).tolist())
        origin, direction = (part.astype(np.float32).astype(float) for part in camera.rays(size))
        bump = 1e-4 * (number % 3 == 2) * random.normal(size=origin.shape)
        (i, j), reach = pixels(size), float(np.linalg.norm(camera.eye))
        one = affine_rays(i, j, origin + bump, direction, reach)
        other = affine_rays(i, j, world * (origin + bump), world * direction, world * reach)
        assert (one is None) == (other is None) == (number % 3 == 2)
        if one is not None and other is not None:
            assert (one.is_parallel, one.starts_there, one.keeps_lengths) == (
                other.is_parallel, other.starts_there, other.keeps_lengths
            )  # fmt: skip
            assert other.scale == pytest.approx(world * one.scale)
            assert other.error == pytest.approx(one.error, rel=0.5, abs=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_a_camera_far_from_the_origin_in_float32(kind):
    """Directions are differences of large numbers: what these have lost is no mistake."""
    random = np.random.default_rng(14)
    for _ in range(20):
        camera = made_camera(random, kind)
        far = replace(camera, eye=tuple(1000 * np.asarray(camera.eye)))
        i, j = pixels((6, 5))
        origin, direction = far.rays((6, 5))
        eye = origin.astype(np.float32)
        given = (eye + direction.astype(np.float32)) - eye
        reach = float(np.abs(origin).max())
        found = affine_rays(i, j, eye, given, reach)
        assert found is not None and not found.is_parallel
        assert told_differences([Fit(far, (6, 5), found)]) == ()
        turned = replace(far, u=tuple(np.add(far.u, (0, 0.2, 0.1))))
        assert told_differences([Fit(turned, (6, 5), found)])


def test_any_affine_rays_by_hand():
    """direction = A + i B + j C of no camera in mind: three rows of a matrix."""
    i, j = pixels((5, 4))
    made = [np.array([3.0, -1, 2]), np.array([0.5, 0.25, 1]), np.array([-1.0, 2, 0.125])]
    direction = made[0] + i[..., None] * made[1] + j[..., None] * made[2]
    found = affine_rays(i, j, np.full_like(direction, 7.0), direction)
    for part, wanted in zip((found.at, found.row, found.column), made, strict=True):
        assert part == pytest.approx(wanted, abs=1e-12)
    assert found.keeps_lengths and (found.fixed == 7.0).all()
    assert not affine_rays(i, j, np.full_like(direction, 7.0), units(direction)).keeps_lengths


def test_rays_that_start_further_on():
    camera = made_camera(np.random.default_rng(3), "skewed")
    size = (5, 4)
    origin, direction = camera.rays(size)
    i, j = pixels(size)
    found = affine_rays(i, j, origin + direction, direction)
    assert not found.starts_there
    assert found.fixed == pytest.approx(camera.eye)


def bent(direction, i, j):
    return direction + 0.01 * (i * j)[..., None]


@pytest.mark.parametrize(
    "make",
    [
        lambda o, d, i, j: (o, bent(d, i, j)),
        lambda o, d, i, j: (bent(o, i, j), d),
        lambda o, d, i, j: (o, np.where((i == 1)[..., None], -d, d)),
        lambda o, d, i, j: (o, np.where((i == 1)[..., None], 0, d)),
        lambda o, d, i, j: (o, np.where((i == 1)[..., None], np.nan, d)),
        lambda o, d, i, j: (np.where((i == 1)[..., None], np.inf, o), d),
        # A single ray is another.
        lambda o, d, i, j: (o, d + 1e-3 * ((i == 2) & (j == 3))[..., None] * (1, -1, 2)),
        lambda o, d, i, j: (o + 1e-3 * ((i == 2) & (j == 3))[..., None] * (1, -1, 2), d),
    ],
)
def test_other_rays_are_no_camera_s(make):
    camera = made_camera(np.random.default_rng(3), "skewed")
    i, j = pixels((5, 4))
    assert affine_rays(i, j, *make(*camera.rays((5, 4)), i, j)) is None
    parallel = replace(camera, projection="parallel").rays((5, 4))
    assert affine_rays(i, j, bent(parallel.origin, i, j), parallel.direction) is None


def test_too_few_pixels_tell_nothing():
    camera = made_camera(np.random.default_rng(3), "skewed")
    for projection in ("perspective", "parallel"):
        turned = replace(camera, projection=projection)
        for size in ((1, 1), (1, 6), (6, 1)):
            i, j = pixels(size)
            assert affine_rays(i, j, *turned.rays(size)) is None
        assert fitted(turned, (2, 2)) is not None


def test_flat_rays_have_no_camera():
    """Directions in one plane: affine, but u, v, w would not be independent."""
    i, j = pixels((5, 4))
    direction = np.stack([j, 0 * j, -1 - 0 * j], axis=-1).astype(float)
    found = affine_rays(i, j, np.zeros_like(direction), direction)
    assert found is None or found.camera(Camera(), (5, 4)) is None


SKEWED = Camera((1, 2, 3), (1, 0.2, 0), (0.1, 2, 0), (0, 0.3, 1.5), 2.5, (-0.7, 0.9, -0.4, 0.8))


def told(change, projection="perspective", normalised=False):
    """Return the diagnosis of two cameras that are changed in the same way."""
    fits = []
    for asked, size in ((SKEWED, (6, 4)), (replace(SKEWED, eye=(-3, 1, 2), distance=1.5), (5, 7))):
        camera = replace(asked, projection=projection)
        lengths = 1.0 if normalised else None
        fits.append(Fit(camera, size, fitted(change(camera, size), size, lengths)))
    return told_differences(fits)


def scaled(name, factor):
    return lambda camera, size: replace(
        camera, **{name: tuple(np.multiply(getattr(camera, name), factor))}
    )


def mirrored(name, order):
    """Return the change that counts the pixels of an axis from its other end."""

    def change(camera, size):
        signs = [-1 if place != number else 1 for number, place in enumerate(order)]
        viewport = tuple(np.multiply(np.take(camera.viewport, order), signs))
        return scaled(name, -1)(replace(camera, viewport=viewport), size)

    return change


BOTH = {
    "your u points to the left": scaled("u", -1),
    "your v points down": scaled("v", -1),
    "your w points forwards": scaled("w", -1),
    "your u is 3 u": scaled("u", 3),
    "your columns count leftwards": mirrored("u", (1, 0, 2, 3)),
    "your rows count upwards": mirrored("v", (0, 1, 3, 2)),
    "your eye is the world's origin": scaled("eye", 0),
    "your eye is 2 e": scaled("eye", 2),
    "your eye is -e": scaled("eye", -1),
    "your eye is e + (0, 1, 0)": lambda c, size: replace(c, eye=tuple(np.add(c.eye, (0, 1, 0)))),
    "your viewport is shifted by half a pixel to the left and up":
        lambda c, size: c.shifted(-0.5, -0.5, size),
    "your viewport is shifted by one pixel to the right": lambda c, size: c.shifted(0, 1, size),
    "your viewport is shifted by half a pixel down": lambda c, size: c.shifted(0.5, 0, size),
    "your u is v; your v is u": lambda c, size: replace(c, u=c.v, v=c.u),
    "your u is the world's x": lambda c, size: replace(c, u=(1, 0, 0)),
    "your basis is that of the world":
        lambda c, size: replace(c, u=(1, 0, 0), v=(0, 1, 0), w=(0, 0, 1)),
}  # fmt: skip
PERSPECTIVE = {
    "your d is 2 d": lambda c, size: replace(c, distance=2 * c.distance),
    "your d is 1": lambda c, size: replace(c, distance=1.0),
    "your basis is transposed: rows for columns":
        lambda c, size: replace(c, **dict(zip("uvw", map(tuple, c.basis.tolist()), strict=True))),
}  # fmt: skip


class TestInWords:
    @pytest.mark.parametrize("saying", BOTH)
    @pytest.mark.parametrize("projection", ["perspective", "parallel"])
    def test_of_both_projections(self, saying, projection):
        assert "; ".join(told(BOTH[saying], projection)) == saying

    @pytest.mark.parametrize("saying", PERSPECTIVE)
    def test_in_perspective(self, saying):
        assert "; ".join(told(PERSPECTIVE[saying])) == saying

    @pytest.mark.parametrize(
        "saying", ["your v points down", "your d is 2 d", "your w points forwards"]
    )
    def test_of_directions_of_length_1(self, saying):
        assert "; ".join(told((BOTH | PERSPECTIVE)[saying], normalised=True)) == saying

    def test_numbers_where_no_words_hold_for_all(self):
        def other(camera, size):
            return replace(camera, eye=tuple(np.sin(camera.eye)))

        assert told(other) == ("your eye is (0.8415, 0.9093, 0.1411), not (1, 2, 3)",)

    def test_another_projection(self):
        def other(camera, size):
            return replace(camera, projection="parallel")

        assert told(other) == ("your rays are parallel",)

    def test_two_at_once(self):
        def both(camera, size):
            return replace(camera.shifted(0, 1, size), eye=(0, 0, 0))

        assert set(told(both)) == {
            "your eye is the world's origin",
            "your viewport is shifted by one pixel to the right",
        }
