"""The benchmarks' tracers: in processes of their own, and Embree in C++. No stopwatch."""

from __future__ import annotations

import numpy as np
import pytest

from tools.benchmarks import embree, measure, run
from tools.benchmarks.cameras import easy_views
from tools.benchmarks.lucida import Lucida
from tools.benchmarks.meshes import bumpy_sphere
from tools.benchmarks.processes import TracerProcess
from tools.benchmarks.scenes import Subject

SIZE = (48, 27)
BALL = Subject("ball", *bumpy_sphere(300))
CAMERA = easy_views(BALL, SIZE)[0].camera


class BrokenTracer(Lucida):
    name = "Broken"

    def __init__(self, threads=None):
        raise ImportError("libusb-1.0.so.0: cannot open shared object file")


@pytest.fixture(scope="module")
def process():
    process = TracerProcess(Lucida)
    yield process
    process.close()


@pytest.fixture
def session():
    session = run.Run()
    yield session
    session.close()


class TestProcess:
    def test_it_traces_what_was_prepared(self, process):
        process.prepare(BALL)
        process.image(CAMERA, SIZE)
        image = process.hits()
        process.release()
        own = Lucida()
        own.prepare(BALL.vertices, BALL.faces)
        expected = own.read(own.trace(CAMERA, SIZE)).primitive
        own.close()
        assert (image.primitive == expected).all()
        assert process.version()

    def test_a_turn_gives_a_time_a_call(self, process):
        process.prepare(BALL, threads=1)
        process.image(CAMERA, SIZE)
        plan = measure.Plan(pause_s=0.0, repeats=4, slow_s=1e9)
        times = process.turn(plan, measure.seconds)()
        assert len(times) == 4
        assert min(times) > 0
        process.building(BALL)
        assert len(process.turn(plan, measure.processor_seconds)()) == 4
        process.release()

    def test_a_failure_is_told_with_its_place(self, process):
        with pytest.raises(RuntimeError) as failure:
            process.image(CAMERA, SIZE)
        assert str(failure.value) == "no scene is prepared"
        assert "In the process of Lucida" in failure.value.__notes__[0]
        assert "_set_image" in failure.value.__notes__[0]
        process.prepare(BALL)  # and it goes on
        process.release()


class TestPeers:
    def test_a_broken_one_is_left_out(self, monkeypatch, session):
        monkeypatch.setattr(run, "PEERS", (BrokenTracer,))
        session.find_peers()
        assert session.kinds == ()
        (reason,) = session.left_out.values()
        assert reason.endswith("install the system's libusb-1.0-0")

    def test_tracers_are_released(self, monkeypatch, session):
        monkeypatch.setattr(run, "PEERS", ())
        with session.tracers(BALL) as (ours,):
            ours.image(CAMERA, SIZE)
            assert session.time([ours], measure.Plan(rounds=1)).keys() == {"Lucida"}
        with pytest.raises(RuntimeError, match="no scene is prepared"):
            ours.image(CAMERA, SIZE)


class TestNativeEmbree:
    @pytest.mark.parametrize("view", range(3))
    def test_it_finds_what_lucida_finds(self, view):
        try:
            native = embree.NativeEmbree()
        except ImportError as why:
            pytest.skip(str(why))
        size = (70, 41)  # of no whole packets
        camera = easy_views(BALL, size)[view].camera
        ours = Lucida()
        for tracer in (native, ours):
            tracer.prepare(BALL.vertices, BALL.faces)
        expected = ours.read(ours.trace(camera, size))
        seen = native.read(native.trace(camera, size))
        same = seen.primitive == expected.primitive
        assert same.mean() > 0.995
        t = (
            np.where(np.isfinite(seen.t), seen.t, -1),
            np.where(expected.primitive < 0, -1, expected.t),
        )
        np.testing.assert_allclose(t[0][same], t[1][same], rtol=1e-4)
        turned = np.sign((seen.normal * expected.normal).sum(axis=1, keepdims=True))
        np.testing.assert_allclose((seen.normal * turned)[same], expected.normal[same], atol=1e-4)
        native.close()
        ours.close()
