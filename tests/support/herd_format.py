"""Two small formats of several cameras, for tests of what is done with any format: `herd`, a JSON
file, and `den`, a folder, which is only written."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import replace
from types import ModuleType
from typing import Any

from lucida import Camera, LucidaError
from lucida.renderer.files.cameras import CameraSet, PosedCamera, formats
from lucida.renderer.files.cameras.distortion import lens_of
from lucida.renderer.files.cameras.formats import Format
from lucida.renderer.files.cameras.given import Given, Options

TAKEN = ("camera-to-world, y up, z back", "whole numbers at the pixels' corners")


def recognises(given: Given) -> bool:
    return isinstance(given.json, dict) and "herd" in given.json


def read(given: Given, options: Options) -> CameraSet:
    return CameraSet("herd", tuple(_camera(entry, options) for entry in given.json["herd"]), TAKEN)


def _camera(entry: dict[str, Any], options: Options) -> PosedCamera:
    size = entry.get("size", options.size)
    lens, ignored = lens_of("brown", {"k1": entry.get("k1", 0.0), "k2": 0.0}, options)
    aspect = 1.0 if size is None else size[0] / size[1]
    camera = Camera.look_at(entry["eye"], (0, 0, 0), fov_y_deg=40.0, aspect=aspect)
    return PosedCamera(
        replace(camera, lens=lens),
        None if size is None else tuple(size),
        entry.get("name", ""),
        entry.get("image", ""),
        ignored=ignored,
    )


def write(cameras: Sequence[PosedCamera], options: Options) -> dict[str, bytes]:
    told = []
    for posed in cameras:
        if posed.camera.is_parallel:
            raise LucidaError("projection", "a herd has no 'parallel'", "give another camera")
        told.append({"name": posed.name, "size": posed.size, "eye": posed.camera.eye})
    return {"": json.dumps({"herd": told, "said": [options.pixel_origin]}).encode()}


def write_den(cameras: Sequence[PosedCamera], options: Options) -> dict[str, bytes]:
    return {"cameras.txt": write(cameras, options)[""], "images.txt": b"none\n"}


def install(monkeypatch: Any) -> None:
    """Both formats, beside the real ones, until the test ends."""
    herd, den = ModuleType("herd"), ModuleType("den")
    herd.recognises, herd.read, herd.write = recognises, read, write  # type: ignore[attr-defined]
    den.recognises, den.write = lambda given: False, write_den  # type: ignore[attr-defined]
    for module in (herd, den):
        monkeypatch.setitem(sys.modules, f"lucida.renderer.files.cameras.{module.__name__}", module)
    own = (
        Format("herd", "cameras in a herd", "herd", (".herd",)),
        Format("den", "a den", "-", ("",)),
    )
    monkeypatch.setattr(formats, "FORMATS", (*own, *formats.FORMATS))
