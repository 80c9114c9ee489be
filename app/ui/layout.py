"""Layouts of docked windows.

A layout is one table of its splits and of the space of each view that it shows. Hidden views are
docked in their own space, or in INSTRUMENTS if the layout lacks that. HelloImGui keeps the user's
changes of each layout, also between runs.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from imgui_bundle import hello_imgui, imgui

from .instrument import Instrument

MAIN = "MainDockSpace"  # HelloImGui's own name for the rest
CAMERA_SPACE = "CameraSpace"
RIGHT_SPACE = "RightSpace"  # next to MAIN, at the same size
LOWER_SPACE = "LowerSpace"  # below MAIN
STACKED_SPACE = "StackedSpace"  # below a lecture's first picture, whose LOWER_SPACE is next to it
INSTRUMENTS = "InstrumentSpace"  # below or next to it: tabs

CAMERA_WIDTH_EM, LEAST_CAMERA_EM = 19.5, 14.5
LECTURE = "Lecture"  # the views of a lecture, which each step arranges
OUTSIDE, LOOPS = "Outside view", "Loops"

Split = tuple[str, str, imgui.Dir, float]  # space, new space, direction, its share


@dataclass(frozen=True)
class Layout:
    """A layout.

    use: its purpose, in words. places: the space of each view that it shows, in the tabs' order.
    """

    name: str
    use: str
    splits: tuple[Split, ...]
    places: dict[str, str]


LEFT, RIGHT, UP, DOWN = imgui.Dir.left, imgui.Dir.right, imgui.Dir.up, imgui.Dir.down
_CAMERA: Split = (MAIN, CAMERA_SPACE, LEFT, 0.0)  # its width is the panel's
_ONE_LARGE = (_CAMERA, (MAIN, INSTRUMENTS, RIGHT, 0.34), (INSTRUMENTS, RIGHT_SPACE, UP, 0.5))

LAYOUTS = (
    Layout(
        "Side by side",
        "Both images, and the camera's numbers.",
        (
            _CAMERA,
            (MAIN, INSTRUMENTS, DOWN, 0.4),
            (MAIN, RIGHT_SPACE, RIGHT, 0.5),
        ),
        {"Camera": CAMERA_SPACE, "Raster": MAIN, "Ray": RIGHT_SPACE},
    ),
    Layout(
        "Four views",
        "Both images, the scene from outside, and where the images differ.",
        (
            _CAMERA,
            (MAIN, RIGHT_SPACE, RIGHT, 0.5),
            (MAIN, LOWER_SPACE, DOWN, 0.5),
            (RIGHT_SPACE, INSTRUMENTS, DOWN, 0.5),
        ),
        {
            "Camera": CAMERA_SPACE,
            "Raster": MAIN,
            "Ray": RIGHT_SPACE,
            "Outside": LOWER_SPACE,
            "Compare": INSTRUMENTS,
        },
    ),
    Layout(
        OUTSIDE,
        "The scene and the camera in it, large, with both images.",
        _ONE_LARGE,
        {"Camera": CAMERA_SPACE, "Outside": MAIN, "Raster": RIGHT_SPACE, "Ray": INSTRUMENTS},
    ),
    Layout(
        "Compare",
        "The difference of the images, pixel by pixel, with its causes.",
        _ONE_LARGE,
        {"Camera": CAMERA_SPACE, "Compare": MAIN, "Raster": RIGHT_SPACE, "Ray": INSTRUMENTS},
    ),
    Layout(
        "Probe",
        "One pixel's numbers and formulas, with its ray from outside.",
        (
            _CAMERA,
            (MAIN, INSTRUMENTS, RIGHT, 0.46),
            (MAIN, LOWER_SPACE, DOWN, 0.62),
            (MAIN, RIGHT_SPACE, RIGHT, 0.5),
        ),
        {
            "Camera": CAMERA_SPACE,
            "Raster": MAIN,
            "Ray": RIGHT_SPACE,
            "Outside": LOWER_SPACE,
            "Probe": INSTRUMENTS,
        },
    ),
    Layout(
        LOOPS,
        "Object order and image order, step by step, next to their code.",
        (
            (MAIN, RIGHT_SPACE, RIGHT, 0.27),
            (RIGHT_SPACE, INSTRUMENTS, DOWN, 0.5),
        ),
        {
            "Stepper": MAIN,
            "Outside": RIGHT_SPACE,
            "Raster": INSTRUMENTS,
            "Ray": INSTRUMENTS,
        },
    ),
    Layout(
        LECTURE,
        "A lecture's text, and what its step shows.",
        (
            (MAIN, RIGHT_SPACE, RIGHT, 0.33),
            (MAIN, LOWER_SPACE, RIGHT, 0.5),
            (MAIN, STACKED_SPACE, DOWN, 0.5),
            (RIGHT_SPACE, INSTRUMENTS, DOWN, 0.45),
        ),
        {"Raster": MAIN, "Ray": MAIN, "Outside": MAIN, "Lecture": RIGHT_SPACE},
    ),
)
CHOICES = LAYOUTS[:-1]  # a lecture chooses the last one


def docking(
    views: Sequence[Instrument],
    draw: Callable[[Instrument], Callable[[], None]],
    window_px: tuple[float, float],
    em_px: float,
) -> list[hello_imgui.DockingParams]:
    """Return every layout in HelloImGui's form; the first is the default.

    draw: returns the function that draws a view's window.
    """
    splits = functools.partial(_splits, window_px=window_px, em_px=em_px)
    return [_docking(layout, views, draw, splits(layout)) for layout in LAYOUTS]


def window_px() -> tuple[float, float]:
    """Return the size of the present window."""
    size = imgui.get_io().display_size
    return size.x, size.y


def camera_width_px(window_width_px: float, em_px: float) -> float:
    """Return the width that the camera panel needs for its numbers.

    It is at most half of a small window, or more if even short numbers would not fit.
    """
    half, most = 0.5 * window_width_px, 0.62 * window_width_px
    return max(min(half, CAMERA_WIDTH_EM * em_px), min(most, LEAST_CAMERA_EM * em_px))


def current() -> Layout:
    """Return the current layout."""
    name = hello_imgui.current_layout_name()
    return next((layout for layout in LAYOUTS if layout.name == name), LAYOUTS[0])


def switch(name: str) -> None:
    """Switch to another layout, as the user left it."""
    if name != hello_imgui.current_layout_name() and any(name == one.name for one in LAYOUTS):
        hello_imgui.switch_layout(name)


def reset() -> None:
    """Reset the current layout."""
    hello_imgui.get_runner_params().docking_params.layout_reset = True


def window_of(view: Instrument) -> hello_imgui.DockableWindow:
    """Return HelloImGui's record of a view in the current layout, which has its visibility."""
    params = hello_imgui.get_runner_params().docking_params
    window = params.dockable_window_of_name(view.label)
    assert window is not None, view.label
    return window


def is_placed(view: Instrument) -> bool:
    """Return True if ImGui draws a view's window in this frame, or a window that covers it as a
    tab.

    ImGui does not draw a window while it moves to a dock.
    """
    window = imgui.internal.find_window_by_name(view.label)
    if window is not None and window.dock_node is not None:
        window = window.dock_node.visible_window
    return window is not None and not window.hidden


def is_to_be_made() -> bool:
    """Return True if the next frame creates a layout's dock spaces again."""
    return bool(hello_imgui.get_runner_params().docking_params.layout_reset)


def arrange(views: Iterable[Instrument], places: dict[str, str]) -> None:
    """Show some of these views in other spaces of the present layout, and hide the rest.

    places: the space of each view. The change takes effect in the next frame; views that the user
    moved return to the layout's place. proportion.py sets the sizes of the spaces.
    """
    layout = current()
    for view in views:
        window = window_of(view)
        window.is_visible = view.name in places
        if view.name in places:
            window.dock_space_name = _own(layout, places[view.name])
    reset()


def whole() -> tuple[tuple[float, float], tuple[float, float]] | None:
    """Return the position and the size of all views together, in ImGui's pixels."""
    params = hello_imgui.get_runner_params().docking_params
    number = params.dock_space_id_from_name(MAIN)
    node = imgui.internal.dock_builder_get_node(number) if number is not None else None
    if node is None:
        return None
    while parent := node.parent_node:
        node = parent
    return (node.pos.x, node.pos.y), (node.size.x, node.size.y)


def _docking(
    layout: Layout,
    views: Sequence[Instrument],
    draw: Callable[[Instrument], Callable[[], None]],
    splits: list[hello_imgui.DockingSplit],
) -> hello_imgui.DockingParams:
    params = hello_imgui.DockingParams()
    params.layout_name = layout.name
    params.docking_splits = splits
    windows, spaces = [], {MAIN, *(new for _, new, _, _ in layout.splits)}
    for view in views:
        space = layout.places.get(view.name, view.space or MAIN)
        if space not in spaces:
            space = INSTRUMENTS
        window = hello_imgui.DockableWindow(view.label, _own(layout, space), draw(view))
        window.is_visible = view.name in layout.places
        window.call_begin_end = False
        windows.append(window)
    params.dockable_windows = windows
    flags = imgui.internal.DockNodeFlagsPrivate_
    # A tab has a close button already; a lecture has no tabs.
    bare = flags.no_tab_bar if layout.name == LECTURE else flags.no_close_button
    params.main_dock_space_node_flags = int(bare)
    return params


def _splits(
    layout: Layout, window_px: tuple[float, float], em_px: float
) -> list[hello_imgui.DockingSplit]:
    camera = camera_width_px(window_px[0], em_px) / window_px[0]
    return [
        _split(_own(layout, space), _own(layout, new), to, part or camera)
        for space, new, to, part in layout.splits
    ]


def _own(layout: Layout, space: str) -> str:
    """Return a layout's own name for a space: HelloImGui has one table of names for all layouts."""
    return MAIN if space == MAIN else f"{space} of {layout.name}"


def node_of(space: str) -> imgui.internal.DockNode | None:
    """Return a dock space of the current layout; None while it does not exist."""
    params = hello_imgui.get_runner_params().docking_params
    number = params.dock_space_id_from_name(_own(current(), space))
    node = imgui.internal.dock_builder_get_node(number) if number is not None else None
    if space == MAIN and node is not None:
        return node.central_node or node  # the name is that of the root around it
    return node


def _split(
    space: str, new_space: str, direction: imgui.Dir, ratio: float
) -> hello_imgui.DockingSplit:
    split = hello_imgui.DockingSplit()
    split.initial_dock, split.new_dock = space, new_space
    split.direction, split.ratio = direction, ratio
    if new_space.endswith(f" of {LECTURE}"):
        split.node_flags = int(imgui.internal.DockNodeFlagsPrivate_.no_tab_bar)
    return split
