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

def normalize(a):
    n = sum(x*x for x in a) ** 0.5
    return [x / n for x in a]
def dot(a, b): return sum(x*y for x, y in zip(a, b))
def basis(eye, target, up):
    w = normalize([e - t for e, t in zip(eye, target)])
    k = dot(up, w)
    v = normalize([p - k * q for p, q in zip(up, w)])
    u = [v[1]*w[2]-v[2]*w[1], v[2]*w[0]-v[0]*w[2], v[0]*w[1]-v[1]*w[0]]
    return [u, v, w]
