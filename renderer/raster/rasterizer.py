"""The rasterizer: object order on the GPU, through OpenGL 3.3.

    for each object: for each pixel that it covers: keep the nearest hit's primitive
    for each pixel: from its primitive to the exact hit, normal and colour

Owns the scene's data on the GPU and the targets that images are drawn into. Knows nothing of
windows, files or the tracer. The numbers come from setup.py, the rules from shaders/.
"""

from __future__ import annotations

import time
from collections.abc import Iterable
from contextlib import AbstractContextManager

import moderngl
import numpy as np

from renderer.camera import Camera
from renderer.frame import Frame, check_channels, check_size
from renderer.raster.contexts import open_platform
from renderer.raster.setup import (
    CAMERA_BLOCK,
    camera_block,
    image_space,
    object_rows,
    scene_setup,
    sphere_rows,
    triangle_rows,
)
from renderer.raster.sources import link
from renderer.raster.tables import Table, check
from renderer.raster.targets import Targets, Textures
from renderer.samples import Progress, check_samples, supersampled
from renderer.scene.flat import SPECULAR_CHECKERED, FlatScene, flatten
from renderer.scene.model import Scene

DEFAULT_CHANNELS = ("color", "depth", "normal", "id")
BOX_VERTICES = 36
# In window depth: where nothing is, and between that and what depth() in camera.glsl may give.
FARTHEST, BEFORE_FARTHEST = 1.0, 1 - 2**-21


class Rasterizer:
    """Draws one scene from any camera.

    backend: "egl", "osmesa" or "auto". context: draw in this one, a window's, instead; it must be
    current whenever a method is called. Without it, whatever was current before a method is so after it.
    Not for several threads at once. Raises LucidaError where there is no OpenGL 3.3, and where
    the scene does not fit.
    """

    def __init__(
        self, scene: Scene, backend: str = "auto", context: moderngl.Context | None = None
    ) -> None:
        flat = flatten(scene)
        self._platform = open_platform(backend, context)
        self._targets: Targets | None = None
        self._data: SceneData | None = None
        try:
            with self.current() as gl:
                self._programs = Programs(gl)
                self._data = SceneData(gl, self._programs, flat)
                info = gl.info
        except BaseException:
            self.release()
            raise
        name, version = info["GL_RENDERER"], info["GL_VERSION"]
        self.platform = f"{self._platform.name}: {name}, OpenGL {version}"

    def __enter__(self) -> Rasterizer:
        return self

    def __exit__(self, *_: object) -> None:
        self.release()

    def current(self) -> AbstractContextManager[moderngl.Context]:
        """Inside it the rasterizer's context is the current one: for reading its textures."""
        return self._platform.current()

    def set_scene(self, scene: Scene) -> None:
        """Draws another scene from now on; if that fails, the old one stays."""
        flat = flatten(scene)
        with self.current() as gl:
            data = SceneData(gl, self._programs, flat)
            old, self._data = self._data, data
            if old is not None:
                old.release()

    def draw(self, camera: Camera, size: tuple[int, int]) -> Textures:
        """The image on the GPU, without reading it back. size: (width, height).

        The textures are drawn over by the next draw() and replaced when the size changes. Leaves
        the framebuffer bound that was bound before, and depth test, culling and blending off.
        """
        size = check_size(size)
        with self.current() as gl:
            return self._draw(gl, camera, size).textures

    def render(
        self,
        camera: Camera,
        size: tuple[int, int],
        channels: Iterable[str] = DEFAULT_CHANNELS,
        samples: int = 1,
        progress: Progress | None = None,
    ) -> Frame:
        """The image as arrays; size: (width, height). samples: a square, of colour only.

        progress is called with fractions 0 to 1. Raises LucidaError.
        """
        size, channels, samples = check_size(size), check_channels(channels), check_samples(samples)
        frame = supersampled(self._frame, camera, size, channels, samples, progress)
        if progress is not None:
            progress(1.0)
        return frame

    def release(self) -> None:
        """Gives everything back; the rasterizer is of no use afterwards. Twice does no harm."""
        owned = [self._targets, self._data, getattr(self, "_programs", None)]
        self._targets = self._data = None
        if any(owned):
            with self.current():
                for part in filter(None, owned):
                    part.release()
        self._programs = None
        self._platform.release()

    def _frame(
        self,
        camera: Camera,
        size: tuple[int, int],
        channels: tuple[str, ...],
        progress: Progress | None,
    ) -> Frame:
        start = time.perf_counter()
        with self.current() as gl:
            targets = self._draw(gl, camera, size)
            arrays = {name: _read(targets, name) for name in channels}
            check(gl, f"an image of {size[0]}x{size[1]}")
        return Frame(size=size, time_s=time.perf_counter() - start, **arrays)

    def _draw(self, gl: moderngl.Context, camera: Camera, size: tuple[int, int]) -> Targets:
        targets, data = self._targets, self._data
        if targets is None or targets.size != size:
            if targets is not None:
                self._targets = None
                targets.release()
            self._targets = targets = Targets(gl, size)
        before = gl.detect_framebuffer()
        try:
            data.set_camera(camera, size)
            gl.wireframe = False
            gl.clear_samplers(0, 16)
            targets.seen.use()
            data.draw_primitives(left_handed=camera.determinant < 0)
            targets.shaded.use()
            data.shade(targets.textures.primitive)
        finally:
            gl.enable_only(moderngl.NOTHING)
            gl.front_face, gl.cull_face, gl.depth_func = "ccw", "back", "<="
            before.use()
        return targets


class Programs:
    """The compiled shaders."""

    def __init__(self, gl: moderngl.Context) -> None:
        self._gl = gl
        self._shade: dict[tuple[bool, ...], moderngl.Program] = {}
        self.clear = link(gl, "screen.vert", "clear.frag")
        self.triangles = link(gl, "triangles.vert", "triangles.frag")
        self.spheres = link(gl, "spheres.vert", "spheres.frag")
        self.background = link(gl, "screen.vert", "background.frag")

    def shade(self, flat: FlatScene) -> moderngl.Program:
        """The shading pass for what the scene has."""
        features = {
            "HAS_TRIANGLES": len(flat.faces) > 0,
            "HAS_SPHERES": len(flat.spheres) > 0,
            "HAS_NORMALS": bool(flat.normals.any()),
            "HAS_COLORS": bool((flat.colors != 1).any()),
            "HAS_CHECKERS": bool(flat.materials[:, SPECULAR_CHECKERED, 3].any()),
        }
        key = tuple(features.values())
        if key not in self._shade:
            self._shade[key] = link(self._gl, "screen.vert", "shade.frag", features)
        return self._shade[key]

    def release(self) -> None:
        first = (self.clear, self.triangles, self.spheres, self.background)
        for program in (*first, *self._shade.values()):
            program.release()


class SceneData:
    """A scene's arrays on the GPU, the tables of the last camera, and the draws that use them."""

    def __init__(self, gl: moderngl.Context, programs: Programs, flat: FlatScene) -> None:
        self._gl, self._programs, self._flat = gl, programs, flat
        self._setup = scene_setup(flat)
        self._camera: tuple | None = None
        self._owned: list = []
        try:
            self._build()
            check(gl, "the scene")
        except BaseException:
            self.release()
            raise

    def _build(self) -> None:
        gl, flat, programs = self._gl, self._flat, self._programs
        triangles, spheres, count = len(flat.faces), len(flat.spheres), len(flat.materials)
        corners = np.stack([flat.vertices, flat.normals, flat.colors], axis=1)
        faces = np.concatenate([flat.faces, flat.face_object[:, None]], axis=1)
        self._rows = self._table("triangles", np.zeros((triangles, 4), np.float32))
        self._spheres = self._table("spheres", np.zeros((spheres, 3, 4), np.float32))
        self._objects = self._table("objects", np.zeros((count, 8, 4), np.float32))
        self._tables = {
            "triangle_rows": self._rows,
            "spheres": self._spheres,
            "objects": self._objects,
            "faces": self._table("faces", faces),
            "vertices": self._table("vertices", corners),
            "lights": self._table("lights", flat.lights),
        }
        self._units = {name: unit for unit, name in enumerate((*self._tables, "primitives"))}
        self._block = self._own(gl.buffer(reserve=CAMERA_BLOCK.itemsize))
        self._clear = self._own(gl.vertex_array(programs.clear, []))
        self._background = self._own(gl.vertex_array(programs.background, []))
        self._shade = self._own(gl.vertex_array(programs.shade(flat), []))
        self._sphere_boxes = self._own(gl.vertex_array(programs.spheres, []))
        self._triangles = None
        if triangles:
            vertices = self._own(gl.buffer(flat.vertices))
            objects = self._own(gl.buffer(self._setup.vertex_object))
            indices = self._own(gl.buffer(flat.faces))
            content = [(vertices, "3f4", "vertex"), (objects, "1i4", "object")]
            self._triangles = self._own(
                gl.vertex_array(programs.triangles, content, indices, index_element_size=4)
            )

    def _table(self, name: str, array: np.ndarray) -> Table:
        return self._own(Table(self._gl, name, array))

    def _own(self, resource):  # type: ignore[no-untyped-def]
        self._owned.append(resource)
        return resource

    def release(self) -> None:
        for resource in reversed(self._owned):
            resource.release()
        self._owned.clear()

    def set_camera(self, camera: Camera, size: tuple[int, int]) -> None:
        """Fills the tables that depend on the camera, unless they are this camera's already."""
        if self._camera == (camera, size):
            return
        flat = self._flat
        space = image_space(camera, size, flat.bounds)
        self._block.write(camera_block(camera, size, space, flat))
        objects = object_rows(flat, self._setup, camera, space)
        self._objects.write(objects)
        if len(flat.faces):
            rows = self._rows.texels[: len(flat.faces), :3]
            triangle_rows(self._setup.planes, space, camera.is_parallel, rows)
            self._rows.write()
        if len(flat.spheres):
            self._spheres.write(sphere_rows(flat, space, objects))
        self._camera = camera, size

    def draw_primitives(self, left_handed: bool) -> None:
        """The nearest primitive of each pixel, into the bound framebuffer."""
        gl, programs = self._gl, self._programs
        self._bind()
        gl.enable_only(moderngl.DEPTH_TEST)
        self._screen(self._clear, "1", FARTHEST)
        gl.depth_func = "<"
        if self._triangles is not None:
            self._use(programs.triangles)
            self._triangles.render(moderngl.TRIANGLES)
        if len(self._flat.spheres):
            self._use(programs.spheres)
            gl.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
            # Far sides only. The image is flipped, and a left-handed basis flips it again.
            gl.front_face, gl.cull_face = "ccw" if left_handed else "cw", "front"
            count = len(self._flat.spheres)
            self._sphere_boxes.render(moderngl.TRIANGLES, vertices=BOX_VERTICES, instances=count)

    def shade(self, primitives: moderngl.Texture) -> None:
        """Hit and colour of each pixel, into the bound framebuffer, by its depth: where the first
        pass has left nothing, no hit is looked for."""
        self._gl.enable_only(moderngl.DEPTH_TEST)
        primitives.use(self._units["primitives"])
        self._screen(self._background, "==", FARTHEST)
        if len(self._flat.materials):
            self._screen(self._shade, ">", BEFORE_FARTHEST)

    def _screen(self, array: moderngl.VertexArray, depth_func: str, window_depth: float) -> None:
        self._gl.depth_func = depth_func
        self._use(array.program)
        array.program["window_depth"].value = window_depth
        array.render(moderngl.TRIANGLES, vertices=3)

    def _bind(self) -> None:
        self._block.bind_to_uniform_block(0)
        for name, table in self._tables.items():
            table.texture.use(self._units[name])

    def _use(self, program: moderngl.Program) -> None:
        """The program's samplers and counts (a program keeps those of the last scene)."""
        for name, unit in self._units.items():
            if name in program:
                program[name].value = unit
        if "triangle_count" in program:
            program["triangle_count"].value = len(self._flat.faces)
        if "Camera" in program:
            program["Camera"].binding = 0


def _read(targets: Targets, channel: str) -> np.ndarray:
    """A channel of the last image."""
    width, height = targets.size
    attachment = {"color": 0, "depth": 1, "normal": 1, "id": 2, "primitive": 0}[channel]
    source = targets.seen if channel == "primitive" else targets.shaded
    if channel in ("id", "primitive"):
        numbers = np.empty((height, width), np.int32)
        source.read_into(numbers, components=1, attachment=attachment, dtype="i4")
        return numbers
    values = np.empty((height, width, 4), np.float32)
    source.read_into(values, components=4, attachment=attachment, dtype="f4")
    return np.ascontiguousarray(values[..., 3] if channel == "depth" else values[..., :3])
