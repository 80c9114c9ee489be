"""The probe's program in Python and Julia: they compute the same.

Julia's text is also read back as Python, with vectors that refuse what Julia's vectors refuse.
"""

from __future__ import annotations

import functools
import math
import re
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from compilers import needs_julia, run_julia

from lucida.app.instruments.probe.copying import as_julia, as_python
from lucida.app.instruments.probe.model import Probe
from lucida.app.instruments.probe.reading import Reading
from lucida.app.state.options.shared import Notation
from lucida.app.ui.explaining.languages import julia
from lucida.app.ui.explaining.symbols import TABLE
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.files import load_scene

SIZE = (64, 48)
LENSES = (
    Lens("brown", {"k1": -0.25, "k2": 0.03}),
    Lens("brown", {"k1": -0.25, "p1": 0.02}),
    Lens("fisheye", {"k1": 0.1}),
    Lens("fov", {"omega": 0.9}),
    *(Lens(name) for name in ("stereographic", "equisolid", "equirectangular", "cylindrical")),
)


@functools.cache
def readings() -> list[tuple[Reading, Indexing]]:
    """Return readings of spheres, meshes and the background, with shadows and mirrors, both curves,
    perspective and parallel.
    """
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
    for lens in LENSES:
        found.append((probe.at((20, 50), replace(camera, lens=lens), SIZE), Indexing.LECTURE))
    return found


RESULTS: dict[Notation, tuple[str, ...]] = {
    "book": ("p", "d", "color", "rgb"),
    "code": ("origin", "direction", "color", "rgb"),
}


def expected(reading: Reading, indexing: Indexing, notation: Notation) -> dict[str, np.ndarray]:
    names: dict[str, Any] = {"print": lambda *_: None}
    exec(compile(as_python(reading, indexing, notation), "python", "exec"), names)
    return {name: np.asarray(names[name]) for name in RESULTS[notation]}


@pytest.mark.parametrize("notation", RESULTS)
def test_a_copied_program_has_one_notation(notation):
    """None of its names is a symbol of the other one; a pixel's rays are the same in both."""
    others = {one.letter if notation == "code" else one.code for one in TABLE}
    others -= {"w"} | {one.code if notation == "code" else one.letter for one in TABLE}
    for reading, indexing in readings():
        for program in (as_python, as_julia):
            code = program(reading, indexing, notation)
            bare = "\n".join(line.partition("#")[0] for line in code.split("\n"))
            assert not others & set(re.findall(r"(?<![\w.])(?:cam\.)?[A-Za-z_]\w*", bare))
        book, code = (expected(reading, indexing, one) for one in ("book", "code"))
        for one, other in zip(book.values(), code.values(), strict=True):
            np.testing.assert_array_equal(one, other)


@needs_julia
@pytest.mark.parametrize("notation", RESULTS)
def test_the_program_in_julia_runs(notation, tmp_path):
    for reading, indexing in readings():
        told = expected(reading, indexing, notation)
        out = run_julia(as_julia(reading, indexing, notation), tmp_path)
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
    "SimpleNamespace": SimpleNamespace,
    "println": lambda *_: None,
    "sqrt": np.sqrt,
    "max": max,
    "sign": lambda x: float(np.sign(x)),
    "dot": lambda a, b: float(a.values @ b.values),
    "norm": lambda a: float(np.linalg.norm(a.values)),
    "cross": lambda a, b: Vector(np.cross(a.values, b.values)),
    "clamp": lambda a, low, high: Vector(np.clip(a.values, low, high)),
    "ifelse": lambda c, a, b: Vector(np.where(c.values, a.values, b.values)),
    **{name: getattr(math, name) for name in ("sin", "cos", "tan", "atan", "asin")},
    "floor_each": lambda a: Vector(np.floor(a.values)),
}


def read_back(text: str) -> str:
    """A Julia program as Python."""
    for pattern, plain in (
        (r"using LinearAlgebra", ""),
        (r"cam = \(", "cam = SimpleNamespace("),
        (r" \.(\+|-|<=) ([\d.e-]+)", r" \1 Each(\2)"),
        (r" \.\* ", " @ "),
        (r" ?\.?\^ ?", " ** "),
        (r"floor\.\(Int, ", "floor_each("),
        (r"(clamp|ifelse)\.\(", r"\1("),
        (r"\[([^\[\]]*)\]", r"Vector([\1])"),
    ):
        text = re.sub(pattern, plain, text)
    return text


@pytest.mark.parametrize("notation", RESULTS)
def test_the_program_in_julia_read_back(notation):
    for reading, indexing in readings():
        program = as_julia(reading, indexing, notation)
        names = dict(NAMES)
        exec(compile(read_back(program), "julia", "exec"), names)
        for name, values in expected(reading, indexing, notation).items():
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
