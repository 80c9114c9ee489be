"""glTF: pygltflib reads and writes, .gltf and .glb; the pixels by the specification's matrices.

Source: Khronos, glTF 2.0 Specification, "Cameras" and "Transformations", written here.
"""

from __future__ import annotations

import math
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np

from renderer.camera_checks import Floats
from renderer.camera_formats import Options, read_cameras, written
from tests.conformance.cameras import POINTS, any_size, cases, from_clip, pixels, rotation
from tests.conformance.measured import Checked, Job, Measured, measured, needed
from tests.support.format_cameras import centred_camera


def check(job: Job) -> Checked:
    gltf = needed("pygltflib")
    peer = f"pygltflib {metadata.version('pygltflib')}, the specification's matrices"
    return Checked(peer, (_ours(gltf, job), _theirs(gltf, job)))


def _ours(gltf: Any, job: Job) -> Measured:
    made = list(cases(job, centred_camera, parallel=True))
    path = job.folder / "ours.gltf"
    path.write_bytes(written([case.posed for case in made], "gltf")[""])
    file = gltf.GLTF2().load(str(path))
    nodes = {node.name: node for node in file.nodes}
    errors = []
    for case in made:
        node = nodes[case.posed.name]
        clip = _clip(file.cameras[node.camera], case.size) @ np.linalg.inv(_local(node))
        errors.append(from_clip(clip, case.points, case.size) - case.pixels)
    return measured("our .gltf, read by pygltflib", errors, cameras=job.cameras)


def _theirs(gltf: Any, job: Job) -> Measured:
    """Cameras below nodes that move, turn and scale, in files of ten."""
    random, errors = job.random, []
    cameras = 0
    while cameras < job.cameras:
        file, expected = gltf.GLTF2(scene=0, scenes=[gltf.Scene(nodes=[])]), []
        for number in range(10):
            size = any_size(random)
            parent, child = (_node(gltf, random, unit) for unit in (number % 2 == 0, True))
            parent.children = [len(file.nodes) + 1]
            child.camera, child.name = number, f"c{number}"
            file.scenes[0].nodes.append(len(file.nodes))
            file.nodes += [parent, child]
            file.cameras.append(_camera(gltf, random, size, number))
            pose = _local(parent) @ _local(child)
            pose[:3, :3] /= np.linalg.norm(pose[:3, :3], axis=0)  # a camera has no scale
            cube = np.column_stack([random.uniform(-0.98, 0.98, (POINTS, 3)), np.ones(POINTS)])
            clip = _clip(file.cameras[-1], size) @ np.linalg.inv(pose)
            world = cube @ np.linalg.inv(clip).T
            expected.append((size, clip, world[:, :3] / world[:, 3:]))
        path = _saved(gltf, file, job.folder, binary=cameras % 20 == 0)
        for number, (size, clip, points) in enumerate(expected):
            posed = read_cameras(path, options=Options(size=size)).cameras[number]
            camera = posed.camera.fitted(size) if posed.fit else posed.camera
            errors.append(pixels(camera, points, size) - from_clip(clip, points, size))
        cameras += len(expected)
    return measured("its .gltf and .glb, read by us", errors, cameras=cameras)


def _saved(gltf: Any, file: Any, folder: Path, binary: bool) -> Path:
    path = folder / ("theirs.glb" if binary else "theirs.gltf")
    if binary:
        file.set_binary_blob(b"")
        file.save_binary(str(path))
    else:
        file.save_json(str(path))
    return path


def _node(gltf: Any, random: np.random.Generator, scaled: bool) -> Any:
    """As a matrix, or as translation, rotation and scale."""
    turn = random.normal(size=4)
    turn /= np.linalg.norm(turn)
    scale = random.uniform(0.3, 3) if scaled else 1.0
    node = gltf.Node(
        translation=(3 * random.normal(size=3)).tolist(),
        rotation=turn.tolist(),
        scale=[scale, scale, scale],
    )
    if random.uniform() < 0.3:
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = rotation(random), 3 * random.normal(size=3)
        node = gltf.Node(matrix=pose.T.ravel().tolist())
    return node


def _camera(gltf: Any, random: np.random.Generator, size: tuple[int, int], number: int) -> Any:
    near, far = 0.1 * random.uniform(0.5, 2), 100 * random.uniform(0.5, 2)
    if number % 3 == 0:
        x, y = random.uniform(0.1, 5, 2)
        box = gltf.Orthographic(xmag=x, ymag=y, znear=near, zfar=far)
        return gltf.Camera(type="orthographic", orthographic=box)
    lens = gltf.Perspective(yfov=random.uniform(0.1, 2.5), znear=near, zfar=far)
    if number % 3 == 1:
        lens.aspectRatio = random.uniform(0.3, 3)
    if number % 2:
        lens.zfar = None
    return gltf.Camera(type="perspective", perspective=lens)


def _local(node: Any) -> Floats:
    """A node's matrix: parent from node."""
    if node.matrix is not None:
        return np.reshape(node.matrix, (4, 4)).T.astype(float)
    x, y, z, w = node.rotation or (0, 0, 0, 1)
    pose = np.eye(4)
    pose[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    pose[:3, :3] *= node.scale or (1, 1, 1)
    pose[:3, 3] = node.translation or (0, 0, 0)
    return pose


def _clip(camera: Any, size: tuple[int, int]) -> Floats:
    """The specification's three projection matrices: finite, infinite and orthographic."""
    if camera.type == "orthographic":
        box = camera.orthographic
        n, f = box.znear, box.zfar
        return np.array(
            [
                [1 / box.xmag, 0, 0, 0],
                [0, 1 / box.ymag, 0, 0],
                [0, 0, 2 / (n - f), (f + n) / (n - f)],
                [0, 0, 0, 1],
            ]
        )
    lens = camera.perspective
    aspect, half = lens.aspectRatio or size[0] / size[1], math.tan(0.5 * lens.yfov)
    n, f = lens.znear, lens.zfar
    deep = (-1.0, -2 * n) if f is None else ((f + n) / (n - f), 2 * f * n / (n - f))
    return np.array(
        [[1 / (aspect * half), 0, 0, 0], [0, 1 / half, 0, 0], [0, 0, *deep], [0, 0, -1, 0]]
    )
