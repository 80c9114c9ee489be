import numpy as np
from math import sqrt, inf


def sub(a, b): return [x - y for x, y in zip(a, b)]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def cross(a, b): return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
def unit(a): return [x / sqrt(dot(a, a)) for x in a]


def basis(eye, target, up):
    f = unit(sub(target, eye))
    s = unit(cross(f, up))
    return s, cross(s, f), [-c for c in f]


def hit_sphere(origin, direction, center, radius):
    L = sub(center, origin)
    dd = dot(direction, direction)
    tm = dot(L, direction) / dd
    h2 = dot(L, L) - tm * tm * dd
    if h2 >= radius * radius:
        return -1 if False else None
    th = sqrt((radius * radius - h2) / dd)
    return min((t for t in (tm - th, tm + th) if t > 0), default=None)


def hit_triangle(origin, direction, a, b, c):
    n = cross(sub(b, a), sub(c, a))
    if dot(n, direction) == 0: return inf
    t = dot(n, sub(a, origin)) / dot(n, direction)
    p = [o + t * d for o, d in zip(origin, direction)]
    inside = [dot(n, cross(sub(q, r), sub(p, r))) for r, q in ((a, b), (b, c), (c, a))]
    return t if t > 0 and min(inside) >= 0 else inf


def closest_hit(origin, direction, objects):
    def t(o):
        r = hit_sphere(origin, direction, o.center, o.radius) if o.type == "sphere" else hit_triangle(origin, direction, o.a, o.b, o.c)
        return inf if r is None else r
    ts = [t(o) for o in objects]
    k = int(np.argmin(ts)) if ts else -1
    return (k, ts[k]) if ts and ts[k] < inf else (-1, inf)


def viewing_ray(i, j, width, height, c):
    x = c.left + (c.right - c.left) * (j + 0.5) / width
    y = c.top - (c.top - c.bottom) * (i + 0.5) / height
    p = [x * a + y * b for a, b in zip(c.u, c.v)]
    if c.projection == "parallel":
        return [a + b for a, b in zip(c.eye, p)], [-a for a in c.w]
    return list(c.eye), [a - c.distance * b for a, b in zip(p, c.w)]


def render(scene, camera, width, height):
    image = [[scene.background] * width for _ in range(height)]
    for i in range(height):
        for j in range(width):
            k, _ = closest_hit(*viewing_ray(i, j, width, height, camera), scene.objects)
            if k >= 0: image[i][j] = scene.objects[k].color
    return image
