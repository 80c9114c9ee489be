"""A lecture of three steps with everything in it, and the reading of one."""

from pathlib import Path

from lucida.app.lecture.reading import lecture_from_toml

FILE = '''\
lucida = 1
title = "A lecture"
author = "A. Speaker"

[scenes.ball]
objects = [
    { type = "sphere" },
]

[[steps]]
title = "One"
part = "First"
text = """
# Hello
A **bold** word and $u = 1$.

- one
"""
scene = "ball"
camera = { eye = [0, 0, 5] }
views = ["outside", "ray"]
options.images.samples = 4
options.images.channel = "depth"
options.outside.bundle = [4, 4]
options.outside.camera = { eye = [5, 5, 5], target = [0, 0, 0] }
options.shadows = true
pixel = [2, 3]
notes = "Say it."

[steps.exercise]
kind = "ray"
question = "Which ray?"
pixel = [1, 3]
size = [4, 3]

[[steps]]
title = "Two"

[[steps]]
title = "Three"
part = "Second"
exercise.kind = "choice"
exercise.question = "Which?"
exercise.options = [
    { text = "this", feedback = "No." },
    { text = "that", feedback = "Yes.", right = true },
]
'''


def read(text=FILE, folder=Path()):
    return lecture_from_toml(text, folder, "x.toml")
