"""Fixtures that several tests share: an OpenGL platform and a rasterizer on it.

A test that needs OpenGL gets it from here. Where there is none it is skipped with the reason; where
CI is set it fails. LUCIDA_PLATFORMS names the platforms (tools/attack/platforms.py: each of them);
otherwise tests run on the first that works.
"""

import functools
import gc
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from hypothesis import settings
from xdist.scheduler import LoadScopeScheduling

from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.raster import Rasterizer
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.trace import Tracer
from lucida.renderer.trace.precompile import precompile
from lucida.renderer.trace.tiles.variants import Variant
from tests.support.browser import chromium
from tests.support.bytecode import write_bytecode
from tests.support.launching import SERVED, address_of_server
from tests.support.needed import absent, x_server

# make test repeats itself; `make attack ARGS=properties` takes other examples each time.
settings.register_profile("lucida", deadline=None, derandomize=True, max_examples=40)
settings.register_profile("attack", deadline=None, max_examples=400, print_blob=True)
settings.load_profile("lucida")

# With all modules loaded a collection is slow, and Python's own threshold triggers many.
gc.set_threshold(20_000, 10, 10)


def pytest_sessionstart(session):
    """Compile the tracer into the cache: or the first test that traces would wait for it, and hear
    of it. Before several processes run all tests, all of it, and all modules and tests: or each
    would compile the same. Not where a few tests run on their own, for another processor."""
    if hasattr(session.config, "workerinput") or session.config.option.collectonly:
        return
    if "NUMBA_CPU_NAME" in os.environ:
        return
    is_whole = session.config.args_source is pytest.Config.ArgsSource.TESTPATHS
    if is_whole and session.config.getoption("numprocesses", None):
        of_variants = [f"{part}-{one}" for part in ("walk", "write") for one in Variant]
        with ThreadPoolExecutor() as threads:
            written = threads.submit(write_bytecode)
            precompile([*of_variants, "trees", "lens", "rays", "shade", "reference"], bool)
        written.result()
        if sys.platform.startswith("linux"):
            os.environ[SERVED] = address_of_server()
    scene = load_scene(BUILTIN_SCENES[0])
    for shadows in (False, True):
        with Tracer(scene, shadows=shadows) as tracer:
            tracer.render(scene.view.for_size((64, 36)), (64, 36))


def pytest_xdist_auto_num_workers():
    """Two more than there are processors: a window waits for its display and its clock, too."""
    ours = getattr(os, "sched_getaffinity", lambda _: range(os.cpu_count() or 1))
    return len(ours(0)) + 2


LONGEST = ("test_window", "test_desk", "test_scene_page")
PAGES = ("/app/web/", "/test_widget_page.py")
PARSED = ("/test_dead_code.py", "/test_layers.py")


SHARED = ("from hypothesis", " cast(")


@functools.cache
def text_of(path):
    return (Path(__file__).parents[1] / path).read_text("utf-8")


class Scheduling(LoadScopeScheduling):
    """One process gets a file or a class whole, all pages, so that they share a browser, both files
    that parse all modules, all tests with examples: Hypothesis reads all modules, too; and all that
    compile `cast`."""

    def _split_scope(self, nodeid):
        if any(part in nodeid for part in PAGES):
            return "pages"
        if any(part in nodeid for part in PARSED):
            return "parsed"
        text = text_of(nodeid.partition("::")[0])
        found = (part for part in SHARED if part in text)
        return next(found, None) or super()._split_scope(nodeid)


def pytest_xdist_make_scheduler(config, log):
    return Scheduling(config, log)


def pytest_collection_modifyitems(items):
    """Begin with what takes longest. (One process gets a file or a class whole: loadscope.)"""
    items.sort(key=lambda item: not item.path.stem.startswith(LONGEST))


@pytest.fixture(scope="session", params=os.environ.get("LUCIDA_PLATFORMS", "auto").split())
def _session_rasterizer(request):
    """One rasterizer a platform for the whole run: its shaders compile once."""
    try:
        rasterizer = Rasterizer(Scene(()), backend=request.param)
    except LucidaError as error:
        absent(str(error))
    with rasterizer:
        yield rasterizer


@pytest.fixture
def gl_backend(_session_rasterizer):
    """The name of a platform that works, for Rasterizer(backend=...)."""
    return _session_rasterizer.platform.split(":")[0]


@pytest.fixture
def rasterizer(_session_rasterizer):
    """A rasterizer of an empty scene: give it another by set_scene(). OpenGL reports no error."""
    _session_rasterizer.set_scene(Scene(()))
    yield _session_rasterizer
    with _session_rasterizer.current() as gl:
        assert gl.error == "GL_NO_ERROR"


@pytest.fixture
def gl(rasterizer):
    """The rasterizer's context, current."""
    with rasterizer.current() as context:
        yield context


@pytest.fixture(scope="session")
def browser():
    """Chromium, for all pages."""
    with chromium() as found:
        yield found


@pytest.fixture
def xvfb():
    """The name of a display that nobody looks at."""
    with x_server((1400, 900)) as display:
        yield display


@pytest.fixture(scope="session")
def desk():
    """A display with a window manager, for the whole run."""
    from desk import Desk

    with Desk() as display:
        yield display
