"""Answers to hit-sphere."""

import math

import numpy as np


def _roots(o, d, c, r):
    a = sum(x * x for x in d)
    b = 2 * sum((x - y) * z for x, y, z in zip(o, c, d))
    k = sum((x - y) ** 2 for x, y in zip(o, c)) - r * r
    return a, b, b * b - 4 * a * k


def right_quadratic(origin, direction, center, radius):
    a, b, disc = _roots(origin, direction, center, radius)
    if disc < 0:
        return None
    near, far = (-b - math.sqrt(disc)) / (2 * a), (-b + math.sqrt(disc)) / (2 * a)
    if near > 0:
        return near
    return far if far > 0 else None


def right_geometric(origin, direction, center, radius):
    o, d, c = (np.array(part) for part in (origin, direction, center))
    length = np.linalg.norm(d)
    d = d / length
    along = (c - o) @ d
    aside = np.sum((c - o) ** 2) - along**2
    if aside > radius**2:
        return math.inf
    half = np.sqrt(radius**2 - aside)
    for t in (along - half, along + half):
        if t > 1e-6:
            return t / length
    return math.inf


def right_false(origin, direction, center, radius):
    found = right_quadratic(origin, direction, center, radius)
    return found if found else False


def wrong_far_root(origin, direction, center, radius):
    a, b, disc = _roots(origin, direction, center, radius)
    t = (-b + math.sqrt(max(disc, 0))) / (2 * a)
    return t if disc > 0 and t > 0 else None


def wrong_never(origin, direction, center, radius):
    return None


def unusable_exception(origin, direction, center, radius):
    return math.sqrt(_roots(origin, direction, center, radius)[2])
