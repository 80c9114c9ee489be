"""What is copied of a reading: a program that computes the pixel, every line, exact numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from read_pixels import SIZE, cameras, run

from app.explaining.notation import latex_number, number
from app.probe.copying import all_lines, as_latex, as_text
from app.probe.model import Probe
from renderer.pixels import Indexing
from renderer.scene import BUILTIN_SCENES, load_scene


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_the_copied_program_computes_the_pixel(name: str) -> None:
    scene = load_scene(name)
    probe, rng = Probe(scene), np.random.default_rng(1)
    for camera in cameras(scene):
        for pixel in zip(rng.integers(0, 48, 12).tolist(), rng.integers(0, 64, 12).tolist()):  # noqa: B905
            reading = probe.at(pixel, camera, SIZE, 0.5, "srgb", shadows=True, mirror_depth=2)
            run(reading, Indexing.LECTURE)
            run(reading, Indexing.ARRAY)


def test_copies_hold_every_line() -> None:
    scene = load_scene("still-life")
    camera = scene.view.for_size(SIZE)
    reading = Probe(scene).at((24, 32), camera, SIZE)
    lines = all_lines(reading)
    assert len({one.key for one in lines}) == len(lines)
    text, latex = as_text(reading), as_latex(reading)
    for one in lines:
        assert one.text in text and one.text_numbers in text
    assert all(entry.name in text for entry in scene.objects)
    assert latex.count(r"\begin{align*}") == latex.count(r"\end{align*}") == 1
    assert latex.count("{") == latex.count("}")
    rows = latex.splitlines()[2:-1]
    assert len(rows) == sum(1 + bool(one.latex_numbers) for one in lines)
    assert all(row.count("&") == 1 for row in rows)
    assert all(row.endswith(r"\\") for row in rows[:-1]) and not rows[-1].endswith("\\")


def test_how_numbers_are_written() -> None:
    assert [number(x) for x in (0.5, -0.25, 3.0, 1 / 3, -0.0)] == [
        "0.5",
        "-0.25",
        "3",
        "0.3333",
        "0",
    ]
    assert number(0.5, fixed=True) == "0.5000"
    assert number(1.5e-7) == "1.5e-07"
    assert latex_number(1.5e-7) == r"1.5 \cdot 10^{-7}"
    assert latex_number(math.inf) == r"\infty"
    assert number(-2e9) == "-2e+09"


@given(st.floats(-1e12, 1e12))
def test_numbers_read_back(value: float) -> None:
    assert abs(float(number(value)) - value) <= max(5.1e-5, 6e-3 * abs(value))
