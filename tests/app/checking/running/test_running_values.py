"""The values that a student's code is given, and what its answers become."""

from __future__ import annotations

import math
import textwrap

from students import CAMERA, called

from lucida.app.checking.tasks import Call, Failure

RAY = {"origin": [0.0, 0.0, 5.0], "direction": [0.5, 0.25, -1.0]}

ANSWERS = {
    "not a number": ("float('nan')", math.nan),
    "dict": ("{'u': (1, 2), 'v': None}", {"u": [1, 2], "v": None}),
    "large integer": ("2**80", float(2**80)),
    "float32": ("np.float32(0.5)", 0.5),
    "array": ("np.array([[0.5, 1], [2, 3]], np.float32)", [[0.5, 1.0], [2.0, 3.0]]),
    "dataclass": ("Ray(D, O)", RAY),
    "namespace": ("types.SimpleNamespace(origin=O, direction=D)", RAY),
    "basis": ("types.SimpleNamespace(v=2, w=3, u=1)", {"u": 1, "v": 2, "w": 3}),
}
SOURCE = """
    import dataclasses, types
    import numpy as np
    O, D = (0.0, 0.0, 5.0), [0.5, 0.25, -1.0]

    @dataclasses.dataclass
    class Ray:
        direction: object
        origin: object

"""
NO_VALUES = {
    "object()": "of type object",
    "1j": "1j of type complex",
    "(lambda a: a.append(a) or a)([])": "[[...]] of type list",
    "type('Loud', (), {'__repr__': lambda self: 1 / 0})()": "returned something of type Loud",
}


def answers(student, written: list[str]):
    """Return the answers of functions that return these values."""
    source = textwrap.dedent(SOURCE)
    for number, text in enumerate(written):
        source += f"def f{number}():\n    return {text}\n"
    run = student(source).call([called(f"f{number}") for number in range(len(written))])
    assert run.failure is None
    return run.values


def equal(one, other) -> bool:
    if isinstance(one, float) and isinstance(other, float) and math.isnan(other):
        return math.isnan(one)
    return one == other


def test_answers_become_values_of_json(student):
    given = answers(student, [written for written, _ in ANSWERS.values()])
    for (name, (_, wanted)), value in zip(ANSWERS.items(), given, strict=True):
        assert equal(value, wanted), name
        assert type(value) is type(wanted), name


def test_what_is_no_value_is_told(student):
    for number, failure in enumerate(answers(student, [*NO_VALUES])):
        told = [*NO_VALUES.values()][number]
        assert isinstance(failure, Failure), told
        assert (failure.kind, failure.call) == ("answer", number)
        assert told in failure.text
        assert "wanted are numbers" in failure.text
        assert len(failure.text) < 400
        assert "\n" not in failure.text


def test_what_an_answers_own_code_raises_is_the_students(answer):
    failure = answer("def f():\n    return (1 / k for k in (1, 0))\n")
    assert failure.kind == "exception"
    assert "rays.py, line 2: ZeroDivisionError" in failure.text


def test_objects_have_attributes_and_keys(answer):
    given = answer(
        """
        def f(camera, scene, i):
            both = {**camera}
            assert camera["eye"] == camera.eye == both["eye"] == camera.get("eye")
            assert "eye" in camera and "fov" not in camera and len(camera) == 10
            assert isinstance(camera.eye, tuple) and isinstance(i, int)
            assert [*camera] == [*camera.keys()] and not hasattr(camera, "fov")
            return scene.objects[1].center, camera.distance, scene.objects[0].kind, i
        """,
        camera=CAMERA,
        scene={"objects": [{"kind": "plane"}, {"kind": "sphere", "center": [1, 2, 3]}]},
        i=4,
    )
    assert given == [[1, 2, 3], 1.0, "plane", 4]


def test_the_letters_of_the_book_name_the_same_fields(answer):
    asked = "def f(camera):\n    return [camera.e, camera.d] == [camera.eye, camera.distance]\n"
    assert answer(asked, camera=CAMERA)
    failure = answer("def f(camera):\n    return camera.e\n", camera={"distance": 2})
    assert "there is no 'e' in it; it has: d or distance" in failure.text
    assert failure.traceback[-2].strip() in ("return camera.e", "^^^^^^^^")  # none of our lines


def test_a_failure_names_the_arguments_in_the_tasks_notation(student):
    one = student("def f(W, camera):\n    return camera.x\n")
    call = Call("f", (("width", 4), ("camera", CAMERA)), notation="book")
    text = one.call([call]).values[0].text
    assert "called as f(W=4, camera={e: " in text and "distance:" not in text


def test_a_call_does_not_change_what_the_next_is_given(student):
    one = student(
        """
        def f(camera, objects):
            before = camera.eye, camera.inner.x, len(objects), objects[0].r, hasattr(camera, "new")
            camera.eye, camera.inner.x, camera.new = 0, 0, 1
            objects[0].r = 0
            return before
        """
    )
    camera = {"eye": [1, 2, 3], "inner": {"x": 5}}
    again = called("f", camera=camera, objects=[{"r": 2}])
    run = one.call([again, again, again])
    assert run.values == ([[1, 2, 3], 5, 1, 2, False],) * 3


def test_thousands_of_calls_are_answered_in_order(student):
    one = student("def f(i, camera):\n    print(i)\n    return i, camera.eye\n", output=100)
    run = one.call([called("f", i=i, camera=CAMERA) for i in range(3072)])
    assert run.values == tuple([i, [0.0, 0.0, 5.0]] for i in range(3072))
    assert run.output.endswith("3070\n3071\n")
