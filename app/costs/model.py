"""The cost of an image: the steps of both loops, counted, and the times of both fast renderers.

Makes the scenes and measures them on its own thread. The rasterizer has its own OpenGL context
there, so that no window waits for it.
"""

from __future__ import annotations

import logging
import math
import threading
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from typing import Literal, Protocol

from app.costs.options import CostOptions
from app.costs.work import Counter, Work
from app.state.bounds import check
from renderer.camera import Camera, Size
from renderer.frame import Frame
from renderer.scene import shapes
from renderer.scene.limits import SEGMENTS
from renderer.scene.model import DirectionalLight, Material, Mesh, Scene, SceneObject

Renderer = Literal["raster", "ray"]
RENDERERS: tuple[Renderer, ...] = ("raster", "ray")
COUNTING = "counting"  # key of problems, besides the renderers' names
ROUNDS = 5  # times that each case is drawn; the least counts, others had company
WATCHED = 240  # frames that are kept while watching
WATCH_S = 0.04  # from one watched frame to the next, so that others have the processor too
_LOG = logging.getLogger(__name__)

Image = tuple[int, int]  # triangles and pixels, as they were asked for


@dataclass(frozen=True)
class Case:
    """A case to measure, within CostOptions' bounds. pixels: of an image of about 4 : 3."""

    renderer: Renderer
    triangles: int
    pixels: int

    def __post_init__(self) -> None:
        check(CostOptions, {"triangles": self.triangles, "pixels": self.pixels})

    @property
    def image(self) -> Image:
        """The image that both renderers draw for this case."""
        return self.triangles, self.pixels

    @property
    def size(self) -> Size:
        """(width, height)"""
        width = round(math.sqrt(self.pixels * 4 / 3))
        return width, round(self.pixels / width)


@dataclass(frozen=True)
class Sample:
    """The time of a case. triangles, pixels: their true numbers."""

    case: Case
    triangles: int
    pixels: int
    time_s: float


class MeasuredRenderer(Protocol):
    """A renderer to measure: a Rasterizer or a Tracer."""

    def set_scene(self, scene: Scene) -> None: ...

    def render(self, camera: Camera, size: Size, channels: tuple[str, ...]) -> Frame: ...


def torus_of(triangles: int) -> Scene:
    """Return a lit torus that fills the canonical camera's image, with about that many
    triangles.
    """
    sides = min(SEGMENTS, max(3, round(math.sqrt(triangles) / 2)))
    segments = min(SEGMENTS, max(3, round(triangles / (2 * sides))))
    return _torus(segments, sides)


def count(scene: Scene) -> int:
    """Return the number of triangles in a scene that torus_of made."""
    return sum(len(e.shape.faces) for e in scene.objects if isinstance(e.shape, Mesh))


@lru_cache(maxsize=4)
def _torus(segments: int, sides: int) -> Scene:
    mesh = shapes.torus(0.62, 0.3, segments, sides)
    mesh = shapes.translate(shapes.rotate(mesh, (55, 0, 20)), (0, 0, -2))
    material = Material((0.8, 0.5, 0.2), (0.3, 0.3, 0.3), 40)
    return Scene((SceneObject(mesh, material, "torus"),), (DirectionalLight((-1, -1, -1)),))


def cases(
    triangles: Iterable[int], pixels: Iterable[int], renderers: Iterable[Renderer] = RENDERERS
) -> list[Case]:
    """Return all combinations, in an order that prepares each scene only once."""
    renderers = tuple(renderers)
    pixels = tuple(pixels)
    return [
        Case(renderer, number_of, pixel_count)
        for number_of in triangles
        for renderer in renderers
        for pixel_count in pixels
    ]


def steps(least: int, most: int, how_many: int) -> list[int]:
    """Return numbers from least to most, with about the same factor from each to the next."""
    ratio = (most / least) ** (1 / max(1, how_many - 1))
    return sorted({round(least * ratio**k) for k in range(how_many)} | {least, most})


def measure(case: Case, drawing: MeasuredRenderer) -> Sample:
    """Draw a case once to warm up, then ROUNDS times. Return the least time."""
    scene = torus_of(case.triangles)
    drawing.set_scene(scene)
    camera = Camera.canonical().fitted(case.size)
    width, height = case.size
    times = [
        drawing.render(camera, case.size, channels=("color",)).time_s for _ in range(1 + ROUNDS)
    ]
    return Sample(case, count(scene), width * height, min(times[1:]))


class Counting(Protocol):
    """A Counter's interface."""

    def work(self, scene: Scene, camera: Camera, size: Size) -> Work: ...


class _Bench:
    """The renderers and scenes of the measuring thread."""

    def __init__(
        self, make: Callable[[Renderer], MeasuredRenderer], counter: Callable[[], Counting]
    ) -> None:
        self._make, self._counter = make, counter
        self._drawings: dict[Renderer, MeasuredRenderer] = {}
        self.scenes: dict[Renderer, Scene] = {}  # that were watched last

    def drawing(self, renderer: Renderer) -> MeasuredRenderer:
        if renderer not in self._drawings:
            self._drawings[renderer] = self._make(renderer)
        return self._drawings[renderer]

    @cached_property
    def counter(self) -> Counting:
        return self._counter()

    def release(self) -> None:
        for drawing in self._drawings.values():
            try:
                _release(drawing)
            except Exception:
                _LOG.exception("lucida: a renderer of the cost plot was not released")


class Meter:
    """Counts and measures in the background: the requested cases, or one again and again.

    The steps of all images are counted before the first is timed: counting is fast, and the plot's
    statement rests on it.

    changed: called from the thread after each.
    make, counter: how renderers and counter are made there; for tests.
    """

    def __init__(
        self,
        changed: Callable[[], None],
        make: Callable[[Renderer], MeasuredRenderer] | None = None,
        counter: Callable[[], Counting] = Counter,
    ) -> None:
        self._changed = changed
        self._make = make or make_renderer
        self._counter = counter
        self._lock = threading.Lock()
        self._wanted: list[Case] = []
        self._samples: list[Sample] = []
        self._uncounted: list[Image] = []
        self._work: dict[Image, Work] = {}
        self._problems: dict[str, str] = {}
        self._watched: tuple[Case, ...] = ()
        self._history: deque[tuple[float, float]] = deque(maxlen=WATCHED)
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self._releasing: threading.Thread | None = None  # it has nothing to do any more
        self._closed = False

    @property
    def samples(self) -> tuple[Sample, ...]:
        """The samples so far, in the order in which they were measured."""
        with self._lock:
            return tuple(self._samples)

    @property
    def work(self) -> dict[Image, Work]:
        """The steps of the images counted so far."""
        with self._lock:
            return dict(self._work)

    @property
    def problems(self) -> dict[str, str]:
        """The reasons why a renderer cannot be measured, or, under COUNTING, why nothing can be
        counted.
        """
        with self._lock:
            return dict(self._problems)

    @property
    def waiting(self) -> int:
        """The number of images not yet counted, and of cases not yet measured."""
        with self._lock:
            return len(self._uncounted) + len(self._wanted)

    @property
    def busy(self) -> bool:
        with self._lock:
            return self._thread is not None

    def ask(self, wanted: Iterable[Case]) -> None:
        """Measure these cases next, instead of those that were waiting. Known ones are kept."""
        wanted = tuple(wanted)
        with self._lock:
            known = {sample.case for sample in self._samples}
            self._wanted = [case for case in wanted if case not in known]
            images = dict.fromkeys(case.image for case in wanted)
            self._uncounted = [image for image in images if image not in self._work]
            self._wake()

    def watch(self, triangles: int, pixels: int) -> None:
        """Draw such an image with each renderer again and again, until unwatch(). Raises
        LucidaError for numbers out of bounds.
        """
        wanted = tuple(Case(renderer, triangles, pixels) for renderer in RENDERERS)
        with self._lock:
            self._watched = wanted
            self._wake()

    def unwatch(self) -> None:
        with self._lock:
            self._watched = ()

    @property
    def history(self) -> list[tuple[float, float]]:
        """The times of the last watched frames, (raster, ray) in seconds; NaN for a renderer that
        fails.
        """
        with self._lock:
            return list(self._history)

    def _wake(self) -> None:
        """Wake or start the thread. Call with the lock held."""
        needed = self._uncounted or self._wanted or self._watched
        if needed and self._thread is None and not self._closed:
            self._thread = threading.Thread(target=self._run, name="lucida costs", daemon=True)
            self._thread.start()

    def clear(self) -> None:
        """Discard all samples, and stop measuring. Counts are exact, so they stay."""
        with self._lock:
            self._uncounted, self._wanted, self._samples, self._problems = [], [], [], {}
            self._history.clear()

    def close(self, timeout_s: float = 2.0) -> None:
        """Stop after the current case."""
        with self._lock:
            self._uncounted, self._wanted, self._watched, self._closed = [], [], (), True
            self._stop.set()
            threads = [self._thread, self._releasing]
        for thread in threads:
            if thread is not None:
                thread.join(timeout_s)

    def _run(self) -> None:
        bench = _Bench(self._make, self._counter)
        try:
            while (task := self._next(bench)) is not None:
                task()
                try:
                    self._changed()
                except Exception:  # in the listener: measuring goes on
                    _LOG.exception("lucida: the cost plot was not told of a sample")
        finally:
            with self._lock:
                if self._thread is threading.current_thread():  # an error: the next has another
                    self._thread = None
            bench.release()

    def _next(self, bench: _Bench) -> Callable[[], None] | None:
        with self._lock:
            # Decide and record this under one lock: later requests start another thread.
            if self._uncounted:
                return partial(self._count, self._uncounted[0], bench)
            if self._wanted:
                return partial(self._measure, self._wanted[0], bench)
            if self._watched:
                return partial(self._watch_once, self._watched, bench)
            self._thread, self._releasing = None, self._thread
            return None

    def _count(self, image: Image, bench: _Bench) -> None:
        """Count an image's steps. An image that cannot be counted ends the counting."""
        work, problem = None, ""
        try:
            size = Case("ray", *image).size
            work = bench.counter.work(torus_of(image[0]), Camera.canonical().fitted(size), size)
        except Exception as error:  # shown next to the plot; times are still measured
            problem = _told(error)
        with self._lock:
            if work is not None:
                self._work[image] = work
                self._uncounted = [one for one in self._uncounted if one != image]
            else:
                self._problems[COUNTING], self._uncounted = problem, []

    def _watch_once(self, watched: Iterable[Case], bench: _Bench) -> None:
        """Draw one frame with each renderer, and pause."""
        times = dict.fromkeys(RENDERERS, math.nan)
        for case in watched:
            renderer, size = case.renderer, case.size
            if renderer in self.problems:
                continue
            camera = Camera.canonical().fitted(size)
            try:
                scene = torus_of(case.triangles)
                drawing = bench.drawing(renderer)
                if bench.scenes.get(renderer) is not scene:
                    drawing.set_scene(scene)
                    bench.scenes[renderer] = scene
                    drawing.render(camera, size, channels=("color",))  # prepares it
                times[renderer] = drawing.render(camera, size, channels=("color",)).time_s
            except Exception as error:  # shown next to the plot; the other one goes on
                with self._lock:
                    self._problems[renderer] = _told(error)
        with self._lock:
            self._history.append((times["raster"], times["ray"]))
        self._stop.wait(WATCH_S)

    def _measure(self, case: Case, bench: _Bench) -> None:
        sample, problem = None, self.problems.get(case.renderer, "")
        bench.scenes.pop(case.renderer, None)
        try:
            if not problem:
                sample = measure(case, bench.drawing(case.renderer))
        except Exception as error:  # shown next to the plot; the other goes on
            problem = _told(error)
        with self._lock:
            if case in self._wanted:  # otherwise it was cancelled
                self._wanted.remove(case)
                if sample is not None:
                    self._samples.append(sample)
            if problem:
                self._problems[case.renderer] = problem


def _told(error: Exception) -> str:
    return str(error) or type(error).__name__


def make_renderer(renderer: Renderer) -> MeasuredRenderer:
    if renderer == "ray":
        from renderer.trace import Tracer  # here, in the thread: it loads the compiler

        return Tracer(Scene(()))
    from renderer.raster import Rasterizer

    return Rasterizer(Scene(()))


def _release(drawing: MeasuredRenderer) -> None:
    for name in ("release", "close"):
        if (end := getattr(drawing, name, None)) is not None:
            end()
