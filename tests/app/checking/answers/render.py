"""Answers to render."""

import closest_hit
import numpy as np
import parallel_ray
import viewing_ray


def _ray(i, j, width, height, camera):
    kind = parallel_ray if camera.projection == "parallel" else viewing_ray
    return kind.right_arrays(i, j, width, height, camera)


def _image(scene, camera, width, height, closest=closest_hit.right_loop, ray=_ray, empty=None):
    image = np.zeros((height, width, 3))
    for i in range(height):
        for j in range(width):
            hit = closest(*ray(i, j, width, height, camera), scene.objects)
            if hit:
                image[i, j] = scene.objects[hit[0]].color
            else:
                image[i, j] = scene.background if empty is None else empty
    return image


def right_loops(scene, camera, width, height):
    return _image(scene, camera, width, height)


def right_float32(scene, camera, width, height):
    return _image(scene, camera, width, height).astype(np.float32)


def right_columns_first(scene, camera, width, height):
    image = [[None] * width for _ in range(height)]
    for j in range(width):
        for i in range(height):
            hit = closest_hit.right_loop(*_ray(i, j, width, height, camera), scene["objects"])
            image[i][j] = list(scene["objects"][hit[0]]["color"] if hit else scene["background"])
    return image


def wrong_upside_down(scene, camera, width, height):
    return _image(scene, camera, width, height)[::-1]


def wrong_last_object(scene, camera, width, height):
    return _image(scene, camera, width, height, closest=closest_hit.wrong_last)


def unusable_transposed(scene, camera, width, height):
    return _image(scene, camera, width, height).transpose(1, 0, 2)
