# clamp: the last column and row are one short
def viewing_ray(i, j, width, height, camera):
    j = min(j, width - 2); i = min(i, height - 2)
    x = camera.left + (camera.right - camera.left) * (j + 0.5) / width
    y = camera.top - (camera.top - camera.bottom) * (i + 0.5) / height
    if camera.projection == "parallel":
        return [camera.eye[k] + x * camera.u[k] + y * camera.v[k] for k in range(3)], [-a for a in camera.w]
    return camera.eye, [x * camera.u[k] + y * camera.v[k] - camera.distance * camera.w[k] for k in range(3)]
