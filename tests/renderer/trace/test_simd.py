"""Lanes inside kernels against NumPy; and the same without the newest instructions."""

import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numba.core import types

from lucida.renderer.trace.compile.compiled import kernel
from lucida.renderer.trace.vector import gather as simd_gather
from lucida.renderer.trace.vector import lanes as simd
from lucida.renderer.trace.vector import math as simd_math
from lucida.renderer.trace.vector import memory as simd_memory
from lucida.renderer.trace.vector.memory import load, pointer, store

ROOT = Path(__file__).parents[3]
random = np.random.default_rng(1)


@kernel
def operators(x, y, i, out, iout):
    a, b, k = load(x, 0), load(y, 0), load(i, 0)
    store(out, 0, a + b)
    store(out, 16, a - np.float32(2))
    store(out, 32, np.float32(3) * b)
    store(out, 48, a / b)
    store(out, 64, -a)
    store(iout, 0, (k + np.int32(5)) * k)
    store(iout, 16, (k << np.int32(3)) ^ (k >> np.int32(1)))
    store(iout, 32, (k & np.int32(6)) | np.int32(1))
    store(iout, 48, ~k)


def test_operators_are_those_of_numpy():
    x, y = random.normal(size=(2, 16)).astype(np.float32)
    i = random.integers(-1000, 1000, 16, dtype=np.int32)
    out, iout = np.empty(80, np.float32), np.empty(64, np.int32)
    operators(x, y, i, out, iout)
    wanted = np.concatenate([x + y, x - np.float32(2), np.float32(3) * y, x / y, -x])
    assert np.array_equal(out, wanted)
    integers = np.concatenate([(i + 5) * i, (i << 3) ^ (i >> 1), (i & 6) | 1, ~i])
    assert np.array_equal(iout, integers)


@kernel
def comparisons(x, y, masks):
    a, b = load(x, 0), load(y, 0)
    masks[0], masks[1], masks[2] = simd.bits(a < b), simd.bits(a <= b), simd.bits(a > b)
    masks[3], masks[4], masks[5] = simd.bits(a >= b), simd.bits(a == b), simd.bits(a != b)
    masks[6] = simd.bits(~(a < b) & simd.mask_of(0x0FF0))


def as_bits(lanes):
    return int(np.sum(lanes.astype(int) << np.arange(16)))


def test_comparisons_are_false_for_nan():
    x, y = random.integers(0, 3, (2, 16)).astype(np.float32)
    x[3] = y[5] = np.nan
    masks = np.zeros(7, np.int64)
    comparisons(x, y, masks)
    numbers = ~(np.isnan(x) | np.isnan(y))
    wanted = [x < y, x <= y, x > y, x >= y, x == y, (x != y) & numbers]
    assert masks[:6].tolist() == [as_bits(lanes) for lanes in wanted]
    assert masks[6] == as_bits(~(x < y)) & 0x0FF0


@kernel
def functions(x, y, z, out, numbers):
    a, b, c = load(x, 0), load(y, 0), load(z, 0)
    store(out, 0, simd.fma(a, b, c))
    store(out, 16, simd.fma(-a, b, -c))
    store(out, 32, simd.vmin(a, b))
    store(out, 48, simd.vmax(a, np.float32(0.25)))
    store(out, 64, simd.vsqrt(simd.vabs(a)))
    store(out, 80, simd.vfloor(a * np.float32(4)))
    store(out, 96, simd.select(a < b, a, np.float32(7)))
    store(out, 112, simd.to_f32(simd.to_f64(a) * 3.0))
    store(out, 128, simd.f32_of(simd.i32_of(a * np.float32(9))))
    store(out, 144, simd.lane_column() + simd.lane_row() * np.float32(10))
    store(out, 160, simd.inverse_root(simd.vabs(a)))
    numbers[0] = simd.smallest(a)
    numbers[1], numbers[2] = simd.lane_of(a, 11), np.float32(simd.lowest_bit(0x0A0))


def test_functions_are_those_of_numpy():
    x, y, z = random.normal(size=(3, 16)).astype(np.float32)
    out, numbers = np.empty(176, np.float32), np.empty(3, np.float32)
    functions(x, y, z, out, numbers)
    rows = out.reshape(11, 16)
    fused = (x.astype(float) * y + z).astype(np.float32)
    assert np.allclose(rows[0], fused, rtol=0, atol=4e-7)
    assert np.array_equal(rows[1], -rows[0])
    assert np.array_equal(rows[2], np.minimum(x, y))
    assert np.array_equal(rows[3], np.maximum(x, np.float32(0.25)))
    assert np.array_equal(rows[4], np.sqrt(np.abs(x)))
    assert np.array_equal(rows[5], np.floor(x * np.float32(4)))
    assert np.array_equal(rows[6], np.where(x < y, x, np.float32(7)))
    assert np.array_equal(rows[7], (x.astype(float) * 3).astype(np.float32))
    assert np.array_equal(rows[8], np.trunc(x * np.float32(9)))
    assert rows[9].tolist() == [lane % 4 + lane // 4 * 10 for lane in range(16)]
    assert np.allclose(rows[10], 1 / np.sqrt(np.abs(x.astype(float))), rtol=4e-7, atol=0)
    assert numbers.tolist() == [x.min(), x[11], 5]


@kernel
def memory(table, indices, square, square3, out):
    k = load(indices, 0)
    mask = simd.mask_of(0x5555)
    store(out, 0, simd_gather.gather(table, k, mask))
    simd_gather.prefetch(table, 0)
    x = load(table, 3)
    simd_memory.store_square(pointer(square), 2 * 9 + 1, 9, x)
    simd_memory.store_square3(pointer(square3), 3, 15, x, x * np.float32(2), x * np.float32(3))


def test_lanes_read_and_write_their_own_memory():
    table = random.normal(size=40).astype(np.float32)
    indices = random.integers(0, 40, 16, dtype=np.int32)
    indices[1::2] = 1 << 30  # of lanes that are masked: not looked at
    square, square3 = np.zeros((7, 9), np.float32), np.zeros((5, 5, 3), np.float32)
    out = np.empty(16, np.float32)
    memory(table, indices, square, square3, out)
    wanted = np.zeros(16, np.float32)
    wanted[::2] = table[indices[::2]]
    assert np.array_equal(out, wanted)
    four = table[3:19].reshape(4, 4)
    assert np.array_equal(square[2:6, 1:5], four)
    square[2:6, 1:5] = 0
    assert not square.any()
    assert np.array_equal(square3[:4, 1:], four[..., None] * np.array([1, 2, 3], np.float32))
    square3[:4, 1:] = 0
    assert not square3.any()


_room = simd_memory.stack_room(types.float32, 24)


@kernel
def halves(source, out):
    room = _room()
    for k in range(24):
        room[k] = np.float32(k)
    half = simd_memory.load_half(pointer(source), 3)
    store(out, 0, half)
    simd_memory.store_half(room, 8, half)
    for k in range(24):
        out[16 + k] = room[k]


def test_halves_and_memory_on_the_stack():
    source, out = np.arange(100, 111, dtype=np.float32), np.empty(40, np.float32)
    halves(source, out)
    half = source[3:]
    assert np.array_equal(out[:16], np.tile(half, 2))
    assert np.array_equal(out[16:], np.concatenate([np.arange(8), half, np.arange(16, 24)]))


@kernel
def memory_by_lanes(table, indices, doubles, out):
    k = load(indices, 0)
    a, b, c, d = simd_gather.gather_fours(table, k, 7)
    simd_gather.prefetch_lanes(table, k)
    store(out, 0, a)
    store(out, 16, b)
    store(out, 32, c)
    store(out, 48, d)
    store(out, 64, simd.first_of_four(k))
    store(out, 80, simd.last_of_four(k))
    eighth = simd_memory.as_float64(simd_memory.shifted(pointer(doubles), 4))
    eighth[1] = eighth[0] / 3.0


def test_lanes_read_neighbours_and_share_lanes():
    table = random.integers(-(1 << 31), 1 << 31, 60).astype(np.int32)
    k = random.integers(0, 52, 16, dtype=np.int32)
    numbers, out = np.array([0.0, 0.0, 8.0, 0.0, 5.0]), np.empty(96, np.int32)
    memory_by_lanes(table, k, numbers.view(np.int32), out)
    rows = out.reshape(6, 16)
    for row, step in zip(rows, (0, 1, 7, 8), strict=False):
        assert np.array_equal(row, table[k + step])
    assert np.array_equal(rows[4], np.repeat(k[::4], 4))
    assert np.array_equal(rows[5], np.repeat(k[3::4], 4))
    assert numbers.tolist() == [0, 0, 8, 8 / 3, 5]


@kernel
def streaming(source, lines, begins):
    for i in range(len(begins)):
        begins[i] = simd_memory.is_line(lines, i)
        if begins[i]:
            simd_memory.stream(lines, i, load(source, i))


def test_streamed_lines_are_aligned_and_complete():
    source = random.normal(size=64).astype(np.float32)
    lines, begins = np.zeros(64, np.float32), np.zeros(33, np.bool_)
    streaming(source, lines, begins)
    first = int(np.argmax(begins))
    assert (lines.ctypes.data + 4 * first) % 64 == 0
    assert np.array_equal(np.flatnonzero(begins), np.arange(first, 33, 16))
    written = np.repeat(begins[first::16], 16).sum()
    assert np.array_equal(lines[first : first + written], source[first : first + written])
    lines[first : first + written] = 0
    assert not lines.any()


@kernel
def powers(x, exponent, out):
    for first in range(0, len(x), 16):
        store(out, first, simd_math.power_lanes(load(x, first), exponent))


@pytest.mark.parametrize("exponent", [1, 2, 7.5, 50, 1000])
def test_powers_are_exact_to_their_tolerance(exponent):
    x = np.concatenate([[0, 1, 1e-30, 0.5], np.linspace(0.9, 1, 1020), random.uniform(0, 1, 1024)])
    x = x.astype(np.float32)
    out = np.empty_like(x)
    powers(x, np.float32(exponent), out)
    exact = x.astype(float) ** exponent
    shown = exact > 2.0**-120
    error = np.abs(out - exact)[shown] / exact[shown]
    assert np.all(error <= 1e-6 * (1 + np.abs(np.log2(exact[shown]))))
    assert np.all(out[~shown] <= 2.0**-119)


@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="x86's instruction sets")
def test_the_others_pass_on_older_processors():
    """This file's other tests, compiled for a processor without AVX: where renderer/trace has
    changed since the last commit but one, or nobody knows."""
    diff = ["git", "diff", "--quiet", "HEAD^", "--", "renderer/trace"]
    if (
        shutil.which("git")
        and not subprocess.run(diff, cwd=ROOT, stderr=subprocess.DEVNULL).returncode
    ):
        pytest.skip("renderer/trace has not changed")
    environment = {**os.environ, "NUMBA_CPU_NAME": "x86-64", "NUMBA_CPU_FEATURES": "+sse2"}
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", __file__]
    command += ["-k", "not processors"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout[-3000:]
