"""A renderer and a counter that only note what is asked of them, and waiting for a meter."""

from __future__ import annotations

import math
import threading

from app.costs.model import (
    ROUNDS,
    Meter,
    Sample,
    count,
)
from app.costs.work import Work
from renderer.camera import Camera
from renderer.frame import Frame
from renderer.scene.model import Scene


class Fake:
    """Draws nothing, and takes as long as its loop would."""

    def __init__(self, per_triangle: float, per_pixel: float) -> None:
        self.per_triangle, self.per_pixel = per_triangle, per_pixel
        self.scene = Scene(())
        self.drawn = 0
        self.released = False

    def set_scene(self, scene: Scene) -> None:
        self.scene = scene

    def render(self, camera: Camera, size, channels) -> Frame:
        self.drawn += 1
        time_s = self.per_triangle * count(self.scene) + self.per_pixel * size[0] * size[1]
        # The first is the slowest, and would be the worst measure.
        return Frame(size=size, time_s=time_s + (10 if self.drawn % (ROUNDS + 1) == 1 else 0))

    def release(self) -> None:
        self.released = True


class FakeCounter:
    """Counts nothing, and says which images it was asked for."""

    def __init__(self) -> None:
        self.asked: list[tuple[int, tuple[int, int]]] = []

    def work(self, scene: Scene, camera: Camera, size) -> Work:
        n, pixels = count(scene), size[0] * size[1]
        self.asked.append((n, size))
        return Work(n, pixels, n, 2 * pixels, pixels, int(pixels * (3 + math.log2(n))), pixels)


def gathered(meter: Meter, done: threading.Event) -> tuple[Sample, ...]:
    assert done.wait(60)
    return meter.samples
