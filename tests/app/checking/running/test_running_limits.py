"""Code that does not end, takes all memory, prints without end, or leaves processes behind."""

from __future__ import annotations

import dataclasses
import subprocess
import sys

import pytest
from students import called
from waiting import is_running, wait_for

from lucida.app.checking.running.file import FileStudent
from lucida.app.checking.tasks import Limits

F = called("f")
LINUX = pytest.mark.skipif(sys.platform != "linux", reason="Linux limits memory")
SHORT = 0.5  # seconds: for code that never ends


@pytest.fixture
def hasty(student):
    """A student whose file is imported in peace: only calls have little time."""

    def make(source: str, **limits) -> FileStudent:
        one = student(source, **limits)
        one.functions()
        one.limits = dataclasses.replace(one.limits, seconds=SHORT)
        return one

    return make


@pytest.mark.parametrize(
    "body",
    [
        "sum(__import__('itertools').count())",  # lets no other thread run
        "while True: print('x' * 10**6) if i < 10 else None; i += 1",
    ],
)
def test_a_call_that_never_ends(hasty, body):
    one = hasty(f"def f(i):\n    while i == 0: return i\n    {body}\n", output=500)
    run = one.call([called("f", i=0), called("f", i=2)])
    assert run.values == (0,)
    told = "is over in call 2 of 2: f(i=2); is each call slow, or a loop endless?"
    assert (run.failure.kind, run.failure.call) == ("time", 1) and told in run.failure.text
    assert len(run.output) < 700
    one.limits = Limits(60)
    assert one.call([called("f", i=0)]).values == (0,)


def test_a_file_that_never_ends_while_it_is_imported(student):
    one = student("while True: pass\n", seconds=SHORT)
    run = one.call([F])
    assert run.failure.kind == "time"
    assert "while the file is imported; put what runs on its own under `if" in run.failure.text
    assert one.call([F]) == run  # it is not waited for twice


@LINUX
@pytest.mark.parametrize("body", ["bytearray(10**10)", "while True: a = [a, *range(10**5)]"])
def test_too_much_memory_in_a_call(student, body):
    one = student(f"def f(i):\n    a = 0\n    if i:\n        {body}\n    return i\n", memory_mb=200)
    failure, right = one.call([called("f", i=1), called("f", i=0)]).values
    assert failure.kind == "memory"
    assert "rays.py, line 4: it needs more than the memory limit of 200 MB" in failure.text
    assert right == 0


@LINUX
def test_a_file_that_fills_the_disk_is_ended(student):
    source = "def f():\n    with open('large', 'wb') as file:\n        file.truncate(1 << 27)\n"
    (failure,) = student(source).call([F]).values
    assert "File too large" in failure.text


@pytest.mark.parametrize(
    ("body", "told"),
    [
        ("import os; os._exit(3)", "it ended with exit status 3 in call 2 of 2"),
        (
            "import os, signal; os.kill(os.getpid(), 9)",
            "it was ended by signal 9 (Killed)",
        ),
        (
            "import os, time; os.closerange(0, 99); time.sleep(99)",
            "it closed what it answers through",
        ),
    ],
)
def test_a_process_that_ends(student, body, told):
    one = student(f"def f(i):\n    if i < 1: return print('kept')\n    {body}\n")
    run = one.call([called("f", i=0), called("f", i=1)])
    assert run.values == (None,)
    assert (run.failure.kind, run.failure.call) == ("ended", 1)
    assert told in run.failure.text
    assert run.output == "kept\n"
    assert one.call([called("f", i=0)]).values == (None,)  # another process


@pytest.mark.parametrize("where", ["def f(): pass\nif 1:", "def f():"])
def test_what_is_written_between_the_answers(student, where):
    write = "    for number in range(3, 30):\n        try: os.write(number, b'\\xff\\nzz\\n')"
    failure = student(f"import os\n{where}\n{write}\n        except OSError: pass\n").call([F])
    assert failure.failure.kind == "ended"
    assert "it wrote into a file of ours" in failure.failure.text


def test_all_that_is_printed_is_captured_in_its_order(student):
    one = student(
        """
        import os, subprocess, sys
        print("import ä")
        def f():
            print("print")
            sys.stderr.write("error\\n")
            os.write(1, b"write\\n")
            subprocess.run([sys.executable, "-c", "print('child')"])
            print("\\udcff")
        """
    )
    assert one.call([F]).output == "import ä\nprint\nerror\nwrite\nchild\n\\udcff\n"
    assert one.call([F]).output == "print\nerror\nwrite\nchild\n\\udcff\n"
    assert one.call([]).output == ""


def test_of_much_output_the_end_is_kept(student):
    source = "def f():\n    print('first')\n    print('y' * 10**7)\n    print('last')\n"
    output = student(source, output=1000).call([F]).output
    assert output.startswith("... 9,999,012 bytes left out ...\nyyy")
    assert output.endswith("yyy\nlast\n")


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no process groups")
def test_what_it_starts_ends_with_the_check(student, tmp_path):
    source = "import subprocess\ndef f(): return subprocess.Popen(['sleep', '1000000']).pid\n"
    one = student(source)
    (process,) = one.call([F]).values
    assert is_running(process)
    one.close()
    wait_for(lambda: not is_running(process))


def test_a_closed_student_says_so(student):
    one = student("def f(): return 7\n")
    assert one.call([F]).values == (7,)
    one.close()
    one.close()
    assert one.call([F]).failure.text == "rays.py: it is closed"


@LINUX
def test_it_ends_with_lucida_however_that_ends(tmp_path):
    begun, path = tmp_path / "begun", tmp_path / "rays.py"
    source = "import os\ndef f():\n"
    source += f"    open({str(begun)!r}, 'w').write(str(os.getpid()))\n    while True: pass\n"
    path.write_text(source, "utf-8")
    run = (
        "import sys\n"
        "from lucida.app.checking.tasks import Call, Limits\n"
        "from lucida.app.checking.running.file import FileStudent\n"
        "FileStudent(sys.argv[1], Limits(1e6)).call([Call('f', ())])"
    )
    with subprocess.Popen([sys.executable, "-c", run, str(path)]) as lucida:
        try:
            wait_for(lambda: begun.exists() and begun.read_text())
        finally:
            lucida.kill()
    wait_for(lambda: not is_running(int(begun.read_text())))
