"""A rasterizer that follows: whatever it has drawn before, moved, or left half drawn, its next
image is that of a new one."""

import numpy as np
import pytest

from lucida import Rasterizer
from lucida.renderer.camera.camera import Camera
from lucida.renderer.editing.moving import shift
from lucida.renderer.editing.outline import outline
from lucida.renderer.files import load_scene
from lucida.renderer.raster.tables import TABLE_WIDTH
from lucida.renderer.scene import Scene

SIZES = (40, 30), (44, 30)
CHANNELS = ("depth", "id", "normal")
CAMERAS = [
    Camera.look_at(eye, (0, 0, 0), fov_y_deg=50) for eye in ((0, 1, 4), (3, 2, 2), (-2, 3, -3))
]
TORI = "".join(
    f'[[objects]]\ntype = "torus"\nsegments = 128\nsides = 64\ntranslate = [{x}, 0, 0]\n'
    for x in (-1.2, 0, 1.2)
)
SPHERE = '[[objects]]\ntype = "sphere"\nradius = 0.3\n'


@pytest.fixture
def start(tmp_path):
    (tmp_path / "scene.toml").write_text(TORI + SPHERE)
    return load_scene(tmp_path / "scene.toml")


def test_what_is_drawn_does_not_depend_on_what_was(start, gl_backend):
    with Rasterizer(start, gl_backend) as rasterizer, Rasterizer(start, gl_backend) as new:
        assert sum(len(one.shape.faces) for one in start.objects[:3]) > 4 * TABLE_WIDTH
        for seed in range(8):
            rng = np.random.default_rng([20261124, seed])
            scene, done = start, []
            rasterizer.set_scene(scene)
            for _ in range(8):
                camera, size = CAMERAS[rng.integers(len(CAMERAS))], SIZES[rng.integers(2)]
                kind = str(rng.choice(["move", "move", "all"]))
                done.append(kind)
                if kind == "move":
                    row = outline(scene)[rng.integers(4)]
                    scene = shift(scene, [row.item], 0.3 * rng.normal(size=3))
                    rasterizer.set_scene(scene)
                else:
                    rasterizer.draw(camera, size)
            frame = rasterizer.render(camera, size, CHANNELS)
            new.set_scene(Scene(()))
            new.set_scene(scene)
            wanted = new.render(camera, size, CHANNELS)
            for name in CHANNELS:
                one, other = frame.channel(name), wanted.channel(name)
                np.testing.assert_array_equal(one, other, err_msg=f"{name} after {done}")
