"""Arguments for a student's function, and its answers in JSON, in the student's process.

Imports only the standard library: see student_process.py.
"""

import copy
import json
import types
from collections.abc import Mapping

_PLAIN = (list, tuple)
_NAMED_PARTS = (("origin", "direction"), ("u", "v", "w"), ("x", "y", "z", "w"), ("x", "y", "z"))


def printable(line):
    """Escape characters that a terminal could take for a command."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in line.expandtabs(4))


def no_answer(answer):
    """Describe an answer that JSON cannot represent."""
    if isinstance(answer, types.CoroutineType):
        answer.close()  # otherwise Python warns about it at a line of ours
        return "a coroutine: write def, not async def"
    try:
        text = " ".join(repr(answer).split())
    except BaseException:
        text = "something"
    text = printable(text if len(text) <= 120 else text[:117] + "...")
    return text if isinstance(answer, type) else f"{text} of type {type(answer).__name__}"


LETTERS = {"e": "eye", "d": "distance"}  # the book's, for these fields


class Values(types.SimpleNamespace, Mapping):
    """A camera, or an object of a scene: camera.eye, camera["eye"], and camera.e."""

    def __getattr__(self, name):
        if LETTERS.get(name) in self.__dict__:
            return self.__dict__[LETTERS[name]]
        has = ", ".join(self.__dict__)
        kind = type(self).__name__
        raise AttributeError(f"{kind} has no {name!r}; it has: {has}", name=name, obj=self)

    def __getitem__(self, name):
        if name not in self.__dict__:
            raise KeyError(name)
        return self.__dict__[name]

    def __setitem__(self, name, value):
        self.__dict__[name] = value

    def __iter__(self):
        return iter(self.__dict__)

    def __len__(self):
        return len(self.__dict__)

    def __eq__(self, other):
        return self is other

    def __hash__(self):  # type: ignore[override]
        return id(self)

    def __reduce__(self):  # processes started by the student lack this class
        return types.SimpleNamespace, (), self.__dict__

    def __copy__(self):
        return type(self)(**self.__dict__)

    def __deepcopy__(self, memo):
        return type(self)(**copy.deepcopy(self.__dict__, memo))


def maker(value, name):
    """Return a function that makes an argument for each call.

    Objects, which the student's code could change, are new for each call. Lists become tuples.
    """
    if isinstance(value, dict):
        kind = type(name.title().replace("_", "") or "Values", (Values,), {})
        parts = {key: maker(part, key) for key, part in value.items()}
        constant = {key: parts[key]() for key, part in value.items() if not has_objects(part)}
        changing = {key: make for key, make in parts.items() if key not in constant}
        if not changing:
            return lambda: kind(**constant)
        return lambda: kind(**{key: make() for key, make in parts.items()})
    if isinstance(value, list):
        makers = [maker(part, name.removesuffix("s")) for part in value]
        if has_objects(value):
            return lambda: tuple([make() for make in makers])
        value = tuple([make() for make in makers])
    return lambda: value


def has_objects(value):
    return isinstance(value, dict) or (isinstance(value, list) and any(map(has_objects, value)))


def array_maker(value):
    """Return a function that makes a NumPy array for each call."""

    def make():
        import numpy

        return numpy.array(value)

    return make


def written(answer):
    """Return the answer in JSON.

    Raises TypeError, ValueError and such if JSON cannot represent it, and whatever the student's
    own code raises on the way, for instance in a generator.
    """
    if type(answer) not in _PLAIN and isinstance(answer, (tuple, dict)):
        answer = named_parts(answer, _NAMED_PARTS[:1]) or answer
    return encode(answer)


def named_parts(value, names):
    for parts in names:
        if isinstance(value, dict) and all(part in value for part in parts):
            return {part: value[part] for part in parts}
        if all(hasattr(value, part) for part in parts):
            found = [getattr(value, part) for part in parts]
            return found if parts[0] == "x" else dict(zip(parts, found, strict=True))
    return None


def plain(value):
    """Convert a value that JSON lacks one step towards one that it has."""
    if isinstance(value, (type, set, frozenset, types.ModuleType, types.FunctionType)):
        raise TypeError
    for name in ("tolist", "item"):
        if callable(method := getattr(value, name, None)):
            return method()
    if (parts := named_parts(value, _NAMED_PARTS)) is not None:
        return parts
    if hasattr(value, "__index__"):
        return value.__index__()
    if hasattr(value, "__float__"):
        return float(value)
    if hasattr(value, "keys"):
        return dict(value)
    return list(value)


encode = json.JSONEncoder(default=plain).encode
