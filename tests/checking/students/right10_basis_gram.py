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
