import math
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
