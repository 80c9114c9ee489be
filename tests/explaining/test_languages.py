"""Programs in Python, Julia and C: they compute the same.

C is compiled, Julia run, where there is a compiler for them. Julia's texts are also read back as
Python, with vectors that refuse what Julia's vectors refuse, and run.
"""

from __future__ import annotations

import functools
import itertools
import re
import shutil
import subprocess
import textwrap
from dataclasses import dataclass, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from app.explaining.languages import julia
from app.laboratory import array_code, memory
from app.lecture import text as texts
from app.lecture.reading import BUILTIN, load_lecture
from app.lecture.states import state_of
from app.probe.copying import as_c, as_julia, as_python
from app.probe.model import Probe
from app.probe.reading import Reading
from app.state.app_state import AppState
from app.state.options import Language
from app.stepper import loop_parts, raster_parts
from app.stepper.loop_parts import Model
from app.stepper.recording import Order
from app.stepper.source import source_of
from renderer.pixels import Indexing
from renderer.scene import load_scene

CC = shutil.which("gcc") or shutil.which("cc")
JULIA = shutil.which("julia")
needs_c = pytest.mark.skipif(CC is None, reason="no C compiler here")
needs_julia = pytest.mark.skipif(JULIA is None, reason="no Julia here")
SIZE = (64, 48)


@functools.cache
def readings() -> list[tuple[Reading, Indexing]]:
    """Of spheres, meshes and the background, with shadows and mirrors, both curves, perspective and
    parallel."""
    found = []
    for name, pixels in (
        ("still-life", ((0, 0), (9, 18), (13, 19), (30, 40), (40, 20))),
        ("spheres", ((24, 32), (30, 20), (36, 40), (40, 12))),
    ):
        scene = load_scene(name)
        probe, camera = Probe(scene), scene.view.for_size(SIZE)
        for number, pixel in enumerate(pixels):
            curve = ("srgb", "linear")[number % 2]
            reading = probe.at(pixel, camera, SIZE, 0.5, curve, True, 2)
            found.append((reading, tuple(Indexing)[number % 2]))
        parallel = replace(camera, projection="parallel", distance=1.0)
        found.append((probe.at((24, 32), parallel, SIZE), Indexing.LECTURE))
    return found


def expected(program: str) -> dict[str, np.ndarray]:
    names: dict[str, Any] = {"print": lambda *_: None}
    exec(compile(program, "python", "exec"), names)
    return {name: np.asarray(names[name]) for name in ("origin", "direction", "color", "rgb")}


def run_c(program: str, folder: Path) -> str:
    source, made = folder / "program.c", folder / "program"
    source.write_text(program)
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-Wno-unused-variable",
             "-Wno-unused-but-set-variable"]  # fmt: skip
    assert CC is not None
    subprocess.run([CC, *flags, "-o", made, source, "-lm"], check=True, timeout=60)
    return subprocess.run([made], check=True, capture_output=True, text=True, timeout=60).stdout


def run_julia(program: str, folder: Path) -> str:
    source = folder / "program.jl"
    source.write_text(program)
    assert JULIA is not None
    done = subprocess.run(
        [JULIA, "--startup-file=no", source], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


# The probe's program.


def test_the_pixels_show_every_part_of_the_program():
    text = "".join(as_python(reading, indexing) for reading, indexing in readings())
    for part in ("hits nothing", "np.cross", "radius**2", "shadowed", "mirrored", "shown = exposed",
                 "np.where", "origin = eye + ", "j + 0.5", "j - 0.5", "l /= "):  # fmt: skip
        assert part in text, part


@needs_c
def test_the_program_in_c(tmp_path):
    for reading, indexing in readings():
        told = expected(as_python(reading, indexing))
        lines = run_c(as_c(reading, indexing), tmp_path).splitlines()
        found = {line.split()[0]: [float(x) for x in line.split()[1:]] for line in lines}
        assert set(found) == set(told)
        for name, values in told.items():
            np.testing.assert_allclose(found[name], values, rtol=1e-11, atol=1e-14, err_msg=name)


@needs_julia
def test_the_program_in_julia_runs(tmp_path):
    for reading, indexing in readings():
        told = expected(as_python(reading, indexing))
        out = run_julia(as_julia(reading, indexing), tmp_path)
        found = [float(x) for x in re.findall(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?", out)]
        np.testing.assert_allclose(found, np.concatenate(list(told.values())), rtol=1e-11)


@dataclass(frozen=True)
class Each:
    """A number beside a dotted operator."""

    value: float


class Vector:
    """Three numbers that do what Julia's vectors do without a dot; and what has one, with Each or
    written as @."""

    def __init__(self, values: Any) -> None:
        self.values = np.asarray(values, float)

    def _with(self, other: Any) -> Any:
        assert isinstance(other, Vector | Each), "a vector and a number need a dot"
        return other.values if isinstance(other, Vector) else other.value

    def __add__(self, other: Any) -> Vector:
        return Vector(self.values + self._with(other))

    def __sub__(self, other: Any) -> Vector:
        return Vector(self.values - self._with(other))

    def __mul__(self, factor: Any) -> Vector:
        assert isinstance(factor, float | int), "two vectors need a dot"
        return Vector(self.values * factor)

    __rmul__ = __mul__

    def __truediv__(self, divisor: Any) -> Vector:
        assert isinstance(divisor, float | int)
        return Vector(self.values / divisor)

    def __matmul__(self, other: Vector) -> Vector:  # .*
        return Vector(self.values * other.values)

    def __pow__(self, exponent: float) -> Vector:
        return Vector(self.values**exponent)

    def __le__(self, other: Each) -> Vector:
        return Vector(self.values <= other.value)

    def __neg__(self) -> Vector:
        return Vector(-self.values)


NAMES: dict[str, Any] = {
    "Vector": Vector,
    "Each": Each,
    "println": lambda *_: None,
    "sqrt": np.sqrt,
    "max": max,
    "sign": lambda x: float(np.sign(x)),
    "dot": lambda a, b: float(a.values @ b.values),
    "norm": lambda a: float(np.linalg.norm(a.values)),
    "cross": lambda a, b: Vector(np.cross(a.values, b.values)),
    "clamp": lambda a, low, high: Vector(np.clip(a.values, low, high)),
    "ifelse": lambda c, a, b: Vector(np.where(c.values, a.values, b.values)),
    "floor_each": lambda a: Vector(np.floor(a.values)),
}


def read_back(text: str) -> str:
    """A Julia program as Python."""
    for pattern, plain in (
        (r"using LinearAlgebra", ""),
        (r" \.(\+|-|<=) ([\d.e-]+)", r" \1 Each(\2)"),
        (r" \.\* ", " @ "),
        (r" ?\.?\^ ?", " ** "),
        (r"floor\.\(Int, ", "floor_each("),
        (r"(clamp|ifelse)\.\(", r"\1("),
        (r"\[([^\[\]]*)\]", r"Vector([\1])"),
    ):
        text = re.sub(pattern, plain, text)
    return text


def test_the_program_in_julia_read_back():
    for reading, indexing in readings():
        program = as_julia(reading, indexing)
        assert program.count("\n") == as_python(reading, indexing).count("\n")  # line by line
        names = dict(NAMES)
        exec(compile(read_back(program), "julia", "exec"), names)
        for name, values in expected(as_python(reading, indexing)).items():
            np.testing.assert_allclose(names[name].values, values, rtol=1e-11, atol=1e-14)


@pytest.mark.parametrize(
    ("python", "written"),
    [
        ("x = a - (b - c)", "x = a - (b - c)"),
        ("x = a - b - c", "x = a - b - c"),
        ("x = -(a + b) * c", "x = -(a + b) * c"),
        ("x = (a + b)**2 / (c * d)", "x = (a + b)^2 / (c * d)"),
        ("x = a**(b * c)", "x = a^(b * c)"),
        ("x = -a**2", "x = -a^2"),
        ("p = np.array([1.0, 2.0, 3.0]) * np.array([a, b, c])", "p = [1.0, 2.0, 3.0] .* [a, b, c]"),
        ("p = np.array([1.0, 2.0, 3.0]) + 1", "p = [1.0, 2.0, 3.0] .+ 1"),
        ("p = 2 / np.array([1.0, 2.0, 4.0])", "p = 2 ./ [1.0, 2.0, 4.0]"),
        ("x = 3  # counted from 1", "x = 3  # counted from 1"),
        ('# "quoted" # twice', '# "quoted" # twice'),
    ],
)
def test_julias_dots_and_parentheses(python, written):
    assert julia.program(python) == written + "\n"


# The array page's program.

ARRAYS = list(itertools.product(("row", "column"), (True, False)))
PIXEL, VALUES = (11, 20), (0.25, 0.5, 0.75)


def listed(language: Language, order: memory.Order, one_based: bool) -> list[str]:
    return array_code.lines(language, order, one_based, (37, 23), PIXEL, VALUES)


@pytest.mark.parametrize(("order", "one_based"), ARRAYS)
def test_the_array_in_python(order, one_based, capsys):
    names: dict[str, Any] = {}
    program = array_code.program("python", listed("python", order, one_based))
    exec(compile(program, "array", "exec"), names)
    canvas, offset = names["canvas"], int(capsys.readouterr().out)
    assert canvas.shape == (23, 37, 3) and canvas.dtype == np.float32
    assert canvas[PIXEL].tolist() == list(VALUES)
    assert offset == memory.offset_bytes(*PIXEL, 0, (37, 23), order)
    assert offset == int(np.dot((*PIXEL, 0), canvas.strides))
    assert f"from {int(one_based)}" in program


@needs_c
@pytest.mark.parametrize(("order", "one_based"), ARRAYS)
def test_the_array_in_c(order, one_based, tmp_path):
    program = array_code.program("c", listed("c", order, one_based))
    where = 'printf("%ld %g\\n", (long)((char *)pixel - (char *)canvas), pixel[2]);\n    return 0;'
    offset, place = run_c(program.replace("return 0;", where), tmp_path).splitlines()
    told = memory.offset_bytes(*PIXEL, 0, (37, 23), order)
    assert int(offset) == told
    assert place == f"{told} 0.75"


RGB = """struct RGB{T}; r::T; g::T; b::T; end
RGB(r, g, b) = RGB{Float32}(r, g, b)
Base.zero(::Type{RGB{T}}) where T = RGB{T}(0, 0, 0)
"""


@needs_julia
@pytest.mark.parametrize(("order", "one_based"), ARRAYS)
def test_the_array_in_julia_runs(order, one_based, tmp_path):
    program = array_code.program("julia", listed("julia", order, one_based))
    row, column = (part + 1 for part in PIXEL)
    place = (
        f"println(Int(pointer(parent(canvas), LinearIndices(parent(canvas))[{column}, {row}])"
        if order == "row"
        else f"println(Int(pointer(canvas, LinearIndices(canvas)[{row}, {column}])"
    )
    base = "parent(canvas)" if order == "row" else "canvas"
    program = program.replace("using Colors\n", RGB) + f"{place} - pointer({base})))\n"
    offset, found = map(int, run_julia(program, tmp_path).split())
    assert offset == found == memory.offset_bytes(*PIXEL, 0, (37, 23), order)


@pytest.mark.parametrize(("order", "one_based"), ARRAYS)
def test_the_array_in_julia_by_construction(order, one_based):
    python, text = (listed(language, order, one_based) for language in ("python", "julia"))
    assert text[-1] == python[-1]  # the offset's formula, and i, j, W, H
    assert [line for line in text if line.startswith(("i, j", "H, W"))] == [
        line for line in python if line.startswith(("i, j", "H, W"))
    ]
    index = next(re.findall(r"canvas\[(.*)\]", line) for line in text if "canvas[" in line)[0]
    i, j = (part + one_based for part in PIXEL)
    assert eval(index, {"i": i, "j": j}) == (PIXEL[0] + 1, PIXEL[1] + 1)  # Julia's own
    made = next(line for line in text if "zeros" in line)
    # Columns one after another: the first number of a Julia array's shape grows fastest.
    assert made.endswith("zeros(RGB{Float32}, H, W)" if order == "column" else "W, H)")
    assert any("PermutedDimsArray(memory, (2, 1))" in line for line in text) == (order == "row")


# The stepper's loops.


def loops_read_back(lines: tuple[str, ...]) -> str:
    """Julia's loops as Python: the indents are there already."""
    text = []
    for line in lines:
        if line.strip() == "end":
            continue
        line = re.sub(r"\b1:(\w+)$", r"range(1, \1 + 1)", line)
        line = line.replace("&&", "and").replace("||", "or").replace("function ", "def ")
        opens = line.strip().startswith(("def ", "for ", "if ", "while ", "else"))
        text.append(line + ":" if opens else line)
    return "\n".join(text)


class FromOne:
    """A canvas or a depth buffer whose rows and columns are counted from 1."""

    def __init__(self, made: Any) -> None:
        self.made = made

    def __getitem__(self, pixel: tuple[int, int]) -> Any:
        assert min(pixel) >= 1
        return self.made[pixel[0] - 1, pixel[1] - 1]

    def __setitem__(self, pixel: tuple[int, int], value: Any) -> None:
        assert min(pixel) >= 1
        self.made[pixel[0] - 1, pixel[1] - 1] = value


def from_one(ranges: tuple[range, range]) -> tuple[range, ...]:
    return tuple(range(one.start + 1, one.stop + 1) for one in ranges)


@pytest.mark.parametrize("order", list(Order))
def test_the_loops_in_julia_draw_the_same(order):
    written = julia.loops("\n".join(source_of(order.renderer).lines))
    names = {name: getattr(raster_parts, name) for name in dir(raster_parts)}
    names |= {name: getattr(loop_parts, name) for name in dir(loop_parts)}
    names |= {
        "prepared": lambda *given: tuple(map(FromOne, raster_parts.prepared(*given))),
        "box_around": lambda *given: from_one(raster_parts.box_around(*given)),
        "Canvas": lambda *given: FromOne(loop_parts.Canvas(*given)),
        "DepthBuffer": lambda size: FromOne(loop_parts.DepthBuffer(size)),
        "bounding_box": lambda *given: from_one(loop_parts.bounding_box(*given)),
    }
    exec(compile(loops_read_back(written.lines), "julia", "exec"), names)
    scene = load_scene("canonical")
    model, size = Model(scene), (12, 9)
    camera = scene.view.for_size(size)
    drawn = names[order.renderer.__name__](model, camera, size)
    told = order.renderer(model, camera, size)
    np.testing.assert_array_equal(drawn.made.array, told.array)


@pytest.mark.parametrize("order", list(Order))
def test_every_line_has_its_line_in_julia(order):
    lines = source_of(order.renderer).lines
    written = julia.loops("\n".join(lines))
    assert len(written.line_of) == len(lines)
    ends = [line for line in written.lines if line.strip() == "end"]
    blocks = sum(line.rstrip().endswith(":") for line in lines)
    assert len(ends) == blocks and len(written.lines) == len(lines) + blocks
    for line, number in zip(lines, written.line_of, strict=True):
        twin = written.lines[number]
        assert len(twin) - len(twin.lstrip()) == len(line) - len(line.lstrip())
        kept = set(re.findall(r"\w+", line)) - {"def", "range", "0", "5"}
        assert kept <= set(re.findall(r"\w+", twin)), (line, twin)
    assert "j - 0.5" in "".join(written.lines) and "j + 0.5" in "".join(lines)


# The lecture's program.

PROGRAMS = {
    block.language: block.text
    for step in load_lecture(BUILTIN).steps
    if texts.languages(step.blocks)
    for block in step.blocks
    if isinstance(block, texts.Code)
}
CAMERA = {"eye": (1.0, 2.0, 3.0), "u": (1.0, 0.0, 0.5), "v": (0.0, 1.0, 0.25), "w": (0.5, 0, 1)}
AROUND = """
#include <stdio.h>
typedef struct {{ double x, y, z; }} Vec;
typedef struct {{ Vec eye, u, v, w; double d; }} Camera;
typedef double Hit;
Vec direction(Camera c, double a, double b) {{
    Vec r = {{ a*c.u.x + b*c.v.x - c.d*c.w.x, a*c.u.y + b*c.v.y - c.d*c.w.y,
              a*c.u.z + b*c.v.z - c.d*c.w.z }};
    return r;
}}
Hit closest(int scene, Vec p, Vec d) {{ return scene + p.x + 10 * d.x + 100 * d.y + 1000 * d.z; }}
double color(Hit hit) {{ return hit; }}
int main(void) {{
    enum {{ H = 3, W = 4 }};
    double canvas[H][W];
    int scene = 0;
    Camera cam = {{ {eye}, {u}, {v}, {w}, 1.5 }};
{program}
    for (int k = 0; k < H * W; k++) printf("%.17g\\n", (&canvas[0][0])[k]);
    return 0;
}}
"""


def drawn_by(program: str, canvas: Any) -> np.ndarray:
    vectors = {name: np.array(value) for name, value in CAMERA.items()}
    names = {
        **{"H": 3, "W": 4, "scene": 0.0, "canvas": canvas},
        "cam": SimpleNamespace(**vectors, d=1.5),
        "closest": lambda scene, p, d: scene + p[0] + d @ np.array([10.0, 100.0, 1000.0]),
        "color": lambda hit: hit,
    }
    exec(compile(program, "lecture", "exec"), names)
    return np.asarray(getattr(canvas, "made", canvas))


def test_the_lectures_program_is_the_same_in_all_languages(tmp_path):
    assert set(PROGRAMS) == {"python", "julia", "c"}
    told = drawn_by(PROGRAMS["python"], np.full((3, 4), np.nan))
    assert np.isfinite(told).all() and len(np.unique(told)) == 12
    julias = loops_read_back(tuple(PROGRAMS["julia"].splitlines()))
    np.testing.assert_array_equal(drawn_by(julias, FromOne(np.full((3, 4), np.nan))), told)
    if CC is not None:
        parts = {name: f"{{ {', '.join(map(str, value))} }}" for name, value in CAMERA.items()}
        program = textwrap.indent(PROGRAMS["c"], "    ")
        out = run_c(AROUND.format(program=program, **parts), tmp_path)
        np.testing.assert_allclose(np.array(out.split(), float).reshape(3, 4), told, rtol=1e-12)


def test_one_of_a_texts_programs_is_shown():
    blocks = texts.parse("a\n```python\nP\n```\n```c\nC\n```\nb\n```\nplain\n```\n```c\nD\n```")
    assert texts.languages(blocks) == ("python", "c")
    for language, shown in (("python", "PplainD"), ("c", "CplainD"), ("julia", "PplainD")):
        kept = texts.in_language(blocks, language)
        code = [block.text for block in kept if isinstance(block, texts.Code)]
        assert "".join(code) == shown
        assert len(kept) == len(blocks) - 1
    assert texts.languages(texts.parse("```c\nx\n```")) == ()


def test_the_language_stays_from_step_to_step():
    lecture = load_lecture(BUILTIN)
    step = lecture.steps[3]
    base = AppState.for_scene(step.scene).with_options(language="c", shadows=True)
    options = state_of(step, base).options
    assert options.language == "c" and not options.shadows
