import math
# builds its own viewport from the angle
def viewing_ray(i, j, width, height, camera):
    fov = 2 * math.atan(camera.top / camera.distance)
    half = camera.distance * math.tan(math.radians(fov) / 2)
    aspect = (camera.right - camera.left) / (camera.top - camera.bottom)
    x = (2 * (j + 0.5) / width - 1) * half * aspect
    y = (1 - 2 * (i + 0.5) / height) * half
    u, v, w = camera.u, camera.v, camera.w
    if camera.projection == "parallel":
        return [camera.eye[k] + x * u[k] + y * v[k] for k in range(3)], [-c for c in w]
    return camera.eye, [x * u[k] + y * v[k] - camera.distance * w[k] for k in range(3)]
