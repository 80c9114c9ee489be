"""The lights of a glTF file. Its point lights fall off with the square of the distance; Lucida's do
not.

Source: Khronos, KHR_lights_punctual.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.files.texture_images import ModelImages
from lucida.renderer.scene.framing import median_distance
from lucida.renderer.scene.material import vector
from lucida.renderer.scene.model import DirectionalLight, PointLight, SceneObject

from .gltf import PlacedNode
from .gltf_file import Gltf, GltfLight

BRIGHTEST = 10.0  # of a white surface; files in lux and candela are darkened to it


def scene_lights(
    tree: Gltf, nodes: Iterable[PlacedNode], objects: list[SceneObject], images: ModelImages
) -> tuple[PointLight | DirectionalLight, ...]:
    """Return lights with which diffuse surfaces are as bright as with the file's lights.

    For a point light, this holds at the median distance of the objects. Lights that are not shown
    are noted. Raises LucidaError.
    """
    found: list[tuple[bool, NDArray[np.float64], NDArray[np.float64]]] = []
    for placed in nodes:
        if (given := placed.node.extensions.light) is None:
            continue
        light: GltfLight = tree.extensions.punctual.entry("lights", given.light)
        strength = np.nan_to_num(light.color).clip(0) * max(light.intensity, 0) / math.pi
        if light.type == "directional":
            found.append((False, -placed.matrix[:3, 2], strength))
        elif light.type == "point":
            position = placed.matrix[:3, 3]
            found.append((True, position, strength / median_distance(objects, position) ** 2))
        else:
            images.note(f"not shown: {light.type[:20]} lights", "lights")
    most = max((float(strength.max()) for _, _, strength in found), default=0.0)
    if most > BRIGHTEST:
        images.note(f"all are {most:.3g} times darker than in the file", "lights")
    lights: list[PointLight | DirectionalLight] = []
    for is_point, where, strength in found:
        color = vector("color", strength / (most if most > BRIGHTEST else 1.0))
        if is_point:
            lights.append(PointLight(vector("position", where), color))
        else:
            lights.append(DirectionalLight(vector("direction", where), color))
    return tuple(lights)
