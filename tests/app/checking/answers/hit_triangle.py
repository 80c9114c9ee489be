"""Answers to hit-triangle."""

import math

import numpy as np


def _solved(o, d, a, b, c):
    o, d, a, b, c = (np.array(part, float) for part in (o, d, a, b, c))
    n = np.cross(b - a, c - a)
    if abs(n @ d) < 1e-9:
        return None
    t = n @ (a - o) / (n @ d)
    return o + t * d, t, n


def right_inside_out(origin, direction, a, b, c):
    found = _solved(origin, direction, a, b, c)
    if found is None:
        return None
    p, t, n = found
    corners = [np.array(x) for x in (a, b, c)]
    inside = all(
        np.cross(corners[(k + 1) % 3] - corners[k], p - corners[k]) @ n > 0 for k in range(3)
    )
    return t if inside and t > 0 else None


def right_matrix(origin, direction, a, b, c):
    m = np.column_stack([np.subtract(a, b), np.subtract(a, c), direction])
    try:
        beta, gamma, t = np.linalg.solve(m, np.subtract(a, origin))
    except np.linalg.LinAlgError:
        return None
    return float(t) if t > 0 and beta > 0 and gamma > 0 and beta + gamma < 1 else math.inf


def right_moller_trumbore(origin, direction, a, b, c):
    e1, e2 = np.subtract(b, a), np.subtract(c, a)
    p = np.cross(direction, e2)
    det = e1 @ p
    if abs(det) < 1e-10:
        return False
    s = np.subtract(origin, a)
    u = s @ p / det
    q = np.cross(s, e1)
    v = np.dot(direction, q) / det
    if u < 0 or v < 0 or u + v > 1:
        return False
    t = e2 @ q / det
    return t if t > 0 else False


def wrong_plane(origin, direction, a, b, c):
    found = _solved(origin, direction, a, b, c)
    return found[1] if found and found[1] > 0 else None


def wrong_always(origin, direction, a, b, c):
    return 1.0


def wrong_never(origin, direction, a, b, c):
    return None


def unusable_division(origin, direction, a, b, c):
    n = [float(x) for x in np.cross(np.subtract(b, a), np.subtract(c, a))]
    return 1 / sum(x * y for x, y in zip(n, direction))
