import numpy as np
def hit_sphere(origin, direction, center, radius):
    o = np.array(origin, float); c = np.array(center, float); d = np.array(direction, float)
    length = np.linalg.norm(d)
    d = d / length
    L = c - o
    tca = L.dot(d)
    d2 = L.dot(L) - tca * tca
    if d2 > radius ** 2:
        return float("inf")
    thc = (radius ** 2 - d2) ** 0.5
    ts = sorted(t for t in (tca - thc, tca + thc) if t > 0)
    return ts[0] / length if ts else float("inf")
