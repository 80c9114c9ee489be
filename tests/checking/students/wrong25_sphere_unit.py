import math
def hit_sphere(origin, direction, center, radius):
    # direction is normalised, so a = 1
    oc = [a - b for a, b in zip(origin, center)]
    b = 2 * sum(o * d for o, d in zip(oc, direction))
    c = sum(o * o for o in oc) - radius ** 2
    D = b * b - 4 * c
    if D < 0: return None
    for t in (-b - math.sqrt(D)) / 2, (-b + math.sqrt(D)) / 2:
        if t > 0: return t
