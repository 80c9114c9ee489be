"""The numbers of shading stand once: shaders get them, kernels and teaching code import them."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import numpy as np
import pytest

from renderer import Camera, Rasterizer, shared_numbers
from renderer.raster.sources import ShaderSource
from renderer.scene.model import DirectionalLight, Material, PointLight, Scene, SceneObject, Sphere

ROOT = Path(__file__).parents[2]
NUMBERS = {name: value for name, value in vars(shared_numbers).items() if name.isupper()}
# No shader goes from display values to light, or has secondary rays.
ONLY_PYTHON = {"SRGB_LINEAR_SHOWN", "AWAY"}
SHADERS = [
    path
    for ending in ("*.frag", "*.vert", "*.glsl")
    for path in sorted((ROOT / "shaders").rglob(ending))
]
STAGES = [path.name for path in SHADERS if path.suffix != ".glsl"]
# Lines on the screen, and places in textures: lengths that only look like one of the numbers.
OTHER_MEANING = {"line.vert", "line.frag", "display.frag"}
# What computes light, or says how it is computed.
SHADING = (
    "renderer/trace/scalar/shade.py",
    *(f"renderer/trace/packets/{name}.py" for name in ("cells", "shade", "smooth", "surface")),
    "renderer/trace/packets/effects.py",
    "renderer/images/display.py",
    "renderer/scene/flat.py",
    "renderer/raster/depth_range.py",
    "app/explaining/shading.py",
    "app/probe/color_formulas.py",
    "app/probe/copying.py",
    "app/stepper/loop_parts.py",
    "app/stepper/loops.py",
)


def floats() -> set[float]:
    """The fractions among the numbers; whole ones may be anything."""
    values = [v for value in NUMBERS.values() for v in np.ravel(value).tolist()]
    return {abs(v) for v in values if v != round(v)}


def written(text: str) -> set[float]:
    """Numbers in a text that is no program of Python."""
    return {float(found) for found in re.findall(r"(?<![\w.])\d*\.?\d+(?:e[-+]?\d+)?", text)}


def in_python(path: Path) -> set[float]:
    """Numbers of a module, also within the texts that it shows; not those in docstrings."""
    tree = ast.parse(path.read_text("utf-8"))
    found: set[float] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, float):
            found.add(node.value)
        elif isinstance(node, ast.Constant) and "\n" not in str(node.value):
            found |= written(str(node.value))
    return found


@pytest.mark.parametrize("path", SHADERS, ids=lambda path: path.name)
def test_no_shader_has_a_copy(path: Path) -> None:
    text = path.read_text("utf-8")
    code = "\n".join(line.split("//")[0] for line in text.splitlines())
    assert not re.findall(rf"\b({'|'.join(NUMBERS)})\b(?=\s*(?:\[\w*\]\s*)?=[^=])", code)
    if path.name not in OTHER_MEANING:
        assert not written(code) & floats()


@pytest.mark.parametrize("name", SHADING)
def test_no_module_has_a_copy(name: str) -> None:
    assert not in_python(ROOT / name) & floats()


def test_nobody_else_writes_srgb_and_luminance_out() -> None:
    telling = {shared_numbers.SRGB_LINEAR, shared_numbers.SRGB_SLOPE, *shared_numbers.LUMINANCE}
    home = ROOT / "renderer" / "shared_numbers.py"
    modules = [*ROOT.glob("app/**/*.py"), *ROOT.glob("renderer/**/*.py")]
    assert home in modules
    assert [path for path in modules if in_python(path) & telling] == [home]


@pytest.mark.parametrize("name", sorted(NUMBERS.keys() - ONLY_PYTHON))
def test_shaders_take_a_changed_number(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    was = NUMBERS[name]
    changed = was[1:] + was[:1] if isinstance(was, tuple) else 2 * was + 1
    taking = [stage for stage in STAGES if re.search(rf"\b{name}\b", ShaderSource(stage).text)]
    assert taking, "no shader names it: it belongs to where it is used"
    before = {stage: ShaderSource(stage).text for stage in taking}
    monkeypatch.setattr(shared_numbers, name, changed)
    for stage in taking:
        first, second = before[stage].splitlines(), ShaderSource(stage).text.splitlines()
        different = [b for a, b in zip(first, second, strict=True) if a != b]
        assert len(different) == 1
        assert re.match(rf"const (int|float|vec3) {name}\b", different[0])


def test_the_rasterizer_draws_with_a_changed_number(
    gl_backend: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every point light is too near, so that only the sun shines."""
    ball = SceneObject(Sphere((0, 0, -3), 1), Material((0.5, 0.5, 0.5)))
    sun, lamp = DirectionalLight((0, 0, -1), (0.5, 0.5, 0.5)), PointLight((1, 1, 0), (0.5, 0, 0))
    camera, size = Camera(), (8, 8)

    def drawn(*lights: DirectionalLight | PointLight) -> np.ndarray:
        with Rasterizer(Scene((ball,), lights), backend=gl_backend) as rasterizer:
            return rasterizer.render(camera, size, ("color",)).channel("color")

    only_sun, both = drawn(sun), drawn(sun, lamp)
    assert np.abs(both - only_sun).max() > 0.01
    monkeypatch.setattr(shared_numbers, "NEAREST_LIGHT", 1e9)
    np.testing.assert_array_equal(drawn(sun, lamp), only_sun)


def test_the_kernels_have_the_numbers() -> None:
    from renderer.trace.packets import cells, shade, smooth, surface
    from renderer.trace.scalar import shade as scalar

    for name in (
        "CELL_NUDGE", "GRAZING", "NEAREST_LIGHT", "OTHER_SIDE", "SHORTEST_HALF", "SHORTEST_MEAN",
    ):  # fmt: skip
        assert getattr(scalar, name) is NUMBERS[name]
    assert shade.CELL_NUDGE is cells.CELL_NUDGE is NUMBERS["CELL_NUDGE"]
    assert np.float32(NUMBERS["OTHER_SIDE"]) == smooth.OTHER_SIDE
    assert np.float32(NUMBERS["GRAZING"]) == surface.GRAZING
