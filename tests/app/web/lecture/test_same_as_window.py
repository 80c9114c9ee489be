"""A lecture's page shows what the window shows: builds, cameras, rays, marked pixels, drawings."""

import json
import re
from dataclasses import replace
from html import unescape
from itertools import zip_longest
from typing import Any

import numpy as np
import pytest

from lucida.app.images.request import MIRROR_DEPTH
from lucida.app.instruments.laboratory.looks import look_of
from lucida.app.instruments.laboratory.page import Page
from lucida.app.instruments.laboratory.pages import drawn
from lucida.app.instruments.outside.figure import Inset, Label
from lucida.app.lecture.exercises import ChoiceExercise
from lucida.app.lecture.hiding import HideExercise
from lucida.app.ui.explaining.notation import text_tuple
from lucida.app.ui.palettes import PRESENTED_DARK
from lucida.app.web.lecture.page import Still, page
from lucida.app.window.start import first_state
from lucida.renderer.files.views import view_from_table

GRAY = np.full((30, 40, 3), 128, np.uint8)
DATA = re.compile(r'(?<=id="lucida-data">).*?(?=</script>)', re.DOTALL)
SECTION = re.compile(r'<section [^>]*?id="([\d.]+)".*?</section>', re.DOTALL)
SEEN = (320, 180)  # an image's size where a build says none: app/web/lecture/described.py
WITH_RAY = ("raster", "ray", "outside", "compare", "mistakes")
RAY = re.compile(r"Pixel (\([^)]*\)) is marked: its ray has p = (\(.*?\)) and d = (\(.*?\)),")
Said = dict[str, Any]


@pytest.fixture(scope="module")
def html(lecture):
    return page(lecture, [stills(build, state_of(lecture, build)) for build in lecture.builds])


@pytest.fixture(scope="module")
def shown(lecture):
    return [*window_says(lecture)]


def state_of(lecture, build):
    return first_state(lecture, (build.number, build.build))


def stills(build, state):
    given = (page_of(state), page_of(state)) if build.views == ("laboratory",) else None
    return [Still(view, GRAY, given) for view in build.views]


def page_of(state):
    options, look = state.options.laboratory, look_of(PRESENTED_DARK)
    size = state.images.resolution or (64, 48)
    color = np.zeros((size[1], size[0], 3), np.float32)
    return Page((640, 480), look, options, color, state.images.exposure_ev, options.point)


def labels_of(figure):
    insets = [part.figure for part in figure.parts if isinstance(part, Inset)]
    yield from (part.text for part in figure.parts if isinstance(part, Label))
    for inset in insets:
        yield from labels_of(inset)


def numbers_of(camera):
    """Return a camera without its lens, and what that distorts: a page names all of its numbers."""
    lens = camera.lens.coefficients if camera.lens else {}
    return replace(camera, lens=None), {name: value for name, value in lens.items() if value}


def window_says(lecture):
    """Yield what the window shows in each build."""
    for build in lecture.builds:
        state = state_of(lecture, build)
        size = state.images.resolution or SEEN
        name, camera = f"{build.number + 1}.{build.build + 1}", state.view.for_size(size)
        figure = drawn(page_of(state))
        ray = None
        if state.marked is not None:
            found = camera.ray(*state.marked, size)
            pixel = state.options.indexing.text(state.marked)
            ray = pixel, text_tuple(found.origin), text_tuple(found.direction)
        seen = list(build.views)
        with_ray = [view for view in seen if view in WITH_RAY]
        outside = state.options.outside
        yield {
            "name": name.removesuffix(".1"),
            "title": build.title,
            "views": seen,
            "rays": [ray] * len(with_ray) if ray else [],
            "labels": sorted({*labels_of(figure)}) if "laboratory" in seen else [],
            "must be open": isinstance(build.exercise, HideExercise | ChoiceExercise),
            "camera": numbers_of(state.view.camera),
            "objects": [entry.name for entry in state.scene.objects],
            "size": state.images.resolution,
            "mark": state.images.resolution and state.marked,
            "shadows": state.options.shadows,
            "mirrors": MIRROR_DEPTH if state.options.mirrors else 0,
            "looking": outside.camera if "outside" in seen else None,
            "handles": outside.pixels or outside.gizmo != "none",
        }


def page_says(html):
    """Yield what a page shows in each build; the camera and what follows, of a live figure only."""
    data = json.loads(DATA.search(html)[0])
    for match in SECTION.finditer(html):
        name, section = match[1], match[0]
        texts = re.findall(r'(?:alt|aria-label)="([^"]*)"', section)
        drawings = re.findall(r"<svg viewBox.*?</svg>\s*<figcaption", section, re.DOTALL)
        words = re.findall(r"<text[^>]*>(.*?)</text>", "".join(drawings))
        said = {
            "name": name,
            "title": unescape(re.search(r"<h2[^>]*>(.*?)</h2>", section)[1]),
            "views": re.findall(r'<figure class="view of-([\w-]+)', section.replace(" still", "")),
            "rays": [ray.groups() for text in texts if (ray := RAY.search(unescape(text)))],
            "labels": sorted({unescape(re.sub(r"<.*?>", "", word)) for word in words}),
        }
        figure = data["figures"].get(name)
        if figure is not None:
            options, scene = figure["options"], data["scenes"][figure["scene"]]
            looking = options.get("outside", {}).get("camera")
            said |= {
                "must be open": figure["open"],
                "camera": numbers_of(view_from_table(figure["camera"]).camera),
                "objects": scene["names"],
                "size": options.get("size") and tuple(options["size"]),
                "mark": options.get("mark") and tuple(options["mark"]),
                "shadows": options["effects"]["shadows"],
                "mirrors": options["effects"]["mirrors"],
                "looking": looking and view_from_table(looking).camera,
            }
        yield said


def differences(shown, html):
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


def test_the_page_shows_what_the_window_shows(shown, html):
    assert differences(shown, html) == []
