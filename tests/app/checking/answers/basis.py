"""Answers to basis."""

import math

import numpy as np


def _unit(a):
    length = math.sqrt(sum(part * part for part in a))
    return tuple(part / length for part in a)


def _cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def right_tuples(eye, target, up):
    w = _unit([e - t for e, t in zip(eye, target)])
    u = _unit(_cross(up, w))
    return u, _cross(w, u), w


def right_arrays(eye, target, up):
    w = np.subtract(eye, target)
    w /= np.linalg.norm(w)
    u = np.cross(up, w)
    u /= np.linalg.norm(u)
    return np.array([u, np.cross(w, u), w])


def right_float32(eye, target, up):
    eye, target, up = np.float32([eye, target, up])
    w = (eye - target) / np.linalg.norm(eye - target)
    u = np.cross(up, w)
    u = u / np.linalg.norm(u)
    return {"w": w, "u": u, "v": np.cross(w, u)}


def wrong_upside_down(eye, target, up):
    u, v, w = right_arrays(eye, target, up)
    return u, -v, w


def wrong_transposed(eye, target, up):
    return right_arrays(eye, target, up).T


def unusable_none(eye, target, up):
    return None
