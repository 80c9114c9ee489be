"""Frames' memory: used again, but never while anybody can see what is in it."""

import threading

import numpy as np
import pytest

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import Scene, SceneObject, Sphere
from lucida.renderer.trace import Tracer
from lucida.renderer.trace.arguments import buffers
from lucida.renderer.trace.arguments.buffers import Buffers

LAYOUTS = [((20, 30, 3), np.float32), ((0, 0), np.int32), ((20, 30), np.int32)]


def address(array):
    return array.ctypes.data


def test_arrays_are_as_asked_and_apart():
    color, none, number = Buffers().arrays(LAYOUTS)
    assert (color.shape, color.dtype) == ((20, 30, 3), np.float32)
    assert (none.shape, none.dtype) == ((0, 0), np.int32)
    assert (number.shape, number.dtype) == ((20, 30), np.int32)
    for array in (color, number):
        assert array.flags.c_contiguous and array.flags.writeable
        assert address(array) % 64 == 0  # a cache line
    color[:], number[:] = 1.5, -7
    assert (color == 1.5).all() and (number == -7).all()


def test_memory_is_used_again_when_the_last_array_is_gone():
    pool = Buffers()
    color, _, number = pool.arrays(LAYOUTS)
    at = address(color)
    part = number[3:, ::2].T.view(np.uint32)  # a view of a view
    del color, _, number
    other = pool.arrays(LAYOUTS)[0]
    assert address(other) != at
    del part
    assert address(pool.arrays(LAYOUTS)[0]) == at


@pytest.mark.parametrize("hold", ["channel", "view", "memoryview"])
def test_a_frame_that_is_held_keeps_its_pixels(hold):
    with Tracer(Scene((SceneObject(Sphere()),)), threads=1) as tracer:
        near, far = Camera(eye=(0, 0, 3)), Camera(eye=(0, 0, 30))
        depth = tracer.render(near, (40, 30), ("depth",)).channel("depth")
        held = {"channel": depth, "view": depth[5:, 3:], "memoryview": memoryview(depth)}[hold]
        before = np.array(held)
        del depth
        for _ in range(5):
            tracer.render(far, (40, 30), ("depth",))
        assert np.array_equal(held, before)
    assert np.array_equal(held, before)  # nor does it end with its Tracer


def test_what_idles_is_bounded(monkeypatch):
    monkeypatch.setattr(buffers, "LARGEST_KEPT_BYTES", 10_000)
    pool = Buffers()
    held = [pool.arrays([((size,), np.uint8)]) for size in (64, 128, 192, 256, 320, 20_032)]
    while held:
        held.pop(0)
    assert [block.nbytes // 64 for block in pool.idle] == [5, 6, 7]


def test_threads_never_get_the_same_memory():
    pool, wrong = Buffers(), []

    def work(number):
        for _ in range(500):
            array = pool.arrays([((64,), np.int32)])[0]
            array[:] = number
            if not (array == number).all():
                wrong.append(number)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong
