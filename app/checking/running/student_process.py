"""Runs a student's Python file in a child process: reads calls, and writes their answers.

file.py passes this text to `python -c`, perhaps of another installation (3.9 or newer), so it
imports the standard library alone. Requests are lines of JSON on standard input. Each answer is a
line that begins with a letter: i, the contents of the file; a, a call's value; f, a failure.
"""

import _thread
import contextlib
import copy
import json
import linecache
import os
import queue
import sys
import traceback
import types
import warnings
from collections.abc import Mapping

_LONGEST_LINE = 300
_LONGEST_ANSWER = 120  # of an answer in a message
_FULL_TRACEBACKS = 3  # failures that are reported with all their lines
_FIRST_LINES, _LAST_LINES = 16, 24  # of a long traceback
_MOST_FILES = 32
_MEMORY_STATUS = 86  # exit status: no memory left to report that
_NAMED_PARTS = (("origin", "direction"), ("u", "v", "w"), ("x", "y", "z", "w"), ("x", "y", "z"))
_LETTERS = {"e": "eye", "d": "distance"}  # the lecture's, for these fields


def main(at_start):
    """Serve the other end until it closes its pipe.

    at_start: the names of modules that were loaded before ours. The student may have modules with
    the names of ours.
    """
    channel = Channel()
    try:
        student = StudentFile(channel.next(), at_start)
        try:
            student.load()
            channel.send("i", encode({"functions": student.functions(), "files": student.files()}))
        except BaseException as error:
            failed = {**student.failure(error, loading=True), "files": student.files(all_of=True)}
            channel.send("f", encode(failed))
        while True:
            student.answer(channel, channel.next())
    except MemoryError:
        os._exit(_MEMORY_STATUS)


class Channel:
    """Copies of standard input and output, for requests and answers.

    For the student's code, standard input is empty, and all printed text goes to standard error.
    """

    def __init__(self):
        self._process = os.getpid()
        self._requests, self._answers = os.dup(0), os.dup(1)
        nothing = os.open(os.devnull, os.O_RDONLY)
        os.dup2(nothing, 0)
        os.close(nothing)
        os.dup2(2, 1)
        for stream in (sys.stdout, sys.stderr):
            stream.reconfigure(encoding="utf-8", errors="backslashreplace", line_buffering=True)  # type: ignore[union-attr]
        self._lines: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        # A thread, because the end of the input ends this process even while a call runs.
        _thread.start_new_thread(self._read, ())

    def next(self):
        """Return the next request."""
        return json.loads(self._lines.get())

    def send(self, kind, text):
        """Send an answer, and the printed text before it."""
        if os.getpid() != self._process:
            os._exit(0)  # a fork by the student's code returned here
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(Exception):  # closed, or not a stream
                stream.flush()
        data = (kind + text + "\n").encode()
        while data:
            data = data[os.write(self._answers, data) :]

    def _read(self):
        with open(self._requests, "rb") as requests:
            for line in requests:
                self._lines.put(line)
        os._exit(1)


class StudentFile:
    """A student's file. opening: its path, and its source (bytes as Latin-1)."""

    def __init__(self, opening, at_start):
        self._path, self._source = opening["path"], opening["source"].encode("latin-1")
        self._at_start = at_start
        self._folder = os.path.dirname(self._path)
        self._failures = 0
        stem = os.path.splitext(os.path.basename(self._path))[0]
        self._module = types.ModuleType(stem if stem not in sys.modules else "student")
        self._module.__file__ = self._path

    def load(self):
        """Run the file. Raises whatever the file raises."""
        sys.path.insert(0, self._folder)
        sys.argv[:] = [self._path]
        with contextlib.suppress(OSError):  # the folder cannot be listed
            own = {name.partition(".")[0] for name in os.listdir(self._folder)}
            for name in sys.modules.keys() - self._at_start:
                if name.partition(".")[0] in own:
                    del sys.modules[name]
        warnings.formatwarning = self._warning
        code = compile(self._source, self._path, "exec", dont_inherit=True)
        text = self._source.decode("utf-8", "replace")
        # For tracebacks: the file may be saved in the meantime.
        linecache.cache[self._path] = (len(text), None, text.splitlines(True), self._path)
        sys.modules[self._module.__name__] = self._module
        exec(code, self._module.__dict__)

    def _warning(self, message, category, filename, lineno, line=None):
        return f"{self._short(filename)}:{lineno}: {category.__name__}: {message}\n"

    def functions(self):
        """Return the names of all callables."""
        values = self._module.__dict__.items()
        return [name for name, value in values if callable(value) and not name.startswith("__")]

    def files(self, all_of=False):
        """Return the paths of the student's imported modules; all_of: of all modules beside the
        file, because one of them may have prevented its import.
        """
        found = []
        for module in [*sys.modules.values()]:
            with contextlib.suppress(Exception):  # may hold any object
                found.append(module.__file__)
        if all_of:
            with contextlib.suppress(OSError):
                found += [os.path.join(self._folder, name) for name in os.listdir(self._folder)]
        inside = self._folder + os.sep
        own = [
            path
            for path in dict.fromkeys(found)
            if isinstance(path, str) and path.startswith(inside) and path.endswith(".py")
        ]
        return [path for path in own if path != self._path][:_MOST_FILES]

    def answer(self, channel, request):
        """Answer a request.

        shared: (name, value, as array) for each list or object.
        calls: (function, arguments); an argument is a plain value, or [index in shared].
        """
        self._failures = 0
        made = [
            array_maker(value) if as_array else maker(value, name)
            for name, value, as_array in request["shared"]
        ]
        for name, arguments in request["calls"]:
            channel.send(*self._called(name, arguments, made))

    def _called(self, name, arguments, made):
        """Run a call. Return the letter of its result, and its text."""
        try:
            function = self._module.__dict__[name]
            answer = function(*[made[a[0]]() if type(a) is list else a for a in arguments])
            try:
                return "a", written(answer)
            except Exception as error:
                if isinstance(error, MemoryError) or self._where(error):
                    raise
                failure = {"kind": "answer", "text": no_answer(answer), "where": "", "lines": []}
        except BaseException as error:
            failure = self.failure(error)
        return "f", encode(failure)

    def failure(self, error, loading=False):
        """Return kind and text of an error, its line in the student's files, and its traceback."""
        self._failures += 1
        where = self._where(error)
        kind = "exception"
        if isinstance(error, SystemExit):
            kind = "ended"
        elif isinstance(error, MemoryError):
            kind = "memory"
        elif loading and (isinstance(error, SyntaxError) or not where):
            kind = "syntax"  # null bytes are a ValueError
        lines = self._lines(error) if self._failures <= _FULL_TRACEBACKS else []
        return {"kind": kind, "text": one_line(error), "where": where, "lines": lines}

    def _where(self, error):
        """Return the last line in the student's own files; "" if there is none."""
        if isinstance(error, SyntaxError) and error.lineno and error.filename:
            return f"{self._short(error.filename)}, line {error.lineno}"
        where = ""
        for frame, number in traceback.walk_tb(error.__traceback__):
            name = frame.f_code.co_filename
            if name.startswith(self._folder + os.sep) and "site-packages" not in name:
                where = f"{self._short(name)}, line {number}"
        return where

    def _lines(self, error):
        step = error.__traceback__
        while step is not None and not step.tb_frame.f_code.co_filename.startswith(self._folder):
            step = step.tb_next
        told = traceback.format_exception(type(error), error, step)
        lines = self._short("".join(told), 'File "').splitlines()
        lines = [line[:_LONGEST_LINE] for line in lines]
        if len(lines) > _FIRST_LINES + _LAST_LINES + 1:
            left_out = f"  ... {len(lines) - _FIRST_LINES - _LAST_LINES} lines left out ..."
            lines[_FIRST_LINES:-_LAST_LINES] = [left_out]
        return lines

    def _short(self, text, before=""):
        return text.replace(f"{before}{self._folder}{os.sep}", before)


def one_line(error):
    try:
        text = " ".join(str(error.msg if isinstance(error, SyntaxError) else error).split())
    except BaseException:
        text = ""  # the student's __str__ failed
    text = text if len(text) <= _LONGEST_LINE else text[:_LONGEST_LINE] + "..."
    return type(error).__name__ + (f": {text}" if text not in ("", "None") else "")


def no_answer(answer):
    """Describe an answer that JSON cannot represent."""
    if isinstance(answer, types.CoroutineType):
        answer.close()  # otherwise Python warns about it
        return "a coroutine: write def, not async def"
    try:
        text = " ".join(repr(answer).split())
    except BaseException:
        text = "something"
    text = text if len(text) <= _LONGEST_ANSWER else text[: _LONGEST_ANSWER - 3] + "..."
    return text if isinstance(answer, type) else f"{text} of type {type(answer).__name__}"


class Values(types.SimpleNamespace, Mapping):
    """A camera, or an object of a scene: camera.eye, camera["eye"], and camera.e."""

    def __getattr__(self, name):
        if _LETTERS.get(name) in self.__dict__:
            return self.__dict__[_LETTERS[name]]
        has = ", ".join(self.__dict__)
        raise AttributeError(f"{type(self).__name__} has no {name!r}; it has: {has}")

    def __getitem__(self, name):
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

    def __reduce__(self):  # processes that the student starts lack this class
        return types.SimpleNamespace, (), self.__dict__

    def __deepcopy__(self, memo):
        return type(self)(**copy.deepcopy(self.__dict__, memo))


def maker(value, name):
    """Return a function that makes an argument for each call.

    Objects, which the student's code could change, are new for each call. Lists become tuples.
    """
    if isinstance(value, dict):
        kind = type(name.title().replace("_", "") or "Values", (Values,), {})
        parts = {key: maker(part, key) for key, part in value.items()}
        return lambda: kind(**{key: make() for key, make in parts.items()})
    if isinstance(value, list):
        makers = [maker(part, name[:-1] if name.endswith("s") else name) for part in value]
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
    if type(answer) not in (list, tuple) and isinstance(answer, (tuple, dict)):
        answer = named_parts(answer, _NAMED_PARTS[:1]) or answer
    return encode(answer)


def named_parts(value, names):
    for parts in names:
        if isinstance(value, dict) and all(part in value for part in parts):
            return {part: value[part] for part in parts}
        if all(hasattr(value, part) for part in parts):
            found = [getattr(value, part) for part in parts]
            return found if parts[0] == "x" else dict(zip(parts, found))  # noqa: B905 - Python 3.9
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
