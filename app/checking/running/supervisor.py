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
_ARCHITECTURE = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
_SOCKET, _PRLIMIT = {"x86_64": 41, "aarch64": 198}, {"x86_64": 302, "aarch64": 261}
_IO_URING_SETUP, _AF_VSOCK = 425, 40  # the same on all architectures, as are Landlock's calls
# memfd_create, memfd_secret: memory that no process is seen to hold
_FILES_IN_MEMORY = {"x86_64": (319, 447), "aarch64": (279, 447)}
# shmget, msgget, semget, mq_open: what is left when all processes have ended
_LEFT_BEHIND = {"x86_64": (29, 68, 64, 240), "aarch64": (194, 186, 190, 180)}
# chmod, chown, utime, setxattr, removexattr and their like, on files of any folder
_CHANGE_OF_FILES = {
    "x86_64": (*range(90, 95), 132, *range(188, 191), *range(197, 200), 235, 260, 261, 268, 280),
    "aarch64": (*range(5, 8), *range(14, 17), *range(52, 56), 88),
}
_NEWER_CHANGE_OF_FILES = (452, 463, 466, 469)
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
        # Not shutil.rmtree, which a thousand folders in one another stop.
        with contextlib.suppress(OSError):
            os.spawnv(os.P_WAIT, "/bin/rm", ["rm", "-rf", "--", orders["scratch"]])


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
        machine = os.uname().machine
        filtered = ["--seccomp", "8"] if machine in _ARCHITECTURE else []
        read = _pipe_of("\0".join([*filtered, *orders["bubblewrap"]]).encode())
        calls = _pipe_of(_filter(machine, orders, False) if filtered else b"")
        unread = os.pipe()[1]  # a pipe, like its replacement: Python checks the type only once
        nothing = os.open(os.devnull, os.O_RDONLY)
        files = [nothing, unread, unread, error, read, *orders["files"], calls]
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


def _pipe_of(data):
    """Return a pipe from which the data can be read."""
    read, write = os.pipe()
    os.write(write, data)
    os.close(write)
    return read


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
    if machine in _ARCHITECTURE:
        _filter_calls(_filter(machine, orders, True))


def _filter(machine, orders, landlock):
    """Return a seccomp program.

    It forbids memory that is not counted and, without a network, sockets to other machines. With
    Landlock, it also forbids what Landlock does not cover.
    """
    load, equal, greater, answer = 0x20, 0x15, 0x35, 0x06
    allow, fail = (answer, 0, 0, 0x7FFF0000), 0x00050000
    refuse = (answer, 0, 0, fail | errno.EPERM)
    number, first = (load, 0, 0, 0), (load, 0, 0, 16)  # of the call; its first argument
    steps = [(load, 0, 0, 4), (equal, 1, 0, _ARCHITECTURE[machine]), refuse, number]
    steps += [(greater, 0, 1, 0x40000000), refuse]  # x86's other numbers for the same calls
    answers = dict.fromkeys(_FILES_IN_MEMORY[machine], errno.ENOSYS)
    if not orders["network"]:
        answers[_IO_URING_SETUP] = errno.EPERM
        steps += [(equal, 0, 4, _SOCKET[machine]), first, (equal, 0, 1, _AF_VSOCK), refuse, number]
    if landlock:
        answers |= dict.fromkeys(_LEFT_BEHIND[machine], errno.ENOSYS)
        # They seem to succeed: what copies files changes its copies' rights and times.
        answers |= dict.fromkeys((*_CHANGE_OF_FILES[machine], *_NEWER_CHANGE_OF_FILES), 0)
        if not orders["network"]:  # sockets of any kind, also those that have a path
            answers[_SOCKET[machine]] = errno.EPERM
        # Its own limits alone: the process that is meant is 0.
        steps += [(equal, 0, 4, _PRLIMIT[machine]), first, (equal, 1, 0, 0), refuse, number]
    for call, error in answers.items():
        steps += [(equal, 0, 1, call), (answer, 0, 0, fail | error)]
    return b"".join(struct.pack("HBBI", *step) for step in [*steps, allow])


def _filter_calls(steps):
    import ctypes

    program = ctypes.create_string_buffer(steps, len(steps))
    address = ctypes.addressof(program)
    pointer = ctypes.create_string_buffer(struct.pack("HP", len(steps) // 8, address))
    _prctl(_SECCOMP, 2, ctypes.cast(pointer, ctypes.c_void_p))


if __name__ == "__main__":
    main()
