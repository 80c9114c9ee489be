import math
def dot(a, b): return a[0]*b[0] + a[1]*b[1] + a[2]*b[2]
def sub(a, b): return (a[0]-b[0], a[1]-b[1], a[2]-b[2])
def cross(a, b): return (a[1]*b[2]-a[2]*b[1], a[2]*b[0]-a[0]*b[2], a[0]*b[1]-a[1]*b[0])
def hit_sphere(origin, direction, center, radius):
    oc = sub(origin, center)
    a = dot(direction, direction)
    b = 2.0 * dot(oc, direction)
    c = dot(oc, oc) - radius * radius
    D = b * b - 4 * a * c
    if D < 0:
        return None
    t = (-b - math.sqrt(D)) / (2 * a)
    if t > 0:
        return t
    t = (-b + math.sqrt(D)) / (2 * a)
    if t > 0:
        return t
    return None

def hit_triangle(origin, direction, a, b, c):
    n = cross(sub(b, a), sub(c, a))
    nd = dot(n, direction)
    if nd == 0:
        return None
    t = dot(n, sub(a, origin)) / nd
    if t <= 0:
        return None
    p = tuple(origin[k] + t * direction[k] for k in range(3))
    if dot(n, cross(sub(b, a), sub(p, a))) < 0: return None
    if dot(n, cross(sub(c, b), sub(p, b))) < 0: return None
    if dot(n, cross(sub(a, c), sub(p, c))) < 0: return None
    return t

def hit(o, d, ob):
    if ob.type == "sphere":
        return hit_sphere(o, d, ob.center, ob.radius)
    return hit_triangle(o, d, ob.a, ob.b, ob.c)

def closest_hit(origin, direction, objects):
    best = None
    for number, ob in enumerate(objects):
        t = hit(origin, direction, ob)
        if t is not None and (best is None or t < best[1]):
            best = (number, t)
    return best

def viewing_ray(i, j, width, height, c):
    x = c.left + (c.right - c.left) * (j + 0.5) / width
    y = c.top - (c.top - c.bottom) * (i + 0.5) / height
    p = [x * c.u[k] + y * c.v[k] for k in range(3)]
    if c.projection == "parallel":
        return [c.eye[k] + p[k] for k in range(3)], [-c.w[k] for k in range(3)]
    return list(c.eye), [p[k] - c.distance * c.w[k] for k in range(3)]

def render(scene, camera, width, height):
    image = []
    for i in range(height):
        row = []
        for j in range(width):
            o, d = viewing_ray(i, j, width, height, camera)
            h = closest_hit(o, d, scene.objects)
            row.append(scene.background if h is None else scene.objects[h[0]].color)
        image.append(row)
    return image
