"""A scene as a binary glTF file, .glb: meshes, materials, lights (KHR_lights_punctual) and camera.

Blinn and Phong's highlight, specular * (n . h)^p, becomes a microfacet highlight with the same
width and peak: a roughness alpha with alpha^2 = 2 / (p + 2), whose peak is F0 / (4 alpha^2).
Source: Khronos, glTF 2.0 Specification; KHR_lights_punctual; KHR_materials_specular; Karis 2013,
"Specular BRDF reference"; Walter et al. 2007, "Microfacet models".
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.files.cameras.gltf import camera_table, node_matrix
from lucida.renderer.files.cameras.rigid import rigid
from lucida.renderer.files.models.gltf_materials import WRAP_NAMES
from lucida.renderer.images.display import from_srgb
from lucida.renderer.scene.framing import median_distance
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
    Color,
    DirectionalLight,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
    without_metal,
)
from lucida.renderer.scene.texture import Texture
from lucida.renderer.system.cancelling import check_cancelled
from lucida.renderer.system.errors import one_line

from .glb_tree import GlbTree
from .meshes import Triangles, exported_triangles

DIELECTRIC = 0.04  # the reflectance of a non-metallic glTF material at normal incidence
MOST_REFLECTED = 0.9  # of the light at normal incidence
LIGHTS, SPECULAR = "KHR_lights_punctual", "KHR_materials_specular"


def glb_of(scene: Scene, camera: Camera, size: Size) -> tuple[bytes, tuple[str, ...]]:
    """Return a scene as a .glb file, and one line for each difference.

    Raises LucidaError for a camera that glTF cannot hold.
    """
    left = ["ambient light and background: glTF has none"]
    camera = rigid(camera, "gltf")
    made = GlbTree()
    nodes = [_object_node(made, number, entry, left) for number, entry in scene.visible]
    lights = []
    for number, light in enumerate(scene.lights):
        lights.append(_light(scene, light))
        node = {"name": f"light {number}", "extensions": {LIGHTS: {"light": number}}}
        nodes.append(node | _light_place(light))
    nodes.append({"name": "camera", "camera": 0, "matrix": node_matrix(camera)})
    tree: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "Lucida"},
        "scene": 0,
        "scenes": [{"name": scene.name, "nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "cameras": [camera_table(camera, size)],
    }
    if extensions := [
        name for name, there in ((LIGHTS, lights), (SPECULAR, scene.visible)) if there
    ]:
        tree["extensionsUsed"] = extensions
    if lights:
        tree["extensions"] = {LIGHTS: {"lights": lights}}
    if any(isinstance(light, PointLight) for light in scene.lights):
        left.append("point lights: they are equally bright only at the objects' median distance")
    return made.glb(tree), tuple(dict.fromkeys(map(one_line, left)))


def _object_node(made: GlbTree, number: int, entry: SceneObject, left: list[str]) -> dict[str, Any]:
    check_cancelled()
    shape, material = entry.shape, entry.material
    name = repr(entry.name) if entry.name else f"object {number}"
    texture = None if isinstance(shape, Sphere) else material.image
    if isinstance(shape, Sphere):
        left.append("spheres: glTF has triangles only")
    found = exported_triangles(shape, not material.single_sided)
    if texture is not None:
        found = _with_uv(found, texture)
    table = _material(made, material, texture, name, left)
    attributes = {"POSITION": made.accessor(found.vertices, has_bounds=True)}
    values = {"NORMAL": found.normals, "COLOR_0": found.colors, "TEXCOORD_0": found.uv}
    attributes |= {key: made.accessor(rows) for key, rows in values.items() if rows is not None}
    primitive = {
        "attributes": attributes,
        "indices": made.accessor(found.faces.reshape(-1)),
        "material": made.add("materials", table),
    }
    mesh = made.add("meshes", {"primitives": [primitive], "name": entry.name or name})
    place = shape.center if isinstance(shape, Sphere) else shape.transform[:3, 3].tolist()
    node = {"mesh": mesh, "translation": list(place)}
    return node | ({"name": entry.name} if entry.name else {})


def _with_uv(found: Triangles, texture: Texture) -> Triangles:
    """Return the triangles with glTF's texture coordinates, v downwards."""
    assert found.uv is not None
    places = found.uv.astype(np.float64) @ texture.place[:, :2].T + texture.place[:, 2]
    places[:, 1] = 1 - places[:, 1]
    return found._replace(uv=places.astype(np.float32))


def _material(
    made: GlbTree, material: Material, texture: Texture | None, name: str, left: list[str]
) -> dict[str, Any]:
    """Return glTF's nearest material. texture: None unless the mesh shows one."""
    surface: dict[str, Any] = {"doubleSided": not material.single_sided}
    if material.cutout is not None:
        surface |= {"alphaMode": "MASK", "alphaCutoff": material.cutout}
    if texture is None and material.metal is not None:
        material = without_metal(material)
    color = material.diffuse if texture is not None else _mean(material)
    if color != material.diffuse:
        left.append(f"pattern of {name}: the mean of its colours was written")
    if max(color) > 1:
        left.append(f"{name}: its diffuse colour reflects more than all light; 1 was written")
    pbr: dict[str, Any] = {"baseColorFactor": [*(min(part, 1.0) for part in color), 1.0]}
    if texture is not None:
        numbers = {name: number for number, name in WRAP_NAMES.items()}
        wraps = [numbers[way] for way in texture.wrap]
        pbr["baseColorTexture"] = made.texture(texture.texels, *wraps)
        if (metal := material.metal) is not None:
            pbr["metallicRoughnessTexture"] = made.texture(metal.texels, *wraps)
            pbr |= {"metallicFactor": metal.metalness, "roughnessFactor": metal.roughness}
            return {"pbrMetallicRoughness": pbr, **surface}
    pbr |= {"metallicFactor": 0.0, "roughnessFactor": 1.0}
    specular: dict[str, Any] = {"specularFactor": 0.0}
    if any(material.specular):
        left.append("highlights: microfacets, equally wide and equally bright in the middle")
        squared = 2 / (material.shininess + 2)
        peaks = (min(4 * squared * part, MOST_REFLECTED) for part in material.specular)
        specular = {"specularColorFactor": [peak / DIELECTRIC for peak in peaks]}
        pbr["roughnessFactor"] = squared**0.25
    return {"pbrMetallicRoughness": pbr, **surface, "extensions": {SPECULAR: specular}}


def _mean(material: Material) -> Color:
    """Return the mean colour of a checker or a texture, or else the diffuse colour."""
    rgb = np.array(material.diffuse)
    if material.texture is not None:
        light = from_srgb(material.texture.texels[..., :3].reshape(-1, 3) / np.float32(255))
        rgb = light.mean(axis=0, dtype=np.float64) * rgb
    elif material.checker is not None:
        rgb = (rgb + material.checker.diffuse) / 2
    red, green, blue = rgb.tolist()
    return red, green, blue


def _light(scene: Scene, light: PointLight | DirectionalLight) -> dict[str, Any]:
    """Return a light in radiometric units that makes a diffuse surface as bright as in Lucida.

    For a point light, this holds at the objects' median distance.
    """
    brightest = max(light.color)
    intensity, kind = math.pi * brightest, "directional"
    if isinstance(light, PointLight):
        intensity *= median_distance(scene.objects, light.position) ** 2
        kind = "point"
    color = [part / brightest if brightest else 1.0 for part in light.color]
    return {"type": kind, "color": color, "intensity": intensity}


def _light_place(light: PointLight | DirectionalLight) -> dict[str, Any]:
    if isinstance(light, PointLight):
        return {"translation": list(light.position)}
    # A directional light shines along its node's -z.
    back = -np.asarray(light.direction) / np.linalg.norm(light.direction)
    across = np.cross(np.eye(3)[np.abs(back).argmin()], back)
    across /= np.linalg.norm(across)
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack([across, np.cross(back, across), back])
    return {"matrix": matrix.T.ravel().tolist()}
