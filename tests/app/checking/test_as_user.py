"""`lucida check --as USER`, and the recipe for an autograder, run as root."""

from __future__ import annotations

import json
import os
import pwd
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from waiting import wait_for

import lucida
from lucida.app.checking.running.account import account
from lucida.app.cli import main

TASKS = 'seed = 4711\n[[tasks]]\nkind = "basis"\npoints = 2\n'
RIGHT = """
def cross(a, b):
    return [a[k - 2] * b[k - 1] - a[k - 1] * b[k - 2] for k in range(3)]


def unit(a):
    return [x / sum(y * y for y in a) ** 0.5 for x in a]


def basis(eye, target, up):
    w = unit(eye - target)
    u = unit(cross(up, w))
    return u, cross(w, u), w
"""
USER = f"lucida-test-{os.getpid()}"
CHEATS = """
def denied(cheat):
    try:
        cheat()
    except PermissionError:
        return True
cheats = (
    lambda: open(ROOT + '/results/results.json', 'w').write('999'),
    lambda: open(ROOT + '/source/hw2.toml').read(),
    lambda: os.kill(os.getppid(), 9),
)
raise RuntimeError(f"denied: {[*map(denied, cheats)]}")
"""
DAEMON = """
if not os.fork():
    os.setsid()
    if not os.fork():
        for name in range(9 ** 9):
            time.sleep(0.01)
    os._exit(0)
"""


def reason() -> str:
    """Return why these tests cannot run here."""
    if sys.platform != "linux" or os.geteuid() != 0:
        return "needs root on Linux"
    found = [shutil.which("useradd"), shutil.which("/usr/bin/python3")]
    return "" if all(found) else "needs useradd and /usr/bin/python3"


pytestmark = pytest.mark.skipif(bool(reason()), reason=reason() or "-")


@pytest.fixture
def root() -> Iterator[Path]:
    """A folder as a container has it at /autograder, and the recipe's user."""
    folder = Path(tempfile.mkdtemp())
    folder.chmod(0o755)
    for name in ("source", "results", "submission", "lucida/bin"):
        (folder / name).mkdir(parents=True)
    (folder / "lucida" / "bin" / "lucida").symlink_to(Path(sys.executable).with_name("lucida"))
    (folder / "source" / "hw2.toml").write_text(TASKS, "utf-8")
    subprocess.run(["useradd", "--system", USER], check=True)
    yield folder
    subprocess.run(["userdel", USER], check=True)
    shutil.rmtree(folder)


def submitted(root: Path, source: str) -> dict:
    """Run the documents' recipe, with another folder and user."""
    known = f"import os, time\nROOT = {str(root)!r}\n"
    (root / "submission" / "rays.py").write_text(known + source, "utf-8")
    documents = Path(lucida.__file__).resolve().parent.parent / "docs" / "checking.md"
    block = re.search(r"`run_autograder`.*?\n\n((?:    .*\n)+)", documents.read_text("utf-8"))
    assert block
    text = block[1].replace("\n    ", "\n").strip().replace("/autograder", str(root))
    script = root / "run_autograder"
    script.write_text(text.replace("--as student", f"--as {USER}"), "utf-8")
    subprocess.run(["sh", str(script)], check=True)
    return json.loads((root / "results" / "results.json").read_text("utf-8"))


def test_an_honest_submission_and_cheats(root: Path) -> None:
    user = f"assert os.getuid() == {pwd.getpwnam(USER).pw_uid} and not os.getgroups()\n"
    assert submitted(root, user + RIGHT)["score"] == 2
    found = submitted(root, CHEATS + RIGHT)
    assert found["score"] == 0
    assert "denied: [True, True, True]" in found["output"]


def test_a_daemon_of_two_forks_ends_with_the_check(root: Path) -> None:
    assert submitted(root, DAEMON + RIGHT)["score"] == 2
    wait_for(lambda: not account(USER).running())


def test_results_wait_with_zero_points_for_the_end_of_the_program(root: Path) -> None:
    waits = "print(open(ROOT + '/results/results.json').read())\n"
    (root / "results").chmod(0o755)
    (root / "submission" / "rays.py").write_text(f"ROOT = {str(root)!r}\n{waits}{RIGHT}", "utf-8")
    results = root / "results" / "results.json"
    words = ["check", str(root / "submission" / "rays.py"), "--task", "basis"]
    words += ["--as", USER, "--python", "/usr/bin/python3", "--json", str(results)]
    assert main(words) == 0
    (test,) = json.loads(results.read_text("utf-8"))["tests"]
    assert "did not finish" in test["output"] and test["score"] > 0


def test_who_cannot_run_a_program(root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, tasks = root / "submission" / "rays.py", root / "source" / "hw2.toml"
    path.write_text(RIGHT, "utf-8")
    words = ["check", str(path), "--task", "basis", "--as"]
    with subprocess.Popen(["sleep", "1000"], user=USER) as sleeping:
        status = main([*words, USER])
        sleeping.kill()
    assert status == 2
    assert f"{USER} has processes already; make a user" in capsys.readouterr().err
    for user in ("root", "no-such-user"):
        assert main([*words, user]) == 2
        assert capsys.readouterr().err.startswith("lucida: --as: ")
    assert main([*words, USER, "--tasks", str(tasks)]) == 2
    assert f"{USER} can read it; chmod 600" in capsys.readouterr().err
    (root / "results").chmod(0o777)
    assert main([*words, USER, "--json", str(root / "results" / "results.json")]) == 2
    assert f"{USER} can write to {root / 'results'}" in capsys.readouterr().err
