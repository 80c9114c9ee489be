"""Lucida's own view files: a camera exactly as it is, without an image size."""

from __future__ import annotations

from collections.abc import Sequence

from lucida.renderer.camera.lenses import MODELS
from lucida.renderer.files.reading import check_bytes
from lucida.renderer.files.views import view_from_toml, view_to_toml
from lucida.renderer.scene.limits import TOML_BYTES
from lucida.renderer.scene.model import View

from .given import Given, Options
from .posed import CameraSet, PosedCamera, one_of

LENSES = MODELS


def recognises(given: Given) -> bool:
    may_be = given.ending in ("", ".txt") and given.is_text
    return given.ending == ".toml" or (may_be and "[camera]" in given.text)


def read(given: Given, options: Options) -> CameraSet:
    check_bytes(len(given.data), TOML_BYTES, given.name)
    view = view_from_toml(given.text)
    return CameraSet("view", (PosedCamera(view.camera, options.size, fit=view.fit),))


def write(cameras: Sequence[PosedCamera], options: Options) -> bytes:
    camera = one_of(cameras)
    return view_to_toml(View(camera.camera, camera.fit)).encode()
