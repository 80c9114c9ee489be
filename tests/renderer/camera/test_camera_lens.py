"""Cameras with a lens: rays, projected points, view files and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from lucida import Camera, LucidaError, View
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.views import view_from_toml, view_to_toml

SIZE = (120, 80)
PINHOLE = Camera.look_at((1.0, 2.0, 5.0), (0.0, 0.0, 0.0), fov_y_deg=70.0, aspect=1.5)
PINHOLE = replace(PINHOLE, v=(0.1, 1.1, 0.0), near=0.1)
LENSES = [
    Lens("brown", {"k1": -0.2, "k2": 0.03, "p1": 0.01}),
    Lens("fisheye", {"k1": 0.02}),
    Lens("fov", {"omega": 0.9}),
    Lens("thin_prism_fisheye", {"k1": 0.01, "sx1": 0.002}),
    Lens("stereographic"),
    Lens("equirectangular"),
    Lens("cylindrical"),
]


@pytest.mark.parametrize("lens", LENSES, ids=lambda lens: lens.model)
def test_points_of_a_ray_are_projected_to_its_pixel(lens):
    camera = replace(PINHOLE, lens=lens, distance=0.4)
    origin, direction = camera.rays(SIZE)
    row, column, parameter = camera.project(origin + 3 * direction, SIZE)
    seen = np.isfinite(direction[..., 0])
    assert seen.mean() > 0.5
    assert np.abs(row - np.arange(SIZE[1])[:, None])[seen].max() < 1e-9
    assert np.abs(column - np.arange(SIZE[0]))[seen].max() < 1e-9
    assert np.abs(parameter - 3)[seen].max() < 1e-9
    assert camera.ray(40, 60, SIZE).direction == pytest.approx(direction[40, 60], abs=1e-12)


def test_a_lens_that_distorts_nothing_has_the_pinholes_rays():
    camera = replace(PINHOLE, lens=Lens("brown"))
    assert np.allclose(camera.rays(SIZE).direction, PINHOLE.rays(SIZE).direction, atol=1e-15)
    assert camera.fov_x_deg == pytest.approx(PINHOLE.fov_x_deg)
    assert camera.pinhole == PINHOLE


def test_a_panorama_sees_all_around():
    everything = (-np.pi, np.pi, -np.pi / 2, np.pi / 2)
    camera = Camera(viewport=everything, lens=Lens("equirectangular"))
    assert (camera.fov_x_deg, camera.fov_y_deg) == pytest.approx((360, 180))
    ways = camera.ray(39.5, np.array([0, 30, 60, 90]) - 0.5, SIZE).direction
    assert ways == pytest.approx(np.array([(0, 0, 1), (-1, 0, 0), (0, 0, -1), (1, 0, 0)]))


@pytest.mark.parametrize("lens", LENSES, ids=lambda lens: lens.model)
def test_a_view_file_holds_the_lens(lens):
    view = View(replace(PINHOLE, lens=lens), False)
    assert view_from_toml(view_to_toml(view)) == view


@pytest.mark.parametrize(
    ("lens", "message"),
    [
        ("{ k1 = 0.1 }", "camera.lens.model: is missing"),
        ('{ model = "wide" }', "camera.lens.model: 'wide' is unknown"),
        ('{ model = "fisheye", k9 = 1 }', "camera.lens.k9: is not a coefficient of fisheye"),
        ('{ model = "brown", k1 = nan }', "camera.lens.k1: nan is not finite"),
    ],
)
def test_a_view_files_lens_is_checked(lens, message):
    with pytest.raises(LucidaError, match=f"^{message}"):
        view_from_toml(f"lucida = 1\n[camera]\nlens = {lens}\n")


def test_parallel_rays_pass_through_no_lens():
    with pytest.raises(LucidaError, match="parallel rays cannot pass through a lens"):
        replace(PINHOLE, projection="parallel", lens=Lens("brown"))
