"""The box for the resolution of both images."""

from __future__ import annotations

from lucida.app.images.imaging import parsed_size, size_text, with_resolution
from lucida.app.ui.entry_box import EntryBox
from lucida.app.ui.host import Host


def ask_resolution(host: Host) -> None:
    """Open the box for the images' resolution."""

    def enter(texts: tuple[str, ...]) -> None:
        host.change(with_resolution(host.state, parsed_size(texts[0])))

    fields = {"width x height": size_text(host.state.images.resolution or host.renderers.size)}
    rule = "16 x 9 to 4096 x 2160 and beyond; 4 x 3 as on the blackboard"
    host.box = EntryBox("Resolution of both images", fields, "Draw", rule, enter, 10.0)
