"""Explanations for an image that is black, or shows only its background.

The reasons are found by querying the scene. nothing_hit.py explains why nothing is hit; this module
explains why hit surfaces are dark.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Camera
from renderer.frame import Frame
from renderer.images.display import encode_srgb
from renderer.nothing_hit import Reason, hits_nothing, why_nothing_is_hit
from renderer.scene.flat import DIFFUSE_SHININESS, SPECULAR_CHECKERED, FlatScene
from renderer.scene.model import Scene
from renderer.scene.positions import world_corners

DARK = 1.5 / 255  # a display value; an image below it looks black
NO_LIGHT = 1e-6  # linear: invisible at any usual exposure
MOST_POINTS = 1 << 16  # of an image that are tested for light


class Darkness(NamedTuple):
    """The darkness of an image.

    brightest: linear light, the maximum over all channels of all pixels that hit something. reason:
    the reason that it is 0, or that nothing is hit; None if there is light.
    """

    brightest: float
    reason: Reason | None

    def shown(self, exposure_ev: float, is_linear: bool = False) -> Reason | None:
        """Return the reason that the colours are black with this exposure; None if they are not.

        is_linear: shown without the sRGB curve.
        """
        if self.reason is not None:
            return self.reason
        light = np.float32(min(self.brightest * 2.0**exposure_ev, 1.0))
        if float(light if is_linear else encode_srgb(light)) >= DARK:
            return None
        text = f"the exposure is {exposure_ev:+.3g} EV; the brightest pixel is {self.brightest:.2g}"
        return Reason("exposure", text)


def darkness(
    scene: Scene, flat: FlatScene, camera: Camera, frame: Frame, shadows: bool = False
) -> Darkness:
    """Return how dark an image is, and why.

    frame: complete, with the channels color, depth, normal and id. shadows: it was traced with
    shadows.

    Causes in addition to those of why_nothing_is_hit(): the eye is "inside" an object; there is "no
    light" at all; the lights are behind the surfaces ("unlit"); the surfaces are in "shadow"; or no
    surface reflects the lights ("material").
    """
    if hits_nothing(frame):
        return Darkness(0.0, why_nothing_is_hit(flat, camera, frame.size))
    hit = frame.channel("id") >= 0
    brightest = float(np.nanmax(frame.channel("color")[hit], initial=0.0))
    if brightest > NO_LIGHT:
        return Darkness(brightest, None)
    return Darkness(brightest, _why_unlit(scene, flat, camera, frame, hit, shadows))


def exposure_for(brightest: float) -> float:
    """Return the largest whole number of stops at which the brightest pixel is at most 1."""
    return float(np.floor(-np.log2(brightest)))


def _why_unlit(
    scene: Scene,
    flat: FlatScene,
    camera: Camera,
    frame: Frame,
    hit: NDArray[np.bool_],
    shadows: bool,
) -> Reason:
    for number in np.unique(frame.channel("id")[hit]).tolist():
        if is_inside(flat, number, camera.eye):
            return Reason("inside", f"the eye is inside {_name(scene, number)}")
    if not len(flat.lights):
        return Reason("no light", "the scene has no lights, and no ambient light")
    if not flat.lights[:, 1, :3].any():
        return Reason("no light", "all lights are black, and there is no ambient light")
    seen = flat.materials[np.unique(frame.channel("id")[hit])]
    if not (seen[:, DIFFUSE_SHININESS, :3].any() or seen[:, SPECULAR_CHECKERED, :3].any()):
        return Reason("material", "what is seen has a black material")
    if not _faces_a_light(flat, camera, frame, hit):
        return Reason("unlit", "all lights are behind the surfaces that are seen")
    if shadows:
        return Reason("shadow", "all that is seen lies in shadow")
    return Reason("material", "what is seen reflects nothing of the lights' colours")


def is_inside(flat: FlatScene, number: int, eye: tuple[float, float, float]) -> bool:
    """Return True if a point in the world is inside an object.

    A line from an inside point crosses the surface an odd number of times. Meaningless for objects
    that are not closed.
    """
    sphere = int(flat.object_sphere[number])
    if sphere >= 0:
        x, y, z, radius = flat.spheres[sphere]
        return bool(np.linalg.norm(np.subtract(eye, (x, y, z))) < radius)
    first, count = flat.object_faces[number]
    corners = world_corners(flat, np.arange(first, first + count)) - np.asarray(eye)
    # An unusual direction, so that no edge of a model lies on the line.
    toward = np.array([0.5381, 0.7123, 0.4507])
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    sides = [np.einsum("ij,j->i", np.cross(p, q), toward) for p, q in ((a, b), (b, c), (c, a))]
    crossed = ((sides[0] > 0) == (sides[1] > 0)) & ((sides[1] > 0) == (sides[2] > 0))
    normal = np.cross(b - a, c - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        ahead = (normal * a).sum(1) / (normal @ toward) > 0
    return bool(np.count_nonzero(crossed & ahead) % 2)


def _faces_a_light(flat: FlatScene, camera: Camera, frame: Frame, hit: NDArray[np.bool_]) -> bool:
    """Return True if any light is on the visible side of any surface."""
    i, j = np.nonzero(hit)
    step = -(-len(i) // MOST_POINTS)
    i, j = i[::step], j[::step]
    ray = camera.ray(i, j, frame.size)
    points = ray.origin + frame.channel("depth")[i, j, None].astype(np.float64) * ray.direction
    normals = frame.channel("normal")[i, j]
    for light in flat.lights:
        if light[1, :3].any():
            toward = light[0, :3] - light[0, 3] * points
            if (np.einsum("ij,ij->i", normals, toward) > 0).any():
                return True
    return False


def _name(scene: Scene, number: int) -> str:
    name = scene.objects[number].name
    return f"the object {name!r}" if name else f"object {number}"
