"""A driven window draws what is looked at: it is a processor that draws."""

from collections.abc import Callable

from imgui_bundle import imgui

from lucida.app.window import viewer
from lucida.app.window.canvas import Target, WindowCanvas


class Glimpses(WindowCanvas):
    """Frames that nobody looks at have one pixel."""

    is_seen: Callable[[], bool]

    def bind(self, size: tuple[int, int], unfinished: bool) -> Target:
        return super().bind(size if self.is_seen() else (1, 1), unfinished)

    @property
    def shown(self) -> Target | None:
        shown = super().shown
        return shown if shown is not None and shown.size != (1, 1) else None


def skip_unseen(run: viewer.WindowRun) -> None:
    """Draw only the frames that run.on_drawn waits for. Everything else is done in all of them."""
    Glimpses.is_seen = lambda _: run.on_drawn is not None
    viewer.WindowCanvas = Glimpses
    callbacks = run.params.callbacks
    before_render = callbacks.before_imgui_render

    def skip() -> None:
        before_render()
        if run.on_drawn is None:
            imgui.get_io().display_framebuffer_scale = (0.0, 0.0)  # then ImGui draws nothing

    callbacks.before_imgui_render = skip
