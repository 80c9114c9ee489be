"""OpenGL platforms: the choice, several contexts in turn, a window's context, and giving back."""

import moderngl
import numpy as np
import pytest
from launching import launch
from needed import absent

from lucida.renderer.camera.camera import Camera
from lucida.renderer.raster import Display, Look, Rasterizer, Section, contexts, current
from lucida.renderer.raster.packages import SYSTEMS, remedy, this_system
from lucida.renderer.raster.resources import check
from lucida.renderer.raster.tables import Table
from lucida.renderer.scene.model import Scene, SceneObject, Sphere
from lucida.renderer.system.errors import LucidaError

on_each_platform = pytest.mark.parametrize("_session_rasterizer", ["egl", "osmesa"], indirect=True)


def painted(number):
    return Scene((), background=(number, 0, 0))


def color_of(rasterizer):
    return rasterizer.render(Camera(), (2, 2), ("color",)).color[0, 0, 0]


@pytest.fixture
def foreign():
    """Somebody else's EGL context, current in this thread, as a window's would be."""
    try:
        context = moderngl.create_context(standalone=True, backend="egl")
    except Exception as error:
        absent(f"no EGL: {error}")
    yield context
    with context:
        assert context.error == "GL_NO_ERROR"
    context.release()


@on_each_platform
def test_what_was_current_before_is_so_afterwards(foreign, gl_backend):
    texture = foreign.texture((2, 2), 4, bytes(range(16)))
    with Rasterizer(painted(1), backend=gl_backend) as rasterizer:
        assert texture.read() == bytes(range(16))
        assert color_of(rasterizer) == 1
        rasterizer.draw(Camera(), (3, 3))
        assert foreign.texture((2, 2), 4, bytes(16)).read() == bytes(16)
    assert texture.read() == bytes(range(16))


def test_a_windows_context_is_drawn_in_and_left_as_it_was(foreign):
    picture = foreign.framebuffer([foreign.texture((4, 4), 4)])
    picture.use()
    # What an immediate-mode GUI may leave behind.
    foreign.enable_only(moderngl.BLEND | moderngl.CULL_FACE)
    foreign.depth_func, foreign.cull_face, foreign.wireframe = ">", "front_and_back", True
    sampler = foreign.sampler(texture=None, filter=(moderngl.LINEAR, moderngl.LINEAR))
    for unit in range(8):
        sampler.use(unit)
    scene = Scene((SceneObject(Sphere((0, 0, -3), 2.0)),))
    with Rasterizer(scene, context=foreign) as rasterizer:
        assert rasterizer.platform.startswith("window: ")
        assert rasterizer.render(Camera(), (5, 5)).id.tolist() == [[0] * 5] * 5
        textures = rasterizer.draw(Camera(), (5, 5))
        assert foreign.detect_framebuffer().glo == picture.glo
        display = Display(foreign)
        display.show(textures.color, Look(), Section(), picture)
        assert foreign.detect_framebuffer().glo == picture.glo
        display.release()
    picture.clear(1.0, 0.0, 0.0, 1.0)
    assert picture.read(components=4)[:4] == b"\xff\x00\x00\xff"  # the context is still alive


WITH_A_WINDOW = """
import glfw, moderngl
from tests.renderer.raster.test_raster_platforms import color_of, painted
from lucida.renderer.raster import Rasterizer

class Loader:
    load_opengl_function = staticmethod(lambda name: glfw.get_proc_address(name) or 0)
    __enter__ = __exit__ = release = lambda self, *_: None

assert glfw.init()
glfw.window_hint(glfw.VISIBLE, False)
glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, 3)
glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, 3)
glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
glfw.make_context_current(glfw.create_window(8, 8, "", None, None))
window = Rasterizer(painted(1), context=moderngl.create_context(context=Loader()))
for number, backend in enumerate(("egl", "osmesa", "egl"), start=2):
    with Rasterizer(painted(number), backend=backend) as other:
        assert color_of(window) == 1
        assert color_of(other) == number
        assert color_of(window) == 1
print("done")
"""


@pytest.mark.parametrize("_session_rasterizer", ["osmesa"], indirect=True)
def test_beside_a_windows_context_on_x11(gl_backend, xvfb, tmp_path):
    """GLX, EGL and OSMesa in one thread."""
    done = launch(["-c", WITH_A_WINDOW], tmp_path, xvfb)
    assert done.stdout == "done\n", done.stderr


@pytest.mark.parametrize("_session_rasterizer", ["osmesa"], indirect=True)
def test_auto_takes_the_first_that_works(monkeypatch, gl_backend):
    def broken(name):
        raise RuntimeError(f"no {name} today")

    monkeypatch.setattr(contexts, "Standalone", broken)
    with Rasterizer(painted(1)) as rasterizer:
        assert rasterizer.platform.startswith("osmesa: ")


def test_no_platform_at_all_is_one_line_that_names_each(monkeypatch):
    def broken(*_):
        raise RuntimeError("no\ndriver")

    monkeypatch.setattr(contexts, "Standalone", broken)
    monkeypatch.setattr(contexts, "OSMesa", broken)
    with pytest.raises(LucidaError) as caught:
        Rasterizer(painted(1))
    text = str(caught.value)
    assert "\n" not in text
    for name in contexts.candidates():
        assert f"{name}: no driver" in text
        assert remedy(name) in text


def test_a_missing_osmesa_says_so(monkeypatch):
    monkeypatch.setattr(current, "OSMESA_NAMES", ("libOSMesaThatIsNot.so",))
    monkeypatch.setattr("ctypes.util.find_library", lambda name: None)
    current.load_osmesa.cache_clear()
    with pytest.raises(LucidaError, match="libOSMesa is not installed") as caught:
        Rasterizer(painted(1), backend="osmesa")
    assert remedy("osmesa") in str(caught.value)


def test_an_unknown_backend_is_refused():
    with pytest.raises(LucidaError, match="backend: 'vulkan' is unknown; give auto, egl, osmesa"):
        Rasterizer(painted(1), backend="vulkan")


def test_release_twice_and_use_afterwards(gl_backend):
    rasterizer = Rasterizer(painted(1), backend=gl_backend)
    rasterizer.release()
    rasterizer.release()
    with pytest.raises(RuntimeError, match="released"):
        rasterizer.render(Camera(), (1, 1))


@on_each_platform
def test_contexts_come_and_go(gl_backend):
    """More than drivers keep at once, if they were not given back."""
    for number in range(20):
        with Rasterizer(painted(number), backend=gl_backend) as rasterizer:
            assert color_of(rasterizer) == number


def test_a_table_that_does_not_fit_is_one_line():
    class Small:
        info = {"GL_MAX_TEXTURE_SIZE": 4096}

    longest = np.broadcast_to(np.float32(0), (4096 * 4096 + 1, 1))
    with pytest.raises(LucidaError, match="16777217 texels of faces do not fit"):
        Table(Small(), "faces", longest)


def test_openglss_errors_become_one_line(rasterizer):
    with rasterizer.current() as gl:
        check(gl, "nothing")
        gl.depth_renderbuffer((gl.info["GL_MAX_RENDERBUFFER_SIZE"] + 1, 1))
        with pytest.raises(LucidaError, match="OpenGL: GL_INVALID_VALUE at a test"):
            check(gl, "a test")


def test_a_size_beyond_the_drivers_is_refused_and_the_next_is_drawn(rasterizer, monkeypatch):
    with rasterizer.current() as gl:
        monkeypatch.setitem(gl.info, "GL_MAX_TEXTURE_SIZE", 64)
        with pytest.raises(LucidaError, match="65x3 is too large for the graphics driver"):
            rasterizer.render(Camera(), (65, 3))
        assert rasterizer.render(Camera(), (64, 3)).size == (64, 3)


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("part", ["egl", "osmesa", "default", "display", "tracer", "formulas"])
def test_a_remedy_is_a_line_with_no_other_system_s_packages(part, system):
    text, tools = remedy(part, system), {"debian": "apt-get", "fedora": "dnf", "arch": "pacman"}
    named = {name for name, tool in tools.items() if tool in text}
    assert named == ({system} & tools.keys() if part in ("egl", "display") else named & {system})
    assert len(text) > 10
    assert text.isprintable()


@pytest.mark.parametrize(
    ("release", "system"),
    [
        ({"ID": "debian"}, "debian"),
        ({"ID": "linuxmint", "ID_LIKE": "ubuntu debian"}, "debian"),
        ({"ID": "ubuntu", "ID_LIKE": "debian"}, "debian"),
        ({"ID": "rocky", "ID_LIKE": "rhel centos fedora"}, "fedora"),
        ({"ID": "manjaro", "ID_LIKE": "arch"}, "arch"),
        ({"ID": "void"}, "other"),
    ],
)
def test_derived_systems_count_as_their_parents(monkeypatch, release, system):
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.setattr("platform.freedesktop_os_release", lambda: release)
    assert this_system() == system


@pytest.mark.parametrize(("name", "system"), [("darwin", "macos"), ("win32", "windows")])
def test_systems_without_egl_have_other_candidates(monkeypatch, name, system):
    monkeypatch.setattr("sys.platform", name)
    assert this_system() == system
    assert contexts.candidates() == ("default", "osmesa")


@pytest.mark.parametrize(
    ("system", "found", "asked"),
    [
        ("linux", "libOSMesa.so.8", "libOSMesa.so.8"),
        ("darwin", "libOSMesa.dylib", None),  # beside the user
        ("darwin", "/usr/local/lib/libOSMesa.dylib", "/usr/local/lib/libOSMesa.dylib"),
        ("win32", "OSMesa.dll", None),
        ("linux", None, None),
    ],
)
def test_no_library_is_taken_from_the_current_folder(monkeypatch, system, found, asked):
    monkeypatch.setattr("ctypes.util.find_library", lambda name: found)
    monkeypatch.setattr(current.sys, "platform", system)
    assert current.found_library("OSMesa") == asked
    assert all("/" in name for name in current.OSMESA_NAMES if name.endswith("dylib"))
