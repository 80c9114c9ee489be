"""Lucida's own view files: a camera exactly as it is, without the size of an image."""

from __future__ import annotations

from collections.abc import Sequence

from renderer.camera_formats.given import Given, Options
from renderer.camera_formats.posed import CameraSet, PosedCamera
from renderer.errors import LucidaError
from renderer.scene.model import View
from renderer.scene.views import view_from_toml, view_to_toml


def recognises(given: Given) -> bool:
    return given.is_text and "[camera]" in given.text


def read(given: Given, options: Options) -> CameraSet:
    view = view_from_toml(given.text)
    return CameraSet("view", (PosedCamera(view.camera, options.size, fit=view.fit),))


def write(cameras: Sequence[PosedCamera], options: Options) -> dict[str, bytes]:
    if len(cameras) != 1:
        problem = f"a view file holds one camera, not {len(cameras)}"
        raise LucidaError("", problem, "choose one with --frame or --image")
    return {"": view_to_toml(View(cameras[0].camera, cameras[0].fit)).encode()}
