"""Line drawings of image-making devices: pencil, brush, eye, camera, and the virtual camera."""

from __future__ import annotations

import math

import numpy as np

from lucida.app.instruments.outside.figure import Figure
from lucida.renderer.camera.checks import Floats

from .page import Page
from .sheet import BLACK, WHITE, YELLOW, Sheet, between, circle, mixed, reached, rectangle, rounded

ROOM, STEP = (15.5, 9.6), (16.0, 12.0)  # the size of each drawing, and the step to the next
FINE = 96  # points of outlines that morph into each other
EDGE = 0.16
BODY, LENS = rounded((3.6, 2.4), (8.2, 5.2), 0.6), circle((7.7, 5.0), 1.9)  # parts of the camera
FRAME = np.array([(7.6, 1.4), (11.0, 2.4), (11.0, 8.2), (7.6, 7.2)])  # the virtual camera's image
EYE = (3.4, 4.9)


def devices(page: Page) -> Figure:
    """Draw pencil and brush, then the eye, the camera, and the camera that turns into an eye and a
    frame.
    """
    sheet = page.sheet((31.5, 23.5))
    drawings = {"pencil, brush": _pencil_and_brush, "eye": _eye, "camera": _camera}
    for number, (caption, draw) in enumerate(drawings.items()):
        part = sheet.part(place(number), reached(page.progress, number))
        draw(part)
        part.word(caption, (ROOM[0] / 2, ROOM[1] + 0.9), 1.4, strong=True)
    turned = reached(page.progress, 3)
    if turned:
        _virtual(sheet.part(between(turned, (place(2), place(3)))), turned)
    return sheet.figure()


def place(number: int) -> Floats:
    """Return the upper left corner of a drawing's area."""
    return np.array([STEP[0] * (number % 2), STEP[1] * (number // 2)])


def _pencil_and_brush(sheet: Sheet) -> None:
    look = sheet.look
    for points, color in (
        ([(-3.6, -0.55), (2.0, -0.55), (2.0, 0.55), (-3.6, 0.55)], YELLOW),
        ([(2.0, -0.55), (3.6, 0.0), (2.0, 0.55)], mixed(look.ray, look.ground, 0.6)),
        ([(3.1, -0.17), (3.6, 0.0), (3.1, 0.17)], look.text),
        ([(-4.3, -0.55), (-3.6, -0.55), (-3.6, 0.55), (-4.3, 0.55)], look.u),
    ):
        sheet.part((4.6, 4.8)).shape(_turned(points, -0.9), color)
    hair = np.linspace(0, math.pi, 20)
    tip = np.stack([2.3 + 1.9 * np.sin(hair), -0.75 * np.cos(hair)], axis=1)
    for points, color in (
        ([(-4.2, -0.15), (1.1, -0.38), (1.1, 0.38), (-4.2, 0.15)], look.fill),
        ([(1.1, -0.5), (2.3, -0.75), (2.3, 0.75), (1.1, 0.5)], look.line),
        (tip.tolist(), look.w),
    ):
        sheet.part((10.6, 4.8)).shape(_turned(points, 2.2), color)


def _turned(points: list[tuple[float, float]], angle: float) -> Floats:
    cosine, sine = math.cos(angle), math.sin(angle)
    turned: Floats = np.array(points) @ np.array([(cosine, sine), (-sine, cosine)])
    return turned


def _eye(sheet: Sheet) -> None:
    eye, across = sheet.part((7.7, 4.9)), np.linspace(-1, 1, 40)
    lids = [
        np.stack([side * 5.2 * across, -side * height * (1 - across**2)], axis=1)
        for side, height in ((1, 2.9), (-1, 2.4))
    ]
    eye.shape(np.concatenate(lids), WHITE)
    for at, radius, color in (
        ((0.0, -0.2), 2.2, sheet.look.w),
        ((0.0, -0.2), 1.0, BLACK),
        ((0.6, -0.8), 0.4, WHITE),
    ):
        eye.disc(at, radius, color)
    for part in (-0.75, -0.4, 0.0, 0.4, 0.75):
        x, y = 5.2 * part, -2.9 * (1 - part**2) - 0.1
        eye.line([(x, y), (x + 0.8 * part, y - 0.9)], width=EDGE)


def _camera(sheet: Sheet) -> None:
    look = sheet.look
    for points, color in (
        (rectangle((5.4, 1.4), (3.2, 1.1)), look.fill),
        (rectangle((10.0, 1.8), (1.2, 0.7)), look.u),
        (BODY, look.fill),
        (LENS, look.ground),
        (circle((7.7, 5.0), 1.15), look.w),
    ):
        sheet.shape(points, color)


def _virtual(sheet: Sheet, turned: float) -> None:
    """Draw the camera turning into an eye and a frame of pixels. turned: 0 to 1."""
    look, grown = sheet.look, sheet.part(opacity=max(0.0, 2 * turned - 1))
    for corner in FRAME:
        grown.line([EYE, corner + 0.45 * (corner - EYE)], look.ray)
    frame = _even(FRAME)
    body = _even(BODY)
    body = np.roll(body, -int(np.argmin(np.linalg.norm(body - frame[0], axis=1))), axis=0)
    frame = between(turned, (body, frame))
    sheet.fill(frame, mixed(look.fill, look.ground, 0.5 * turned), 1 - 0.35 * turned)
    sheet.outline(frame, width=EDGE)
    for part in (0.25, 0.5, 0.75):
        for first, second, third, fourth in (FRAME, np.roll(FRAME, 1, axis=0)):
            ends = [between(part, (first, second)), between(part, (fourth, third))]
            grown.line(ends, look.text, 0.06)
    sheet.shape(between(turned, (LENS, circle(EYE, 0.55))), mixed(look.ground, look.text, turned))
    sheet.part(opacity=turned).word(
        "virtual camera", (ROOM[0] / 2, ROOM[1] + 0.9), 1.4, strong=True
    )
    grown.word("eye", (EYE[0], EYE[1] + 1.6), 1.3)
    grown.word("frame", (13.2, 4.9), 1.3)


def _even(points: Floats) -> Floats:
    """Return FINE points at equal distances along a closed outline."""
    closed = np.concatenate([points, points[:1]])
    run = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    places = np.arange(FINE) * run[-1] / FINE
    return np.stack([np.interp(places, run, closed[:, axis]) for axis in (0, 1)], axis=1)
