"""The view "Poses": a set of cameras, listed, shown in the outside view, visited one after another.

model.py prepares a set, panel.py draws the panel.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import moderngl
from imgui_bundle import imgui

from lucida.app.images.photograph.model import closed, with_photograph
from lucida.app.instruments.outside.diagram import Dot, Face, Item, Label, Role, Segments
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.state.app_state import AppState
from lucida.app.state.paths import restored
from lucida.app.ui import layout, theme
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of
from lucida.app.ui.uploads import Uploads
from lucida.renderer.scene import Scene
from lucida.renderer.system.errors import one_line
from lucida.renderer.system.memo import Memo

from . import panel
from .model import PoseSet, cloud, frusta, with_set, with_set_framed
from .panel import PoseWish
from .photographs import Photograph, Photographs, photo_path
from .reading import PosesReader

POSES = "Poses"
PHOTO = "photograph"
BEYOND = 1 << 30  # more steps than a set has cameras


class PosesView(Instrument):
    """The view "Poses".

    poses: the open set; None if there is none, or it is being read.
    problem: the reason why it could not be read.
    """

    name = POSES
    title = "Poses"
    keyboard = (("arrows in Poses", "another camera; Home, End"),)
    space = layout.INSTRUMENTS

    def __init__(self, views: Sequence[Instrument]) -> None:
        self._outside = view_of(views, OutsideView)
        self._reader = PosesReader()
        self._photographs = Photographs()
        self._uploads: Uploads | None = None
        self.poses: PoseSet | None = None
        self.problem = ""
        self._cloud = Memo(cloud)
        self._items = Memo(_outside_items)
        self._upload = Memo(_upload)
        self._scrolled: int | None = None  # the selected one that was last scrolled into view
        self._seen = False

    def give(self, window: Host, poses: PoseSet) -> None:
        """Show the set that the state names."""
        self._reader.give(poses)  # so that it need not be read again
        window.show_in(POSES, layout.OUTSIDE)

    def open(self, window: Host, poses: PoseSet, scene: Scene | None) -> None:
        """Open a set for the user, with its first camera. scene: the scene to show it in; None
        to keep the current scene and camera.
        """
        state = with_set(window.state, poses, scene)
        if scene is not None:
            state = with_set_framed(state, poses, self._outside.size_px)
        window.change(state)
        self.give(window, poses)

    @property
    def settled(self) -> bool:
        return not self._seen or not (self._reader.busy or self._photographs.busy)

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._uploads = Uploads(context)

    def end(self) -> None:
        self._reader.close()
        self._photographs.close()
        if self._uploads is not None:
            self._uploads.release()

    def unseen(self, host: Host) -> None:
        self._seen = False
        self._hide()

    def draw(self, host: Host) -> None:
        assert self._uploads is not None
        self._uploads.begin_frame()
        self._seen = True
        path = restored(host.state.options.poses.file)
        name = Path(path).name
        poses = self._reader.of(path)
        if poses is not self.poses:
            self.poses = poses
            self._forget_set()
        self.problem = self._reader.problems.get(path, "")
        wish: PoseWish
        if not path:
            wish = panel.invitation()
        elif poses is not None:
            wish = self._of_set(host, poses)
        elif self.problem:
            wish = panel.failed(name, self.problem)
        else:
            wish = ""
            imgui.text_colored(theme.DIM, f"reading {one_line(name)} ...")
            host.animate()
        self._grant(host, panel.keys() or wish)
        if self.poses is None:
            self._hide()

    def _of_set(self, host: Host, poses: PoseSet) -> PoseWish:
        state = host.state
        options = state.options.poses
        chosen = self.chosen(state)
        wish, changed = panel.head(poses, options, host.fonts)
        if changed != options:
            host.apply(state.with_options(changed))
        clicked = panel.rows(poses, chosen, scroll=chosen != self._scrolled)
        self._scrolled = chosen
        if chosen >= 0:
            wish = panel.photograph(*self._photo(host, poses, chosen)) or wish
        else:
            self._photographs.want_none()
        if clicked is not None:
            self.take(host, clicked)
        self._show_outside(host, poses)
        return wish

    def _forget_set(self) -> None:
        self._photographs.forget()
        for memo in (self._cloud, self._items, self._upload):
            memo.forget()
        self._scrolled = None

    # The list.

    def chosen(self, state: AppState) -> int:
        """Return the number of the selected camera; -1 if there is none."""
        number = state.options.poses.pose
        return number if self.poses is not None and number < len(self.poses.names) else -1

    def take(self, host: Host, number: int) -> None:
        """Move the window's camera to this one by a transition; at once if another transition is
        under way, as during quick steps.
        """
        poses = self.poses
        if poses is None or not 0 <= number < len(poses.names):
            return
        before = self.chosen(host.state)
        target = host.state.with_options(replace(host.state.options.poses, pose=number)).with_view(
            poses.view(number)
        )
        if target.options.photograph.follows:
            target = _photographed(target, poses, number)
        if before >= 0 and host.travelling:  # arrive there first, as a step of its own
            host.amend(host.state.with_view(poses.view(before)))
            host.change(target)
        else:
            host.travel(target)

    def _grant(self, host: Host, wish: PoseWish) -> None:
        poses = self.poses
        if wish == "open":
            host.files.open_dialog()
        elif wish == "close":
            self._reader.problems.clear()
            host.change(
                host.state.with_options(replace(host.state.options.poses, file="", pose=-1))
            )
        elif poses is None or not wish:
            return
        elif wish == "frame":
            self.frame(host, poses)
        elif wish == "lay":
            self.lay(host, poses)
        else:
            steps = {"next": 1, "previous": -1, "first": -BEYOND, "last": BEYOND}[wish]
            chosen = self.chosen(host.state)
            number = min(max(chosen + steps, 0), len(poses.names) - 1)
            if number != chosen:
                self.take(host, number)

    def frame(self, host: Host, poses: PoseSet) -> None:
        """Frame the whole set in the outside view."""
        host.travel(with_set_framed(host.state, poses, self._outside.size_px))

    # The photograph.

    def lay(self, host: Host, poses: PoseSet) -> None:
        """Lay the selected camera's photograph over the images, and later that of each camera that
        is visited; if this is on, turn it off.
        """
        state, chosen = host.state, self.chosen(host.state)
        if state.options.photograph.follows:
            host.change(closed(state))
        elif chosen >= 0:
            laid = state.with_options(replace(state.options.photograph, follows=True, shown=True))
            host.change(_photographed(laid, poses, chosen))

    def _photo(
        self, host: Host, poses: PoseSet, number: int
    ) -> tuple[moderngl.Texture | None, str, bool | None]:
        """Return the picture, its caption, and True if it is laid over the images."""
        assert self._uploads is not None
        dotted = host.state.options.poses.reprojected
        follows = host.state.options.photograph.follows
        found = self._photographs.of(poses, number, dotted)
        if found is None:  # the last one stays until then
            return self._uploads.get(PHOTO), "", follows or None
        self._upload(self._uploads, found)
        caption = found.problem
        if found.path is not None and not found.problem:
            caption = f"{found.size[0]} x {found.size[1]}, {one_line(found.path.name)}"
        laid = follows if follows or found.path is not None else None
        return self._uploads.get(PHOTO), caption, laid

    # In the outside view.

    def _hide(self) -> None:
        self._cloud.forget()  # it may be large
        self._outside.show(POSES, ())

    def _show_outside(self, host: Host, poses: PoseSet) -> None:
        chosen = self.chosen(host.state)
        self._outside.show(
            POSES,
            self._items(poses, chosen),
            cloud=self._cloud(poses, host.state.options.poses.points),
        )


def _upload(uploads: Uploads, found: Photograph) -> None:
    uploads.drop(PHOTO)
    if found.pixels is not None:
        uploads.put(PHOTO, found.pixels)


def _outside_items(poses: PoseSet, chosen: int) -> tuple[Item, ...]:
    """Return the frustum of the selected camera, distinct from the others, and its name."""
    if chosen < 0:
        return ()
    role: Role = "other"
    origins = poses.origins[chosen]
    ends, eye = origins + poses.length * poses.ways[chosen], origins.mean(axis=0)
    image = (Face("other pose", role, ends, 0.22),) if poses.parts == 1 else ()
    corner = ends[poses.parts]  # the name is beyond a corner of the image
    return (
        *image,
        Segments("other pose", role, frusta(poses, [chosen]), 2.6, hidden=0.7, layer=2),
        Dot("other pose", role, eye, 3.5),
        Label("other pose", role, one_line(poses.names[chosen]), corner, away=eye),
    )


def _photographed(state: AppState, poses: PoseSet, number: int) -> AppState:
    """Return the state with a camera's photograph over the images; none if the file names none."""
    path = photo_path(poses, number)
    return with_photograph(state, str(path.absolute()) if path is not None else None)
