"""The supervisor of a student's program: starts it, confines it, and outlives all that it starts.

Runs in a separate process and imports only the standard library. Orders come on standard input, as
one line of JSON; the end of that input means: kill everything. Standard output gets one line for
the start ("started", or an errno) and one for the program's exit status. On Linux, orphans of the
program become children of this process: once it has no children left, nothing is running any more.
"""

import contextlib
import errno
import fcntl
import json
import os
import resource
import select
import signal
import struct
import sys

_ERROR = 3  # descriptor for the errno of a failed start
_DUMPABLE, _NO_NEW_PRIVILEGES, _SUBREAPER, _SECCOMP, _DROP_BOUND = 4, 38, 36, 22, 24  # prctl
_CAPSET = {"x86_64": 126, "aarch64": 91}
_CALLS = {"x86_64": (0xC000003E, 41, 302), "aarch64": (0xC00000B7, 198, 261)}  # socket, prlimit64
_IO_URING_SETUP = 425  # same on all architectures, like Landlock's
_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
_OF_FILES = 1 | 2 | 4 | 1 << 14 | 1 << 15  # Landlock: execute, write, read, truncate, ioctl


def main():
    orders = json.loads(_line(0))
    if sys.platform == "linux":
        _prctl(_SUBREAPER, 1)
        _prctl(_DUMPABLE, 0)  # only root can read this process' memory
    woken, wake = os.pipe()
    os.set_blocking(wake, False)
    signal.set_wakeup_fd(wake)
    signal.signal(signal.SIGCHLD, lambda *_: None)
    program = _start(orders)
    for file in orders["files"]:
        os.close(file)
    while True:
        ready, _, _ = select.select([0, woken], [], [])
        if 0 in ready:
            break
        os.read(woken, 1 << 12)
        with contextlib.suppress(ChildProcessError):
            while (ended := os.waitpid(-1, os.WNOHANG))[0]:
                if ended[0] == program:
                    _say(os.waitstatus_to_exitcode(ended[1]))
    _end_all(program)
    if "scratch" in orders:
        import shutil

        shutil.rmtree(orders["scratch"], ignore_errors=True)


def _line(file):
    text = b""
    while not text.endswith(b"\n"):
        text += os.read(file, 1 << 16) or sys.exit(1)
    return text


def _say(what):
    with contextlib.suppress(OSError):  # the other end is gone
        os.write(1, f"{what}\n".encode())


def _start(orders):
    """Start the program, report that, and return its process id."""
    failed, error = os.pipe()
    program = os.fork()
    if not program:
        try:
            _become(orders, error)
        except OSError as problem:
            os.write(_ERROR, str(problem.errno).encode())
        finally:
            os._exit(127)
    os.close(error)
    _say(os.read(failed, 9).decode() or "started")
    os.close(failed)
    return program


def _end_all(program):
    with contextlib.suppress(OSError):
        os.killpg(program, signal.SIGKILL)
    with contextlib.suppress(ChildProcessError):  # no children left
        while True:
            for process in _children():
                with contextlib.suppress(OSError):
                    os.kill(process, signal.SIGKILL)
            os.waitpid(-1, 0)  # its children become this process' children


def _children():
    try:
        with open(f"/proc/self/task/{os.getpid()}/children") as file:
            return [*map(int, file.read().split())]
    except OSError:
        return []


# The functions below run in the process that becomes the program.


def _become(orders, error):
    os.setsid()
    files = [*orders["files"], error]
    if "bubblewrap" in orders:
        # The program cannot close pipes that bubblewrap holds open, so its launcher takes them.
        # The arguments come through a pipe: the program could read a command line.
        read, write = os.pipe()
        os.write(write, "\0".join(orders["bubblewrap"]).encode())
        os.close(write)
        unread = os.pipe()[1]  # a pipe, like its replacement: Python checks the type only once
        nothing = os.open(os.devnull, os.O_RDONLY)
        files = [nothing, unread, unread, error, read, *orders["files"]]
    files = [fcntl.fcntl(file, fcntl.F_DUPFD, 10) for file in files]
    for number, file in enumerate(files):
        os.dup2(file, number)
    os.closerange(len(files), max(*files, *orders["files"]) + 1)
    os.set_inheritable(_ERROR, "bubblewrap" in orders)
    signal.set_wakeup_fd(-1)
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    most = orders["memory_mb"] << 20  # file size limit, because files in memory count nowhere else
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
    with contextlib.suppress(PermissionError):  # the user has no access to the folder
        os.chdir(orders["folder"])
    ruleset = _ruleset(orders) if "rules" in orders else None
    if "user" in orders:
        user, group = orders["user"]
        os.setgroups([])
        os.setgid(group)
        os.setuid(user)
    if ruleset is not None:
        _restrict(ruleset, orders)
    os.execvpe(orders["command"][0], orders["command"], orders["environment"])


def _libc():
    import ctypes

    return ctypes.CDLL(None, use_errno=True)


def _prctl(option, *values):
    _called(_libc().prctl, option, *[*values, 0, 0, 0, 0][:4])


def _called(function, *values):
    """Call a C function. Raises OSError."""
    import ctypes

    result = function(*[ctypes.c_long(v) if isinstance(v, int) else v for v in values])
    if result < 0:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))
    return result


def _ruleset(orders):
    """Make Landlock's rules. Open the folders before the user changes, because that user may lack
    access.
    """
    syscall, abi = _libc().syscall, orders["landlock"]
    handled = (1 << {1: 13, 2: 14, 3: 15, 4: 15}.get(abi, 16)) - 1
    network = 0 if orders["network"] else 3
    fields = [handled, network, 3][: 1 if abi < 4 else 2 if abi < 6 else 3]  # 3: pipes and signals
    data = struct.pack(f"{len(fields)}Q", *fields)
    ruleset = _called(syscall, _CREATE_RULESET, data, len(data), 0)
    for path, rights in orders["rules"]:
        try:
            file = os.open(path, os.O_PATH | os.O_CLOEXEC)
        except OSError:
            continue
        allowed = handled & rights & (-1 if os.path.isdir(path) else _OF_FILES)
        _called(syscall, _ADD_RULE, ruleset, 1, struct.pack("=Qi", allowed, file), 0)
        os.close(file)
    return ruleset


def _restrict(ruleset, orders):
    libc, machine = _libc(), os.uname().machine
    if os.geteuid() == 0:
        with contextlib.suppress(OSError):  # stops after the kernel's last capability
            for capability in range(64):
                _prctl(_DROP_BOUND, capability)
        if machine in _CAPSET:
            header = struct.pack("Ii", 0x20080522, 0)
            _called(libc.syscall, _CAPSET[machine], header, bytes(24))
    _prctl(_NO_NEW_PRIVILEGES, 1)
    _called(libc.syscall, _RESTRICT_SELF, ruleset, 0)
    os.close(ruleset)
    if machine in _CALLS:
        _filter_calls(*_CALLS[machine], orders["network"])


def _filter_calls(architecture, socket, prlimit, network):
    """Forbid what Landlock does not cover: changing other processes' limits and, without a network,
    all sockets, including Unix sockets with a path.
    """
    import ctypes

    load, equal, greater, answer = 0x20, 0x15, 0x35, 0x06
    steps = [
        (load, 0, 0, 4),
        (equal, 0, 7, architecture),
        (load, 0, 0, 0),
        (greater, 5, 0, 0x40000000),  # x32 numbers of the same calls
        (equal, 0 if network else 4, 0, socket),
        (equal, 0 if network else 3, 0, _IO_URING_SETUP),
        (equal, 0, 3, prlimit),
        (load, 0, 0, 16),  # target process of prlimit; 0 is the caller
        (equal, 1, 0, 0),
        (answer, 0, 0, 0x00050000 | errno.EPERM),
        (answer, 0, 0, 0x7FFF0000),  # allowed
    ]
    program = ctypes.create_string_buffer(b"".join(struct.pack("HBBI", *step) for step in steps))
    pointer = ctypes.create_string_buffer(struct.pack("HP", len(steps), ctypes.addressof(program)))
    _prctl(_SECCOMP, 2, ctypes.cast(pointer, ctypes.c_void_p))


if __name__ == "__main__":
    main()
