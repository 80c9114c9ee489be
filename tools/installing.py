"""Install the built packages as users do, and use what was installed: `make install-check`.

    python -m tools.installing                        every Python from 3.11 on that is on the PATH
    python -m tools.installing --python python3.13    one of them; may be repeated

Builds sdist and wheel, has twine check them, and installs each with pip, pipx and uv into new
environments. Each installed `lucida` must then work in a folder that has an app.py, a json.py and a
renderer/ of its own. Needs the network. Status 1 if anything failed. The names of the files inside
are checked in tests/project/test_wheel.py.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from tarfile import open as open_tar
from zipfile import ZipFile

ROOT = Path(__file__).resolve().parents[1]
PYTHONS = ("python3.11", "python3.12", "python3.13", "python3.14")
LIMIT_S = 1800
# What a user types, and the words that its output must have.
LINES = (
    ("--version", "lucida"),
    ("doctor", "tracer"),
    ("render spheres -o raster.png --size 64x48", ""),
    ("render spheres -o ray.png --size 64x48 --renderer ray", ""),
    ("camera ../pinhole.toml", ""),
)
NOTEBOOK = "import lucida; s = lucida.load_scene('spheres'); c = s.view.for_size((64, 48)); "
NOTEBOOK += "print(lucida.Tracer(s).render(c, (64, 48)).channel('color').shape, lucida.__file__)"
CAMERA = '[camera]\nprojection = "perspective"\neye = [0, 0, 5]\n'


class InstallError(Exception):
    pass


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m tools.installing")
    parser.add_argument("--python", action="append", metavar="PROGRAM")
    asked = parser.parse_args(argv).python
    pythons = asked or [name for name in PYTHONS if _answers(name)]
    with tempfile.TemporaryDirectory(prefix="installing-") as name:
        folder = Path(name)
        try:
            tools = _tools(folder / "tools")
            built = _built(folder / "dist", tools)
        except InstallError as failure:
            print(failure)
            return 1
        failed = 0
        for number, (python, package, way) in enumerate(_cases(pythons, built)):
            start = time.monotonic()
            try:
                told = _try(folder / str(number), python, package, way, tools)
            except InstallError as failure:
                failed += 1
                told = f"FAILED\n{failure}"
            took = time.monotonic() - start
            print(f"{python} {way.__name__:5} {package.name} ({took:.0f} s): {told}", flush=True)
            shutil.rmtree(folder / str(number), ignore_errors=True)
        missing = sorted({*PYTHONS} - {*pythons}) if asked is None else []
        print(f"{failed} failed", *(f"({name} is not here)" for name in missing))
    return 1 if failed or not pythons else 0


def _answers(python: str) -> bool:
    """Return True if the program is there and runs: a version manager's stub may not."""
    return shutil.which(python) is not None and _run([python, "-c", ""]).returncode == 0


def _cases(
    pythons: list[str], built: list[Path]
) -> Iterator[tuple[str, Path, Callable[..., Path]]]:
    """Yield the wheel in every way under every Python; the sdist in every way under the first."""
    for python in pythons:
        for package in built if python == pythons[0] else built[:1]:
            for way in (uv, pip, pipx):
                yield python, package, way


def _tools(folder: Path) -> Path:
    """Make an environment with the programs that install. Return its folder of commands."""
    _must([sys.executable, "-m", "venv", folder])
    scripts = _scripts(folder)
    _must([scripts / "python", "-m", "pip", "install", "-q", "build", "pipx", "twine", "uv"])
    return scripts


def _scripts(environment: Path) -> Path:
    return environment / ("Scripts" if os.name == "nt" else "bin")


def _built(folder: Path, tools: Path) -> list[Path]:
    """Return the wheel, which was built from the sdist, and the sdist; both are listed."""
    _must([tools / "python", "-m", "build", "--outdir", folder, ROOT])
    (wheel,), (sdist,) = folder.glob("*.whl"), folder.glob("*.tar.gz")
    print(_must([tools / "python", "-m", "twine", "check", "--strict", wheel, sdist]).strip())
    with ZipFile(wheel) as archive, open_tar(sdist) as tar:
        for package, names in ((wheel, archive.namelist()), (sdist, tar.getnames())):
            kinds = Counter(Path(name).suffix or Path(name).name for name in names)
            print(package.name, *(f"{kind}: {count}" for kind, count in kinds.most_common()))
    return [wheel, sdist]


# The ways to install. Each returns the folder with the command.


def pip(folder: Path, python: str, package: Path, tools: Path) -> Path:
    _must([python, "-m", "venv", folder / "environment"])
    scripts = _scripts(folder / "environment")
    _must([scripts / "python", "-m", "pip", "install", "-q", package])
    return scripts


def pipx(folder: Path, python: str, package: Path, tools: Path) -> Path:
    homes = {"PIPX_HOME": folder / "pipx", "PIPX_BIN_DIR": folder / "bin"}
    homes |= {"PIPX_MAN_DIR": folder / "man"}
    _must([tools / "pipx", "install", "--python", python, package], **homes)
    return folder / "bin"


def uv(folder: Path, python: str, package: Path, tools: Path) -> Path:
    homes = {"UV_TOOL_DIR": folder / "uv", "UV_TOOL_BIN_DIR": folder / "bin"}
    _must([tools / "uv", "tool", "install", "--python", shutil.which(python), package], **homes)
    return folder / "bin"


def _try(folder: Path, python: str, package: Path, way: Callable[..., Path], tools: Path) -> str:
    """Install the package and use it. Raises InstallError."""
    folder.mkdir()
    scripts = way(folder, python, package, tools)
    here = folder / "work"
    here.mkdir()
    for name in ("lucida.py", "json.py"):
        (here / name).write_text("raise SystemExit('a file of the user was imported')\n")
    (folder / "pinhole.toml").write_text(CAMERA)
    for line, wanted in LINES:
        told = _must([scripts / "lucida", *line.split()], cwd=here)
        if wanted not in told:
            raise InstallError(f"lucida {line} says {told!r}")
    for image in ("raster.png", "ray.png"):
        if (here / image).stat().st_size < 1000:
            raise InstallError(f"{image} is too small")
    if way is pip:
        told = _must([scripts / "python", "-c", NOTEBOOK], cwd=folder)
        if not told.startswith("(48, 64, 3)") or str(scripts.parent) not in told:
            raise InstallError(f"a Python in another folder says {told!r}")
    return "works"


def _run(command: list[object], cwd: Path | None = None, **variables: object):
    kept = {name: text for name, text in os.environ.items() if not name.startswith("PYTHON")}
    return subprocess.run(
        [str(part) for part in command],
        cwd=cwd,
        env=kept | {name: str(value) for name, value in variables.items()},
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
    )


def _must(command: list[object], cwd: Path | None = None, **variables: object) -> str:
    """Run a command. Return its standard output. Raises InstallError if its status is not 0."""
    done = _run(command, cwd, **variables)
    if done.returncode:
        line = " ".join(str(part) for part in command)
        raise InstallError(f"{line}: status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


if __name__ == "__main__":
    sys.exit(main())
