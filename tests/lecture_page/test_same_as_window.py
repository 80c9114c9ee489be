"""A lecture's page shows what the window shows: builds, cameras, rays, marked pixels, drawings."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from html import unescape
from itertools import zip_longest
from typing import Any

import numpy as np
import pytest

from app.explaining.notation import text_tuple
from app.images.request import MIRROR_DEPTH
from app.laboratory.looks import look_of
from app.laboratory.options import LaboratoryOptions
from app.laboratory.page import Page
from app.laboratory.pages import drawn
from app.lecture.hiding import HideExercise
from app.lecture.model import Lecture, Step
from app.lecture.reading import BUILTIN, load_lecture
from app.lecture_page.page import Still, page
from app.outside.figure import Figure, Inset, Label
from app.outside.options import OutsideOptions
from app.page.bundle import bundle
from app.state.app_state import AppState
from app.widgets.theme import PRESENTED_DARK
from app.window.start import first_state
from renderer.camera import Camera, Size
from renderer.scene.views import view_from_table
from tests.support.browser import chromium

GRAY = np.full((30, 40, 3), 128, np.uint8)
DATA = re.compile(r'(?<=id="lucida-data">).*?(?=</script>)', re.DOTALL)
SECTION = re.compile(r'<section [^>]*?id="([\d.]+)".*?</section>', re.DOTALL)
SEEN = (320, 180)  # an image's size where a build says none: app/lecture_page/described.py
OUTSIDE: Size = (640, 420)  # of the outside view in modules/outside.js
WITH_RAY = ("raster", "ray", "outside", "compare", "mistakes")
RAY = re.compile(r"Pixel (\([^)]*\)) is marked: its ray has p = (\(.*?\)) and d = (\(.*?\)),")
Said = dict[str, Any]


@pytest.fixture(scope="module")
def lecture() -> Lecture:
    return load_lecture(BUILTIN)


@pytest.fixture(scope="module")
def html(lecture: Lecture) -> str:
    return page(lecture, [stills(build, state_of(lecture, build)) for build in lecture.builds])


@pytest.fixture(scope="module")
def shown(lecture: Lecture) -> list[Said]:
    return [*window_says(lecture)]


def state_of(lecture: Lecture, build: Step) -> AppState:
    return first_state(lecture, (build.number, build.build))


def stills(build: Step, state: AppState) -> list[Still]:
    given = page_of(state) if build.views == ("laboratory",) else None
    return [Still(view, GRAY, given) for view in build.views if view != "camera"]


def page_of(state: AppState) -> Page:
    options, look = state.of(LaboratoryOptions), look_of(PRESENTED_DARK)
    size = state.images.resolution or (64, 48)
    color = np.zeros((size[1], size[0], 3), np.float32)
    taken_ev, notation = state.images.exposure_ev, state.options.notation
    return Page((640, 480), look, options, color, taken_ev, options.point, notation)


def labels_of(figure: Figure) -> Iterator[str]:
    insets = [part.figure for part in figure.parts if isinstance(part, Inset)]
    yield from (part.text for part in figure.parts if isinstance(part, Label))
    for inset in insets:
        yield from labels_of(inset)


def numbers_of(camera: Camera) -> tuple[Camera, dict[str, float]]:
    """Return a camera without its lens, and what that distorts: a page names all of its numbers."""
    lens = camera.lens.coefficients if camera.lens else {}
    return replace(camera, lens=None), {name: value for name, value in lens.items() if value}


def window_says(lecture: Lecture) -> Iterator[Said]:
    """Yield what the window shows in each build."""
    for build in lecture.builds:
        state = state_of(lecture, build)
        size = state.images.resolution or SEEN
        name, camera = f"{build.number + 1}.{build.build + 1}", state.view.for_size(size)
        figure = drawn(page_of(state).options.page, page_of(state))
        ray = None
        if state.marked is not None:
            found = camera.ray(*state.marked, size)
            pixel = state.options.indexing.text(state.marked)
            ray = pixel, text_tuple(found.origin), text_tuple(found.direction)
        seen = [view for view in build.views if view != "camera"]
        with_ray = [view for view in seen if view in WITH_RAY]
        outside = state.of(OutsideOptions)
        yield {
            "name": name.removesuffix(".1"),
            "title": build.title,
            "views": seen,
            "rays": [ray] * len(with_ray) if ray else [],
            "labels": sorted({*labels_of(figure)}) if "laboratory" in seen else [],
            "must be open": isinstance(build.exercise, HideExercise),
            "camera": numbers_of(state.view.camera),
            "objects": [entry.name for entry in state.scene.objects],
            "size": state.images.resolution,
            "mark": state.images.resolution and state.marked,
            "shadows": state.options.shadows,
            "mirrors": MIRROR_DEPTH if state.options.mirrors else 0,
            "looking": outside.camera if "outside" in seen else None,
            "handles": outside.pixels or outside.gizmo != "none",
        }


def page_says(html: str) -> Iterator[Said]:
    """Yield what a page shows in each build; the camera and what follows, of a live figure only."""
    data = json.loads(DATA.search(html)[0])  # type: ignore[index]
    for match in SECTION.finditer(html):
        name, section = match[1], match[0]
        texts = re.findall(r'(?:alt|aria-label)="([^"]*)"', section)
        drawings = re.findall(r"<svg viewBox.*?</svg>\s*<figcaption", section, re.DOTALL)
        words = re.findall(r"<text[^>]*>(.*?)</text>", "".join(drawings))
        said: Said = {
            "name": name,
            "title": unescape(re.search(r"<h2[^>]*>(.*?)</h2>", section)[1]),  # type: ignore[index]
            "views": re.findall(r'<figure class="view of-([\w-]+)', section.replace(" still", "")),
            "rays": [ray.groups() for text in texts if (ray := RAY.search(unescape(text)))],
            "labels": sorted({unescape(re.sub(r"<.*?>", "", word)) for word in words}),
        }
        figure = data["figures"].get(name)
        if figure is not None:
            options, scene = figure["options"], data["scenes"][figure["scene"]]
            looking = options.get("outside", {}).get("camera")
            said |= {
                "must be open": figure["open"] and "controls" not in figure["shows"],
                "camera": numbers_of(view_from_table(figure["camera"]).camera),
                "objects": scene["names"],
                "size": options.get("size") and tuple(options["size"]),
                "mark": options.get("mark") and tuple(options["mark"]),
                "shadows": options["effects"]["shadows"],
                "mirrors": options["effects"]["mirrors"],
                "looking": looking and view_from_table(looking).camera,
            }
        yield said


def differences(shown: list[Said], html: str) -> list[str]:
    """Return what a page shows otherwise than the window. shown: there."""
    found = []
    for wanted, said in zip_longest(shown, page_says(html), fillvalue={}):
        found += [
            f"{wanted.get('name')}: {key} is {said[key]!r}, not {wanted.get(key)!r}"
            for key in said
            if said[key] != wanted.get(key)
        ]
        if not said or (wanted.get("handles") and "camera" not in said):
            found.append(f"{wanted['name']}: is missing, or has no handles")
    return found


def test_the_page_shows_what_the_window_shows(shown: list[Said], html: str) -> None:
    assert differences(shown, html) == []


def _of_figures(change: Callable[[dict[str, Any]], Any], part: str) -> Callable[[str], str]:
    """Return a fault in the data of the first figure that has a part of its options."""

    def spoil(html: str) -> str:
        data = json.loads(DATA.search(html)[0])  # type: ignore[index]
        change(next(one for one in data["figures"].values() if part in one["options"]))
        return DATA.sub(lambda _: json.dumps(data).replace("<", "\\u003c"), html)

    return spoil


FAULTS: dict[str, Callable[[str], str]] = {
    "a build is missing": lambda html: SECTION.sub("", html, count=1),
    "a picture is missing": lambda html: re.sub('<figure class="view', "<figure ", html, count=1),
    "a title": lambda html: html.replace('tabindex="-1">', 'tabindex="-1">Not ', 1),
    "a ray's direction": lambda html: html.replace(" and d = (", " and d = (-", 1),
    "a marked pixel in words": lambda html: html.replace("Pixel (", "Pixel (1", 1),
    "a word of a drawing": lambda html: re.sub(r"(<text[^>]*>)", r"\1not ", html, count=2),
    "a camera": _of_figures(lambda one: one["camera"]["eye"].reverse(), "mark"),
    "a camera from outside": _of_figures(
        lambda one: one["options"]["outside"]["camera"]["eye"].reverse(), "outside"
    ),
    "a marked pixel": _of_figures(lambda one: one["options"].update(mark=[0, 0]), "mark"),
    "an image's size": _of_figures(lambda one: one["options"].update(size=[9, 9]), "size"),
    "another scene": _of_figures(lambda one: one.update(scene=one["scene"] ^ 1), "mark"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_found(shown: list[Said], html: str, fault: str) -> None:
    spoiled = FAULTS[fault](html)
    assert spoiled != html
    assert differences(shown, spoiled)


def test_live_figures_have_the_rays_and_frames_of_the_window(lecture: Lecture, html: str) -> None:
    """Of all figures at once, because no element of a page is needed."""
    data = json.loads(DATA.search(html)[0])  # type: ignore[index]
    script = (
        "(figures) => {" + bundle("camera.js") + """
        return figures.map(({ camera, size, corners, mark, looking, frame }) => {
          const fitted = cameraForSize(camera, size);
          const on = ([x, y]) => imagePoint(fitted, y - 0.5, x - 0.5, size);
          const at = (corner) => imagePlanePoint(fitted, ...on(corner));
          const ray = viewingRay(fitted, ...mark, size);
          const seen = looking ? corners.map((one) => project(looking, at(one), frame)) : [];
          const places = seen.map(({ column, row }) => [column, row]);
          return [ray.origin, ray.direction, corners.map(at), places];
        }); }"""
    )  # fmt: skip
    wanted, given = [], []
    for build in lecture.builds:
        figure = data["figures"].get(f"{build.number + 1}.{build.build + 1}".removesuffix(".1"))
        if figure is None:
            continue
        state = state_of(lecture, build)
        size = state.images.resolution or SEEN
        mark = state.marked or (1, 2)
        corners = [(0, 0), (size[0], 0), (size[0], size[1]), (0, size[1])]
        looking = figure["options"].get("outside", {}).get("camera")
        given.append(
            {"camera": figure["camera"], "size": size, "corners": corners, "mark": mark,
             "looking": looking, "frame": OUTSIDE}
        )  # fmt: skip
        camera = state.view.for_size(size)
        ray, frame = camera.ray(*mark, size), [_corner(camera, size, *one) for one in corners]
        seen = []
        if looking is not None:
            outside = state.of(OutsideOptions).camera
            assert outside is not None
            seen = [outside.project(one, OUTSIDE)[:2][::-1] for one in frame]
        wanted.append([ray.origin, ray.direction, frame, seen])
    with chromium() as browser:
        found = browser.new_page().evaluate(script, given)
    assert len(given) > 15
    for theirs, ours in zip(found, wanted, strict=True):
        for one, other in zip(theirs, ours, strict=True):
            np.testing.assert_allclose(np.array(one, float), np.array(other, float), atol=1e-9)


def _corner(camera: Camera, size: Size, x: float, y: float) -> np.ndarray:
    """Return the point of the image plane at a corner of pixels."""
    left, right, bottom, top = camera.viewport
    u, v = left + (right - left) * x / size[0], top - (top - bottom) * y / size[1]
    depth = 0.0 if camera.is_parallel else camera.distance
    eye, *basis = (np.asarray(one, float) for one in (camera.eye, camera.u, camera.v, camera.w))
    return eye + u * basis[0] + v * basis[1] - depth * basis[2]
