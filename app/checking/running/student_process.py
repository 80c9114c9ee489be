"""Our code in the process that runs a student's Python file: it reads calls and answers them.

Its text arrives over standard input, as does that of student_values.py, so the process knows none
of our paths. It imports only the standard library, and stays out of the way of a student's own
modules. The other end is file.py. Each request is a line of JSON. Each answer is a line that begins
with a letter: i, the contents of the file; a, a call's value; m, no such function; f, a failure.
"""

import _thread
import contextlib
import json
import linecache
import os
import queue
import site
import sys
import tokenize
import traceback
import types
import warnings
from importlib.machinery import PathFinder
from io import BytesIO, TextIOWrapper

from app.checking.running.student_values import (
    array_maker,
    encode,
    maker,
    no_answer,
    printable,
    written,
)

_LONGEST_LINE = 300
_FULL_TRACEBACKS = 3  # failures of a run that are told with all their lines
_LEAST_RECURSION = 500  # of sys.setrecursionlimit, for what is done here
_MOST_FILES = 32  # of the student's other modules that are told
_FIRST_LINES, _LAST_LINES = 16, 24  # of a long traceback
_RIGHT_ANSWERS = ("app", "renderer", "shaders")  # our packages, wherever they are installed


def main(at_start):
    """Serve the process at the other end until that closes its pipe.

    at_start: the modules that were loaded before ours. The student may have modules with the same
    names as later ones.
    """
    for name in [name for name in sys.modules if name.startswith("app.")]:
        del sys.modules[name]
    sys.modules["__main__"] = types.ModuleType("__main__")  # hides this file
    channel = Channel()
    student = StudentFile(channel.next(), at_start)
    try:
        student.load()
        kind, told = "i", student.names()
    except BaseException as error:
        kind, told = "f", {**student.failure(error, loading=True), "files": student.files(error)}
    channel.send(kind, encode(told), mark=student.mark)
    while True:
        student.answer(channel, channel.next())


class Channel:
    """Copies of standard input and output, for requests and answers.

    The student's own ones are replaced: standard input is empty, and printed text goes to standard
    error.
    """

    def __init__(self):
        self._process = os.getpid()
        self._requests, self._answers, self._output = os.dup(0), os.dup(1), os.dup(2)
        nothing = os.open(os.devnull, os.O_RDONLY)
        os.dup2(nothing, 0)
        os.close(nothing)
        os.dup2(2, 1)
        for stream in (sys.stdout, sys.stderr):
            stream.reconfigure(  # type: ignore[union-attr]
                encoding="utf-8", errors="backslashreplace", line_buffering=True
            )
        if hasattr(os, "register_at_fork"):
            os.register_at_fork(after_in_child=self._forget)
        self._lines: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        # Not with threading, so that the student's code does not see this thread.
        _thread.start_new_thread(self._read, ())

    def next(self):
        """Return the next request."""
        return json.loads(self._lines.get())

    def send(self, kind, text, mark=None):
        """Send an answer. mark: written to the output to show that everything was printed."""
        if os.getpid() != self._process:
            os._exit(0)  # a fork by the student's code returned here
        if mark is not None:
            for stream in (sys.stdout, sys.stderr):
                with contextlib.suppress(Exception):  # closed, or not a stream
                    stream.flush()
            self._write(self._output, mark.encode())
        self._write(self._answers, f"{kind}{text}\n".encode())

    @staticmethod
    def _write(file, data):
        while data:
            data = data[os.write(file, data) :]

    def _read(self):
        pending: list[bytes] = []
        with contextlib.suppress(OSError):  # closed by the student's code
            while chunk := os.read(self._requests, 1 << 16):
                *lines, rest = chunk.split(b"\n")
                for line in lines:
                    self._lines.put(b"".join([*pending, line]))
                    pending = []
                pending.append(rest)
        os._exit(1)  # the other end is gone

    def _forget(self):
        for file in (self._requests, self._answers, self._output):
            with contextlib.suppress(OSError):
                os.close(file)


class StudentFile:
    """A student's file.

    opening: path, source (its bytes as Latin-1), libraries, memory_mb, mark.
    at_start: as for main().
    """

    def __init__(self, opening, at_start):
        self._libraries, self._at_start = opening["libraries"], at_start
        self.mark = opening["mark"]
        self._path, self._source = opening["path"], opening["source"].encode("latin-1")
        self._folder = os.path.dirname(self._path)
        self._failures = 0
        stem = os.path.splitext(os.path.basename(self._path))[0]
        taken = stem in sys.modules or stem in sys.stdlib_module_names or not stem.isidentifier()
        self._module = types.ModuleType("student" if taken else stem)
        self._module.__file__ = self._path
        limit_memory(opening["memory_mb"])

    def load(self):
        """Run the file. Raises whatever the file raises."""
        sys.path[:] = [self._folder, *sys.path, *self._libraries]
        site.setquit()
        sys.argv[:] = [self._path]
        sys.orig_argv[:] = [sys.executable, self._path]
        sys.meta_path.insert(0, self)
        own = set()
        with contextlib.suppress(OSError):  # the folder cannot be listed
            own = {name.partition(".")[0] for name in os.listdir(self._folder)}
        own.discard(os.path.splitext(os.path.basename(self._path))[0])
        for name in sys.modules.keys() - self._at_start:
            if name.partition(".")[0] in own:
                del sys.modules[name]  # the student has a module with that name
        warnings.formatwarning = self._warning
        code = compile(self._source, self._path, "exec", dont_inherit=True)
        self._keep_lines()
        sys.modules[self._module.__name__] = self._module
        exec(code, self._module.__dict__)

    def find_spec(self, name, path=None, target=None):
        """Find the student's own `renderer` and such, not an installed one. Called by importlib.

        The sandbox hides the files of the installed one as well, where the system supports that.
        """
        if path is not None or name not in _RIGHT_ANSWERS:
            return None
        found = PathFinder.find_spec(name, [self._folder])
        with contextlib.suppress(OSError):  # an installed one, hidden by the sandbox
            if found and found.origin:
                open(found.origin, "rb").close()
                return found
            if found and any(map(os.listdir, found.submodule_search_locations or ())):
                return found
        raise ModuleNotFoundError(f"No module named {name!r}", name=name)

    def _warning(self, message, category, filename, lineno, line=None):
        """Format a warning as Python does, without paths. A line of ours is the call of the
        student's code.
        """
        where = "" if filename == __file__ else f"{self._short(filename)}:{lineno}: "
        return f"{where}{category.__name__}: {message}\n"

    def _keep_lines(self):
        """Keep the source for tracebacks: the file may be saved or deleted in the meantime."""
        encoding, _ = tokenize.detect_encoding(BytesIO(self._source).readline)
        text = TextIOWrapper(BytesIO(self._source), encoding).read()
        linecache.cache[self._path] = (len(text), None, text.splitlines(True), self._path)

    def names(self):
        """Return all callables (functions), those that the file defines itself (own), and the paths
        of its modules (files).
        """
        found = {
            name: value
            for name, value in self._module.__dict__.items()
            if callable(value) and not name.startswith("__")
        }
        own = [
            name
            for name, value in found.items()
            if getattr(value, "__module__", None) == self._module.__name__
        ]
        return {"functions": [*found], "own": own, "files": self.files()}

    def files(self, error=None):
        """Return the paths of the student's other modules that were imported, or whose import the
        error prevented.
        """
        found = []
        for module in [*sys.modules.values()]:
            with contextlib.suppress(Exception):  # may hold any object
                found.append(module.__file__)
        step = error.__traceback__ if error else None
        while step is not None:
            found.append(step.tb_frame.f_code.co_filename)
            step = step.tb_next
        if isinstance(error, SyntaxError):
            found.append(error.filename)
        if isinstance(error, ImportError) and error.name:
            found.append(os.path.join(self._folder, *error.name.split(".")) + ".py")
        return [path for path in dict.fromkeys(found) if self._is_own(path)][:_MOST_FILES]

    def _is_own(self, path):
        is_inside = isinstance(path, str) and path.startswith(self._folder + os.sep)
        return is_inside and "site-packages" not in path and path != self._path

    def answer(self, channel, request):
        """Answer a request.

        shared: (name, value, as array) for each list or object.
        calls: (function, arguments); an argument is a plain value, or [index in shared].
        """
        self._failures = 0
        made, calls = [], request["calls"]
        for name, value, as_array in request["shared"]:
            made.append(array_maker(value) if as_array else maker(value, name))
        for number, call in enumerate(calls):
            kind, text = self._called(call, made)
            if sys.getrecursionlimit() < _LEAST_RECURSION:
                sys.setrecursionlimit(_LEAST_RECURSION)
            channel.send(kind, text, mark=self.mark if number + 1 == len(calls) else None)

    def _called(self, call, made):
        """Run a call. Return the letter of its result, and its text."""
        name, arguments = call
        function = self._module.__dict__.get(name)
        if not callable(function):
            return "m", ""
        try:
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
        """Return kind and text of an error, its line in the student's files, and the traceback's
        lines there.
        """
        sys.setrecursionlimit(max(sys.getrecursionlimit(), _LEAST_RECURSION))
        self._failures += 1
        where = self._where(error)
        kind = "exception"
        if isinstance(error, SystemExit):
            kind = "ended"
        elif isinstance(error, MemoryError):
            kind = "memory"
        elif loading and (isinstance(error, SyntaxError) or not where):
            kind = "syntax"  # null bytes are a ValueError
        full = self._failures <= _FULL_TRACEBACKS
        lines = self._lines(traceback.TracebackException.from_exception(error)) if full else []
        return {"kind": kind, "text": self._one_line(error), "where": where, "lines": lines}

    def _where(self, error):
        """Return the last line in the student's own files; "" if there is none."""
        if isinstance(error, SyntaxError) and error.lineno and error.filename:
            return f"{self._short(error.filename)}, line {error.lineno}"
        step, where = error.__traceback__, ""
        while step is not None:
            name = step.tb_frame.f_code.co_filename
            if name.startswith(self._folder + os.sep) and "site-packages" not in name:
                where = f"{self._short(name)}, line {step.tb_lineno}"
            step = step.tb_next
        return where

    def _one_line(self, error):
        try:
            text = " ".join(str(error.msg if isinstance(error, SyntaxError) else error).split())
        except BaseException:
            text = ""  # the student's __str__ failed
        text = (
            f"{type(error).__name__}: {text}" if text not in ("", "None") else type(error).__name__
        )
        return printable(text if len(text) <= _LONGEST_LINE else text[:_LONGEST_LINE] + "...")

    def _lines(self, told):
        seen = set()

        def forget_ours(told):
            if told is None or id(told) in seen:
                return
            seen.add(id(told))
            told.stack[:] = [
                frame
                for frame in told.stack
                if frame.filename != __file__ and not frame.filename.startswith("<frozen ")
            ]
            group = getattr(told, "exceptions", None) or ()
            for other in (told.__cause__, told.__context__, *group):
                forget_ours(other)

        forget_ours(told)
        text = "".join(told.format()).replace(f'File "{self._folder}{os.sep}', 'File "')
        lines = [printable(line[:_LONGEST_LINE]) for line in text.splitlines()]
        if len(lines) > _FIRST_LINES + _LAST_LINES + 1:
            left_out = f"  ... {len(lines) - _FIRST_LINES - _LAST_LINES} lines left out ..."
            lines[_FIRST_LINES:-_LAST_LINES] = [left_out]
        return lines

    def _short(self, path):
        return printable(path.removeprefix(self._folder + os.sep))


def limit_memory(megabytes):
    try:
        import resource

        with open("/proc/self/statm") as file:
            now = int(file.read().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        most = now + (megabytes << 20)
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
    except (ImportError, OSError, ValueError):
        pass  # unsupported here: the other end checks memory
