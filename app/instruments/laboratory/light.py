"""Three projectors, whose light adds where their discs overlap."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from lucida.app.instruments.outside.figure import Color, Figure
from lucida.renderer.camera.checks import Floats

from .page import Page
from .sheet import BLACK, LIGHTS, WALL, between, circle, mixed, reached, rectangle

# The centres of red, green and blue at distance 1 from the middle: an upright triangle.
APART = ((0.0, -1.0), (-0.866, 0.5), (0.866, 0.5))
CENTER, RADIUS = (13.0, 8.9), 3.9
DISTANCES = 4.6, 2.3, 0.0  # from each disc to the middle, in the three builds
WALL_BOTTOM, LENS_Y = 16.4, 20.0
# Where the words for two discs are, from the middle: away from red, green and blue.
OUTSIDE = ((0.0, 6.7), (7.2, -3.35), (-7.2, -3.35))
SUMS = {(0, 1): "yellow", (1, 2): "cyan", (0, 2): "magenta"}
FINE = 720  # corners of the discs whose overlaps are computed


def projectors(page: Page) -> Figure:
    """Draw three discs of light on a wall. They overlap with build 1, and are one with build 2."""
    sheet = page.sheet((26, 22))
    sheet.fill(rectangle((0.5, 0), (25, WALL_BOTTOM)), WALL)
    centers = discs(page.progress)
    for channel, lens_x in enumerate((13.0, 8.0, 18.0)):
        light, x = LIGHTS[channel], centers[channel][0]
        ends = [lens_x + (end - lens_x) * 0.42 for end in (x - RADIUS, x + RADIUS)]
        sheet.fill([(lens_x, LENS_Y), *((end, WALL_BOTTOM) for end in ends)], light, 0.3)
        sheet.fill(rectangle((lens_x - 1.4, LENS_Y), (2.8, 1.8)), page.look.fill)
        sheet.fill(rectangle((lens_x - 0.5, LENS_Y - 0.3), (1.0, 0.4)), light)
    for count in (1, 2, 3):
        for channels in combinations(range(3), count):
            region = overlap(centers[list(channels)], RADIUS)
            if len(region):
                sheet.fill(region, sum_of(channels))
    overlapping = min(reached(page.progress, 1), 1 - reached(page.progress, 2))
    for channels, name in SUMS.items():
        at, color = np.add(CENTER, OUTSIDE[3 - sum(channels)]), sum_of(channels)
        sheet.word(name, at, 1.3, mixed(WALL, color, overlapping), float(overlapping > 0),
                   strong=True, rim=False)  # fmt: skip
    sheet.word("white", CENTER, 1.15, BLACK, float(page.progress >= 1), strong=True, rim=False)
    return sheet.figure()


def discs(progress: float) -> Floats:
    """Return the centres of the red, green and blue disc: (3, 2)."""
    found: Floats = np.array(CENTER) + between(progress, DISTANCES) * np.array(APART)
    return found


def overlap(centers: Floats, radius: float) -> Floats:
    """Return the convex region (n, 2) that equal discs have in common; empty if there is none."""
    points = np.concatenate([circle(center, radius, FINE) for center in centers])
    away = np.linalg.norm(points[:, None] - centers, axis=2)
    points = points[(away < radius + 1e-9).all(axis=1)]
    if len(points) < 3:
        return np.zeros((0, 2))
    x, y = (points - points.mean(axis=0)).T
    order: Floats = points[np.argsort(np.arctan2(y, x), kind="stable")]
    every = max(1, len(order) // 180)
    return order[::every]


def sum_of(channels: tuple[int, ...]) -> Color:
    """Return the colour of full red, green and blue light together."""
    red, green, blue = (float(channel in channels) for channel in range(3))
    return red, green, blue
