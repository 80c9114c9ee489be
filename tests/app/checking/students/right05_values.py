import math
import numpy as np
from numpy.linalg import norm

def basis(eye, target, up):
    gaze = np.subtract(target, eye)
    w = -gaze / norm(gaze)
    u = np.cross(up, w); u /= norm(u)
    return u, np.cross(w, u), w

def hit_sphere(origin, direction, center, radius):
    ox, oy, oz = [o - c for o, c in zip(origin, center)]
    dx, dy, dz = direction
    a = dx*dx + dy*dy + dz*dz
    half_b = ox*dx + oy*dy + oz*dz
    c = ox*ox + oy*oy + oz*oz - radius*radius
    disc = half_b*half_b - a*c
    if disc < 0:
        return None
    s = math.sqrt(disc)
    for t in ((-half_b - s)/a, (-half_b + s)/a):
        if t > 0:
            return t
    return None

def hit_triangle(origin, direction, a, b, c):
    A = np.column_stack([np.subtract(a, b), np.subtract(a, c), direction])
    try:
        beta, gamma, t = np.linalg.solve(A, np.subtract(a, origin))
    except np.linalg.LinAlgError:
        return None
    return t if beta >= 0 and gamma >= 0 and beta + gamma <= 1 and t > 0 else None
