# d left out and point instead of vector
def viewing_ray(i, j, width, height, camera):
    x = camera.left + (camera.right - camera.left) * (j + 0.5) / width
    y = camera.top - (camera.top - camera.bottom) * (i + 0.5) / height
    return camera.eye, [camera.eye[k] + x * camera.u[k] + y * camera.v[k] - camera.w[k] for k in range(3)]
