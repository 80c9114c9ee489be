"""Which scenes need exact positions in the cells of checkers."""

import numpy as np
import pytest

from lucida import Camera
from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Checker, Mesh, Scene, SceneObject
from lucida.renderer.trace.tiles.cells import are_blurred, cells_of


def is_coarse_for_cells(scene, camera):
    eye, back = np.array(camera.eye), np.array(camera.w)
    to_t = -camera.camera_from_world[2, :3]
    return are_blurred(
        cells_of(flatten(scene)), eye, to_t, back if camera.is_parallel else None, 2.0**-22
    )


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_usual_scenes_need_no_exact_cells(name):
    scene = load_scene(name)
    assert not is_coarse_for_cells(scene, scene.view.camera)


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_thin_cells_are_coarse(projection):
    camera = Camera((0.3, -0.2, 5.0), viewport=(-0.8, 0.7, -0.4, 0.6), projection=projection)
    corners = [(-1, 0, 0.5), (1, 0.1, -0.5), (0.2, 1.06, 0.3)]
    mesh = Mesh(corners, [[0, 1, 2]], transform=np.diag((1e-3, 500.0, 300.0, 1.0)))
    assert not is_coarse_for_cells(Scene((SceneObject(mesh),)), camera)
    thin = Scene((SceneObject(mesh, Material(checker=Checker(size=0.1))),))
    assert is_coarse_for_cells(thin, camera)
