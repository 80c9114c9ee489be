"""A scene as a binary glTF file, .glb: meshes, materials, lights (KHR_lights_punctual), the camera.

Source: Khronos, glTF 2.0 Specification; KHR_lights_punctual; KHR_materials_specular.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.files.cameras.gltf import camera_table, node_matrix
from lucida.renderer.files.cameras.rigid import rigid
from lucida.renderer.files.export.glb_tree import GlbTree, glb_bytes
from lucida.renderer.files.export.materials import (
    LeftOut,
    light_strengths,
    mean_of_pattern,
    microfacets,
    reflectance,
)
from lucida.renderer.files.export.meshes import Triangles, arrays_of, unit_sphere, wound
from lucida.renderer.files.models.gltf_materials import WRAP_NAMES
from lucida.renderer.images.png import png_of
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
    Color,
    DirectionalLight,
    Mesh,
    PointLight,
    Scene,
    Sphere,
    without_metal,
)
from lucida.renderer.scene.texture import Texture
from lucida.renderer.system.cancelling import check_cancelled

DIELECTRIC = 0.04  # the reflectance of a non-metallic glTF material at normal incidence
SKEWED = 1e-6  # with a larger cosine, a transform is not just rotation and scale
SPHERE_RINGS = 64
LINEAR = 9729  # a filter
LIGHTS, SPECULAR = "KHR_lights_punctual", "KHR_materials_specular"


def glb_of(scene: Scene, camera: Camera, size: Size) -> tuple[bytes, tuple[str, ...]]:
    """Return a scene as a .glb file, and one line for each thing that differs there.

    Raises LucidaError for a camera that glTF cannot hold.
    """
    left = LeftOut()
    camera = rigid(camera, "gltf", size)
    made = GlbTree()
    nodes = [_object_node(made, number, entry, left) for number, entry in scene.visible]
    strengths = light_strengths(scene, left)
    lights = [_light(color) for color in strengths]
    for number, light in enumerate(scene.lights):
        lights[number]["type"] = "point" if isinstance(light, PointLight) else "directional"
        nodes.append(_light_node(number, light))
    nodes.append({"name": "camera", "camera": 0, "matrix": node_matrix(camera)})
    if any(scene.ambient):
        left.add("ambient", "glTF has none")
    left.add("background", "glTF has none")
    if any(any(entry.material.specular) for _, entry in scene.visible):
        left.add(
            "highlights",
            "microfacets, as wide and as bright in the middle, stand for (n . h)^shininess",
        )
    extensions = [name for name, there in ((LIGHTS, lights), (SPECULAR, scene.visible)) if there]
    tree: dict[str, Any] = {
        "asset": {
            "version": "2.0",
            "generator": "Lucida",
            "extras": {"not_carried_over": list(left.lines)},
        },
        "scene": 0,
        "scenes": [{"name": scene.name, "nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "cameras": [camera_table(camera, size)],
        **made.tables(),
    }
    if extensions:
        tree["extensionsUsed"] = extensions
    if lights:
        tree["extensions"] = {LIGHTS: {"lights": lights}}
    return glb_bytes(tree, bytes(made.chunk)), left.lines


def _object_node(made: GlbTree, number: int, entry: Any, left: LeftOut) -> dict[str, Any]:
    check_cancelled()
    shape, material = entry.shape, entry.material
    name = repr(entry.name) if entry.name else f"object {number}"
    texture = material.image
    is_mapped = texture is not None and not isinstance(shape, Sphere)
    table = _material(material, is_mapped, name, left)
    if isinstance(shape, Sphere):
        left.add("spheres", f"glTF has triangles only; {2 * SPHERE_RINGS} x {SPHERE_RINGS} each")
        if material.texture is not None:
            left.add(f"texture of {name}", "no image was written; the mean of its colours was")
        place = np.diag([shape.radius] * 3 + [1.0])
        place[:3, 3] = shape.center
        primitive = made.primitive(unit_sphere, SPHERE_RINGS)
    else:
        own = arrays_of(shape)
        if texture is not None:
            table["pbrMetallicRoughness"] |= _textured(made, material, texture, name, left)
        place, linear = _place(shape)
        primitive = made.primitive(_triangles, own, texture, linear, not material.single_sided)
    if material.checker is not None:
        left.add(f"checker of {name}", "glTF has none; the mean of its colours was written")
    mesh = made.mesh(primitive, table, entry.name)
    node = {"mesh": mesh, "matrix": place.T.ravel().tolist()}
    return node | ({"name": entry.name} if entry.name else {})


def _place(mesh: Mesh) -> tuple[NDArray[np.float64], tuple[float, ...] | None]:
    """Return a node's matrix, which must consist of rotation and scale; and the part of a mesh's
    transform to apply to its vertices, a matrix (3, 3), or None.
    """
    linear = mesh.transform[:3, :3]
    unit = linear / np.linalg.norm(linear, axis=0)
    if np.abs(unit.T @ unit - np.eye(3)).max() <= SKEWED:
        return mesh.transform, None
    place = np.eye(4)
    place[:3, 3] = mesh.transform[:3, 3]
    return place, tuple(linear.ravel().tolist())


def _triangles(
    own: Triangles,
    texture: Texture | None,
    linear: tuple[float, ...] | None,
    turns: bool,
) -> Triangles:
    found = wound(own, turns)
    if texture is not None:
        found = _with_uv(found, texture)
    if linear is None:
        return found
    matrix, normals = np.reshape(linear, (3, 3)), found.normals
    if normals is not None:
        turned = normals @ np.linalg.inv(matrix)
        normals = (turned / np.linalg.norm(turned, axis=1, keepdims=True)).astype(np.float32)
    faces = found.faces[:, ::-1] if np.linalg.det(matrix) < 0 else found.faces
    vertices = (found.vertices @ matrix.T).astype(np.float32)
    return Triangles(vertices, faces, normals, found.colors, found.uv)


def _material(material: Material, is_mapped: bool, name: str, left: LeftOut) -> dict[str, Any]:
    surface: dict[str, Any] = {"doubleSided": not material.single_sided}
    if material.cutout is not None:
        surface |= {"alphaMode": "MASK", "alphaCutoff": material.cutout}
    if material.metal is not None:
        if is_mapped:
            return {"pbrMetallicRoughness": {}, **surface}
        left.add(f"metal of {name}", "no image was written; what it looks like from far away was")
        material = without_metal(material)
    color = reflectance(mean_of_pattern(material), name, left)
    found = microfacets(material)
    pbr = {
        "baseColorFactor": [*color, 1.0],
        "metallicFactor": 0.0,
        "roughnessFactor": 1.0 if found is None else math.sqrt(found[0]),
    }
    specular: dict[str, Any] = {"specularFactor": 0.0}
    if found is not None:
        specular = {"specularColorFactor": [part / DIELECTRIC for part in found[1]]}
    return {
        "pbrMetallicRoughness": pbr,
        **surface,
        "extensions": {SPECULAR: specular},
    }


def _picture(made: GlbTree, texels: NDArray[np.uint8], wraps: Iterable[int]) -> dict[str, int]:
    return {"index": made.texture(png_of(texels), LINEAR, LINEAR, *wraps)}


def _with_uv(found: Triangles, texture: Texture) -> Triangles:
    """Return the triangles with glTF's texture coordinates, v downwards."""
    assert found.uv is not None
    places = found.uv.astype(np.float64) @ texture.place[:, :2].T + texture.place[:, 2]
    places[:, 1] = 1 - places[:, 1]
    return replace(found, uv=places.astype(np.float32))


def _textured(
    made: GlbTree, material: Material, texture: Texture, name: str, left: LeftOut
) -> dict[str, Any]:
    numbers = {name: number for number, name in WRAP_NAMES.items()}
    wraps = [numbers[way] for way in texture.wrap]
    table: dict[str, Any] = {
        "baseColorFactor": [*reflectance(material.diffuse, name, left), 1.0],
        "baseColorTexture": _picture(made, texture.texels, wraps),
    }
    if (metal := material.metal) is not None:
        table |= {
            "metallicRoughnessTexture": _picture(made, metal.texels, wraps),
            "metallicFactor": metal.metalness,
            "roughnessFactor": metal.roughness,
        }
    return table


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
