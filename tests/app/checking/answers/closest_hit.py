"""Answers to closest-hit."""

import math

import hit_sphere
import hit_triangle
import numpy as np


def _hit(origin, direction, thing):
    if thing.type == "sphere":
        return hit_sphere.right_quadratic(origin, direction, thing.center, thing.radius)
    return hit_triangle.right_inside_out(origin, direction, thing.a, thing.b, thing.c)


def _hits(origin, direction, objects):
    for number, thing in enumerate(objects):
        t = _hit(origin, direction, thing)
        if t is not None:
            yield number, t


def right_loop(origin, direction, objects):
    nearest, which = math.inf, None
    for number, t in _hits(origin, direction, objects):
        if t < nearest:
            nearest, which = t, number
    return None if which is None else (which, nearest)


def right_arrays(origin, direction, objects):
    found = [
        hit_sphere.right_geometric(origin, direction, o["center"], o["radius"])
        if o["type"] == "sphere"
        else hit_triangle.right_moller_trumbore(origin, direction, o["a"], o["b"], o["c"]) or np.inf
        for o in objects
    ]
    if not found or np.isinf(min(found)):
        return -1, np.inf
    return np.argmin(found), np.min(found)


def right_dict(origin, direction, objects):
    found = right_loop(origin, direction, objects)
    return {"object": found[0], "t": found[1]} if found else {"object": None, "t": math.inf}


def wrong_last(origin, direction, objects):
    found = list(_hits(origin, direction, objects))
    return found[-1] if found else None


def wrong_from_one(origin, direction, objects):
    found = right_loop(origin, direction, objects)
    return found and (found[0] + 1, found[1])


def unusable_number(origin, direction, objects):
    return 3
