"""The cost of an image: the steps of both loops, counted, and the times of both fast renderers.

Makes the scenes and measures them on its own thread. The rasterizer has its own OpenGL context
there, so that no window waits for it.
"""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import product
from typing import Any, Literal

from app.costs.options import CostOptions
from app.costs.work import Counter, Work
from app.state.bounds import check
from renderer.camera import Camera, Size
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
    return [Case(renderer, n, m) for n, renderer, m in product(triangles, renderers, pixels)]


def steps(least: int, most: int, how_many: int) -> list[int]:
    """Return numbers from least to most, with about the same factor from each to the next."""
    ratio = (most / least) ** (1 / max(1, how_many - 1))
    return sorted({round(least * ratio**k) for k in range(how_many)} | {least, most})


def draw(case: Case, drawing: Any) -> float:
    """Draw a case, whose scene is set, with a Rasterizer or a Tracer. Return the time, seconds."""
    camera = Camera.canonical().fitted(case.size)
    return float(drawing.render(camera, case.size, channels=("color",)).time_s)


def measure(case: Case, drawing: Any) -> Sample:
    """Draw a case once to warm up, then ROUNDS times. Return the least time."""
    scene = torus_of(case.triangles)
    drawing.set_scene(scene)
    draw(case, drawing)
    time_s = min(draw(case, drawing) for _ in range(ROUNDS))
    width, height = case.size
    return Sample(case, count(scene), width * height, time_s)


class Meter:
    """Counts and measures on a thread: the requested cases, or one again and again.

    The steps of all images are counted before the first is timed: counting is fast, and the plot's
    statement rests on it. The renderers are released when nothing is left to do.

    changed: called from the thread after each case. make, counter: create the renderers and the
    counter there; for tests. samples: in the order in which they were measured. work: the steps of
    the images counted so far. problems: why a renderer cannot be measured, or, under COUNTING, why
    nothing can be counted. history: the times of the last watched frames, (raster, ray) in seconds;
    NaN for a renderer that fails. busy: True until the thread has nothing to do.
    """

    def __init__(
        self,
        changed: Callable[[], None],
        make: Callable[[Renderer], Any] | None = None,
        counter: Callable[[], Any] = Counter,
    ) -> None:
        self._changed, self._make, self._counter = changed, make or make_renderer, counter()
        # The thread's alone.
        self._drawings: dict[Renderer, Any] = {}
        self._scenes: dict[Renderer, Scene] = {}  # that were watched last
        # Guarded by `_wake`. What others read is replaced, not changed.
        self._wake = threading.Condition()
        self._uncounted: list[Image] = []
        self._wanted: list[Case] = []
        self._watched: tuple[Case, ...] = ()
        self._closed = self.busy = False
        self._thread: threading.Thread | None = None
        self.samples: tuple[Sample, ...] = ()
        self.work: dict[Image, Work] = {}
        self.problems: dict[str, str] = {}
        self.history: tuple[tuple[float, float], ...] = ()

    @property
    def waiting(self) -> int:
        """The number of images not yet counted, and of cases not yet measured."""
        with self._wake:
            return len(self._uncounted) + len(self._wanted)

    def ask(self, wanted: Iterable[Case]) -> None:
        """Measure these cases next, instead of those that were waiting. Known ones are kept."""
        wanted = tuple(wanted)
        with self._wake:
            known = {sample.case for sample in self.samples}
            self._wanted = [case for case in wanted if case not in known]
            images = dict.fromkeys(case.image for case in wanted)
            self._uncounted = [image for image in images if image not in self.work]
            self._start()

    def watch(self, triangles: int, pixels: int) -> None:
        """Draw such an image with each renderer again and again, until unwatch(). Raises
        LucidaError for numbers out of bounds.
        """
        wanted = tuple(Case(renderer, triangles, pixels) for renderer in RENDERERS)
        with self._wake:
            self._watched = wanted
            self._start()

    def unwatch(self) -> None:
        with self._wake:
            self._watched = ()

    def clear(self) -> None:
        """Discard all samples, and stop measuring. Counts are exact, so they stay."""
        with self._wake:
            self._uncounted, self._wanted = [], []
            self.samples, self.problems, self.history = (), {}, ()

    def close(self, timeout_s: float = 2.0) -> None:
        """Stop after the current case."""
        with self._wake:
            self._closed = True
            self._wake.notify()
        if self._thread is not None:
            self._thread.join(timeout_s)

    def _start(self) -> None:
        """Wake or start the thread if there is work. Call with the lock held."""
        if self._closed or not (self._uncounted or self._wanted or self._watched):
            return
        self.busy = True
        self._wake.notify()
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="lucida costs", daemon=True)
            self._thread.start()

    def _run(self) -> None:
        while not self._closed:
            if (task := self._next()) is None:
                self._release()
                with self._wake:
                    if self._next() is None and not self._closed:
                        self.busy = False
                        self._wake.wait()
                continue
            task()
            try:
                self._changed()
            except Exception:  # in the listener: measuring goes on
                _LOG.exception("lucida: the cost plot could not be updated")
        self._release()
        self.busy = False

    def _next(self) -> Callable[[], None] | None:
        with self._wake:
            if self._uncounted:
                return partial(self._count, self._uncounted[0])
            if self._wanted:
                return partial(self._measure, self._wanted[0])
            return partial(self._watch_once, self._watched) if self._watched else None

    def _count(self, image: Image) -> None:
        """Count an image's steps. An image that cannot be counted ends the counting."""
        try:
            size = Case("ray", *image).size
            work = self._counter.work(torus_of(image[0]), Camera.canonical().fitted(size), size)
        except Exception as error:  # shown next to the plot; times are still measured
            self._fail(COUNTING, error)
            with self._wake:
                self._uncounted = []
            return
        with self._wake:
            self.work = {**self.work, image: work}
            self._uncounted = [one for one in self._uncounted if one != image]

    def _watch_once(self, watched: Iterable[Case]) -> None:
        """Draw one frame with each renderer, and pause."""
        times = dict.fromkeys(RENDERERS, math.nan)
        for case in watched:
            renderer, scene = case.renderer, torus_of(case.triangles)
            if renderer in self.problems:
                continue
            try:
                drawing = self._drawing(renderer)
                if self._scenes.get(renderer) is not scene:
                    drawing.set_scene(scene)
                    self._scenes[renderer] = scene
                    draw(case, drawing)  # prepares it
                times[renderer] = draw(case, drawing)
            except Exception as error:  # shown next to the plot; the other one goes on
                self._fail(renderer, error)
        with self._wake:
            self.history = (*self.history, (times["raster"], times["ray"]))[-WATCHED:]
            if not self._closed:
                self._wake.wait(WATCH_S)

    def _measure(self, case: Case) -> None:
        sample = None
        self._scenes.pop(case.renderer, None)
        try:
            if case.renderer not in self.problems:
                sample = measure(case, self._drawing(case.renderer))
        except Exception as error:  # shown next to the plot; the other goes on
            self._fail(case.renderer, error)
        with self._wake:
            if case in self._wanted:  # otherwise it was cancelled
                self._wanted.remove(case)
                if sample is not None:
                    self.samples = (*self.samples, sample)

    def _fail(self, what: str, error: Exception) -> None:
        with self._wake:
            self.problems = {**self.problems, what: str(error) or type(error).__name__}

    def _drawing(self, renderer: Renderer) -> Any:
        if renderer not in self._drawings:
            self._drawings[renderer] = self._make(renderer)
        return self._drawings[renderer]

    def _release(self) -> None:
        for drawing in self._drawings.values():
            try:
                drawing.close() if hasattr(drawing, "close") else drawing.release()
            except Exception:
                _LOG.exception("lucida: a renderer of the cost plot was not released")
        self._drawings.clear()
        self._scenes.clear()


def make_renderer(renderer: Renderer) -> Any:
    if renderer == "ray":
        from renderer.trace import Tracer  # here, in the thread: it loads the compiler

        return Tracer(Scene(()))
    from renderer.raster import Rasterizer

    return Rasterizer(Scene(()))
