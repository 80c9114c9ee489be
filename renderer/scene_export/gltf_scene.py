"""A scene as a binary glTF file, .glb: meshes, materials, lights (KHR_lights_punctual), the camera.

Source: Khronos, glTF 2.0 Specification; KHR_lights_punctual; KHR_materials_specular.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from renderer.camera_formats.gltf import camera_table, node_matrix
from renderer.camera_formats.rigid import rigid
from renderer.scene.flat import flatten
from renderer.scene.model import Color, DirectionalLight, Material, Mesh, PointLight, Sphere
from renderer.scene_export.materials import (
    light_strengths,
    mean_of_checker,
    microfacets,
    note_highlights,
    reflectance,
)
from renderer.scene_export.meshes import Triangles, triangles, unit_sphere
from renderer.scene_export.what import Exported, ExportSubject, LeftOut, called

DIELECTRIC = 0.04  # what a glTF material without metal reflects head on
SKEWED = 1e-6  # a cosine from which on a transform is no rotation and scale
SPHERE_RINGS = 64
LIGHTS, SPECULAR = "KHR_lights_punctual", "KHR_materials_specular"


def write(subject: ExportSubject) -> Exported:
    """Raises LucidaError for a camera that glTF cannot hold."""
    scene, left = subject.scene, LeftOut()
    camera = rigid(subject.camera, "gltf")
    made = _Tree()
    nodes = [_object_node(made, number, entry, left) for number, entry in enumerate(scene.objects)]
    strengths = light_strengths(scene, flatten(scene), left)
    lights = [_light(color) for color in strengths]
    for number, light in enumerate(scene.lights):
        lights[number]["type"] = "point" if isinstance(light, PointLight) else "directional"
        nodes.append(_light_node(number, light))
    nodes.append({"name": "camera", "camera": 0, "matrix": node_matrix(camera)})
    if any(scene.ambient):
        left.add("ambient", "glTF has none")
    left.add("background", "glTF has none")
    note_highlights(scene, left)
    extensions = [name for name, there in ((LIGHTS, lights), (SPECULAR, made.is_specular)) if there]
    tree: dict[str, Any] = {
        "asset": {
            "version": "2.0",
            "generator": "Lucida",
            "extras": {"not_carried_over": list(left.lines)},
        },
        "scene": 0,
        "scenes": [{"name": scene.name, "nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "cameras": [camera_table(camera)],
        **made.tables(),
    }
    if extensions:
        tree["extensionsUsed"] = extensions
    if lights:
        tree["extensions"] = {LIGHTS: {"lights": lights}}
    return Exported(_glb(tree, made.chunk()), left_out=left.lines)


class _Tree:
    """The parts of the tree that nodes share, and the binary chunk."""

    def __init__(self) -> None:
        self._chunk: list[bytes] = []
        self._bytes = 0
        self._views: list[dict[str, int]] = []
        self._accessors: list[dict[str, Any]] = []
        self._meshes: list[dict[str, Any]] = []
        self._materials: list[dict[str, Any]] = []
        self._known: dict[Any, Any] = {}
        self.is_specular = False

    def primitive(self, key: tuple[object, ...], found: Triangles) -> dict[str, Any]:
        """Attributes and indices of triangles. key: of these arrays."""
        if key not in self._known:
            attributes = {"POSITION": self._vectors(found.vertices, bounds=True)}
            if found.normals is not None:
                attributes["NORMAL"] = self._vectors(found.normals)
            if found.colors is not None:
                attributes["COLOR_0"] = self._vectors(found.colors)
            indices = self._accessor(found.faces.astype("<u4").reshape(-1), "SCALAR", 5125, 34963)
            self._known[key] = {"attributes": attributes, "indices": indices}
        primitive: dict[str, Any] = dict(self._known[key])
        return primitive

    def mesh(self, primitive: dict[str, Any], material: int, name: str) -> int:
        primitive["material"] = material
        self._meshes.append({"primitives": [primitive]} | ({"name": name} if name else {}))
        return len(self._meshes) - 1

    def material(self, table: dict[str, Any]) -> int:
        key = json.dumps(table)
        if key not in self._known:
            self._known[key] = len(self._materials)
            self._materials.append(table)
            self.is_specular |= "extensions" in table
        number: int = self._known[key]
        return number

    def tables(self) -> dict[str, Any]:
        """What is not empty: glTF allows no empty lists."""
        lists = {
            "meshes": self._meshes,
            "materials": self._materials,
            "accessors": self._accessors,
            "bufferViews": self._views,
            "buffers": [{"byteLength": self._bytes}] if self._bytes else [],
        }
        return {name: entries for name, entries in lists.items() if entries}

    def chunk(self) -> bytes:
        return b"".join(self._chunk)

    def _vectors(self, values: NDArray[np.float32], bounds: bool = False) -> int:
        number = self._accessor(values.astype("<f4"), "VEC3", 5126, 34962)
        if bounds:
            limits = {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
            self._accessors[number] |= limits
        return number

    def _accessor(self, values: NDArray[Any], type: str, component: int, target: int) -> int:
        data = values.tobytes()  # of four bytes each: what follows stays aligned
        view = {"buffer": 0, "byteOffset": self._bytes, "byteLength": len(data), "target": target}
        self._views.append(view)
        self._chunk.append(data)
        self._bytes += len(data)
        self._accessors.append(
            {
                "bufferView": len(self._views) - 1,
                "componentType": component,
                "count": len(values),
                "type": type,
            }
        )
        return len(self._accessors) - 1


def _object_node(made: _Tree, number: int, entry: Any, left: LeftOut) -> dict[str, Any]:
    shape, name = entry.shape, called("object", number, entry.name)
    material = made.material(_material(entry.material, name, left))
    if isinstance(shape, Sphere):
        left.add("spheres", f"glTF has triangles only; {2 * SPHERE_RINGS} x {SPHERE_RINGS} each")
        place = np.diag([shape.radius] * 3 + [1.0])
        place[:3, 3] = shape.center
        primitive = made.primitive(("sphere",), unit_sphere(SPHERE_RINGS))
    else:
        place, primitive = _placed(made, shape)
    node = {"mesh": made.mesh(primitive, material, entry.name), "matrix": place.T.ravel().tolist()}
    return node | ({"name": entry.name} if entry.name else {})


def _placed(made: _Tree, mesh: Mesh) -> tuple[NDArray[np.float64], dict[str, Any]]:
    """A mesh's place and primitive: what of the place is no rotation and scale, which nodes must
    be, is in the vertices."""
    linear = mesh.transform[:3, :3]
    key: tuple[object, ...] = tuple(map(id, (mesh.vertices, mesh.faces, mesh.normals, mesh.colors)))
    unit = linear / np.linalg.norm(linear, axis=0)
    if np.abs(unit.T @ unit - np.eye(3)).max() <= SKEWED:
        return mesh.transform, made.primitive(key, triangles(mesh))
    found = triangles(mesh)
    normals = found.normals
    if normals is not None:
        turned = normals @ np.linalg.inv(linear)
        normals = (turned / np.linalg.norm(turned, axis=1, keepdims=True)).astype(np.float32)
    faces = found.faces[:, ::-1] if np.linalg.det(linear) < 0 else found.faces
    vertices = (found.vertices @ linear.T).astype(np.float32)
    baked = Triangles(vertices, faces, normals, found.colors)
    place = np.eye(4)
    place[:3, 3] = mesh.transform[:3, 3]
    return place, made.primitive((*key, linear.tobytes()), baked)


def _material(material: Material, name: str, left: LeftOut) -> dict[str, Any]:
    if material.checker is not None:
        left.add(f"checker of {name}", "glTF has pictures only; its colours' mean was written")
    color = reflectance(mean_of_checker(material), name, left)
    found = microfacets(material)
    pbr = {
        "baseColorFactor": [*color, 1.0],
        "metallicFactor": 0.0,
        "roughnessFactor": 1.0 if found is None else math.sqrt(found.alpha),
    }
    specular: dict[str, Any] = {"specularFactor": 0.0}
    if found is not None:
        specular = {"specularColorFactor": [part / DIELECTRIC for part in found.f0]}
    return {
        "pbrMetallicRoughness": pbr,
        "doubleSided": True,
        "extensions": {SPECULAR: specular},
    }


def _light(strength: Color) -> dict[str, Any]:
    brightest = max(strength)
    return {
        "color": [part / brightest if brightest else 1.0 for part in strength],
        "intensity": brightest,
    }


def _light_node(number: int, light: PointLight | DirectionalLight) -> dict[str, Any]:
    node: dict[str, Any] = {"name": f"light {number}", "extensions": {LIGHTS: {"light": number}}}
    if isinstance(light, PointLight):
        return node | {"translation": list(light.position)}
    # A directional light shines along its node's -z.
    back = -np.asarray(light.direction) / np.linalg.norm(light.direction)
    across = np.cross(np.eye(3)[np.abs(back).argmin()], back)
    across /= np.linalg.norm(across)
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack([across, np.cross(back, across), back])
    return node | {"matrix": matrix.T.ravel().tolist()}


def _glb(tree: dict[str, Any], binary: bytes) -> bytes:
    text = json.dumps(tree, ensure_ascii=False, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = [(b"JSON", text), *([(b"BIN\0", binary)] if binary else [])]
    length = 12 + sum(8 + len(data) for _, data in chunks)
    parts = [b"glTF", (2).to_bytes(4, "little"), length.to_bytes(4, "little")]
    for kind, data in chunks:
        parts += [len(data).to_bytes(4, "little"), kind, data]
    return b"".join(parts)
