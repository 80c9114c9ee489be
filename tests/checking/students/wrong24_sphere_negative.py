import math
def hit_sphere(origin, direction, center, radius):
    oc = [a - b for a, b in zip(origin, center)]
    a = sum(d * d for d in direction)
    b = 2 * sum(o * d for o, d in zip(oc, direction))
    c = sum(o * o for o in oc) - radius ** 2
    D = b * b - 4 * a * c
    if D < 0: return None
    return (-b - math.sqrt(D)) / (2 * a)
