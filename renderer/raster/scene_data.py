"""A scene on the GPU: its tables, and the draw calls of both passes.

Manages the scene's buffers and textures, including those for the last camera. The numbers come from
setup.py; shaders/ uses them.
"""

from __future__ import annotations

from collections.abc import Sequence

import moderngl
import numpy as np

from renderer.camera import Camera, Floats
from renderer.raster.prepared import Prepared
from renderer.raster.programs import Programs, set_uniform
from renderer.raster.resources import Owner, check
from renderer.raster.setup import (
    CAMERA_BLOCK,
    camera_block,
    image_space,
    light_rows,
    object_rows,
    plane_bases,
    sphere_rows,
    triangle_rows,
)
from renderer.raster.tables import TABLE_WIDTH, Table
from renderer.shared_numbers import OBJECT_TEXELS, SPHERE_TEXELS

BOX_VERTICES = 36
MARGIN = 1024  # pixels around the image, or half its size; Mesa 22.3 loses triangles with 4096
# Window depths: of the background, and one between it and the farthest of depth() in camera.glsl.
FARTHEST, BEFORE_FARTHEST = 1.0, 1 - 2**-21


class SceneData:
    """One scene in one context, which must be current. Raises LucidaError if it does not fit."""

    def __init__(self, context: moderngl.Context, programs: Programs, scene: Prepared) -> None:
        self._context = context
        self._flat, self._setup = scene
        self._last: tuple[Camera, tuple[int, int]] | None = None
        self._bases: Floats | None = None  # of that camera, see plane_bases()
        # The camera of the triangles in the table, the number of its valid rows, and stale ranges.
        self._camera: tuple[Camera, tuple[int, int]] | None = None
        self._rows = 0
        self._moved: list[tuple[int, int]] = []
        self._owner = Owner()
        try:
            self._build_tables()
            self._build_arrays(programs)
            check(context, "the scene")
        except BaseException:
            self.release()
            raise

    def follows(self, programs: Programs, scene: Prepared, same: Sequence[int]) -> bool:
        """Change to another scene if it has the same arrays, and only transforms, materials and
        lights differ.

        same: the result of same_places(). Uploads the changes. Returns False, without a change, if
        the scenes differ more.
        """
        flat, old = scene.flat, self._flat
        layout = "vertices", "colors", "faces", "object_sphere", "uv", "textures", "texels"
        if any(getattr(flat, name) is not getattr(old, name) for name in layout):
            return False
        if len(flat.lights) != len(old.lights):
            return False
        moved = [number for number, was in enumerate(same) if was != number]
        moved += np.flatnonzero(flat.single_sided != old.single_sided).tolist()
        moved = [number for number in set(moved) if flat.object_faces[number, 1]]
        if flat.normals is not old.normals:
            vertices = self._tables["vertices"]
            texels = vertices.texels[: vertices.count].reshape(len(flat.vertices), 3, -1)
            for number in moved:
                first, count = flat.object_vertices[number]
                texels[first : first + count, 1] = flat.normals[first : first + count]
                low, high = 3 * first // TABLE_WIDTH, -(-3 * (first + count) // TABLE_WIDTH)
                vertices.write_rows(low, high)
        for number in moved:
            first, count = map(int, flat.object_faces[number])
            self._moved.append((first, first + count))
        self._flat, self._setup = scene
        self._camera, self._last = self._last or self._camera, None
        self._choose_programs(programs)
        return True

    def _build_tables(self) -> None:
        flat = self._flat
        triangles, spheres, objects = len(flat.faces), len(flat.spheres), len(flat.materials)
        changing = {
            "triangle_rows": np.zeros((triangles, 4), np.float32),
            "spheres": np.zeros((spheres, SPHERE_TEXELS, 4), np.float32),
            "objects": np.zeros((objects, OBJECT_TEXELS, 4), np.float32),
            "lights": np.zeros(flat.lights.shape, np.float32),
        }
        fixed = {
            "faces": np.concatenate([flat.faces, flat.face_object[:, None]], axis=1),
            "vertices": np.stack([flat.vertices, flat.normals, flat.colors], axis=1),
        }
        if len(flat.texels):
            fixed |= {
                "texels": flat.texels[:, None],
                "textures": flat.textures,
                "uv": flat.uv,
            }
        self._tables = {
            name: self._owner.own(Table(self._context, name, array))
            for name, array in (changing | fixed).items()
        }
        names = (*self._tables, "primitives")
        self._units = {name: unit for unit, name in enumerate(names)}

    def _build_arrays(self, programs: Programs) -> None:
        context, flat, own = self._context, self._flat, self._owner.own
        self._block = own(context.buffer(reserve=CAMERA_BLOCK.itemsize))
        self._clear = own(context.vertex_array(programs.clear, []))
        self._background = own(context.vertex_array(programs.background, []))
        self._spheres = own(context.vertex_array(programs.spheres, []))
        self._content: list[tuple[moderngl.Buffer, str, str]] = []
        if len(flat.faces):
            vertices = own(context.buffer(flat.vertices))
            objects = own(context.buffer(self._setup.vertex_object))
            self._content = [(vertices, "3f4", "vertex"), (objects, "1i4", "object")]
            self._indices = own(context.buffer(flat.faces))
        self._shade: moderngl.VertexArray | None = None
        self._triangles: moderngl.VertexArray | None = None
        self._arrays: dict[moderngl.Program, moderngl.VertexArray] = {}
        self._choose_programs(programs)

    def _choose_programs(self, programs: Programs) -> None:
        """Choose the programs for the scene's features, which may change when an object is
        rotated.
        """
        context, flat, own = self._context, self._flat, self._owner.own
        if len(flat.materials):
            program = programs.shade(flat)
            if program not in self._arrays:
                self._arrays[program] = own(context.vertex_array(program, []))
            self._shade = self._arrays[program]
        if len(flat.faces):
            program = programs.triangles(flat)
            if program not in self._arrays:
                self._arrays[program] = own(
                    context.vertex_array(
                        program, self._content, self._indices, index_element_size=4
                    )
                )
            self._triangles = self._arrays[program]

    def release(self) -> None:
        self._owner.release()

    @property
    def triangles(self) -> int:
        return len(self._flat.faces)

    def margin(self, size: tuple[int, int]) -> tuple[int, int]:
        """Return the number of pixels by which the viewport extends beyond the image on each side.

        GL clips in float32, and the edges made by clipping must be outside the image. Their error
        is about 2^-24 of a triangle's size: the margin exceeds it even for a vast plain in a narrow
        view.
        """
        largest = self._context.info["GL_MAX_VIEWPORT_DIMS"]
        width, height = (
            max(0, min(max(side // 2 + 1, MARGIN), (most - side) // 2))
            for side, most in zip(size, largest, strict=True)
        )
        return width, height

    def set_camera(self, camera: Camera, size: tuple[int, int]) -> None:
        """Fill the tables that depend on the camera, unless they are already this camera's.

        The triangles' table is only filled as far as it is drawn: a million triangles take as long
        as a frame.
        """
        if self._last == (camera, size):
            return
        self._last, before = None, self._camera
        flat, tables = self._flat, self._tables
        space = image_space(camera, size, flat)
        objects = object_rows(flat, self._setup, space)
        self._block.write(camera_block(camera, size, self.margin(size), space, flat))
        tables["objects"].write(objects)
        tables["lights"].write(light_rows(flat, space))
        if len(flat.spheres):
            tables["spheres"].write(sphere_rows(flat, space, objects))
        self._last, self._bases = (camera, size), plane_bases(flat, self._setup, space)
        filled, self._rows = self._rows if before == self._last else 0, 0
        for first, last in self._moved if filled else ():
            low, high = first // TABLE_WIDTH, min(-(-last // TABLE_WIDTH), filled)
            self._write_triangles(low, high)
        self._camera, self._rows, self._moved = self._last, filled, []

    def see(self, first: int = 0, count: int | None = None) -> bool:
        """Run the first pass: draw the nearest primitive of each pixel into the bound framebuffer.

        first, count: a part of the triangles; the parts must come in order. count None: to the last
        one. Returns True after the last part.
        """
        context, camera = self._context, self._last
        assert camera is not None, "set_camera() comes first"
        (width, height), (x, y) = camera[1], self.margin(camera[1])
        context.viewport = -x, -y, width + 2 * x, height + 2 * y
        context.enable_only(moderngl.DEPTH_TEST)
        if first == 0:
            self._cover(self._clear, "1", FARTHEST)
        context.depth_func = "<"
        total = len(self._flat.faces)
        last = total if count is None else min(first + count, total)
        self._fill_triangles(last)
        if self._triangles is not None and first < last:
            self._prepare(self._triangles.program)
            set_uniform(self._triangles.program, "first_triangle", first)
            self._triangles.render(moderngl.TRIANGLES, vertices=3 * (last - first), first=3 * first)
        if last < total:
            return False
        if len(self._flat.spheres):
            self._prepare(self._spheres.program)
            context.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
            # Draw far sides only. The image is flipped, and a left-handed basis flips it again.
            context.front_face = "cw" if camera[0].determinant > 0 else "ccw"
            context.cull_face = "front"
            spheres = len(self._flat.spheres)
            self._spheres.render(moderngl.TRIANGLES, vertices=BOX_VERTICES, instances=spheres)
        return True

    def shade(self, primitives: moderngl.Texture) -> None:
        """Run the second pass: draw the hit and colour of each pixel into the bound framebuffer.

        Its depth selects the pixels: where the first pass has drawn nothing, no hit is computed.
        """
        self._fill_triangles(len(self._flat.faces))  # another camera may have been set since
        self._context.enable_only(moderngl.DEPTH_TEST)
        primitives.use(self._units["primitives"])
        self._cover(self._background, "==", FARTHEST)
        if self._shade is not None:
            self._cover(self._shade, ">", BEFORE_FARTHEST)

    def bind(self) -> None:
        """Bind the inputs of both passes. Call this before either."""
        self._block.bind_to_uniform_block(0)
        for name, table in self._tables.items():
            table.texture.use(self._units[name])

    def _fill_triangles(self, last: int) -> None:
        """Fill the table of triangles for this camera, up to a number."""
        wanted = -(-last // TABLE_WIDTH)
        if wanted <= self._rows:
            return
        self._write_triangles(self._rows, wanted)
        self._rows = wanted

    def _write_triangles(self, low: int, high: int) -> None:
        """Write the rows of that table from low up to high."""
        if low >= high:
            return
        assert self._last is not None
        assert self._bases is not None
        table, first = self._tables["triangle_rows"], low * TABLE_WIDTH
        rows = table.texels[first : min(high * TABLE_WIDTH, len(self._flat.faces)), :3]
        is_parallel = self._last[0].is_parallel
        triangle_rows(self._flat, self._setup, self._bases, is_parallel, rows, first)
        table.write_rows(low, high)

    def _cover(self, array: moderngl.VertexArray, depth_func: str, window_depth: float) -> None:
        self._context.depth_func = depth_func
        self._prepare(array.program)
        set_uniform(array.program, "window_depth", window_depth)
        array.render(moderngl.TRIANGLES, vertices=3)

    def _prepare(self, program: moderngl.Program) -> None:
        """Set a program's uniforms. Programs are shared: one may still have those of another
        scene.
        """
        for name, unit in self._units.items():
            set_uniform(program, name, unit)
        set_uniform(program, "triangle_count", len(self._flat.faces))
        set_uniform(program, "Camera", 0)
