def viewing_ray(i, j, width, height, camera):
    x = camera.left + (camera.right - camera.left) * (j + 0.5) / width
    y = camera.top - (camera.top - camera.bottom) * (i + 0.5) / height
    u, v, w = camera.u, camera.v, camera.w
    if camera.projection == "parallel":
        return [-c for c in w], [camera.eye[k] + x * u[k] + y * v[k] for k in range(3)]
    return [x * u[k] + y * v[k] - camera.distance * w[k] for k in range(3)], camera.eye
