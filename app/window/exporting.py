"""File > Export, which exports the scene and its camera for other renderers, or as a page."""

from __future__ import annotations

from pathlib import Path

from lucida.app.cameras.camera_panel.actions import image_size
from lucida.app.ui.host import Host
from lucida.app.web import ENDINGS as PAGES
from lucida.renderer.files.export import ENDINGS, export_scene
from lucida.renderer.scene.model import View
from lucida.renderer.system.atomic import file_stem
from lucida.renderer.system.errors import one_line

KINDS = "glTF (.glb) or a page (.html)"
NOT_CARRIED = "Exported with differences:"


def ask_export(host: Host) -> None:
    """Ask for a file, whose ending names the format, and export into it in the background.

    A message lists the features that the format cannot hold.
    """
    scene, camera, size = host.state.scene, host.renderers.camera(host.state), image_size(host)

    def write(path: str) -> str:
        notes: tuple[str, ...] = ()
        if Path(path).suffix.lower() in PAGES:
            from lucida.app.web.scene_page import write_scene_page

            write_scene_page(path, scene, View(camera))
        else:
            notes = export_scene(path, scene, camera, size)
        exported = one_line(f"Exported the scene and its camera as {path}.")
        return "\n".join((exported, NOT_CARRIED, *notes) if notes else (exported,))

    title = f"Export the scene and its camera as {KINDS}"
    name = (file_stem(scene.name) or "scene") + ENDINGS[0]
    host.files.save_as_dialog(title, name, (KINDS, *ENDINGS, *PAGES), write)
