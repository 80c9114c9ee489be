"""A model that is opened, taken back, and shown again."""

from __future__ import annotations

from window_driver import Driver


def drive_a_scene_taken_back_is_drawn_without_being_prepared_again(d: Driver) -> None:
    window, path = d.window, d.folder / "twice.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    window.open(str(path))
    d.until(lambda: window.state.scene.name == "twice")
    d.settle()
    opened = window.state.scene
    window.undo()
    d.settle()
    textures = window.renderers.textures
    assert textures is not None
    rasterizer = textures.rasterizer.of(window.state.scene)
    taken: list[bool] = []
    good = rasterizer.set_scene

    def set_scene(scene: object, prepared: object = None) -> None:
        taken.append(scene is opened and prepared is not None)
        good(scene, prepared)  # type: ignore[arg-type]

    rasterizer.set_scene = set_scene  # type: ignore[method-assign]
    window.redo()
    d.settle()
    del rasterizer.set_scene
    assert taken == [True]
    d.agreeing_images()
