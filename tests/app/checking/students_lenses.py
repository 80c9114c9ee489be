"""Answers to project, project-fisheye and undistort, the task's name after right_, wrong_, ..."""

import math

import numpy as np


def _distorted(a, b, k1, k2, p1, p2, k3):
    r2 = a * a + b * b
    radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
    return (
        a * radial + 2 * p1 * a * b + p2 * (r2 + 2 * a * a),
        b * radial + p1 * (r2 + 2 * b * b) + 2 * p2 * a * b,
    )


def right_project_tuple(point, fx, fy, cx, cy, k1, k2, p1, p2, k3):
    x, y, z = point
    a, b = _distorted(x / z, y / z, k1, k2, p1, p2, k3)
    return fx * a + cx, fy * b + cy


def right_project_array(*given):
    return np.array(right_project_tuple(*given))


def right_project_named(*given):
    return dict(zip(("row", "column"), right_project_tuple(*given)[::-1]))


def wrong_project_nan(*given):
    return math.nan, math.nan


def wrong_project_pinhole(point, fx, fy, cx, cy, *coefficients):
    return fx * point[0] / point[2] + cx, fy * point[1] / point[2] + cy


def unusable_project_none(*given):
    return None


def right_fisheye_atan2(point, fx, fy, cx, cy, k1, k2, k3, k4):
    x, y, z = point
    r = math.hypot(x, y)
    theta = math.atan2(r, z)
    bent = theta * (1 + k1 * theta**2 + k2 * theta**4 + k3 * theta**6 + k4 * theta**8)
    return fx * bent * x / r + cx, fy * bent * y / r + cy


def right_fisheye_array(*given):
    return np.array(right_fisheye_atan2(*given))


def right_fisheye_named(*given):
    return dict(zip(("column", "row"), right_fisheye_atan2(*given)))


def wrong_fisheye_ahead(point, *given):
    return right_fisheye_atan2((point[0], point[1], abs(point[2])), *given)


def unusable_fisheye_text(*given):
    return "no"


def right_undistort_steps(column, row, fx, fy, cx, cy, *k):
    a = a2 = (column - cx) / fx
    b = b2 = (row - cy) / fy
    for _ in range(100):
        there = _distorted(a, b, *k)
        a, b = a + a2 - there[0], b + b2 - there[1]
    return a, b


def right_undistort_newton(column, row, fx, fy, cx, cy, *k):
    seen = np.array([(column - cx) / fx, (row - cy) / fy])
    at, h = seen.copy(), 1e-6
    for _ in range(20):
        slopes = [
            np.subtract(_distorted(*(at + h * e), *k), _distorted(*(at - h * e), *k)) / (2 * h)
            for e in np.eye(2)
        ]
        at = at - np.linalg.solve(np.transpose(slopes), np.subtract(_distorted(*at, *k), seen))
    return at


def right_undistort_list(*given):
    return list(right_undistort_newton(*given))


def wrong_undistort_once(column, row, fx, fy, cx, cy, *k):
    a, b = (column - cx) / fx, (row - cy) / fy
    there = _distorted(a, b, *k)
    return a + a - there[0], b + b - there[1]


def wrong_undistort_pinhole(column, row, fx, fy, cx, cy, *k):
    return (column - cx) / fx, (row - cy) / fy


def unusable_undistort_one(*given):
    return 1.0
