"""The sandbox of a student's program: the best one that this machine offers.

bubblewrap provides separate process ids, a network without neighbours, and a file system with only
the necessary files. Landlock allows the same files and confines signals. Without both, `--as`
leaves the rights of another user. Without that, nothing is protected from the program, and
`remark` describes what a dishonest one could do.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy

import renderer
from app.checking.calls import Limits
from renderer.child import import_path
from renderer.errors import LucidaError

PACKAGES = ("app", "renderer", "shaders")  # contain the correct answers
SYSTEM = ("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32")
_ETC: tuple[str, ...] = ("alternatives", "fonts", "group", "ld.so.cache", "ld.so.conf")
_ETC += ("ld.so.conf.d", "localtime", "nsswitch.conf", "passwd", "ssl/openssl.cnf", "timezone")
_NETWORK = ("hosts", "resolv.conf", "services", "protocols", "ssl", "pki", "ca-certificates")
_DEVICES = ("null", "zero", "full", "random", "urandom")
# Below the home folder, of all that is there, a program of --command sees its language's packages.
_PACKAGES_AT_HOME = (".gem", ".julia", ".local/lib", ".luarocks", "R", "perl5")
_FOLDERS_OF_PROGRAMS = ("bin", "sbin", "shims")  # the folder around them is an installation
_SCRATCH = "/var/tmp"  # inside bubblewrap
_LIST, _READ, _ALL = 8, 1 | 4 | 8, -1  # rights of Landlock: read is execute, read, list
_SIGNALS_ABI = 6  # first version that confines signals
# Inside bubblewrap: take the pipes, become the user, and exec the command or run the code below.
_LAUNCHER = """\
import os, sys
for number in range(3):
    os.dup2(number + 5, number)
os.closerange(4, 9)
os.set_inheritable(3, False)
user, group = map(int, sys.argv[1:3])
if user >= 0:
    os.setgroups([])
    os.setgid(group)
    os.setuid(user)
if sys.argv[3:]:
    try:
        os.execvp(sys.argv[3], sys.argv[3:])
    except OSError as error:
        os.write(3, str(error.errno).encode())
        os._exit(127)
os.close(3)
"""


@dataclass(frozen=True)
class Access:
    """The access rights of a student's program.

    writable: it may write into its own folder.
    hidden: files and folders that it never sees.
    user: the user that it runs as; "" for this process' own.
    """

    writable: bool = True
    hidden: tuple[Path, ...] = ()
    user: str = ""


@dataclass(frozen=True)
class Plan:
    """The supervisor's orders for starting a program.

    libraries: the folders of installed packages, as the program sees them.
    """

    orders: dict[str, Any]
    libraries: list[str] = field(default_factory=list)


def remark(access: Access) -> str:
    """Return one line on what a dishonest program could do here; "" if it is sandboxed."""
    kind = level()
    if kind == "bubblewrap":
        return ""
    if access.user:
        if kind == "landlock":
            return ""
        return (
            f"The program runs as {access.user}, and can read whatever that user can: "
            "keep results, tasks and Lucida itself out of that user's reach, or install bubblewrap."
        )
    if kind == "landlock":
        if _landlock() >= _SIGNALS_ABI:
            return ""
        return (
            "A dishonest program could stop or kill this check: its points are 0 then. "
            "Install bubblewrap, or run as root with --as USER."
        )
    return (
        "A dishonest program could read the right answers, change its results, or kill this check. "
        "On Linux, install bubblewrap, or run as root with --as USER."
    )


def interpreter() -> str | None:
    """Return the path of Python's executable itself, not of a virtual environment's link to it."""
    if getattr(sys, "frozen", False) or not sys.executable:
        return None
    python = getattr(sys, "_base_executable", None) or sys.executable
    return os.path.realpath(python) if Path(python).stem.lower().startswith("python") else None


def python_plan(
    code: str, folder: str, environment: Mapping[str, str], access: Access, limits: Limits
) -> Plan:
    """Return how to run the code in Python, for a student's file in the folder."""
    python = interpreter()
    if python is None:
        raise LucidaError("", "Python files need Python", "install Lucida by pip")
    libraries = _libraries()
    wanted = _Wanted(folder, [os.path.realpath(sys.base_prefix)], libraries, access, limits)
    own = {
        name: os.environ[name]
        for name in ("LANG", "LC_ALL", "LC_CTYPE", "TZ")
        if name in os.environ
    }
    environment = {**own, **environment, "PATH": "/usr/local/bin:/usr/bin:/bin"}
    if sys.platform == "win32":
        environment = {**os.environ, **environment, "PATH": os.environ.get("PATH", "")}
    command = [python, "-I", "-S", "-B", "-c", code]
    return wanted.plan(command, environment, code)


def command_plan(command: list[str], access: Access, limits: Limits) -> Plan:
    """Return how to start a program of any language in the current folder."""
    paths = [os.path.dirname(os.path.abspath(word)) for word in command if os.path.exists(word)]
    readable = [sys.base_prefix, "/opt", *_installation(command[0])]
    readable = [path for path in readable if os.path.isdir(path) and os.path.realpath(path) != "/"]
    wanted = _Wanted(os.getcwd(), readable, _libraries(), access, limits, paths)
    hidden = [str(path) for path in wanted.hidden]
    environment = {
        name: value
        for name, value in os.environ.items()
        if not any(path in value for path in hidden)
    }
    return wanted.plan(command, environment, "")


def _installation(program: str) -> list[str]:
    """Return the folders that a program needs: its own, its interpreter's, and home's packages."""
    home = Path.home()
    folders = [home / name for name in _PACKAGES_AT_HOME]
    found = shutil.which(program)
    for path in map(Path, [*_links(found), *_links(_interpreter_of(found))]):
        prefix = path.parent.parent
        is_wide = home.is_relative_to(prefix) or prefix == home / ".local"
        is_installation = path.parent.name in _FOLDERS_OF_PROGRAMS and not is_wide
        folders.append(prefix if is_installation else path.parent)
    return [str(folder) for folder in folders]


def _links(path: str | None) -> Iterator[str]:
    """Yield the path, the link that it leads to, and so on to the file itself."""
    while path:
        path = os.path.abspath(path)
        yield path
        link = os.readlink(path) if os.path.islink(path) else ""
        path = os.path.join(os.path.dirname(path), link) if link else None


def _interpreter_of(script: str | None) -> str | None:
    """Return the program in a script's first line; None if there is none."""
    line = b""
    with contextlib.suppress(OSError), open(script or "", "rb") as file:
        line = file.readline(200)
    words = line[2:].decode("utf-8", "replace").split() if line.startswith(b"#!") else []
    names = [word for word in words if not word.startswith("-") and Path(word).name != "env"]
    return shutil.which(names[0]) if names else None


def _libraries() -> list[str]:
    """Return the folders of installed packages."""
    folders = [path for path in import_path() if path.endswith("-packages")]
    folders.append(os.path.dirname(os.path.dirname(numpy.__file__)))
    return [*dict.fromkeys(os.path.realpath(path) for path in folders if os.path.isdir(path))]


@dataclass(frozen=True)
class _Wanted:
    folder: str
    readable: list[str]
    libraries: list[str]
    access: Access
    limits: Limits
    written: list[str] = field(default_factory=list)  # further folders that count as its own

    @property
    def hidden(self) -> list[Path]:
        ours = Path(renderer.__file__).resolve().parent.parent
        installed = sysconfig.get_paths(vars={"base": sys.base_prefix, "platbase": sys.base_prefix})
        places = {str(ours), installed["purelib"], installed["platlib"], *self.libraries}
        packages = [Path(place, name) for place in sorted(places) for name in PACKAGES]
        found = [path.resolve() for path in (*packages, *self.access.hidden)]
        return [path for path in dict.fromkeys(found) if path.exists()]

    def plan(self, command: list[str], environment: Mapping[str, str], code: str) -> Plan:
        walls = level()
        orders: dict[str, Any] = {
            "command": command,
            "environment": dict(environment),
            "folder": self.folder,
            "memory_mb": self.limits.memory_mb,
            "network": self.limits.network,
        }
        user = user_ids(self.access.user)
        if walls == "bubblewrap":
            return self._within_bubblewrap(orders, user, code)
        scratch = Path(tempfile.mkdtemp(prefix="student-"))
        orders["environment"]["TMPDIR"] = str(scratch)
        if code:
            orders["environment"]["HOME"] = str(scratch)
        if user is not None:
            os.chown(scratch, *user)
            orders["user"] = user
        orders["scratch"] = str(scratch)
        if walls == "landlock":
            orders["landlock"], orders["rules"] = _landlock(), [*self._rules(scratch)]
        if sys.platform == "win32":
            return Plan(orders, self.libraries)
        libraries = [scratch / f"site-packages-{n}" for n in range(len(self.libraries))]
        for link, folder in zip(libraries, self.libraries, strict=True):
            link.symlink_to(folder)  # hides where Lucida is installed
        return Plan(orders, [*map(str, libraries)])

    def _own(self) -> list[str]:
        return [*dict.fromkeys(map(os.path.realpath, (self.folder, *self.written)))]

    def _rules(self, scratch: Path) -> Iterator[tuple[str, int]]:
        """Yield (path, rights) for Landlock."""
        etc = _ETC + (_NETWORK if self.limits.network else ())
        yield from ((f"/dev/{name}", _ALL if name == "null" else _READ) for name in _DEVICES)
        yield from ((f"/etc/{name}", _READ) for name in etc)
        yield from [(str(scratch), _ALL), ("/dev/shm", _ALL)]
        yield from [("/proc/self", _READ), ("/sys/devices/system/cpu", _READ)]
        hidden = self.hidden
        for path in (*SYSTEM, *self.readable, *self.libraries, *self._own()):
            yield from _parts(Path(path).resolve(), hidden)
        if self.access.writable:
            for path in self._own():
                if not any(one.is_relative_to(path) for one in hidden):
                    yield path, _ALL

    def _within_bubblewrap(
        self, orders: dict[str, Any], user: tuple[int, int] | None, code: str
    ) -> Plan:
        libraries = {path: f"/site-packages/{n}" for n, path in enumerate(self.libraries)}
        binds = {os.path.realpath(path): "--ro-bind" for path in self.readable}
        binds |= dict.fromkeys(self._own(), "--bind" if self.access.writable else "--ro-bind")
        targets = [(path, path, kind) for path, kind in binds.items() if path != "/"]
        for path in self.readable:  # and where links lead to it, unless those are seen themselves
            if not any(Path(path).is_relative_to(seen) for seen in (*SYSTEM, *binds)):
                targets.append((os.path.realpath(path), path, "--ro-bind"))
        targets += (
            [(path, target, "--ro-bind") for path, target in libraries.items()] if code else []
        )
        inside: list[str] = []
        for path, target, kind in sorted(targets, key=lambda one: one[1].count("/")):
            for parent in reversed(Path(target).parents):  # by default, only root could enter them
                inside += ["--perms", "0755", "--dir", str(parent)]
            inside += [kind, path, target]
        for hidden in self.hidden:
            for path, target, _ in [*targets, *((path, path, "") for path in SYSTEM)]:
                if hidden.is_relative_to(path):
                    place = os.path.normpath(os.path.join(target, hidden.relative_to(path)))
                    inside += (
                        ["--tmpfs", place] if hidden.is_dir() else ["--ro-bind", os.devnull, place]
                    )
        arguments = _bubblewrap(self.limits.network, self.limits.memory_mb)
        arguments += [*inside, "--remount-ro", "/", "--remount-ro", "/proc", "--chdir", self.folder]
        if user is not None:
            arguments += ["--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID"]
        orders["bubblewrap"] = arguments
        environment = orders["environment"]
        environment["TMPDIR"] = _SCRATCH
        if code:
            environment["HOME"] = _SCRATCH
        launched = [str(number) for number in user or (-1, -1)] + (
            [] if code else orders["command"]
        )
        python = interpreter() or "python3"
        program = [python, "-I", "-S", "-B", "-c", _LAUNCHER + code, *launched]
        orders["command"] = [_bubblewrap_program(), "--args", "4", "--", *program]
        return Plan(orders, [*libraries.values()] if code else [])


def _parts(path: Path, hidden: Sequence[Path]) -> Iterator[tuple[str, int]]:
    """Yield Landlock's rules for the path, without its hidden parts."""
    if path in hidden:
        return
    if not any(one.is_relative_to(path) for one in hidden):
        yield str(path), _READ
        return
    yield str(path), _LIST
    with contextlib.suppress(OSError):
        for child in path.iterdir():
            if not child.is_symlink():  # only its target counts
                yield from _parts(child, hidden)


def user_ids(name: str) -> tuple[int, int] | None:
    """Return the ids of the user and of its group; None for "". Raises LucidaError."""
    if not name:
        return None
    if sys.platform == "win32":
        raise LucidaError("--as", "is not for Windows", "leave it out")
    import pwd

    try:
        found = pwd.getpwnam(name)
    except KeyError:
        remedy = "make it: useradd --system student"
        raise LucidaError("--as", f"there is no user {name[:40]!r}", remedy) from None
    if os.geteuid() != 0:
        raise LucidaError("--as", "needs root", "run the check as root, or leave --as out")
    if found.pw_uid == 0:
        raise LucidaError("--as", f"{name} may do everything", "name a user without rights: nobody")
    return found.pw_uid, found.pw_gid


@cache
def level() -> str:
    """Return the sandbox that this machine offers: bubblewrap, landlock or plain."""
    if sys.platform != "linux":
        return "plain"
    program = _bubblewrap_program()
    if program:
        prefix = os.path.realpath(sys.base_prefix)
        tried = [*_bubblewrap(False, 16), "--ro-bind", prefix, prefix, "--remount-ro", "/proc"]
        command = [program, *tried, "--", interpreter() or "true", "-I", "-S", "-c", ""]
        with contextlib.suppress(OSError, subprocess.TimeoutExpired):
            if (
                subprocess.run(command, capture_output=True, timeout=30, check=False).returncode
                == 0
            ):
                return "bubblewrap"
    return "landlock" if _landlock() else "plain"


def _bubblewrap_program() -> str:
    return shutil.which("bwrap") or ""


@cache
def _landlock() -> int:
    """Return the version of Landlock's interface; 0 if there is none."""
    if sys.platform != "linux" or os.uname().machine not in ("x86_64", "aarch64"):
        return 0
    return max(0, int(ctypes.CDLL(None).syscall(444, None, ctypes.c_size_t(0), 1)))


def _bubblewrap(network: bool, memory_mb: int) -> list[str]:
    """Return the bubblewrap arguments that all programs share."""
    arguments = ["--unshare-pid", "--unshare-ipc", "--unshare-uts", "--unshare-cgroup-try"]
    arguments += ["--cap-drop", "ALL"]
    if not network:
        arguments.append("--unshare-net")
    for path in SYSTEM:
        if os.path.islink(path):
            arguments += ["--symlink", os.readlink(path), path]
        else:
            arguments += ["--ro-bind-try", path, path]
    for folder in ("/etc", "/etc/ssl", "/var"):  # bubblewrap's own are root's alone
        arguments += ["--perms", "0755", "--dir", folder]
    for name in _ETC + (_NETWORK if network else ()):
        arguments += ["--ro-bind-try", f"/etc/{name}", f"/etc/{name}"]
    arguments += ["--proc", "/proc", "--dev", "/dev"]
    folders = ("/tmp", _SCRATCH, "/dev/shm")
    for path in folders:  # together as much as the memory limit
        size = str((memory_mb << 20) // len(folders))
        arguments += ["--perms", "1777", "--size", size, "--tmpfs", path]
    return arguments
