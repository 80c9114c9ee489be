# assumes a viewport of 1 x 1 around the middle, as on the first slide
def viewing_ray(i, j, width, height, camera):
    us = (j + 0.5) / width - 0.5
    vs = -((i + 0.5) / height - 0.5)
    u, v, w = camera.u, camera.v, camera.w
    if camera.projection == "parallel":
        o = [camera.eye[k] + us * u[k] + vs * v[k] for k in range(3)]
        return o, [-c for c in w]
    return camera.eye, [us * u[k] + vs * v[k] - camera.distance * w[k] for k in range(3)]
