"""Environments with the programs that Lucida is held against, that also see what Lucida needs:
.venv-bench for `make bench`, .venv-conformance for `make conformance`, .venv-notebooks for
`make notebooks`.

`python -m tools.peer_environment bench` makes one, run by the Python of the project's own
environment; what is there already is left alone. A peer that cannot be installed is named and left
out; the next run tries again. Owns these folders. Needs the standard library only.
"""

from __future__ import annotations

import subprocess
import sys
import sysconfig
import venv
from importlib import metadata
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
NAMES = ("bench", "conformance", "notebooks")
CONSTRAINTS = "constraints.txt"


def folder_of(name: str) -> Path:
    return ROOT / f".venv-{name}"


def requirements_of(name: str) -> Path:
    return ROOT / f"requirements-{name}.txt"


def prepare(folder: Path, requirements: Path) -> dict[str, str]:
    """Complete the environment. Return what could not be installed, and why."""
    made(folder)
    failed = {}
    for line in wanted(requirements.read_text()):
        why = _install(folder, line)
        if why:
            failed[line] = why
    return failed


def made(folder: Path) -> None:
    """An empty environment that sees Lucida's packages, unless it is there."""
    runtime = sysconfig.get_path("purelib")
    made_from = f"{sys.version}\n{runtime}\n"
    stamp = folder / "made-from"
    if not stamp.exists() or stamp.read_text() != made_from:
        say(f"making {folder.name}")
        venv.create(folder, clear=True, with_pip=True)
        own = Path(ask(folder, "import sysconfig; print(sysconfig.get_path('purelib'))"))
        # Behind the environment's own packages on the path, which therefore come first.
        (own / "lucida-runtime.pth").write_text(runtime + "\n")
        stamp.write_text(made_from)


def wanted(requirements: str) -> list[str]:
    """The lines of a requirements file that name a package."""
    lines = (line.partition("#")[0].strip() for line in requirements.splitlines())
    return [line for line in lines if line]


def python_of(folder: Path) -> Path:
    """The environment's interpreter."""
    windows = sys.platform == "win32"
    return folder / ("Scripts/python.exe" if windows else "bin/python")


def say(text: str) -> None:
    print(f"peers: {text}", file=sys.stderr, flush=True)


def _install(folder: Path, requirement: str) -> str:
    """Installs one package, if it is not there; gives why that failed, or ""."""
    name = requirement.partition("==")[0]
    stamp = folder / f"installed-{name}"
    if stamp.exists() and stamp.read_text() == requirement:
        return ""
    say(f"installing {requirement}")
    command = [str(python_of(folder)), "-m", "pip", "install", "--quiet"]
    command += ["--disable-pip-version-check", "--retries", "1"]
    # Peers are compared with the packages that Lucida runs with.
    constraints = folder / CONSTRAINTS
    constraints.write_text("".join(f"{line}\n" for line in _installed()))
    command += ["--constraint", str(constraints), requirement]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        lines = [line for line in done.stderr.splitlines() if line.strip()]
        errors = [line for line in lines if line.startswith("ERROR:")]
        return (errors or lines or ["pip failed"])[-1].removeprefix("ERROR: ")
    stamp.write_text(requirement)
    return ""


def _installed() -> list[str]:
    """name==version of the packages that Lucida runs with."""
    found = metadata.distributions(path=[sysconfig.get_path("purelib")])
    pins = {d.metadata["Name"]: d.version for d in found}
    return [
        f"{name}=={version}" for name, version in sorted(pins.items()) if name != "camera-lucida"
    ]


def ask(folder: Path, code: str) -> str:
    command = [str(python_of(folder)), "-c", code]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def main(name: str) -> int:
    """Always 0: what is run goes on with whatever could be installed."""
    for requirement, why in prepare(folder_of(name), requirements_of(name)).items():
        say(f"{requirement} is left out: {why}")
    return 0


if __name__ == "__main__":
    sys.exit(main(NAMES[NAMES.index(sys.argv[1])]))
