"""Nothing that lies beside the user, or beside the user's files, is ever run."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from lucida.renderer.system import child, compile_note
from lucida.renderer.trace.compile.cache_folder import cache_folder

ROOT = Path(__file__).parents[3]
# What Python, the packages and Lucida import early, late, and by chance; and the packages' names.
NAMES = """\
json numpy struct lucida/__init__ lucida/renderer/system/child lucida/renderer/system/doctor
lucida/shaders/__init__ os re
io subprocess threading signal ctypes enum types random logging locale numba llvmlite trimesh
PIL yaml glfw imgui_bundle moderngl msgspec platformdirs sitecustomize usercustomize cuda
scipy networkx lxml site encodings/__init__ encodings/utf_8"""
MISSING = "binary._fill_shapes"  # of the kernels, in the cache of whoever stands there
TRIANGLE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
LECTURE = """title = "T"
[[steps]]
title = "A"
text = "$x$"
scene = "canonical"
"""
SCENE = '[[objects]]\ntype = "model"\nfile = "models/large.obj"\n'


class Here:
    """A folder to stand in, full of traps. Each that is imported leaves its name in `ran`."""

    def __init__(self, folder):
        self.folder = folder / "here"
        self.ran = folder / "ran"
        for place in (self.folder, self.folder / "models"):
            for name in NAMES.split():
                trap = place / f"{name}.py"
                trap.parent.mkdir(parents=True, exist_ok=True)
                trap.write_text(f"open({str(self.ran)!r}, 'a').write({name!r} + '\\n')\n")
        (self.folder / "models" / "large.obj").write_bytes(TRIANGLE + b"#" * (1 << 20))
        (self.folder / "scene.toml").write_text(SCENE)
        (self.folder / "lecture.toml").write_text(LECTURE)
        for name in ("home", "cache", "config"):
            (folder / name).mkdir()
        strange = ("PYTHON", "NUMBA_", "DISPLAY", "WAYLAND_DISPLAY")
        kept = {name: text for name, text in os.environ.items() if not name.startswith(strange)}
        self.environment = kept | {
            "HOME": str(folder / "home"),
            "XDG_CACHE_HOME": str(folder / "cache"),
            "XDG_CONFIG_HOME": str(folder / "config"),
            "LOCALAPPDATA": str(folder / "cache"),
            "PYTHONPATH": str(ROOT),
        }

    def run(self, *command, safe=True):
        """Runs Python in the folder; gives its standard output. safe: as the installed `lucida`,
        in whose path the current folder is not."""
        self.ran.unlink(missing_ok=True)
        done = subprocess.run(
            [sys.executable, *(["-P"] if safe else []), *command],
            cwd=self.folder, env=self.environment, capture_output=True, text=True,
        )  # fmt: skip
        ran = self.ran.read_text().split() if self.ran.exists() else []
        assert ran == [], f"{command} imported {ran}"
        assert done.returncode == 0, done.stdout + done.stderr
        assert done.stderr in ("", f"lucida: {compile_note.ONCE}\n")
        return done.stdout

    def fill_cache(self):
        """Give the folder's user the kernels that this run has compiled, but for MISSING: one is
        enough to see what a process that compiles imports."""
        kernels = cache_folder()
        if kernels is None:
            return
        copy = self.folder.parent / "cache" / "lucida" / "kernels" / kernels.name
        others = shutil.ignore_patterns("*.done", "*.tmp.*", f"{MISSING}*")
        shutil.copytree(kernels, copy, ignore=others)
        copy.parent.chmod(0o700)


@pytest.fixture(scope="module")
def here(tmp_path_factory):
    made = Here(tmp_path_factory.mktemp("traps"))
    made.fill_cache()
    return made


def test_a_trap_that_is_imported_is_noticed(tmp_path):
    trapped = Here(tmp_path)
    with pytest.raises(AssertionError, match=r"imported.*'json'"):
        trapped.run("-c", "import json", safe=False)


# The first traces with a kernel missing, so that processes compile for it.
def test_commands_in_one_process_import_nothing_from_the_current_folder(here):
    lines = (
        "compare scene.toml --size 32x32",
        "render models/large.obj -o raster.png --size 32x32",
        "scene",
        "lecture lecture.toml --check",
    )
    run = "import sys; from lucida.app.cli import main; " + " ".join(
        f"sys.exit(1) if main({line.split()!r}) else None;" for line in lines
    )
    assert "1 step" in here.run("-c", run)


def test_a_window_imports_nothing_from_the_current_folder(here):
    line = "models/large.obj --screenshot window.png --size 320x200"
    here.run("-m", "lucida", *line.split())


def test_python_m_lucida_leaves_the_current_folder_at_once(here, tmp_path):
    (tmp_path / "struct.py").write_text(f"open({str(here.ran)!r}, 'a').write('struct ')\n")
    (tmp_path / "argparse.py").write_text(f"open({str(here.ran)!r}, 'a').write('argparse ')\n")
    folder, here.folder = here.folder, tmp_path
    try:
        assert "spheres" in here.run("-m", "lucida", "scene", safe=False)
    finally:
        here.folder = folder


def test_a_notebook_has_the_current_folder_in_its_path_and_its_processes_have_not(
    here,
):
    told = here.run(
        "-c",
        "import sys\n"
        "from lucida.renderer.system import doctor\n"
        "sys.path.insert(0, '')\n"
        "print(doctor.check('formulas').works)\n",
    )
    assert told == "True\n"


# The path that is handed over.


def test_the_path_has_no_current_folder(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "link").symlink_to(tmp_path)
    monkeypatch.setattr(
        sys, "path", ["", "lib", str(tmp_path), str(tmp_path / "link"), str(ROOT), "."]
    )
    assert child.import_path() == [str(tmp_path / "lib"), str(ROOT)]


def test_the_path_has_the_current_folder_if_our_packages_are_there(
    monkeypatch,
):
    monkeypatch.chdir(ROOT)
    monkeypatch.setattr(sys, "path", ["", str(ROOT / "lib")])
    assert [os.path.normpath(folder) for folder in child.import_path()] == [
        str(ROOT), str(ROOT / "lib")
    ]  # fmt: skip


@pytest.mark.skipif(sys.platform == "win32", reason="Windows removes no folder that is in use")
def test_the_current_folder_may_have_been_removed(monkeypatch, tmp_path):
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    monkeypatch.setattr(sys, "path", ["", "lib", str(ROOT)])
    assert child.import_path() == [str(ROOT)]


def test_a_child_reads_names_and_writes_byte_code_as_its_parent(monkeypatch, tmp_path):
    program = "import sys\ndef main(name):\n    print(ascii(name), sys.flags.utf8_mode,"
    program += " sys.dont_write_bytecode, sys.pycache_prefix, sys.flags.isolated)\n"
    (tmp_path / "told.py").write_text(program)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    monkeypatch.setattr(sys, "pycache_prefix", str(tmp_path / "prefix"))
    command = child.child_command(sys.executable, "told", "ä.obj")
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    expected = f"{'ä.obj'!a} {sys.flags.utf8_mode} True {tmp_path / 'prefix'} 1\n"
    assert done.stdout == expected
