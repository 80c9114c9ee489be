"""Blender's side of formats/blender.py: python blender_peer.py ASKED.json ANSWER.json

Run with bpy and its own NumPy on the path; knows nothing of Lucida.
"""

import json
import random
import sys
from pathlib import Path

import bpy
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

ORDERS = ("XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX", "QUATERNION")
OF_CAMERA = ("type", "sensor_fit", "lens", "sensor_width", "sensor_height")
OF_CAMERA += ("shift_x", "shift_y", "ortho_scale")
OF_RENDER = ("resolution_x", "resolution_y", "resolution_percentage")
OF_RENDER += ("pixel_aspect_x", "pixel_aspect_y")
OF_PANORAMA = ("panorama_type", "fisheye_polynomial_k1", "fisheye_fov", "fisheye_lens")
OF_PANORAMA += ("longitude_min", "longitude_max", "latitude_min", "latitude_max")
OF_PANORAMA += tuple(
    f"central_cylindrical_range_{axis}_{end}" for axis in "uv" for end in ("min", "max")
)
PANORAMAS = ("EQUIRECTANGULAR", "CENTRAL_CYLINDRICAL", "FISHEYE_EQUISOLID")
PANORAMAS += ("FISHEYE_EQUIDISTANT", "FISHEYE_LENS_POLYNOMIAL")
POINTS = 8


def emptied():
    for collection in (bpy.data.objects, bpy.data.cameras):
        for entry in list(collection):
            collection.remove(entry)
    return bpy.context.scene


def read(cameras):
    """The pixels of points, by the camera that a script makes."""
    seen = []
    for camera in cameras:
        scene = emptied()
        exec(compile(camera["script"], "script", "exec"), {})
        bpy.context.view_layer.update()
        render = scene.render
        size = [render.resolution_x, render.resolution_y]
        if size != camera["size"]:
            raise AssertionError(f"the script makes {size} of {camera['size']}")
        seen.append([whole_view(scene, point, size) for point in camera["points"]])
    return seen


def whole_view(scene, point, size):
    """A pixel from the left upper corner, of a picture of 100 %."""
    seen = world_to_camera_view(scene, scene.camera, Vector(point))
    return [seen.x * size[0], (1 - seen.y) * size[1]]


def rendered_view(scene, point, size):
    """The same by the projection that the picture is rendered with."""
    render, camera = scene.render, scene.camera
    clip = camera.calc_matrix_camera(
        bpy.context.evaluated_depsgraph_get(),
        x=size[0],
        y=size[1],
        scale_x=render.pixel_aspect_x,
        scale_y=render.pixel_aspect_y,
    )
    local = camera.matrix_world.normalized().inverted() @ Vector(point)
    x, y, _, w = clip @ local.to_4d()
    return [(x / w + 1) / 2 * size[0], (1 - y / w) / 2 * size[1]]


def write(count, numbers):
    """Cameras of Blender's own, as a script or a table has their values."""
    scene = emptied()
    data = bpy.data.cameras.new("c")
    camera = bpy.data.objects.new("c", data)
    scene.collection.objects.link(camera)
    scene.camera = camera
    made = []
    for number in range(count):
        changed(data, scene.render, numbers, full=number % 2 == 0)
        placed(camera, numbers)
        bpy.context.view_layer.update()
        render = scene.render
        size = rendered_size(render)
        values = {name: getattr(data, name) for name in OF_CAMERA}
        values |= {name: getattr(render, name) for name in OF_RENDER}
        values |= pose(camera, as_matrix=number % 4 < 2)
        points = [point_ahead(camera, data, scene, numbers) for _ in range(POINTS)]
        view = whole_view if number % 2 == 0 else rendered_view
        made.append(
            {
                "text": json.dumps(values) if number % 3 else script(values),
                "size": size,
                "is_share": number % 2 == 1,
                "points": points,
                "pixels": [view(scene, point, size) for point in points],
            }
        )
    return made


def changed(data, render, numbers, full):
    draw = numbers.uniform
    data.type = numbers.choice(["PERSP", "ORTHO"])
    data.sensor_fit = numbers.choice(["AUTO", "HORIZONTAL", "VERTICAL"])
    data.lens, data.ortho_scale = draw(10, 200), draw(0.2, 10)
    data.sensor_width, data.sensor_height = draw(10, 60), draw(10, 60)
    data.shift_x, data.shift_y = draw(-1, 1), draw(-1, 1)
    render.resolution_x, render.resolution_y = numbers.randint(16, 3000), numbers.randint(16, 3000)
    render.resolution_percentage = 100 if full else numbers.randint(10, 99)
    render.pixel_aspect_x = numbers.choice([1, draw(1, 3)])
    render.pixel_aspect_y = numbers.choice([1, draw(1, 3)])


def placed(camera, numbers):
    camera.location = [numbers.uniform(-5, 5) for _ in range(3)]
    camera.rotation_mode = numbers.choice(ORDERS)
    if camera.rotation_mode == "QUATERNION":
        turn = Vector([numbers.uniform(-1, 1) for _ in range(4)])
        camera.rotation_quaternion = turn.normalized()
    else:
        camera.rotation_euler = [numbers.uniform(-3, 3) for _ in range(3)]
    camera.scale = [numbers.uniform(0.5, 2)] * 3


def pose(camera, as_matrix):
    if as_matrix:
        return {"matrix_world": [list(row) for row in camera.matrix_world]}
    values = {"location": list(camera.location), "rotation_mode": camera.rotation_mode}
    kind = "quaternion" if camera.rotation_mode == "QUATERNION" else "euler"
    return values | {f"rotation_{kind}": list(getattr(camera, f"rotation_{kind}"))}


def script(values):
    """As people copy it from Blender's Python console."""
    lines = ["import bpy", "cam = bpy.data.objects['c']"]
    for name, value in values.items():
        owner = "cam.data" if name in OF_CAMERA else "cam"
        owner = "bpy.context.scene.render" if name in OF_RENDER else owner
        lines.append(f"{owner}.{name} = {value!r}")
    return "\n".join(lines) + "\n"


def point_ahead(camera, data, scene, numbers):
    """A point that the picture shows."""
    corners = data.view_frame(scene=scene)
    right, left = corners[0], corners[2]
    depth = numbers.uniform(1, 5)
    scale = depth / -right.z if data.type == "PERSP" else 1
    x = left.x + (right.x - left.x) * numbers.uniform(0, 1)
    y = left.y + (right.y - left.y) * numbers.uniform(0, 1)
    return list(camera.matrix_world.normalized() @ Vector((x * scale, y * scale, -depth)))


def rendered_size(render):
    """In whole numbers, as BKE_render_resolution() has it."""
    share = render.resolution_percentage
    return [side * share // 100 for side in (render.resolution_x, render.resolution_y)]


def render_pictures(count, numbers):
    """The sizes of pictures, whose sides times the percentage are whole at times."""
    path = Path(sys.argv[2]).with_suffix(".png")
    scene = emptied()
    camera = bpy.data.objects.new("c", bpy.data.cameras.new("c"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.render.filepath = str(path)
    made = []
    for number in range(count):
        render = scene.render
        render.resolution_x = 100 if number % 2 else numbers.randint(40, 200)
        render.resolution_y = numbers.randint(40, 200)
        render.resolution_percentage = (
            (29, 57, 58)[number] if number < 3 else numbers.randint(10, 100)
        )
        bpy.ops.render.render(write_still=True)
        picture = bpy.data.images.load(str(path))
        size = list(picture.size)
        bpy.data.images.remove(picture)
        values = {name: getattr(render, name) for name in OF_RENDER}
        values["matrix_world"] = [list(row) for row in camera.matrix_world]
        made.append({"values": values, "size": size})
    return made


def look(scripts):
    """The directions in which Cycles looks, by the cameras that scripts make."""
    found = []
    for text in scripts:
        scene = emptied()
        exec(compile(text, "script", "exec"), {})
        found.append(directions(scene))
    return found


def panoramas(count, numbers):
    """Panoramic cameras of Blender's own, and the directions in which Cycles looks."""
    made = []
    for number in range(count):
        scene = emptied()
        data = bpy.data.cameras.new("c")
        camera = bpy.data.objects.new("c", data)
        scene.collection.objects.link(camera)
        scene.camera = camera
        placed(camera, numbers)
        changed(data, scene.render, numbers, full=True)
        scene.render.resolution_x, scene.render.resolution_y = numbers.choice([(48, 32), (30, 40)])
        data.type, data.panorama_type = "PANO", PANORAMAS[number % len(PANORAMAS)]
        draw = numbers.uniform
        data.fisheye_fov, data.fisheye_lens = draw(2, 6), draw(20, 40)
        data.shift_x, data.shift_y = draw(-0.1, 0.1), draw(-0.1, 0.1)
        for name in OF_PANORAMA[4:]:
            setattr(data, name, draw(-0.8, -0.3) if name.endswith("min") else draw(0.3, 0.8))
        data.fisheye_polynomial_k1 = draw(-0.05, -0.02)
        for name in ("k0", "k2", "k3", "k4"):
            setattr(data, f"fisheye_polynomial_{name}", 0)
        bpy.context.view_layer.update()
        values = {name: getattr(data, name) for name in (*OF_CAMERA, *OF_PANORAMA)}
        values |= {name: getattr(scene.render, name) for name in OF_RENDER}
        values |= pose(camera, as_matrix=True)
        made.append({"values": values, "looked": directions(scene)})
    return made


def directions(scene):
    """The numbers of a picture, from its upper left corner, whose colours are directions."""
    path = Path(sys.argv[2]).with_suffix(".exr")
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 1, False
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.01
    scene.render.filepath = str(path)
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.view_settings.view_transform = "Raw"
    scene.world = world = bpy.data.worlds.new("directions")
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    place, half = nodes.new("ShaderNodeTexCoord"), nodes.new("ShaderNodeVectorMath")
    light, out = nodes.new("ShaderNodeBackground"), nodes.new("ShaderNodeOutputWorld")
    half.operation = "MULTIPLY_ADD"
    half.inputs[1].default_value = half.inputs[2].default_value = (0.5, 0.5, 0.5)
    links.new(place.outputs["Generated"], half.inputs[0])
    links.new(half.outputs[0], light.inputs[0])
    links.new(light.outputs[0], out.inputs[0])
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(str(path))
    picture.colorspace_settings.name = "Non-Color"
    width, height = picture.size
    numbers = list(picture.pixels)
    bpy.data.images.remove(picture)
    rows = [numbers[4 * width * row : 4 * width * (row + 1)] for row in range(height)]
    return [
        [[2 * x - 1 for x in row[i : i + 3]] for i in range(0, 4 * width, 4)] for row in rows[::-1]
    ]


def main(asked, answer):
    question = json.loads(Path(asked).read_text())
    numbers = random.Random(question.get("seed"))
    do = question["do"]
    if do == "version":
        found = bpy.app.version_string
    elif do == "read":
        found = read(question["cameras"])
    elif do == "look":
        found = look(question["scripts"])
    elif do == "panoramas":
        found = panoramas(question["count"], numbers)
    elif do == "write":
        found = write(question["count"], numbers)
    else:
        found = render_pictures(question["count"], numbers)
    Path(answer).write_text(json.dumps(found))


if __name__ == "__main__":
    main(*sys.argv[1:3])
