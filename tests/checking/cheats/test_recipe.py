"""The recipe for an autograder, as the documents have it, run as root."""

from __future__ import annotations

import json
import os
import pwd
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

import renderer

TASKS = 'seed = 4711\n[[tasks]]\nkind = "memory-offset"\npoints = 2\n'
HONEST = "import os\ndef memory_offset(i, j, width): return i * width + j\n"
DISHONEST = """
import os
told = [os.getuid()]
for attack in (
    lambda: open(ROOT + "/results/results.json", "w").write("999"),
    lambda: open(ROOT + "/source/hw2.toml").read(),
    lambda: os.listdir(ROOT + "/results"),
    lambda: os.kill(GRADER, 9),
    lambda: __import__("renderer"),
):
    try:
        told.append(attack())
    except (OSError, ImportError) as error:
        told.append(type(error).__name__)
print(told)
def memory_offset(i, j, width): return 0
"""


def is_missing() -> str:
    """Return why the recipe cannot be run here."""
    if sys.platform != "linux" or os.geteuid() != 0:
        return "needs root on Linux"
    try:
        pwd.getpwnam("nobody")
    except KeyError:
        return "there is no user nobody"
    command = [os.path.realpath(sys.executable), "-I", "-S", "-c", ""]
    try:
        subprocess.run(command, user="nobody", check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        return "" if shutil.which("bwrap") else "nobody cannot read this Python"
    return ""


pytestmark = pytest.mark.skipif(bool(is_missing()), reason=is_missing() or "-")


@pytest.fixture
def autograder():
    """A folder that nobody can reach, as a container has it at /autograder."""
    root = Path(tempfile.mkdtemp())
    root.chmod(0o755)
    installed = root / "lucida" / "lib" / "python3.11" / "site-packages"
    for folder in ("source", "results", "submission", "lucida/bin"):
        (root / folder).mkdir(parents=True)
    for package in ("app", "renderer", "shaders"):
        (installed / package).mkdir(parents=True)
    (root / "lucida" / "bin" / "lucida").symlink_to(Path(sys.executable).with_name("lucida"))
    (root / "source" / "hw2.toml").write_text(TASKS, "utf-8")
    yield root
    shutil.rmtree(root)


def submitted(root: Path, source: str) -> dict:
    (root / "submission" / "rays.py").write_text(source, "utf-8")
    documents = Path(renderer.__file__).resolve().parent.parent / "docs" / "checking.md"
    block = re.search(r"`run_autograder`.*?\n\n((?:    .*\n)+)", documents.read_text("utf-8"))
    assert block
    script = root / "run_autograder"
    script.write_text(
        block[1].replace("\n    ", "\n").strip().replace("/autograder", str(root)), "utf-8"
    )
    subprocess.run(["sh", str(script)], check=True)
    return json.loads((root / "results" / "results.json").read_text("utf-8"))


def test_an_honest_and_a_dishonest_submission(autograder):
    assert submitted(autograder, HONEST)["score"] == 2
    known = f"ROOT, GRADER = {str(autograder)!r}, {os.getpid()}\n"
    found = submitted(autograder, known + DISHONEST)
    assert found["score"] == 0
    told = re.search(r"\[(\d+), (.*)\]", found["tests"][0]["output"])
    assert told
    assert int(told[1]) == pwd.getpwnam("nobody").pw_uid
    assert all(word.strip("' ").endswith("Error") for word in told[2].split(","))
    assert (autograder / "results").stat().st_mode & 0o777 == 0o700
