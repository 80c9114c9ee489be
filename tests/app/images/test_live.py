"""The ray image of a changing camera: the newest wins, and nothing is waited for."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from flawed_images import changed, image
from waiting import PATIENT_S, wait_for

from lucida.app.images import agreement as agreement_module
from lucida.app.images import progressive_ray as live
from lucida.app.images.agreement import Agreement, Verdict
from lucida.app.images.progressive_ray import LiveTrace, RayImage
from lucida.app.images.request import ImageRequest
from lucida.renderer.camera.camera import Camera
from lucida.renderer.images.frame import CHANNELS, Frame
from lucida.renderer.scene.model import Scene, SceneObject, Sphere
from lucida.renderer.system.errors import LucidaError

SCENE, OTHER = Scene((SceneObject(Sphere()),)), Scene(())
TWO = Scene((SceneObject(Sphere()), SceneObject(Sphere())))
SIZE = (80, 64)


class Job:
    """A job that ends when the test says so, or when it is cancelled."""

    def __init__(self, size: tuple[int, int], channels: tuple[str, ...], time_s: float) -> None:
        self.size, self.channels, self.time_s = size, channels, time_s
        self.ended, self.cancelled = threading.Event(), False

    progress = 0.5

    @property
    def done(self) -> bool:
        return self.ended.is_set()

    def cancel(self) -> None:
        if not self.done:
            self.cancelled = True
            self.ended.set()

    def wait(self, timeout_s: float | None = None) -> bool:
        return self.ended.wait(PATIENT_S if timeout_s is None else timeout_s)

    def result(self) -> Frame:
        assert self.wait()
        color = np.zeros((self.size[1], self.size[0], 3), np.float32)
        return Frame(self.size, color, time_s=self.time_s, complete=not self.cancelled)


@dataclass
class Tracer:
    """held: jobs wait for the test; else they end at once. pixel_s: how slow it says it is."""

    scene: Scene
    held: bool = False
    pixel_s: float = 1e-9
    error: Exception | None = None
    jobs: list[Job] = field(default_factory=list)
    cameras: list[Camera] = field(default_factory=list)
    closed: bool = False
    is_compiling: bool = False

    def start(self, camera: Camera, size: tuple[int, int], channels: tuple[str, ...] = ()) -> Job:
        if self.error is not None:
            raise self.error
        job = Job(size, channels, self.pixel_s * size[0] * size[1])
        self.jobs.append(job)
        self.cameras.append(camera)
        if not self.held:
            job.ended.set()
        return job

    def set_scene(self, scene: Scene) -> None:
        self.scene = scene

    def close(self) -> None:
        self.closed = True


class Rig:
    def __init__(self) -> None:
        self.tracers: list[Tracer] = []
        self.settings: dict = {}
        self.woken = threading.Semaphore(0)
        others = set(threading.enumerate())
        self.live = LiveTrace(self.woken.release, self._make)
        (self.thread,) = set(threading.enumerate()) - others

    def _make(self, request: ImageRequest) -> Tracer:
        self.tracers.append(Tracer(request.scene, **self.settings))
        return self.tracers[-1]

    @property
    def factors(self) -> list[int]:
        """Return the factors of all images that were traced.

        A quick one may replace the last one before the window asks.
        """
        return [SIZE[0] // job.size[0] for tracer in self.tracers for job in tracer.jobs]

    def images(self) -> list[RayImage]:
        """All images until nothing more is to come."""
        images = []
        while True:
            image = self.live.poll()
            if image is not None:
                images.append(image)
            elif not self.live.busy:
                return images
            else:
                assert self.woken.acquire(timeout=PATIENT_S)


@pytest.fixture
def rig() -> Iterator[Rig]:
    rig = Rig()
    yield rig
    for tracer in rig.tracers:
        for job in tracer.jobs:
            job.ended.set()
    rig.live.close(PATIENT_S)
    assert not rig.thread.is_alive()


def request(x: float = 0.0, scene: Scene = SCENE) -> ImageRequest:
    return ImageRequest(scene, replace(Camera(), eye=(x, 0, 3)), SIZE)


def test_an_image_is_as_coarse_as_it_is_requested(rig):
    for factor, size, channels in ((8, (10, 8), CHANNELS), (1, SIZE, CHANNELS)):
        rig.live.request(request(), factor)
        image = rig.images()[-1]
        job = rig.tracers[0].jobs[-1]
        assert (image.factor, job.size, job.channels) == (factor, size, channels)
    assert len(rig.tracers[0].jobs) == 2


def test_several_samples_a_pixel_come_after_the_full_image(rig):
    """The image to be compared with the raster image keeps one sample, as do other channels."""
    rig.live.request(replace(request(), samples=4))
    image = rig.images()[-1]
    (tracer,) = rig.tracers
    assert rig.factors == [1, 1, 1, 1, 1]
    assert [job.channels for job in tracer.jobs[1:]] == [("color",)] * 4
    assert tracer.cameras[0] == request().camera
    assert {camera.viewport for camera in tracer.cameras[1:]} == {
        request().camera.shifted(rows, columns, SIZE).viewport
        for rows in (-0.25, 0.25)
        for columns in (-0.25, 0.25)
    }
    assert image.mean is not None and image.mean is not image.frame.color
    assert image.shown("color") is image.mean and image.frame.size == SIZE
    assert image.request.without_effects == request()
    assert not rig.live.busy


def test_a_change_cancels_the_samples_that_are_still_to_come(rig):
    rig.settings = {"held": True}
    rig.live.request(replace(request(), samples=64))
    wait_for(lambda: bool(rig.tracers) and len(rig.tracers[0].jobs) == 1)
    jobs = rig.tracers[0].jobs
    for number in range(2):
        wait_for(lambda: len(jobs) == number + 1)  # noqa: B023
        jobs[number].ended.set()
    wait_for(lambda: len(jobs) == 3)
    assert rig.live.busy
    rig.live.request(request(1.0))
    wait_for(lambda: len(jobs) == 4)
    assert jobs[2].cancelled and rig.tracers[0].cameras[3].eye[0] == 1.0
    image = rig.live.poll()
    assert image is not None and image.factor == 1 and image.mean is None


def test_the_same_request_is_traced_once(rig):
    rig.live.request(request())
    rig.images()
    rig.live.request(request())
    assert not rig.live.busy
    assert rig.images() == []


@pytest.mark.parametrize("factor", [1, 4])
def test_an_image_that_takes_too_long_is_cancelled_by_the_newest(rig, factor, monkeypatch):
    # The jobs never end by themselves: any call that waited for them would hang.
    monkeypatch.setattr(live, "FULL_PATIENCE_S", 0.0)
    monkeypatch.setattr(live, "COARSE_PATIENCE_S", 0.0)
    rig.settings = {"held": True, "is_compiling": True}
    rig.live.request(request(), factor)
    wait_for(lambda: bool(rig.tracers) and len(rig.tracers[0].jobs) == 1)
    tracer = rig.tracers[0]
    assert rig.live.poll() is None and rig.live.busy
    wait_for(lambda: rig.live.preparing_s > 0)
    rig.live.request(request(1.0), factor)
    rig.live.request(request(2.0), factor)
    wait_for(lambda: tracer.cameras[-1].eye[0] == 2.0)
    assert tracer.jobs[0].cancelled
    assert rig.live.is_compiling


def test_a_coarse_image_is_finished_despite_changes(rig, monkeypatch):
    monkeypatch.setattr(live, "COARSE_PATIENCE_S", PATIENT_S)
    rig.settings = {"held": True}
    rig.live.request(request(), 4)
    wait_for(lambda: bool(rig.tracers) and len(rig.tracers[0].jobs) == 1)
    rig.live.request(request(1.0), 4)
    job = rig.tracers[0].jobs[0]
    assert not job.cancelled
    job.ended.set()
    wait_for(lambda: len(rig.tracers[0].jobs) == 2)
    image = rig.live.poll()
    assert image is not None
    assert image.request == request()


def test_another_scene_is_followed_by_the_same_tracer(rig):
    rig.live.request(request())
    rig.images()
    rig.live.request(request(scene=OTHER))
    images = rig.images()
    assert [(image.request.scene, image.factor) for image in images] == [(OTHER, 1)]
    assert [(tracer.scene, tracer.closed) for tracer in rig.tracers] == [(OTHER, False)]
    assert rig.live.preparing_s == 0


def test_other_effects_get_another_tracer(rig):
    rig.live.request(request())
    rig.images()
    rig.live.request(replace(request(), shadows=True))
    assert rig.images()[-1].request.shadows
    assert [tracer.closed for tracer in rig.tracers] == [True, False]


def test_a_scene_that_takes_long_is_being_prepared(rig):
    rig.live.request(request())
    rig.images()
    tracer = rig.tracers[0]
    tracer.held = True
    rig.live.request(request(scene=OTHER))
    wait_for(lambda: rig.live.preparing_s > 0)
    wait_for(lambda: len(tracer.jobs) == 2)
    tracer.jobs[-1].ended.set()
    rig.images()
    assert rig.live.preparing_s == 0


def test_an_error_is_kept_and_the_next_request_tries_again(rig):
    rig.settings = {"error": LucidaError("size", "is too large")}
    rig.live.request(request())
    assert rig.images() == []
    assert isinstance(rig.live.error, LucidaError)
    rig.settings = {}
    rig.live.request(request(1.0))
    assert rig.images()[-1].factor == 1
    assert rig.live.error is None


def test_closing_cancels_and_does_not_wait_for_ever():
    rig = Rig()
    rig.settings = {"held": True}
    rig.live.request(request())
    wait_for(lambda: bool(rig.tracers) and len(rig.tracers[0].jobs) == 1)
    rig.live.close(PATIENT_S)
    assert rig.tracers[0].jobs[0].cancelled
    assert rig.tracers[0].closed
    rig.live.request(request(1.0))
    assert len(rig.tracers[0].jobs) == 1


def agreeing(number: int = 0) -> Frame:
    """4 x 2 pixels, of which the first shows the object of that number."""
    return changed(image(1, 0, 0, (4, 2)), (0, 0), id=number)


def test_agreement_counts_the_pixels_that_differ(monkeypatch):
    flattened = []
    flatten = agreement_module.flatten
    monkeypatch.setattr(
        agreement_module, "flatten", lambda *given: flattened.append(given[0]) or flatten(*given)
    )
    woken = threading.Semaphore(0)
    agreement = Agreement(woken.release)
    asked = ImageRequest(SCENE, Camera(eye=(0, 0, 3)), (4, 2))

    def verdict_of(request: ImageRequest, raster: Frame) -> Verdict:
        agreement.submit(RayImage(request, agreeing(), 1), raster)
        assert agreement.busy
        assert woken.acquire(timeout=PATIENT_S)
        agreement.poll()
        assert not agreement.busy
        verdict = agreement.verdict_on(request)
        assert verdict is not None
        return verdict

    assert verdict_of(asked, agreeing()).text == "raster and ray: all pixels agree"
    many = replace(asked, samples=16)
    assert verdict_of(many, agreeing()).text == "raster and ray: all pixels agree, at their centres"
    assert verdict_of(asked, agreeing()).text == "raster and ray: all pixels agree"
    assert agreement.verdict_on(replace(asked, size=(4, 3))) is None
    verdict = verdict_of(asked, agreeing(1))
    assert verdict.comparison.differing == 1
    # Shadows differ for a good reason: nothing is said of the rest either.
    verdict = verdict_of(replace(asked, shadows=True), agreeing(1))
    assert verdict.text == "not compared: only rays find shadows and mirrors"
    assert verdict.agrees is None
    verdict_of(replace(asked, scene=TWO), agreeing())
    assert flattened == [SCENE, TWO]  # once each: it is costly
    agreement.close()
    assert "lucida-compare" not in {thread.name for thread in threading.enumerate()}
