"""The names of `lucida` that Python users import, and the errors of wrong arguments."""

import math

import pytest

import lucida
from lucida import (
    Camera,
    LucidaError,
    Rasterizer,
    Tracer,
    View,
    load_scene,
    load_view,
    read_cameras,
)
from lucida.renderer.images.frame import check_size
from lucida.renderer.scene.model import Scene

SIZE = (8, 6)


def test_dir_shows_the_public_names_and_each_of_them_is_there():
    assert dir(lucida) == sorted(lucida.__all__)
    assert {"Camera", "load_scene", "save_view", "write_image", "picture"} <= set(dir(lucida))
    for name in lucida.__all__:
        assert getattr(lucida, name).__name__ == name


def test_an_unknown_name_is_python_s_own_error():
    with pytest.raises(AttributeError, match=r"lucida.*nosuch"):
        _ = lucida.nosuch


def test_a_view_for_a_camera_names_the_remedy(gl_backend):
    told = r"camera: is of type View, not a Camera; give \.for_size\(size\) of it"
    with Tracer(Scene(())) as tracer:
        for draw in (tracer.render, tracer.start):
            with pytest.raises(LucidaError, match=told):
                draw(View(Camera()), SIZE)
    with (
        Rasterizer(Scene(()), gl_backend) as rasterizer,
        pytest.raises(LucidaError, match=told),
    ):
        rasterizer.render(View(Camera()), SIZE)


def test_something_else_for_a_camera():
    with (
        Tracer(Scene(())) as tracer,
        pytest.raises(LucidaError, match="is of type tuple, not"),
    ):
        tracer.render((0, 0, 5), SIZE)


@pytest.mark.parametrize("make", [Tracer, Rasterizer])
def test_a_name_for_a_scene_names_the_remedy(make):
    with pytest.raises(LucidaError, match=r"scene: is of type str, .*load_scene\(\.\.\.\) of it"):
        make("spheres")


@pytest.mark.parametrize("size", [3, (0, 0), (8, 0), (8,), ("8", "6"), None, (math.nan, 6)])
def test_what_is_no_size(size):
    for draw in (View(Camera(), fit=True).for_size, Camera().fitted):
        with pytest.raises(LucidaError, match=r"size: .* is not a width and a height"):
            draw(size)


def test_a_size_without_end():
    with pytest.raises(LucidaError, match=r"size: .* is not two whole numbers"):
        check_size((math.inf, 6))


@pytest.mark.parametrize("load", [load_scene, load_view, read_cameras])
def test_what_is_no_path(load):
    for source in (None, 3, ["spheres"]):
        with pytest.raises(LucidaError, match=r"is of type .*, not a path; give text"):
            load(source)
