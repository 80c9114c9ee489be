def dot(a, b): return sum(x*y for x, y in zip(a, b))
def sub(a, b): return [x-y for x, y in zip(a, b)]
def hit_sphere(o, d, c, r):
    oc = sub(o, c); A = dot(d, d); B = dot(oc, d); C = dot(oc, oc) - r*r
    D = B*B - A*C
    if D < 0: return None
    for t in ((-B - D**.5)/A, (-B + D**.5)/A):
        if t > 0: return t
def cross(a, b): return [a[1]*b[2]-a[2]*b[1], a[2]*b[0]-a[0]*b[2], a[0]*b[1]-a[1]*b[0]]
def hit_triangle(o, d, a, b, c):
    e1, e2 = sub(b, a), sub(c, a)
    p = cross(d, e2); det = dot(e1, p)
    if abs(det) < 1e-12: return None
    s = sub(o, a); x = dot(s, p) / det
    q = cross(s, e1); y = dot(d, q) / det
    t = dot(e2, q) / det
    return t if x >= 0 and y >= 0 and x + y <= 1 and t > 0 else None
def closest_hit(origin, direction, objects):
    best = None
    for n, ob in enumerate(objects):
        if ob.kind == "sphere": t = hit_sphere(origin, direction, ob.center, ob.radius)
        else: t = hit_triangle(origin, direction, ob.a, ob.b, ob.c)
        if t is not None:
            best = (n, t)
    return best
