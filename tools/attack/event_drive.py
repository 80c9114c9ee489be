"""A drive of tests/support/window_driver.py: events that nobody would think of, in any order.

What random_events.py runs, in a process of its own; see there for what is looked at.
"""

from __future__ import annotations

import faulthandler
import gc
import os
import random
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
from imgui_bundle import hello_imgui, imgui
from option_changes import with_options
from window_driver import SIZE, Driver, Key

from lucida.app.images.pair.view import RASTER, RAY
from lucida.app.lecture.reading import BUILTIN, load_lecture
from lucida.app.state.bounds import check
from lucida.app.state.options import Options
from lucida.app.state.session import from_bytes, session_of, to_bytes
from lucida.app.ui import layout
from lucida.app.window.action_table import ACTIONS
from lucida.app.window.platform import set_size
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import save_view
from lucida.renderer.scene import View
from lucida.renderer.system.errors import LucidaError

SEED = int(os.environ["LUCIDA_ATTACK_SEED"])
MINUTES = float(os.environ["LUCIDA_ATTACK_MINUTES"])
HANG_S = 150.0  # longer than the first compiling takes
REST_EVERY = 150  # events
WARM_RESTS = 3  # after which memory counts
GROWTH_BYTES = 400 << 20

TEXTS = (
    "nan",
    "inf",
    "-1e999",
    "1e-300",
    "0",
    "-",
    "1,5",
    "é\u2603",
    "4096 x 4096",
    "\t\n",
    "16x9",
)
SCENES = ("spheres", "still-life", "canonical", "primitives", "columns")
FILES = {
    "broken.toml": "[[objects]\n",
    "empty.toml": "",
    "none.obj": "v 0 0\nf 1 2 3\n",
    "one.obj": "v 0 0 -3\nv 1 0 -3\nv 0 1 -3\nf 1 2 3\n",
    "far.toml": '[[objects]]\ntype = "sphere"\ncenter = [0, 0, -1e9]\nradius = 1e-3\n',
    "lecture.toml": 'title = "x"\n[[steps]]\ntitle = "a"\ntext = "$x$"\nscene = "spheres"\n'
    '[[steps]]\ntitle = "b"\nscene = "canonical"\noptions.stepper.canvas = [64, 48]\n',
    "picture.png": "no picture",
}
NAMED = "escape enter tab space backspace delete home end page_up page_down minus equal"
ARROWS = "left_arrow right_arrow up_arrow down_arrow left_bracket right_bracket"
KEYS = [
    *"abcdefghijklmnopqrstuvwxyz",
    *(f"_{digit}" for digit in range(10)),
    *(f"f{number}" for number in range(1, 13)),
    *NAMED.split(),
    *ARROWS.split(),
]
MODIFIERS = {"Ctrl": int(Key.mod_ctrl), "Shift": int(Key.mod_shift), "Alt": int(Key.mod_alt)}


class Attack:
    """Events, each by a method whose name begins with `do_`; what they do is told in a file."""

    def __init__(self, d: Driver) -> None:
        self.d, self.window = d, d.window
        self.rng = random.Random(SEED)
        self.log = (d.folder / "events.txt").open("w", buffering=1)
        self.files = [str(d.folder / name) for name in (*FILES, "missing.toml", "view.toml")]
        for name, text in FILES.items():
            (d.folder / name).write_text(text)
        save_view(d.folder / "view.toml", View(Camera(eye=(1, 2, 3))))
        kinds = [name for name in dir(self) if name.startswith("do_")]
        often = ("do_click", "do_drag", "do_key", "do_action", "do_option")
        self.kinds = [*kinds, *often, *often]
        self.failed: list[str] = []
        self.memory: list[int] = []

    def event(self) -> None:
        kind = self.rng.choice(self.kinds)
        faulthandler.dump_traceback_later(HANG_S, exit=True)
        getattr(self, kind)()
        self.d.ctx.yield_(self.rng.choice((1, 1, 1, 2, 5)))
        self._check()

    def tell(self, *what: object) -> None:
        print(*what, file=self.log)

    def point(self) -> tuple[float, float]:
        width, height = imgui.get_io().display_size
        return self.rng.uniform(0, width), self.rng.uniform(0, height)

    # Events.

    def do_click(self) -> None:
        at, button, twice = self.point(), self.rng.choice((0, 0, 0, 1, 2)), self.rng.random() < 0.2
        self.tell("click", at, button, twice)
        self.d.ctx.mouse_teleport_to_pos(at)
        self.d.ctx.yield_()
        (self.d.ctx.mouse_double_click if twice else self.d.ctx.mouse_click)(button)

    def do_drag(self) -> None:
        start, end, button = self.point(), self.point(), self.rng.choice((0, 0, 1, 2))
        key = self.rng.choice((0, 0, *MODIFIERS.values()))
        self.tell("drag", start, end, button, key)
        if key:
            self.d.ctx.key_down(key)
        self.d.drag(start, end, button)
        if key:
            self.d.ctx.key_up(key)

    def do_wheel(self) -> None:
        at, turn = self.point(), self.rng.choice((-20.0, -3.0, -1.0, 1.0, 3.0, 20.0))
        self.tell("wheel", at, turn)
        self.d.ctx.mouse_teleport_to_pos(at)
        self.d.ctx.yield_()
        self.d.ctx.mouse_wheel_y(turn)

    def do_key(self) -> None:
        held = [name for name in MODIFIERS if self.rng.random() < 0.2]
        name = self.rng.choice(KEYS)
        self.tell("key", *held, name)
        self.d.ctx.key_press(int(getattr(Key, name)) | sum(MODIFIERS[one] for one in held))

    def do_type(self) -> None:
        text = self.rng.choice(TEXTS)
        self.tell("type", repr(text))
        self.d.ctx.key_chars(text)
        if self.rng.random() < 0.7:
            self.d.ctx.key_press(int(Key.enter))

    def do_hold(self) -> None:
        key = self.rng.choice((Key.w, Key.s, Key.a, Key.d, Key.q, Key.e, Key.x))
        self.tell("hold", key.name)
        self.d.ctx.key_down(int(key))
        self.d.ctx.yield_(self.rng.randrange(1, 6))
        self.d.ctx.key_up(int(key))

    def do_action(self) -> None:
        action = self.rng.choice(ACTIONS)
        if action.can is None or action.can(self.window):
            self.tell("action", action.menu, action.name)
            action.run(self.window)

    def do_drop(self) -> None:
        paths = self.rng.sample(self.files, self.rng.randrange(1, 4))
        self.tell("drop", [Path(path).name for path in paths])
        self.d.drop(paths)

    def do_scene(self) -> None:
        name = self.rng.choice(SCENES)
        self.tell("scene", name)
        self.window.open(name)

    def do_layout(self) -> None:
        name = self.rng.choice([one.name for one in layout.LAYOUTS])
        self.tell("layout", name)
        layout.switch(name)

    def do_view(self) -> None:
        name, shown = self.rng.choice(list(self.window.views)), self.rng.random() < 0.7
        self.tell("view", name, shown)
        self.window.shell.stage.show(name, shown)

    def do_lecture(self) -> None:
        number = self.rng.randrange(-2, 40)
        self.tell("lecture", number)
        if not self.window.lecture.is_given:
            self.window.lecture.give(load_lecture(BUILTIN), BUILTIN)
        self.d.ctx.yield_(2)
        if self.window.lecture.is_given:
            self.window.lecture.go(self.window, number)

    def do_resize(self) -> None:
        usual = (SIZE, (640, 480), (1280, 720))
        size = self.rng.choice((*usual, *usual, (200, 900), (1600, 120), (16, 16), (1, 1)))
        self.tell("resize", size)
        self._resize(size)

    def do_option(self) -> None:
        changes = self.rng.choice(
            (
                {"images": {"exposure_ev": self.rng.uniform(-20, 20)}},
                {"images": {"samples": self.rng.randrange(0, 70)}},
                {"images": {"resolution": self.rng.choice((None, (1, 1), (7, 300), (640, 360)))}},
                {"images": {"magnification": self.rng.choice((None, 0.0, 1e9, 3.3))}},
                {"images": {"channel": self.rng.choice(("color", "depth", "normal", "id"))}},
                {"compare": {"gain": self.rng.choice((-1.0, 1e30, float("nan"), 8.0))}},
                {"compare": {"mode": self.rng.choice(("absolute", "wipe"))}},
                {"outside": {"bundle": (self.rng.randrange(-5, 30), self.rng.randrange(-5, 30))}},
                {"laboratory": {"progress": self.rng.choice((0.0, 2.5, float("inf")))}},
                {"stepper": {"canvas": (self.rng.randrange(0, 99), self.rng.randrange(0, 99))}},
                {"stepper": {"steps": (self.rng.randrange(-5, 10**7), 0)}},
                {"costs": {"against": self.rng.choice(("triangles", "pixels"))}},
                {"preferences": {"font_scale": self.rng.choice((0.1, 0.75, 1.0, 2.0, 9.0))}},
                {"marked": (self.rng.randrange(-9, 999), self.rng.randrange(-9, 999))},
                {"shadows": True, "mirrors": True},
            )
        )
        self.tell("option", changes)
        self.window.change(with_options(self.window.state, **changes))

    def do_camera(self) -> None:
        """A legal one, however strange."""
        vector = [self.rng.choice((0.0, 1.0, -1.0, self.rng.gauss(0, 5))) for _ in range(12)]
        size = 10.0 ** self.rng.uniform(-6, 6)
        near = self.rng.choice((None, None, 10.0 ** self.rng.uniform(-6, 3)))
        try:
            camera = Camera(
                tuple(x * self.rng.choice((1.0, 1.0, size)) for x in vector[:3]),  # type: ignore[arg-type]
                *(tuple(vector[k : k + 3]) for k in (3, 6, 9)),  # type: ignore[arg-type]
                distance=10.0 ** self.rng.uniform(-3, 3),
                projection=self.rng.choice(("perspective", "parallel")),
                near=near,
            )
        except LucidaError:
            return
        self.tell("camera", camera)
        view = View(camera, self.rng.random() < 0.5)
        travel = self.rng.random() < 0.5
        (self.window.travel if travel else self.window.change)(self.window.state.with_view(view))

    def do_session(self) -> None:
        """Restore the session that would be restored if the window were closed now."""
        self.tell("session")
        arrangement = self.window.shell.stage.arrangement()
        session = from_bytes(to_bytes(session_of(self.window.state, arrangement)))
        self.window.change(session.state(self.window.state.scene))
        self.window.shell.stage.restore(session.arrangement)

    def _resize(self, size: tuple[int, int]) -> None:
        """In the window's own thread."""
        callbacks = self.d.run.params.callbacks

        def once() -> None:
            callbacks.post_new_frame = lambda: None
            set_size(size)

        callbacks.post_new_frame = once
        self.d.ctx.yield_(3)

    # What is looked at.

    def _check(self) -> None:
        state, stage = self.window.state, self.window.shell.stage
        check(Options, state.options)
        kept = from_bytes(to_bytes(session_of(state, stage.arrangement())))
        assert (kept.view, kept.options) == (state.view, state.options), "no session can hold this"
        assert not stage.failed.errors, stage.failed.errors
        failure = self.window.renderers.failure
        assert failure is None or isinstance(failure, LucidaError), repr(failure)
        assert not self.failed, self.failed
        assert not self.d.run.params.app_shall_exit, "the window closes by itself"

    def plant(self) -> None:
        """Plant a fault that must be noticed: a view that fails."""
        view = self.window.views[RASTER]
        view.draw = lambda _: [][0]  # type: ignore[method-assign]
        self.d.until(lambda: bool(self.window.shell.stage.failed.errors))
        try:
            self._check()
        except AssertionError:
            del view.draw
            self.window.shell.stage.failed.errors.clear()
            self.d.until(lambda: not self.window.shell.stage.failed.errors)
            return
        raise AssertionError("a view that fails is not noticed: the attack sees nothing")

    def rest(self) -> None:
        """Back to the beginning: both images are there, agree, and memory has not grown."""
        self.tell("rest")
        faulthandler.dump_traceback_later(2 * HANG_S, exit=True)
        self._leave()
        if tuple(imgui.get_io().display_size) != SIZE:
            self._resize(SIZE)
            self.d.until(lambda: tuple(imgui.get_io().display_size) == SIZE)
        layout.switch(layout.LAYOUTS[0].name)
        self.d.until(lambda: layout.current() is layout.LAYOUTS[0])
        layout.reset()  # images that were dragged behind others come to the front
        self.d.ctx.yield_(5)
        for name in self.window.views:
            self.window.shell.stage.show(name, name in (RASTER, RAY))
        self.d.ctx.yield_(5)
        try:
            self.d.reset()
        except AssertionError as error:
            raise AssertionError(self._unsettled()) from error
        raster, ray = self.d.agreeing_images()
        assert np.isfinite(raster).all() and np.isfinite(ray).all()
        gc.collect()
        self.memory.append(_memory())
        self.tell("memory", self.memory[-1] >> 20, "MiB")
        grown = self.memory[-1] - min(self.memory[:WARM_RESTS])
        if len(self.memory) > WARM_RESTS:
            assert grown < GROWTH_BYTES, f"memory has grown by {grown >> 20} MiB"

    def _unsettled(self) -> str:
        """Return what keeps the window from coming to rest."""
        stage, window = self.window.shell.stage, self.window
        views = [name for name in stage.rects if not stage.views[name].settled]
        return (
            f"no rest: views {views}, failures {stage.failed.errors}, shown {list(stage.rects)}, "
            f"files {window.files.busy}, travelling {window.motions.transition.under_way}, images "
            f"{window.renderers.settled(window.state)}, failure {window.renderers.failure}"
        )

    def _leave(self) -> None:
        """Whatever covers the images: boxes and menus."""
        for button in range(3):
            self.d.ctx.mouse_up(button)
        for _ in range(5):
            self.d.ctx.key_press(int(Key.escape))
            self.d.ctx.yield_()
        self.window.change(self.d.start)
        self.window.shell.stage.failed.errors.clear()
        self.window.renderers.retry()
        self.d.until(lambda: not self.window.files.busy)
        self.d.ctx.yield_(3)


def _memory() -> int:
    """Bytes that the process has in memory; 0 where the system does not say."""
    try:
        pages = int(Path("/proc/self/statm").read_text().split()[1])
    except OSError:
        return 0
    return pages * os.sysconf("SC_PAGE_SIZE")


def _stay_open(d: Driver, attack: Attack) -> None:
    """Ignore what would end the attack or leave the window: closing, full screen, the system's
    dialogs.
    """
    d.window.quit = lambda: attack.tell("  (quit)")  # type: ignore[method-assign]
    d.window.shell.toggle_full_screen = lambda: attack.tell("  (full screen)")  # type: ignore[method-assign]

    def fell(args: Any) -> None:
        attack.failed.append(f"{args.thread}: {args.exc_type.__name__}: {args.exc_value}")

    threading.excepthook = fell


def drive_random_events(d: Driver) -> None:
    io = imgui.test_engine.get_io(hello_imgui.get_imgui_test_engine())
    io.config_watchdog_warning = io.config_watchdog_kill_test = 60 * MINUTES + 2 * HANG_S
    attack = Attack(d)
    _stay_open(d, attack)
    end_s = time.monotonic() + 60 * MINUTES
    attack.rest()
    attack.plant()
    count = 0
    while time.monotonic() < end_s:
        attack.event()
        count += 1
        if count % REST_EVERY == 0:
            attack.rest()
    attack.rest()
    faulthandler.cancel_dump_traceback_later()
