"""Run a student's Python file in a child process: read calls, and write their answers.

file.py passes this text to `python -c`, perhaps of another installation (3.9 or newer), so it
imports only the standard library. Requests are lines of JSON on standard input: the file, then
lists of calls. Each answer is a line that begins with a letter: a, the names of the file's
functions, or a call's value; f, a failure.
"""

import _thread
import contextlib
import json
import linecache
import numbers
import operator
import os
import queue
import sys
import traceback
import types

_LONGEST_LINE = 300
_LAST_FRAMES = 12  # of a long traceback
_NAMED_PARTS = (("origin", "direction"), ("u", "v", "w"), ("x", "y", "z", "w"), ("x", "y", "z"))
_LETTERS = {"e": "eye", "d": "distance"}  # the lecture's letters for these fields


def main():
    """Serve the other end until it closes its pipe."""
    channel = Channel()
    student = StudentFile(channel.next())
    channel.send(*student.answer(student.load))
    while True:
        for name, arguments in channel.next():
            given = [made(value) for _, value in arguments]
            channel.send(*student.answer(student.called, name, given))


class Channel:
    """Copies of standard input and output, for requests and answers.

    The student's code has an empty standard input, and all printed text goes to standard error.
    """

    def __init__(self):
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

    def send(self, kind, value):
        """Send an answer, and the printed text before it. value: JSON text or JSON values."""
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(Exception):  # closed, or not a stream
                stream.flush()
        text = value if isinstance(value, str) else encode(value)
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

    def __init__(self, opening):
        self._path, self._source = opening["path"], opening["source"].encode("latin-1")
        self._folder = os.path.dirname(self._path)
        self._module = types.ModuleType("student")
        self._module.__file__ = self._path

    def load(self):
        """Run the file. Return the names of all callables. Raises whatever the file raises."""
        sys.path.insert(0, self._folder)
        sys.argv[:] = [self._path]
        code = compile(self._source, self._path, "exec", dont_inherit=True)
        text = self._source.decode("utf-8", "replace")
        # Keep the text for tracebacks, because the file may be saved in the meantime.
        linecache.cache[self._path] = (len(text), None, text.splitlines(True), self._path)
        sys.modules[self._module.__name__] = self._module
        exec(code, self._module.__dict__)
        values = self._module.__dict__.items()
        return [name for name, value in values if callable(value) and not name.startswith("__")]

    def called(self, name, arguments):
        """Return a function's result. Raises whatever it raises."""
        return self._module.__dict__[name](*arguments)

    def answer(self, run, *arguments):
        """Run a function. Return the letter of its result, and the result as JSON."""
        try:
            value = run(*arguments)
            try:
                return "a", encode(value)
            except Exception as error:
                if isinstance(error, MemoryError) or self._where(error):
                    raise
            text = f"something of type {type(value).__name__}"
            with contextlib.suppress(Exception):  # the student's __repr__ may fail
                text = f"{repr(value)[:_LONGEST_LINE]} of type {type(value).__name__}"
            return "f", {"kind": "answer", "text": text, "where": "", "lines": []}
        except BaseException as error:
            return "f", self.failure(error)

    def failure(self, error):
        """Return kind and text of an error, its line in the student's files, and its traceback."""
        kinds = {SystemExit: "ended", MemoryError: "memory"}
        kind = next((kinds[one] for one in kinds if isinstance(error, one)), "exception")
        text = type(error).__name__
        with contextlib.suppress(BaseException):  # the student's __str__ may fail
            told = str(error.msg if isinstance(error, SyntaxError) else error)[:_LONGEST_LINE]
            text += f": {told}" if told not in ("", "None") else ""
        where, lines = self._where(error), self._lines(error)
        return {"kind": kind, "text": text, "where": where, "lines": lines}

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
        told = traceback.TracebackException(type(error), error, step, limit=-_LAST_FRAMES)
        own = [frame.f_globals is globals() for frame, _ in traceback.walk_tb(step)]
        while told.stack and own.pop():  # __getattr__ and __getitem__ below
            told.stack.pop()
        lines = self._short("".join(told.format()), 'File "').splitlines()
        return [line[:_LONGEST_LINE] for line in lines]

    def _short(self, text, before=""):
        return text.replace(f"{before}{self._folder}{os.sep}", before)


class Values(dict):
    """A camera, or an object of a scene: camera.eye, camera["eye"], and camera.e."""

    __hash__ = object.__hash__  # type: ignore[assignment]
    __setattr__ = dict.__setitem__

    def __getattr__(self, name):
        if (field := _LETTERS.get(name, name)) in self:
            return self[field]
        letters = {word: letter for letter, word in _LETTERS.items()}
        has = ", ".join(f"{letters[one]} or {one}" if one in letters else one for one in self)
        raise AttributeError(f"there is no {name!r} in it; it has: {has}")


def _with(operation):
    """Return a method that combines a vector with another one, number by number."""

    def combined(self, other):
        if isinstance(other, (tuple, list)) and len(other) == len(self):
            return Vector(map(operation, self, other))
        if operation is operator.add and isinstance(other, tuple):
            return (*self, *other)  # eye + (1,), as tuples are
        return NotImplemented

    return combined


def _scaled(operation):
    """Return a method that scales a vector."""

    def scaled(self, number):
        if not isinstance(number, numbers.Number):
            return NotImplemented
        return Vector(operation(part, number) for part in self)

    return scaled


class Vector(tuple):
    """Numbers that can be added, subtracted and scaled, as in a formula: eye + x*u + y*v."""

    __slots__ = ()
    __add__, __radd__ = _with(operator.add), _with(lambda mine, its: its + mine)
    __sub__, __rsub__ = _with(operator.sub), _with(lambda mine, its: its - mine)
    __mul__ = __rmul__ = _scaled(operator.mul)
    __truediv__ = _scaled(operator.truediv)

    def __neg__(self):
        return -1 * self


def made(value):
    """Return an argument: objects for dicts, and vectors or tuples for lists."""
    if isinstance(value, dict):
        return Values({key: made(part) for key, part in value.items()})
    if not isinstance(value, list):
        return value
    if all(isinstance(part, numbers.Number) for part in value):
        return Vector(value)
    return tuple([made(part) for part in value])


def plain(value):
    """Convert a value that JSON lacks one step towards one that it has."""
    if callable(method := getattr(value, "tolist", None)):
        return method()
    for parts in _NAMED_PARTS:
        if all(hasattr(value, part) for part in parts):
            found = [getattr(value, part) for part in parts]
            return found if parts[0] == "x" else dict(zip(parts, found))  # noqa: B905 - Python 3.9
    if hasattr(value, "__float__"):
        return float(value)
    return dict(value) if hasattr(value, "keys") else list(value)


encode = json.JSONEncoder(default=plain).encode
