"""Processes that were forked: what would wait for ever there says so; what works still works."""

import os

import pytest
from launching import launch

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="POSIX's fork")

# Prints what becomes of each call in a forked process; one that hangs is ended by an alarm.
SCRIPT = """
import os, signal, sys, time
from lucida import Camera, LucidaError, Rasterizer, Tracer
from lucida.renderer.scene.model import Scene, SceneObject, Sphere

scene, camera = Scene((SceneObject(Sphere((0, 0, -3))),)), Camera()

def forked(name, call):
    sys.stdout.flush()
    pid = os.fork()
    if pid == 0:
        signal.alarm(100)
        try:
            print(name, call(), flush=True)
        except LucidaError as error:
            print(name, "error", error, flush=True)
        os._exit(0)
    if os.waitpid(pid, 0)[1]:
        print(name, "hung")
"""
TRACER = """
from tests.renderer.trace.test_trace_jobs import FRONT, LARGE, slow_scene
unused = Tracer(scene)
tracer = Tracer(scene)
tracer.render(camera, (8, 8))
forked("unused", lambda: unused.render(camera, (8, 8)).complete)
forked("new", lambda: Tracer(scene).render(camera, (8, 8)).complete)
forked("used", lambda: tracer.render(camera, (8, 8)).complete)
forked("closed", lambda: tracer.close())
job = Tracer(slow_scene(), method="reference").start(FRONT, LARGE)
while not job.progress:
    time.sleep(0.001)
forked("result", lambda: job.result())
forked("wait", lambda: job.wait())
forked("beside", lambda: Tracer(scene).render(camera, (8, 8)).complete)
job.cancel()
sys.stdout.flush()
pid = os.fork()
if pid == 0:
    signal.alarm(100)
    sys.exit(3)  # runs what is to be done at exit
print("exit", os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
print("parent", tracer.render(camera, (8, 8)).complete)
"""
RASTERIZER = """
forked("before", lambda: Rasterizer(scene, "{backend}").render(camera, (8, 8)).complete)
rasterizer = Rasterizer(scene, "{backend}")
rasterizer.render(camera, (8, 8))
forked("inherited", lambda: rasterizer.render(camera, (8, 8)).complete)
forked("new", lambda: Rasterizer(scene, "{backend}").render(camera, (8, 8)).complete)
forked("released", lambda: rasterizer.release())
print("parent", rasterizer.render(camera, (8, 8)).complete)
"""


def outcomes(script, folder):
    done = launch(["-c", SCRIPT + script], folder)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    lines = (line.partition(" ") for line in done.stdout.splitlines())
    return {name: outcome for name, _, outcome in lines}


def test_a_tracer_works_or_says_so_in_a_forked_process(tmp_path):
    came = outcomes(TRACER, tmp_path)
    for name in ("used", "result", "wait", "beside"):
        text = came.pop(name)
        assert text.startswith("error tracer: "), (name, text)
        assert "spawn" in text
    assert came == {
        "unused": "True", "new": "True", "closed": "None", "exit": "3", "parent": "True"
    }  # fmt: skip


def test_a_rasterizer_works_or_says_so_in_a_forked_process(tmp_path, gl_backend):
    came = outcomes(RASTERIZER.format(backend=gl_backend), tmp_path)
    for name in ("inherited", "new"):
        text = came.pop(name)
        assert text.startswith("error OpenGL: "), (name, text)
        assert "spawn" in text
    assert came == {"before": "True", "released": "None", "parent": "True"}
