from fractions import Fraction as F


def viewing_ray(i, j, width, height, camera):
    l, r, b, t, d = map(F, (camera.left, camera.right, camera.bottom, camera.top, camera.distance))
    x = l + (r - l) * F(2 * j + 1, 2 * width)
    y = t - (t - b) * F(2 * i + 1, 2 * height)
    u, v, w, e = ([F(a) for a in q] for q in (camera.u, camera.v, camera.w, camera.eye))
    if camera.projection == "parallel":
        return [a + x * p + y * q for a, p, q in zip(e, u, v)], [-c for c in w]
    return e, [x * p + y * q - d * c for p, q, c in zip(u, v, w)]
