"""Jobs in the background: progress, cancelling, several at once, and their end."""

from __future__ import annotations

import gc
import threading
import weakref
from dataclasses import replace

import numpy as np
import pytest
from launching import launch
from trace_reference import scene_of
from waiting import PATIENT_S, wait_for

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import Mesh, Sphere
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.trace import Tracer
from lucida.renderer.trace.arguments.image import BLOCK
from lucida.renderer.trace.bvh import instances
from lucida.renderer.trace.threads.thread_pool import Team

FRONT = Camera.look_at((0, 0, 5), (0, 0, 0), fov_y_deg=40)
SMALL, LARGE = (48, 32), (1024, 1024)


class Gate:
    """Holds up the building of a mesh's tree. ends: how each one that was held up has ended."""

    def __init__(self, monkeypatch):
        self.reached, self.opened = threading.Event(), threading.Event()
        self.ends: list[str] = []
        self.build = instances.tree_of_mesh
        self.monkeypatch = monkeypatch

    def hold(self, tracer, scene):
        """Draw an image; then return a job that waits for the tree of another scene."""
        tracer.render(FRONT, SMALL)
        self.monkeypatch.setattr(instances, "tree_of_mesh", self)
        tracer.set_scene(scene)
        job = tracer.start(FRONT, SMALL)
        assert self.reached.wait(PATIENT_S)
        return job

    def __call__(self, *arguments):
        self.reached.set()
        assert self.opened.wait(PATIENT_S)
        self.ends.append("given up")
        tree = self.build(*arguments)
        self.ends[-1] = "built"
        return tree


@pytest.fixture
def gate(monkeypatch):
    return Gate(monkeypatch)


def one_triangle(depth):
    vertices = np.array([[-9, -9, depth], [9, -9, depth], [0, 20, depth]], float)
    return scene_of(Mesh(vertices, np.array([[0, 1, 2]])))


def nearest(frame):
    """The distance from the eye of the nearest hit, along the view's direction."""
    return float(frame.channel("depth").min()) * FRONT.distance


def test_building_for_a_scene_that_nobody_wants_any_more_is_given_up(gate):
    with Tracer(scene_of(Sphere())) as tracer:
        first = gate.hold(tracer, one_triangle(1.0))
        first.cancel()
        assert not first.result().complete  # at once
        tracer.set_scene(scene_of(Sphere(radius=0.5)))
        second = tracer.start(FRONT, SMALL)
        gate.opened.set()
        assert second.result().complete
        assert gate.ends == ["given up"]
        # Nothing is left of it: the same scene, asked for again, is built and drawn.
        tracer.set_scene(one_triangle(2.0))
        assert nearest(tracer.render(FRONT, SMALL)) == pytest.approx(3.0)
        assert gate.ends == ["given up", "built"]


@pytest.mark.parametrize("fails", [False, True])
def test_after_a_scene_that_was_not_finished_the_one_before_is_drawn_as_before(gate, fails):
    """Preparing another scene is given up, or fails. The one before is prepared again."""
    before = one_triangle(0.5)
    with Tracer(before) as tracer:
        wanted = tracer.render(FRONT, SMALL)
        colors = {"ambient": (0.9, 0.1, 0.1), "background": (0.2, 0.9, 0.2)}
        first = gate.hold(tracer, replace(one_triangle(2.0), **colors))
        if fails:
            build, gate.build = gate.build, None  # calling it raises
        else:
            first.cancel()
        tracer.set_scene(before)
        second = tracer.start(FRONT, SMALL)
        gate.opened.set()
        if fails:
            with pytest.raises(TypeError, match="not callable"):
                first.result()
            gate.build = build
        assert np.array_equal(second.result().color, wanted.color)
        assert gate.ends[:1] == ["given up"]


def test_building_goes_on_for_another_image_of_the_same_scene(gate):
    with Tracer(scene_of(Sphere())) as tracer:
        first = gate.hold(tracer, one_triangle(1.0))
        first.cancel()
        second = tracer.start(FRONT, SMALL)
        gate.opened.set()
        assert nearest(second.result()) == pytest.approx(4.0)
        assert gate.ends == ["built"]


def test_closing_gives_up_building(gate):
    tracer = Tracer(scene_of(Sphere()))
    job = gate.hold(tracer, one_triangle(1.0))
    closing = threading.Thread(target=tracer.close)
    closing.start()
    assert not job.result().complete  # at once
    gate.opened.set()
    closing.join(PATIENT_S)
    assert gate.ends == ["given up"]


def test_a_scene_whose_first_job_was_cancelled_waiting_is_prepared_for_the_next(gate):
    with Tracer(scene_of(Sphere())) as tracer:
        busy = gate.hold(tracer, one_triangle(1.0))
        tracer.set_scene(scene_of(Sphere(radius=0.5)))
        waiting = tracer.start(FRONT, SMALL)
        waiting.cancel()
        wanted = tracer.start(FRONT, SMALL)
        gate.opened.set()
        assert busy.result().complete
        assert nearest(wanted.result()) == pytest.approx(4.5, rel=1e-3)


def slow_scene():
    """Each ray tries all of 1000 equal triangles: an image of LARGE takes half a minute."""
    vertices = np.array([[-9, -9, 0], [9, -9, 0], [0, 20, 0]], float)
    return scene_of(Mesh(vertices, np.tile([0, 1, 2], (1000, 1))))


@pytest.fixture(scope="module")
def slow():
    with Tracer(slow_scene(), threads=2, method="reference") as tracer:
        tracer.render(FRONT, (1, 1))
        yield tracer


def wait_until_tracing(job):
    wait_for(lambda: job.progress)
    assert job.progress < 1


def test_a_cancelled_job_gives_what_it_has(slow):
    job = slow.start(FRONT, LARGE, ("color", "depth", "normal", "id", "primitive"))
    wait_until_tracing(job)
    assert not job.done
    job.cancel()
    assert job.wait(PATIENT_S)
    assert job.done
    assert job.progress == 1
    frame = job.result()
    assert not frame.complete
    assert frame is job.result()
    first = frame.id[:BLOCK, :BLOCK]  # taken first, and finished before any progress was seen
    assert (first == 0).any() or (frame.id == 0).any()
    missed = frame.id < 0
    assert missed[-BLOCK:].all()
    assert np.isinf(frame.depth[missed]).all()
    assert (frame.color[missed] == np.float32([0.1, 0.2, 0.3])).all()
    assert (frame.normal[missed] == 0).all()
    assert (frame.primitive[missed] == -1).all()
    assert np.isfinite(frame.depth[~missed]).all()


def test_jobs_wait_for_one_another_and_can_be_cancelled_while_waiting(slow):
    first = slow.start(FRONT, LARGE, ("depth",))
    second = slow.start(FRONT, SMALL)
    third = slow.start(FRONT, (8, 8))
    second.cancel()
    assert second.done  # at once, though the first goes on
    assert not first.done
    frame = second.result()
    assert not frame.complete
    assert frame.color.shape == (32, 48, 3)
    assert np.isinf(frame.depth).all()
    assert not third.wait(0.01)
    first.cancel()
    assert third.result().complete


def test_a_cancelled_job_stays_cancelled_and_the_tracer_goes_on(slow):
    job = slow.start(FRONT, LARGE)
    job.cancel()
    job.cancel()
    assert not job.result().complete
    assert slow.render(FRONT, (4, 4)).complete
    done = slow.start(FRONT, (4, 4))
    done.wait()
    done.cancel()
    assert done.result().complete


def test_progress_rises_to_one(slow):
    seen = []
    threads = set()

    def progress(fraction):
        seen.append(fraction)
        threads.add(threading.current_thread())

    frame = slow.render(FRONT, (96, 64), ("color", "depth"), samples=4, progress=progress)
    assert frame.complete
    assert seen == sorted(seen)
    assert len(seen) >= 5
    assert seen[-1] == 1
    assert 0 <= seen[0] < 1
    assert threads == {threading.current_thread()}


def test_an_exception_in_progress_cancels(slow):
    def progress(fraction):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        slow.render(FRONT, LARGE, progress=progress)
    assert slow.render(FRONT, (4, 4)).complete  # not after minutes


def test_closing_cancels_and_ends_the_threads():
    before = set(threading.enumerate())
    tracer = Tracer(slow_scene(), threads=3, method="reference")
    jobs = [tracer.start(FRONT, LARGE) for _ in range(3)]
    wait_until_tracing(jobs[0])
    tracer.close()
    tracer.close()
    assert all(job.done for job in jobs)
    assert not any(job.result().complete for job in jobs)
    assert before.issuperset(threading.enumerate())
    with pytest.raises(LucidaError, match="closed"):
        tracer.start(FRONT, SMALL)


def test_a_dropped_tracer_ends_its_threads():
    before = set(threading.enumerate())
    tracer = Tracer(slow_scene(), threads=2, method="reference")
    job = tracer.start(FRONT, LARGE)
    wait_until_tracing(job)
    started = set(threading.enumerate()) - before
    gone = weakref.ref(tracer)
    del tracer
    gc.collect()
    assert gone() is not None  # the job keeps it
    assert not job.done
    del job
    gc.collect()
    assert gone() is None
    assert len(started) == 2
    for thread in started:
        thread.join(PATIENT_S)
        assert not thread.is_alive()


def test_several_tracers_at_once():
    scenes = [scene_of(Sphere((0, 0, z), 1.0)) for z in (-4.0, -2.0, 0.0, 1.0)]
    tracers = [Tracer(scene, threads=2) for scene in scenes]
    jobs = [tracer.start(FRONT, (63, 65), ("depth",)) for _ in range(5) for tracer in tracers]
    frames = [job.result() for job in jobs]
    assert all(frame.complete for frame in frames)
    for number, frame in enumerate(frames):
        assert np.array_equal(frame.depth, frames[number % 4].depth)
        assert frame.depth[32, 31] * FRONT.distance == pytest.approx(
            4 - (-4.0, -2.0, 0.0, 1.0)[number % 4], rel=0.01
        )
    for tracer in tracers:
        tracer.close()


def test_the_image_does_not_depend_on_the_threads():
    frames = []
    for threads in (1, 2, 5):
        with Tracer(scene_of(Sphere(), Sphere((1, 1, 1), 0.5)), threads) as tracer:
            frames.append(tracer.render(FRONT, (100, 70)))
    for channel in ("color", "depth", "normal", "id"):
        assert all(
            np.array_equal(getattr(frame, channel), getattr(frames[0], channel)) for frame in frames
        )


def test_an_error_in_the_team_reaches_the_caller():
    team = Team(3)

    def fail():
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        team.run(fail)
    calls = []
    team.run(calls.append, 1)
    team.run(calls.append, 1, size=2)
    assert len(calls) == 5
    team.close()


def test_the_interpreter_exits_while_jobs_run(tmp_path):
    script = """
import sys, time
from tests.renderer.trace.test_trace_jobs import FRONT, LARGE, slow_scene
from lucida.renderer.trace import Tracer
tracers = [Tracer(slow_scene(), threads=2, method="reference") for _ in range(2)]
jobs = [tracer.start(FRONT, LARGE) for tracer in tracers for _ in range(2)]
while not jobs[0].progress or not jobs[2].progress:
    time.sleep(0.01)
sys.exit(3)
"""
    done = launch(["-c", script], tmp_path)
    assert (done.returncode, done.stderr) == (3, "")
