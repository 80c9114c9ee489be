"""`lucida render` and `lucida compare` for real: files, cameras, progress, and Ctrl-C."""

from __future__ import annotations

import io
import json
import os
import select
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lucida.app.cameras.films.frames import Drawing, Look, Shot
from lucida.app.cli import main
from lucida.app.commands import render_parts
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files import load_scene, save_view
from lucida.renderer.images import ENDINGS, to_srgb8
from lucida.renderer.scene.model import View

ROOT = Path(__file__).parents[3]
SMALL = ("--size", "32x18")


@pytest.fixture(autouse=True)
def in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def drawn(name: str, *options: str) -> np.ndarray:
    """Return what `lucida render` writes into `name`.npy, by the ray tracer unless the options
    differ.
    """
    arguments = ["render", "spheres", "-o", f"{name}.npy", "--renderer", "ray", *SMALL, *options]
    assert main(arguments) == 0
    return np.load(f"{name}.npy", allow_pickle=False)


class TestRender:
    def test_npy_is_as_the_contract_says(self):
        self.check_npy()

    def test_npy_of_the_rasterizer_too(self, gl_backend):
        self.check_npy("--renderer", "raster", "--backend", gl_backend)

    @staticmethod
    def check_npy(*options):
        color = drawn("color", *options)
        depth = drawn("depth", *options, "--channel", "depth")
        normal = drawn("normal", *options, "--channel", "normal")
        index = drawn("id", *options, "--channel", "id")
        assert (color.shape, color.dtype) == ((18, 32, 3), np.float32)
        assert (depth.shape, depth.dtype) == ((18, 32), np.float32)
        assert (normal.shape, normal.dtype) == ((18, 32, 3), np.float32)
        assert (index.shape, index.dtype) == ((18, 32), np.int32)
        hit = index >= 0
        assert hit.any()
        assert (index[~hit] == -1).all()
        assert index.max() < len(load_scene("spheres").objects)
        assert np.isfinite(depth[hit]).all()
        assert np.isposinf(depth[~hit]).all()
        np.testing.assert_allclose(np.linalg.norm(normal[hit], axis=1), 1, atol=1e-5)
        assert not normal[~hit].any()

    @pytest.mark.parametrize("ending", ENDINGS)
    @pytest.mark.parametrize("channel", ["color", "depth", "z", "normal", "id"])
    def test_every_channel_goes_into_every_format(self, capsys, ending, channel):
        name = f"a{ending}"
        arguments = ["render", "spheres", "-o", name, "--renderer", "ray", "--channel", channel]
        assert main([*arguments, *SMALL]) == 0
        told = capsys.readouterr()
        assert told.out.startswith(f"{name}: {channel}, ray, 32x18, ")
        assert not told.err
        assert os.listdir() == [name]

    @pytest.mark.parametrize("lens", [(), ("--lens", "equidistant")])
    def test_z_is_the_distance_along_the_view_also_in_parts(self, lens):
        scene, size = load_scene("spheres"), (32, 18)
        t = drawn("t", "--channel", "depth", *lens)
        z = drawn("z", "--channel", "z", *lens)
        camera = scene.view.for_size(size)
        if lens:
            camera = replace(camera, lens=Lens("equidistant"))
        origin, direction = camera.rays(size)
        hit = np.isfinite(t)
        points = origin[hit] + t[hit][:, None] * direction[hit]
        from_eye = (points - camera.eye) @ np.asarray(camera.w)  # w is a unit vector
        np.testing.assert_allclose(z[hit], -from_eye, rtol=1e-5)
        assert hit.any() and np.isposinf(z[~hit]).all()
        drawing = Drawing(scene, Look("ray", channel="z", ending=".npy"))
        part = np.load(io.BytesIO(drawing.encoded(Shot(camera, size, (5, 11)))))
        drawing.close()
        np.testing.assert_allclose(part, z[5:11], rtol=1e-5)

    @pytest.mark.skipif(sys.platform != "linux", reason="other systems refuse such names")
    def test_a_name_that_is_no_text(self, capsys):
        drawn("\udcff\n")
        assert capsys.readouterr().out.startswith(r"\xff .npy: color")

    def test_row_0_is_the_top(self):
        # The scene's floor is below its sky.
        hit = drawn("id", "--channel", "id") >= 0
        assert hit[-1].all()
        assert not hit[0].all()

    def test_a_view_replaces_the_camera_and_its_viewport_stands(self):
        camera = load_scene("spheres").view.camera
        save_view("own.toml", View(camera, fit=True))
        save_view("stretched.toml", View(camera))
        own = drawn("own", "--channel", "id", "--view", "own.toml")
        np.testing.assert_array_equal(own, drawn("scene", "--channel", "id"))
        stretched = drawn("stretched", "--channel", "id", "--view", "stretched.toml")
        assert (stretched != own).any()

    def test_exposure_brightens_pictures_only(self):
        linear = drawn("a", "--exposure", "-1")
        np.testing.assert_array_equal(linear, drawn("b"))
        arguments = ["render", "spheres", "-o", "a.png", "--renderer", "ray", *SMALL]
        assert main([*arguments, "--exposure", "-1"]) == 0
        with Image.open("a.png") as image:
            np.testing.assert_array_equal(image, to_srgb8(linear / 2))


class TestCompare:
    def test_json_has_counts_that_add_up(self, capsys, gl_backend):
        arguments = ["compare", "spheres", "--size", "96x54", "--backend", gl_backend]
        assert main([*arguments, "--json", "-o", "difference.png"]) == 0
        told = capsys.readouterr()
        assert not told.err
        result = json.loads(told.out)
        assert result["size"] == [96, 54]
        assert result["pixels"] == 96 * 54
        assert result["agree"] + sum(result["explained"].values()) == result["pixels"]
        assert result["unexplained"] == 0
        assert set(result) >= {"max_depth_error", "max_normal_error", "max_color_error", "times_s"}
        with Image.open("difference.png") as image:
            assert image.size == (96, 54)

    def test_disagreement_is_status_1(self, monkeypatch, capsys, gl_backend):
        import lucida.renderer.compare.raster_and_ray

        real = lucida.renderer.compare.raster_and_ray.compare

        def wrong(*arguments):
            comparison = real(*arguments)
            object.__setattr__(comparison, "unexplained", 3)
            return comparison

        monkeypatch.setattr(lucida.renderer.compare.raster_and_ray, "compare", wrong)
        assert main(["compare", "canonical", "--size", "16x16", "--backend", gl_backend]) == 1
        assert "unexplained: 3" in capsys.readouterr().out


@pytest.mark.skipif(sys.platform == "win32", reason="needs a POSIX terminal")
class TestOnATerminal:
    def start(self, terminal: int) -> subprocess.Popen:
        """A rendering that takes minutes, with its standard error on a terminal."""
        command = ["-m", "lucida", "render", "still-life", "-o", "a.png", "--renderer", "ray"]
        options = ["--size", "4000x3000", "--samples", "64"]
        return subprocess.Popen(
            [sys.executable, *command, *options],
            stderr=terminal,
            stdout=subprocess.PIPE,
            env={**os.environ, "PYTHONPATH": str(ROOT), "COLUMNS": "80"},
            # Whoever runs the tests in the background may have switched Ctrl-C off.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        )

    def test_progress_is_drawn_and_ctrl_c_leaves_nothing(self):
        import pty
        import termios

        try:
            ours, theirs = pty.openpty()
        except OSError as error:  # a container without /dev/pts
            pytest.skip(f"no terminal can be had: {error}")
        termios.tcsetwinsize(theirs, (24, 80))
        process = self.start(theirs)
        os.close(theirs)
        try:
            assert b"ray" in self.read_until(ours, b"%")
            process.send_signal(signal.SIGINT)
            shown = self.read_until(ours, b"interrupted")
            assert process.wait() == 130
        finally:
            process.kill()
            process.wait()
            process.stdout.close()
            os.close(ours)
        assert b"lucida: interrupted" in shown
        assert b"Traceback" not in shown
        assert os.listdir() == []

    @staticmethod
    def read_until(terminal: int, wanted: bytes) -> bytes:
        """Read the terminal until `wanted`, the process's end, or a silence of 100 s."""
        seen = b""
        while wanted not in seen and select.select([terminal], [], [], 100)[0]:
            try:
                seen += os.read(terminal, 4096)
            except OSError:  # Linux's way to tell that the other side is closed
                break
        return seen


def test_a_model_is_drawn_without_what_only_other_files_need(tmp_path):
    """Importing these would take longer than drawing."""
    (tmp_path / "x.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    code = (
        "import sys; from lucida.app.cli import main; status = main(sys.argv[1:]);"
        "names = 'trimesh PIL tqdm numba scipy multiprocessing'.split();"
        "sys.exit(status or str([name for name in names if name in sys.modules]))"
    )
    command = [sys.executable, "-c", code, "render", "x.obj", "-o", "x.png", "--size", "8x8"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.stderr.strip() == "[]"


@pytest.mark.parametrize(
    "options", [("--workers", "2"), ("--scheduler", "tcp://there:8786"), ("--size", "16384x4097")]
)
def test_a_large_image_and_one_of_several_workers_are_drawn_in_parts(options, monkeypatch):
    monkeypatch.setattr(render_parts, "render_in_parts", lambda *_: 7)
    assert main(["render", "spheres", "-o", "a.png", *options]) == 7


def test_notes_on_a_scene_are_told_on_standard_error(capsys, tmp_path):
    Path("a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n")
    Path("a.mtl").write_text("newmtl a\nmap_Bump bumps.png\n")
    notes = load_scene("a.obj").notes
    assert notes
    assert main(["pick", "a.obj", "0", "0", "--size", "8x8"]) == 0
    told = capsys.readouterr().err.splitlines()
    assert told[: len(notes)] == [f"lucida: {note}" for note in notes]
