"""`pip install .`: the wheel holds everything, and its `lucida` works far from the checkout."""

import os
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import venv
import zipfile
from pathlib import Path

import numpy as np
import pytest

from lucida import __version__

ROOT = Path(__file__).parents[2]
# Files of all these kinds are our own, under LICENSE: a font or a model would bring its own.
KINDS = {"py", "toml", "frag", "vert", "glsl", "js", "css", "html", "png", "md"}
READ_IN_THE_WINDOW = {".md", ".png"}  # of docs/


def run(*command, **options):
    return subprocess.run(
        [str(part) for part in command],
        capture_output=True,
        text=True,
        check=False,
        **options,
    )


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The folder of the sdist, and of the wheel that was built from it; without the network:
    hatchling is among the development packages."""
    folder = tmp_path_factory.mktemp("built")
    end = run(sys.executable, "-m", "build", "--no-isolation", "-o", folder, ROOT)
    assert end.returncode == 0, end.stdout + end.stderr
    return folder


@pytest.fixture(scope="module")
def wheel(built):
    (path,) = built.glob("*.whl")
    return path


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    """The scripts' folder of an environment that has the wheel, and sees the dependencies here.

    They come in by a .pth file, whose folder is searched without reading the .pth files in it: so
    an editable installation's way to the checkout is not followed.
    """
    home = tmp_path_factory.mktemp("environment")
    venv.create(home, with_pip=False, symlinks=os.name != "nt")
    paths = sysconfig.get_paths("venv", {"base": str(home), "platbase": str(home)})
    python = Path(paths["scripts"]) / Path(sys.executable).name
    pip = (sys.executable, "-m", "pip", "--python", python, "--isolated", "install")
    end = run(*pip, "--no-deps", "--no-index", "--no-compile", "--disable-pip-version-check", wheel)
    assert end.returncode == 0, end.stdout + end.stderr
    here = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    (Path(paths["purelib"]) / "dependencies.pth").write_text("\n".join(here) + "\n")
    return Path(paths["scripts"])


@pytest.fixture
def environment():
    return {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}


def of_the_packages():
    documents = {
        f"lucida/docs/{path.name}"
        for path in (ROOT / "docs").iterdir()
        if path.suffix in READ_IN_THE_WINDOW
    }
    links = {f"lucida/{name}": ROOT / name for name in ("app", "renderer", "shaders")}
    return documents | {
        f"{place}/{path.relative_to(folder).as_posix()}"
        for place, folder in {"lucida": ROOT / "lucida", **links}.items()
        for path in folder.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts and path.suffix != ".pyc"
    }


def test_everything_travels_and_nothing_else(wheel):
    with zipfile.ZipFile(wheel) as archive:
        packed = set(archive.namelist())
    described = {name for name in packed if ".dist-info/" in name}
    assert {name.partition("/")[0] for name in packed - described} == {"lucida"}
    assert packed - described == of_the_packages()
    assert any(name.endswith("licenses/LICENSE") for name in described)
    assert any(name.endswith(".toml") for name in packed)
    assert any(name.endswith(".frag") for name in packed)
    assert {name.rsplit(".", 1)[1] for name in packed - described} <= KINDS


def test_the_sdist_builds_it_and_has_no_tests(built):
    (sdist,) = built.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert {name.replace("lucida/docs", "docs") for name in of_the_packages()} <= names
    assert {"LICENSE", "README.md", "CHANGELOG.md", "pyproject.toml"} <= names
    assert not {name for name in names if name.startswith((".ci", ".github", "tests"))}


def test_package_wheel_and_changelog_have_one_version(wheel):
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    assert "version" not in project["project"]
    assert wheel.name.startswith(f"camera_lucida-{__version__}-")
    newest = next(
        line
        for line in (ROOT / "CHANGELOG.md").read_text("utf-8").splitlines()
        if line[:3] == "## "
    )
    assert newest.split()[1] == __version__


def test_the_packages_come_from_the_installation(installed, environment, tmp_path):
    program = "import lucida.app, sys; print(lucida.__file__, lucida.app.__file__, *sys.path)"
    end = run(installed / "python", "-c", program, cwd=tmp_path, env=environment)
    assert end.returncode == 0, end.stderr
    assert str(installed.parent) in end.stdout
    assert f"{ROOT}{os.sep}lucida" not in end.stdout
    assert str(ROOT) not in end.stdout.split()


def test_the_installed_wheel_draws(installed, environment, tmp_path, gl_backend):
    """Its tracer needs no test: its files are those that are tested here."""
    options = ("--renderer", "raster", "--backend", gl_backend)
    command = ("render", "still-life", "-o", "a.npy", "--size", "64x36", *options)
    end = run(installed / "lucida", *command, cwd=tmp_path, env=environment)
    assert end.returncode == 0, end.stderr
    image = np.load(tmp_path / "a.npy")
    assert image.shape == (36, 64, 3)
    assert len(np.unique(image.reshape(-1, 3), axis=0)) > 100
