import math
def dot(a, b): return a[0]*b[0] + a[1]*b[1] + a[2]*b[2]
def sub(a, b): return (a[0]-b[0], a[1]-b[1], a[2]-b[2])
def cross(a, b): return (a[1]*b[2]-a[2]*b[1], a[2]*b[0]-a[0]*b[2], a[0]*b[1]-a[1]*b[0])
def hit_sphere(origin, direction, center, radius):
    oc = sub(origin, center)
    a = dot(direction, direction)
    b = 2.0 * dot(oc, direction)
    c = dot(oc, oc) - radius * radius
    D = b * b - a * c
    if D < 0:
        return None
    t = (-b - math.sqrt(D)) / (2 * a)
    if t > 0:
        return t
    t = (-b + math.sqrt(D)) / (2 * a)
    if t > 0:
        return t
    return None
