def viewing_ray(i, j, width, height, camera):
    x = camera.left + (camera.right - camera.left) * (j + 0.5) / width
    y = camera.top - (camera.top - camera.bottom) * (i + 0.5) / height
    if camera.projection != "perspective":
        yield (e + x * u + y * v for e, u, v in zip(camera.eye, camera.u, camera.v))
        yield map(float.__neg__, camera.w)
        return
    yield iter(camera.eye)
    yield (x * u + y * v - camera.distance * w for u, v, w in zip(camera.u, camera.v, camera.w))
