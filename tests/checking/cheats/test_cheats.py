"""A grade holds against dishonest programs: each cheat gets no points, and touches nothing."""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

import psutil
import pytest
from students import adopting
from table import ANSWERS, FORGED, FORGERIES, SYSTEM
from waiting import wait_for

import renderer
from app.checking.running import isolation
from app.cli import main

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="walls are Linux's")
CHECKOUT = Path(renderer.__file__).resolve().parent.parent
TASK = '[[tasks]]\nkind = "memory-offset"\npoints = 2\n'
ATTACKS = """
import ctypes, os, socket, subprocess, sys, tempfile, time
libc = ctypes.CDLL(None, use_errno=True)
{names}
def attack():
    {source}
print("tried", flush=True)
try:
    attack()
except BaseException as error:
    print(type(error).__name__)
def memory_offset(i, j, width): return 0
"""


@pytest.fixture(params=["bubblewrap", "landlock"])
def walls(request, monkeypatch):
    """One kind of wall after the other."""
    if request.param == "landlock":
        monkeypatch.setenv("PATH", "/nowhere")
    elif shutil.which("bwrap") is None:
        pytest.skip("bubblewrap is not installed")
    isolation.level.cache_clear()
    if isolation.remark(isolation.Access()):
        pytest.skip(f"no {request.param} here")
    yield request.param
    monkeypatch.undo()
    isolation.level.cache_clear()


@pytest.fixture
def adopted():
    with adopting() as left:
        yield left


@pytest.fixture
def graded(tmp_path, capsys, adopted):
    """Check a submission, and return its results; nothing that it started may be left."""

    def grade(source: str, *options: str) -> dict:
        for folder in ("submission", "grader"):
            (tmp_path / folder).mkdir(exist_ok=True)
        (tmp_path / "submission" / "rays.py").write_text(source, "utf-8")
        tasks, results = tmp_path / "grader" / "tasks.toml", tmp_path / "grader" / "results.json"
        tasks.write_text(TASK, "utf-8")
        main(
            [
                *("check", str(tmp_path / "submission" / "rays.py"), "--tasks", str(tasks)),
                *("--json", str(results), "--time-limit", "3", "--memory-limit", "64", *options),
            ]
        )
        if isolation.level() == "plain":  # where it is known that something may be left
            wait_for(lambda: not adopted())
        assert not adopted()
        assert {path.name for path in tmp_path.rglob("*") if path.is_file()} == {
            *("rays.py", "tasks.toml", "results.json")
        }
        assert not results.is_symlink()
        assert results.parent.stat().st_mode & 0o777 != 0o777
        assert " 1282763625 " not in (Path("/proc/sysvipc/shm").read_text())
        assert not [*Path(tempfile.gettempdir()).glob("student-*/d")]
        return json.loads(results.read_text("utf-8"))

    return grade


@pytest.fixture(scope="module")
def listeners(tmp_path_factory):
    """A port that listens, on TCP and UDP, and the path of a service; nobody may reach them."""
    path, udp = str(tmp_path_factory.mktemp("service") / "socket"), socket.SOCK_DGRAM
    with socket.create_server(("127.0.0.1", 0)) as there, socket.socket(socket.AF_UNIX) as here:
        here.bind(path)
        here.listen()
        with socket.socket(socket.AF_INET, udp) as also:
            also.bind(there.getsockname())
            yield there.getsockname()[1], path
            also.setblocking(False)
            with pytest.raises(BlockingIOError):
                also.recv(1)


@pytest.mark.parametrize("name", SYSTEM)
def test_a_cheat_of_the_system(graded, walls, listeners, tmp_path, name):
    known = {
        "RESULTS": str(tmp_path / "grader" / "results.json"),
        "TASKS": str(tmp_path / "grader" / "tasks.toml"),
        "CHECKOUT": str(CHECKOUT),
        "GRADER": os.getpid(),
        "PORT": listeners[0],
        "SERVICE": listeners[1],
    }
    names = "\n".join(f"{word} = {value!r}" for word, value in known.items())
    who, source = SYSTEM[name]
    found = graded(ATTACKS.format(names=names, source=source))
    assert found["score"] == 0
    told = found["output"] + found["tests"][0]["output"]
    assert "tried" in told
    assert "cheated" not in told
    if who == "walls" and "assert" not in source:
        refused = ("Error", "was ended by", "proc")
        assert any(word in told for word in refused), told


@pytest.mark.parametrize("name", ANSWERS)
def test_a_cheat_of_the_answers(graded, name):
    found = graded(ANSWERS[name][1])
    assert found["score"] == 0
    assert found["tests"][0]["status"] == "failed"


@pytest.mark.parametrize("name", FORGERIES)
def test_a_forged_answer_is_no_internal_error(graded, capsys, name):
    first, then = FORGERIES[name]
    found = graded(FORGED.format(first=first, then=then), "--memory-limit", "256")
    assert found["score"] == 0
    assert "wrote into a file of ours" in json.dumps(found)


def test_a_failure_s_lines_are_bounded(graded):
    lines = f'"lines": {json.dumps(["x"] * 9999)}'
    has = 'i{"functions": ["memory_offset"], "own": [], "files": []}'
    failure = 'f{"kind": "exception", "text": "t", "where": "", ' + lines + "}"
    found = graded(FORGED.format(first=has, then=failure), "--memory-limit", "256")
    assert len(found["tests"][0]["output"]) < 1000


@pytest.mark.parametrize("name", ["rays.py", "rays.csv"])
def test_a_submission_that_is_a_link_to_another_s_is_refused(tmp_path, capsys, name):
    (tmp_path / "solution").write_text("def memory_offset(i, j, width): return i * width + j\n")
    (tmp_path / "submission").mkdir()
    (tmp_path / "submission" / name).symlink_to(tmp_path / "solution")
    assert main(["check", str(tmp_path / "submission" / name), "--task", "memory-offset"]) == 2
    assert "is a link out of its folder; give the file itself" in capsys.readouterr().err


def test_a_submission_that_is_a_link_within_its_folder_is_followed(tmp_path, capsys):
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "mine.py").write_text(
        "def memory_offset(i, j, width): return i * width + j\n"
    )
    (tmp_path / "rays.py").symlink_to("src/mine.py")
    assert main(["check", str(tmp_path / "rays.py"), "--task", "memory-offset"]) == 0


@pytest.mark.parametrize("kind", ["as it is", "plain"])
def test_a_program_is_told_no_path_of_ours(graded, monkeypatch, kind):
    if kind == "plain":
        monkeypatch.setattr(isolation, "level", lambda: "plain")
    found = graded(
        """
import os, sys, numpy
files = [os.readlink(f"/proc/self/fd/{number}") for number in range(3)]
print(sys.path, sys.argv, sys.orig_argv, sys.executable, numpy.__file__, os.environ, os.getcwd())
print(files, open("/proc/self/cmdline").read(), [*sys.modules], sys._getframe(1).f_globals)
memory_offset = __builtins__["id"] if isinstance(__builtins__, dict) else abs
""",
        *("--memory-limit", "512"),
    )
    told = json.dumps(found)
    assert "site-packages" in told
    for word in (str(CHECKOUT), "results.json", "tasks.toml"):
        assert word not in told


@pytest.mark.parametrize("name", ["results.json", "tasks.toml", "page.html"])
def test_what_lies_in_the_program_s_own_folder_is_hidden(tmp_path, walls, capsys, name):
    tasks, results, page = (tmp_path / file for file in ("tasks.toml", "results.json", "page.html"))
    tasks.write_text(TASK, "utf-8")
    (tmp_path / "helper.py").write_text("zero = 0\n", "utf-8")
    attack = f"open({name!r}, 'w').write('cheated'); print(open({name!r}).read())"
    source = ATTACKS.format(names="import helper", source=attack)
    (tmp_path / "rays.py").write_text(source, "utf-8")
    words = ["--tasks", str(tasks), "--json", str(results), "--html", str(page)]
    assert main(["check", str(tmp_path / "rays.py"), *words]) == 1
    for file in (results, page):
        text = file.read_text("utf-8")
        assert "tried" in text and "did not come to its end" not in text
        assert "cheated" not in text and "kind =" not in text
    assert tasks.read_text("utf-8") == TASK


def test_a_program_of_any_language_is_walled_in_too(tmp_path, walls, listeners, capsys):
    results, program = tmp_path / "results.json", tmp_path / "program" / "cheat.py"
    program.parent.mkdir()
    program.write_text(
        f"""
import contextlib, socket, sys
with contextlib.suppress(OSError):  # in bubblewrap it is another file of that name
    open({str(results)!r}, "w").write("cheated")
for attack in (
    lambda: open({str(program.parent / "left")!r}, "w").write("cheated"),
    lambda: exec("from renderer.camera import Camera"),
    lambda: sys.path.append({str(CHECKOUT)!r}) or exec("from renderer.camera import Camera"),
    lambda: socket.create_connection(("127.0.0.1", {listeners[0]}), 5),
):
    try:
        attack()
        print("cheated", file=sys.stderr)
    except (OSError, ImportError):
        print("refused", file=sys.stderr)
for line in sys.stdin:
    print(0)
"""
    )
    command = f"{sys.executable} {program}"
    words = ["check", "--command", command, "--task", "memory-offset", "--json", str(results)]
    assert main(words) == 1
    text = results.read_text("utf-8")
    assert text.count("refused") == 4 and "cheated" not in text
    assert not (program.parent / "left").exists()


def test_a_program_sees_of_the_home_folder_its_language_alone(tmp_path, walls, monkeypatch, capsys):
    """Its interpreter is there under a version's name, which a link leads to."""
    home = tmp_path / "home"
    for name in ("lang-1.2/bin", "lang-1.2/lib", ".julia/packages", ".ssh", "hw"):
        (home / name).mkdir(parents=True)
    (home / "lang").symlink_to("lang-1.2")
    lang, program = home / "lang-1.2" / "bin" / "lang", home / "hw" / "rays.lang"
    lang.write_text(f'#!/bin/sh\nexec {isolation.interpreter()} -I "$@"\n', "utf-8")
    needed = [home / "lang" / "lib" / "number", home / ".julia" / "packages" / "number"]
    private = [home / ".ssh" / "key", home / "solution.py"]
    for path in (*needed, *private):
        path.write_text("0", "utf-8")
    program.write_text(
        f"""#!{home / "lang" / "bin" / "lang"}
import sys
needed = sum(int(open(path).read()) for path in {[*map(str, needed)]})
for path in {[*map(str, private)]}:
    try:
        print("secret", open(path).read(), file=sys.stderr)
    except OSError:
        print("refused", file=sys.stderr)
for line in sys.stdin:
    print(needed)
""",
        "utf-8",
    )
    for path in (lang, program):
        path.chmod(0o755)
    monkeypatch.setenv("HOME", str(home))
    results = tmp_path / "results.json"
    words = ["--command", str(program), "--task", "memory-offset", "--json", str(results)]
    assert main(["check", *words]) == 1
    told = json.loads(results.read_text("utf-8"))["tests"][0]["output"]
    assert "All your answers are 0" in told  # it could read what it needs
    assert told.count("refused") == 2 and "secret" not in told


def test_a_task_file_may_allow_the_network(tmp_path, walls, listeners, capsys):
    (tmp_path / "tasks.toml").write_text("network = true\n" + TASK, "utf-8")
    source = f"import socket\nsocket.create_connection(('127.0.0.1', {listeners[0]}), 5)\n"
    source += "def memory_offset(i, j, width): return i * width + j\n"
    (tmp_path / "rays.py").write_text(source, "utf-8")
    words = ["check", str(tmp_path / "rays.py"), "--tasks", str(tmp_path / "tasks.toml")]
    assert main(words) == 0


@pytest.mark.skipif(not hasattr(os, "geteuid"), reason="Windows has no such users")
@pytest.mark.parametrize("user", ["root", "no-such-user"])
def test_as_whom_a_program_cannot_run(tmp_path, capsys, user):
    (tmp_path / "rays.py").write_text("", "utf-8")
    assert main(["check", str(tmp_path / "rays.py"), "--as", user]) == 2
    assert capsys.readouterr().err.startswith("lucida: --as: ")


def test_without_walls_a_line_says_so_and_a_killed_supervisor_earns_nothing(
    graded, monkeypatch, capsys
):
    monkeypatch.setattr(isolation, "level", lambda: "plain")
    right = "def memory_offset(i, j, width): return i * width + j\n"
    assert graded(right)["score"] == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "A dishonest program could read the right answers" in line
    found = graded("import os\nos.kill(os.getppid(), 9)\n" + right)
    assert found["score"] == 0
    assert "could not be ended" in found["output"]


def test_a_grader_that_is_killed_leaves_a_zero_and_no_process(tmp_path, adopted):
    (tmp_path / "rays.py").write_text("while True: pass\n", "utf-8")
    results = tmp_path / "results.json"
    run = "import sys; from app.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", run, "check", "rays.py", "--task", "basis"]
    with subprocess.Popen([*command, "--json", str(results)], cwd=tmp_path) as grader:
        wait_for(results.exists)
        wait_for(lambda: len(psutil.Process(grader.pid).children(recursive=True)) > 1)
        grader.kill()
    found = json.loads(results.read_text("utf-8"))
    assert found["score"] == 0
    assert "did not come to its end" in found["output"]
    wait_for(lambda: not adopted())


def test_an_honest_program_gets_its_points(graded, walls):
    source = "import numpy\ndef memory_offset(i, j, width): return numpy.int64(i * width + j)\n"
    assert graded(source, "--memory-limit", "512")["score"] == 2


def test_the_table_of_the_documents():
    """Each cheat stands there with who stops it."""
    text = (CHECKOUT / "docs" / "checking.md").read_text("utf-8")
    for name, (who, _) in {**SYSTEM, **ANSWERS}.items():
        assert f"| {name} | {who} |" in text
