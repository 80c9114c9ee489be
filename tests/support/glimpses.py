"""A canvas for a window that a test drives: it draws what is looked at."""

from collections.abc import Callable

from lucida.app.window.canvas import Target, WindowCanvas


class Glimpses(WindowCanvas):
    """Frames that nobody looks at are drawn into one pixel: it is a processor that draws them."""

    is_seen: Callable[[], bool]

    def bind(self, size: tuple[int, int], unfinished: bool) -> Target:
        return super().bind(size if self.is_seen() else (1, 1), unfinished)

    @property
    def shown(self) -> Target | None:
        shown = super().shown
        return shown if shown is not None and shown.size != (1, 1) else None
