"""Shader sources: includes, and a compiler's errors told by file and line."""

from importlib.resources import files

import pytest

from lucida.renderer.raster import sources
from lucida.renderer.raster.sources import ShaderSource, link, read_shader
from lucida.renderer.system.errors import LucidaError

STAGES = sorted(
    entry.name
    for entry in files("shaders").iterdir()
    if entry.name.endswith((".vert", ".frag", ".geom"))
)


@pytest.fixture
def library(monkeypatch):
    """Replaces the shaders by others; "__" stands for the dot of a name."""

    def replace(**texts):
        named = {name.replace("__", "."): text for name, text in texts.items()}
        monkeypatch.setattr(sources, "read_shader", named.__getitem__)

    return replace


def test_chunks_are_put_in_where_they_are_named_each_once(library):
    library(
        main__frag='#version 330 core\n#include "a.glsl"\n#include "b.glsl"\nlast',
        a__glsl='#include "b.glsl"\na',
        b__glsl='#include "a.glsl"\nb',
    )
    source = ShaderSource("main.frag")
    assert source.text == "#version 330 core\nb\na\nlast\n"
    assert source.places == [("main.frag", 1), ("b.glsl", 2), ("a.glsl", 2), ("main.frag", 4)]


def test_a_stage_that_does_not_exist_is_one_line():
    with pytest.raises(LucidaError, match=r"shaders/none\.frag: does not exist"):
        ShaderSource("none.frag")


def test_constants_follow_the_version(library):
    library(a="#version 330 core\nx")
    source = ShaderSource("a", {"YES": True, "NO": False})
    assert source.text.splitlines()[0] == "#version 330 core"
    assert set(source.text.splitlines()[1:3]) == {
        "const bool YES = true;",
        "const bool NO = false;",
    }
    assert source.places[-1] == ("a", 2)


@pytest.mark.parametrize(
    ("message", "told"),
    [
        ("0:2(5): error: x", "b.glsl:1: error: x"),  # Mesa
        ("0(2) : error C1008: x", "b.glsl:1 : error C1008: x"),  # NVIDIA
        ("ERROR: 0:3: 'x' : undeclared", "ERROR: a.frag:3: 'x' : undeclared"),  # macOS, AMD, Intel
        ("0:99(1): error", "0:99(1): error"),
        ("error: 10:30 is no place", "error: 10:30 is no place"),
    ],
)
def test_messages_of_each_driver_are_told_by_file_and_line(library, message, told):
    library(a__frag='one\n#include "b.glsl"\nthree', b__glsl="two")
    assert ShaderSource("a.frag").explain(message) == told


def test_a_compile_error_names_the_chunk_and_the_line(rasterizer, library):
    library(
        all__vert='#version 330 core\n#include "chunk.glsl"\nvoid main() { gl_Position = f(); }',
        chunk__glsl="// one\n// two\nvec4 f() { return undeclared; }",
        all__frag="#version 330 core\nvoid main() {}",
    )
    with rasterizer.current() as gl, pytest.raises(LucidaError) as caught:
        link(gl, "all.vert", "all.frag")
    assert caught.value.field == "shaders/all.vert"
    assert "chunk.glsl:3" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_link_error_is_one_line(rasterizer, library):
    library(
        a__vert="#version 330 core\nout vec2 m; void main() { m = vec2(0.0); }",
        a__frag="#version 330 core\nin vec3 m; out vec3 c; void main() { c = m; }",
    )
    with rasterizer.current() as gl, pytest.raises(LucidaError, match=r"a\.vert, a\.frag"):
        link(gl, "a.vert", "a.frag")


@pytest.mark.parametrize("name", STAGES)
def test_every_stage_is_glsl_3_30_and_has_a_heading(name):
    lines = read_shader(name).splitlines()
    assert lines[0] == "#version 330 core"
    assert lines[1].startswith("// ")
    assert len(ShaderSource(name).text.splitlines()) == len(ShaderSource(name).places)
