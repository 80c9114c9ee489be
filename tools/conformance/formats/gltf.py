"""glTF: pygltflib reads and writes, .gltf and .glb; the pixels by the specification's matrices.

Source: Khronos, glTF 2.0 Specification, "Cameras" and "Transformations", written here.
"""

from __future__ import annotations

import math
from importlib import metadata
from typing import Any

import numpy as np

from lucida.renderer.camera.checks import Floats
from lucida.renderer.files.cameras import Options, read_cameras, written
from tests.support.format_cameras import centred_camera
from tools.conformance.cameras import POINTS, any_pose, any_size, cases, from_clip, pixels
from tools.conformance.measured import Checked, Job, Measured, measured, needed


def check(job: Job) -> Checked:
    gltf = needed("pygltflib")
    peer = f"pygltflib {metadata.version('pygltflib')}, the specification's matrices"
    return Checked(peer, (_ours(gltf, job), _theirs(gltf, job)))


def _ours(gltf: Any, job: Job) -> Measured:
    made = list(cases(job, centred_camera, parallel=True))
    path = job.folder / "ours.gltf"
    path.write_bytes(written([case.posed for case in made], "gltf"))
    file = gltf.GLTF2().load(str(path))
    nodes = {node.name: node for node in file.nodes}
    errors = []
    for case in made:
        node = nodes[case.posed.name]
        clip = _clip(file.cameras[node.camera], case.size) @ np.linalg.inv(_local(node))
        errors.append(from_clip(clip, case.points, case.size) - case.pixels)
    return measured("our .gltf, read by pygltflib", errors)


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
        path = job.folder / ("theirs.glb" if cameras % 20 == 0 else "theirs.gltf")
        file.set_binary_blob(b"")
        file.save(str(path))
        for number, (size, clip, points) in enumerate(expected):
            posed = read_cameras(path, options=Options(size=size)).cameras[number]
            camera = posed.camera.fitted(size) if posed.fit else posed.camera
            errors.append(pixels(camera, points, size) - from_clip(clip, points, size))
        cameras += len(expected)
    return measured("its .gltf and .glb, read by us", errors)


def _node(gltf: Any, random: np.random.Generator, scaled: bool) -> Any:
    """Return a node with a matrix, or with translation, rotation and scale."""
    if random.uniform() < 0.3:
        return gltf.Node(matrix=any_pose(random).T.ravel().tolist())
    turn = random.normal(size=4)
    return gltf.Node(
        translation=(3 * random.normal(size=3)).tolist(),
        rotation=(turn / np.linalg.norm(turn)).tolist(),
        scale=[random.uniform(0.3, 3) if scaled else 1.0] * 3,
    )


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
        clip = np.diag([1 / box.xmag, 1 / box.ymag, 2 / (n - f), 1])
        clip[2, 3] = (f + n) / (n - f)
        return clip
    lens = camera.perspective
    aspect, half = lens.aspectRatio or size[0] / size[1], math.tan(0.5 * lens.yfov)
    n, f = lens.znear, lens.zfar
    deep = (-1.0, -2 * n) if f is None else ((f + n) / (n - f), 2 * f * n / (n - f))
    return np.array(
        [[1 / (aspect * half), 0, 0, 0], [0, 1 / half, 0, 0], [0, 0, *deep], [0, 0, -1, 0]]
    )
