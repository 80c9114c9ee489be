"""The mistakes laboratory and its quiz in a page: the pictures that wrong lines make, made here."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from app.checking.mistakes.program import Mistake
from app.images.ray_pictures import RayPainter
from app.instruments.mistakes.model import Bytes, Situation, of_line, rays_of, shown, situation_of
from app.instruments.mistakes.question import LETTERS, question, reason
from app.lecture.model import Step
from app.state.app_state import AppState
from app.state.options.shared import Notation
from app.web.lecture.pictures import data_uri
from app.web.lecture.text import plain, written

SIZE = (160, 120)  # of the pictures, where a step leaves it to the window


@contextmanager
def _painter(state: AppState) -> Iterator[RayPainter]:
    from renderer.trace import Tracer

    with Tracer(state.scene) as tracer:
        yield RayPainter(state.scene, tracer, lambda: True)


def laboratory(number: str, state: AppState) -> str:
    """Return the program of a step's mistakes as HTML: each line may be made wrong, and the picture
    changes. The pictures of wrong lines are in templates.
    """
    now = situation_of(state, state.images.resolution or SIZE)
    notation = state.options.notation
    program = now.program.in_notation(notation)
    with _painter(state) as painter:
        right = _picture(painter, now, None)
        pictures = {one.name: _picture(painter, now, one) for one in now.program.mistakes}
    rows: list[str] = []
    templates: list[str] = []
    for line in program.lines:
        options = ["<option value=''>correct</option>"]
        for mistake in of_line(program, line.key):
            place = len(templates)
            options.append(f'<option value="{place}">{plain(mistake.name)}</option>')
            templates.append(_template(place, mistake, pictures[mistake.name], notation))
        rows.append(
            f'<li data-line="{plain(line.key)}"><pre tabindex="0"><code>{plain(line.code)}</code>'
            f'</pre><select aria-label="{plain(line.key)}: correct or wrong">{"".join(options)}'
            "</select></li>\n"
        )
    return (
        f'<div class="mistakes" data-step="{number}">\n<div class="pair">'
        f"{_figure(right, 'correct')}{_figure(right, 'as written')}</div>\n"
        f'<ol class="program">{"".join(rows)}</ol>\n<div class="reply" role="status"></div>\n'
        f"{''.join(templates)}</div>\n"
    )


def _template(place: int, mistake: Mistake, picture: Bytes, notation: Notation) -> str:
    lines = "".join(
        f'<pre data-line="{plain(key)}"><code>{plain(code)}</code></pre>'
        for key, code in mistake.lines
    )
    hint = written(mistake.hint, notation)
    image = _image(picture, f"The picture with the mistake: {mistake.name}")
    return (
        f'<template data-mistake="{place}">{image}{lines}'
        f'<div class="hint">{hint}</div></template>\n'
    )


def quiz(step: Step, state: AppState) -> tuple[str, dict[str, Any]] | None:
    """Return the quiz of a step, which picture a wrong line makes: its options as HTML, and the
    data that modules/exercise.js judges by. None if the camera tells too few pictures apart.
    """
    options = state.options.mistakes
    now = situation_of(state, state.images.resolution or SIZE)
    with _painter(state) as painter:
        asked = question(painter, now, options)
    if not asked.names:
        return None
    program = now.program.in_notation(state.options.notation)
    by_name = {one.name: one for one in program.mistakes}
    right = by_name[asked.names[asked.right_at]]
    items, judged = [], []
    for place, (name, light) in enumerate(zip(asked.names, asked.pictures, strict=True)):
        label = f"Picture {LETTERS[place]}"
        items.append(
            f'<li><button type="button" data-option="{place}" aria-pressed="false">'
            f"{_image(shown(light, 0.0), label)}</button></li>\n"
        )
        is_right = place == asked.right_at
        text = reason(program, asked.names, asked.right_at, name)
        mistake = "" if is_right else f"{right.name}: not recognised"
        judged.append({"right": is_right, "text": text, "mistake": mistake, "read": right.part})
    code = "".join(f'<pre tabindex="0"><code>{plain(code)}</code></pre>' for _, code in right.lines)
    html = (
        f'<div class="asked"><p>Which picture does this wrong line make?</p>{code}</div>\n'
        f'{_figure(shown(asked.right, 0.0), "correct")}<ol class="options pictures">'
        f"{''.join(items)}</ol>\n"
    )
    return html, {"options": judged, "step": step.title, "read": right.part}


def _picture(painter: RayPainter, now: Situation, mistake: Mistake | None) -> Bytes:
    origins, directions = rays_of(now, () if mistake is None else (mistake,))
    return shown(painter.picture(origins, directions, now.camera.t_range), 0.0)


def _image(picture: Bytes, alternative: str) -> str:
    height, width = picture.shape[:2]
    return (
        f'<img src="{data_uri(picture, is_exact=True)}" width="{width}" height="{height}" '
        f'alt="{plain(alternative)}">'
    )


def _figure(picture: Bytes, caption: str) -> str:
    image = _image(picture, f"The picture of the program, {caption}")
    return f"<figure>{image}<figcaption>{caption}</figcaption></figure>"
