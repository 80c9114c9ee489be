import numpy as np
def hit_triangle(origin, direction, a, b, c):
    o, d, a, b, c = (np.array(x, float) for x in (origin, direction, a, b, c))
    n = np.cross(b - a, c - a)
    if n @ d == 0: return None
    t = n @ (a - o) / (n @ d)
    if t <= 0: return None
    return t      # the plane is hit
