"""The common size of both images, and their place in the windows that show them."""

from __future__ import annotations

from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import ImageOptions
from lucida.renderer.images.frame import LARGEST_PIXELS, LARGEST_SIDE
from lucida.renderer.system.memo import Memo

from .placement import Placement, common_pane, place

NEARBY_PX = 4  # greatest difference between the halves of a window
UNSEEN_SIZE = (640, 480)  # of images that no view shows


class ImageSize:
    """The size that both images share.

    size: (width, height); (0, 0) before the first layout. panes_px: the sizes of the images'
    windows, by name.
    """

    def __init__(self) -> None:
        self.size = (0, 0)
        self.panes_px: dict[str, tuple[int, int]] = {}
        self._rulers_px = (0, 0)
        self._place = Memo(place, most=2)  # called several times in a frame
        self._selected: tuple[int, int] | None = None  # the resolution, in the last frame

    def fit_pane(
        self,
        name: str,
        pane_px: tuple[int, int],
        state: AppState,
        rulers_px: tuple[int, int] = (0, 0),
    ) -> None:
        """Report the size of an image's window, (width, height) in framebuffer pixels.

        Both images get the size of the largest window, or the selected resolution. A camera of a
        set keeps the shape of its own image. rulers_px: of the rulers next to magnified pixels, see
        Placement.
        """
        options, given = state.images, state.view.given
        self.panes_px[name], self._rulers_px = pane_px, rulers_px
        if options.resolution is not None:
            self.size = options.resolution
            return
        width, height = common_pane(list(self.panes_px.values()))
        width, height = min(width, LARGEST_SIDE), min(height, LARGEST_SIDE)
        if state.options.poses.pose >= 0 and given is not None and given[1] is not None:
            scale = min(width / given[1][0], height / given[1][1])
            width, height = (max(1, round(scale * side)) for side in given[1])
        self.size = (width, min(height, LARGEST_PIXELS // width))

    def common_room(self, pane_px: tuple[int, int]) -> tuple[int, int]:
        """Return the space for an image in a window. It is a few pixels smaller if another window
        is, so that both show their images at the same size.
        """
        near = [
            pane
            for pane in (*self.panes_px.values(), pane_px)
            if all(abs(a - b) <= NEARBY_PX for a, b in zip(pane, pane_px, strict=True))
        ]
        return min(pane[0] for pane in near), min(pane[1] for pane in near)

    def placement(self, state: AppState) -> Placement | None:
        """Return the place of the images in the smallest of their windows; None if there is
        none.
        """
        panes = self.panes_px.values()
        if not panes or not min(self.size):
            return None
        room = min(pane[0] for pane in panes), min(pane[1] for pane in panes)
        return self.placed(state.images, room)

    def placed(self, options: ImageOptions, room_px: tuple[int, int]) -> Placement:
        """Return the place of the images in a space of (width, height) framebuffer pixels."""
        return self._place(options, self.size, room_px, self._rulers_px)

    def forget_pane(self, name: str) -> None:
        """Report that an image's window is hidden."""
        self.panes_px.pop(name, None)

    def need_size(self, options: ImageOptions) -> None:
        """Give the images a size if none of them has been visible yet."""
        if not min(self.size):
            self.size = options.resolution or UNSEEN_SIZE

    def follow_resolution(self, state: AppState) -> None:
        """Apply the selected resolution, even while no image is visible.

        Hidden images keep their size, except from step to step of a lecture, where a step must not
        depend on the previous one.
        """
        resolution = state.images.resolution
        if resolution is not None:
            self.size = resolution
        elif not self.panes_px and (self._selected is not None or state.step is not None):
            self.size = UNSEEN_SIZE
        self._selected = resolution
