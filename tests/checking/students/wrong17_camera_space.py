def viewing_ray(i, j, width, height, camera):
    x = camera.left + (camera.right - camera.left) * (j + 0.5) / width
    y = camera.top - (camera.top - camera.bottom) * (i + 0.5) / height
    return (0, 0, 0), (x, y, -camera.distance)
