"""Code that does not end, takes all memory, prints without end, or leaves processes behind.

Nothing here depends on how fast it goes: what is to be stopped would never end by itself.
"""

from __future__ import annotations

import dataclasses
import os
import signal
import subprocess
import sys
import threading

import pytest
from students import called
from waiting import wait_for

from app.checking.calls import Failure, Limits, Run
from app.checking.running.file import FileStudent, endless

F = called("f")
LINUX = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="Linux says who lives")
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
        "while True: pass",
        "import time; time.sleep(10**6)",
        "sum(__import__('itertools').count())",  # lets no other thread run
        "__import__('threading').Event().wait()",
        "import os, signal; os.kill(os.getpid(), signal.SIGSTOP)",
        "while True: print('x' * 10**6)",
        "import os\n    while True: os.write(2, b'y' * 10**6)",
        "import signal\n    signal.signal(signal.SIGTERM, signal.SIG_IGN)\n    while True: pass",
    ],
)
def test_a_call_that_never_ends(hasty, body):
    run = hasty(f"def f(i):\n    {body}\n", output=500).call([called("f", i=2), F])
    assert run.values == ()
    assert run.failure == Failure(
        "time",
        "rays.py: the time limit of 0.5 s is over in call 1 of 2: f(i=2); "
        "is there a loop that does not end?",
        call=0,
    )
    assert len(run.output) < 700


def test_calls_that_are_only_slow_are_no_loop():
    assert endless(19, 9.5, 0.4) == "each call takes 0.5 s"
    assert endless(19, 0.4, 9.5) == endless(0, 0.0, 10.0) == "is there a loop that does not end?"


def test_a_file_that_never_ends_while_it_is_imported(student):
    one = student("while True: pass\n", seconds=SHORT)
    run = one.call([F])
    assert run.failure.kind == "time"
    assert "while the file is imported; put what runs on its own under `if" in run.failure.text
    assert one.call([F]) == run  # it is not waited for twice


def test_after_the_time_limit_the_next_run_has_a_process_of_its_own(hasty):
    one = hasty("def f(i):\n    while i: pass\n    return i\n")
    assert one.call([called("f", i=1)]).failure.kind == "time"
    one.limits = Limits(60)
    assert one.call([called("f", i=0)]).values == (0,)


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere it is ended, without its line")
@pytest.mark.parametrize(
    "body",
    ["[0] * 10**10", "bytearray(10**10)", "'x' * 10**10", "while True: a = [a, *range(10**5)]"],
)
def test_too_much_memory_in_a_call(student, body):
    one = student(f"def f(i):\n    a = 0\n    if i:\n        {body}\n    return i\n", memory_mb=200)
    failure, right = one.call([called("f", i=1), called("f", i=0)]).values
    assert failure.kind == "memory"
    assert "it needs more than the memory limit of 200 MB (MemoryError)" in failure.text
    assert "rays.py, line 4" in failure.text
    assert right == 0


@LINUX
def test_too_much_memory_while_importing(student):
    failure = student("a = [0] * 10**10\n", memory_mb=200).call([F]).failure
    assert failure.kind == "memory"
    assert failure.text.startswith("rays.py, line 1: it needs more than the memory limit")


def test_an_end_without_memory_to_report_it(student):
    failure = student("import os\ndef f(): os._exit(86)\n", memory_mb=200).call([F]).failure
    assert failure.kind == "memory"
    assert "needs more than the memory limit of 200 MB in call 1 of 1" in failure.text


def test_an_answer_without_end(student):
    one = student("import itertools\ndef f(): return itertools.count()\n", memory_mb=200)
    (failure,) = one.call([F]).values
    assert failure.kind == "memory"


@pytest.mark.parametrize(
    ("body", "told"),
    [
        ("import os; os._exit(3)", "its process ended with exit status 3 in call 2 of 2"),
        ("import os, signal; os.kill(os.getpid(), 9)", "its process was ended by SIGKILL in call"),
        ("import os, signal; os.killpg(0, 15)", "its process was ended by SIGTERM"),
        ("import ctypes; ctypes.string_at(0)", "its process was ended by SIGSEGV"),
        ("import os; os.abort()", "its process was ended by SIGABRT"),
        (
            "import os; os.closerange(0, 99)\n    while True: pass",
            "its process closed what it answers through",
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


@pytest.mark.parametrize("when", ["def f(): pass\n", ""])
def test_what_is_written_between_the_answers(student, when):
    write = "    for number in range(3, 30):\n        try: os.write(number, b'\\xff\\nzz\\n')"
    source = f"import os\n{when}if 1:\n{write}\n        except OSError: pass\n"
    if not when:
        source = source.replace("if 1:", "def f():")
    failure = student(source).call([F]).failure
    assert failure.kind == "ended"
    assert "it wrote into a file of ours" in failure.text


@pytest.mark.parametrize(
    "source",
    [
        "import sys\nsys.stdout = None\ndef f(): print(1)\n",
        "import sys\ndef f(): sys.stdout.close()\n",
        "import os\ndef f(): os.close(1); os.close(2); os.close(0)\n",
        "import sys, io\nsys.stdout = sys.stderr = io.StringIO()\ndef f(): print(1)\n",
        "import builtins, json\nbuiltins.print = json.dumps = None\ndef f(): return None\n",
        "import sys\nsys.stdout.write = lambda text: 1 / 0\ndef f(): return None\n",
        "import sys\ndef f(): sys.settrace(lambda *a: None); sys.modules.clear()\n",
        "import gc, threading\ndef f(): threading.stack_size(0); gc.freeze()\n",
    ],
)
def test_what_is_done_to_the_output_disturbs_no_answer(student, source):
    run = student(source).call([F, F])
    assert run.failure is None
    assert run.values[0] is None


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


def test_of_much_output_the_ends_are_kept(student):
    source = "def f():\n    print('first')\n    print('ü' * 10**7)\n    print('last')\n"
    output = student(source, output=1000).call([F]).output
    assert output.startswith("first\nüüü")
    assert output.endswith("üüü\nlast\n")
    assert "... about 19,9" in output
    assert len(output) < 1100
    output = student("def f(): print('x' * 1200)\n", output=1000).call([F]).output
    assert "x\n... 201 characters left out ...\nx" in output


STARTED = {
    "fork": "os.fork() or time.sleep(10**6)",
    "fork that comes back": "os.fork()",
    "session": "os.fork() or (os.setsid(), os.fork(), time.sleep(10**6))",
    "program": "subprocess.Popen(['sleep', '1000000'])",
    "program in a session": "subprocess.Popen(['sleep', '1000000'], start_new_session=True)",
    "shell": "os.system('nohup sleep 1000000 >/dev/null 2>&1 &')",
    "thread": "threading.Thread(target=time.sleep, args=(10**6,)).start()",
    "multiprocessing": "context('fork').Process(target=time.sleep, args=(10**6,)).start()",
    "spawned": "context('spawn').Process(target=time.sleep, args=(10**6,)).start()",
    "pool": "held.append(context('fork').Pool(2)) or held[0].map(abs, [1, 2])",
}
STARTS = """
    import multiprocessing, os, subprocess, threading, time
    context, held = multiprocessing.get_context, []
    def f():
        {started}
        return 7
"""


@LINUX
@pytest.mark.parametrize("name", STARTED)
def test_what_is_started_ends_with_the_check(student, nothing_left, name):
    one = student(STARTS.format(started=STARTED[name]))
    run = one.call([F])
    assert run.failure is None
    assert run.values == (7,)
    one.close()
    assert not nothing_left()


@LINUX
def test_forks_without_end_are_ended(student):
    """Few at a time: each is replaced by another, in a session of its own."""
    one = student(
        """
        import os
        def f():
            while True:
                if os.fork():
                    os._exit(0)
                os.setsid()
        """
    )
    assert one.call([F]).failure.kind == "ended"


def stopped(one, calls, begun) -> Run:
    """A run that is stopped as soon as that file is there."""
    runs: list[Run] = []
    thread = threading.Thread(target=lambda: runs.append(one.call(calls)))
    thread.start()
    wait_for(begun.exists)
    one.stop()
    thread.join()
    return runs[0]


def test_a_stop_from_another_thread(student, tmp_path):
    begun = tmp_path / "begun"
    one = student(
        f"""
        def f(i):
            if i < 2:
                return i
            print("printed")
            open({str(begun)!r}, "w").close()
            while True:
                pass
        """
    )
    run = stopped(one, [called("f", i=i) for i in range(5)], begun)
    assert run.values == (0, 1)
    assert run.failure == Failure("ended", "rays.py: was stopped in call 3 of 5: f(i=2)", call=2)
    assert run.output == "printed\n"
    one.stop()


def test_a_stop_while_importing_and_another_run_then(student, tmp_path):
    begun = tmp_path / "begun"
    one = student(
        f"""
        import os
        if not os.path.exists({str(begun)!r}):
            open({str(begun)!r}, 'w').close()
            while True: pass
        def f(): return 7
        """
    )
    assert "was stopped while the file is imported" in stopped(one, [F], begun).failure.text
    assert one.call([F]).values == (7,)


@pytest.mark.parametrize("ask", ["functions", "call"])
def test_ctrl_c_ends_the_process_and_another_run_starts_anew(student, monkeypatch, ask):
    one = student("def f(): return 7\n")

    def pressed(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr("app.checking.running.program.StudentProgram.lines", pressed)
        with pytest.raises(KeyboardInterrupt):
            one.functions() if ask == "functions" else one.call([F])
    assert one._program is None  # a process is nobody's business but its own
    assert one.call([F]).values == (7,)


def test_closed_while_it_starts(student, monkeypatch):
    one = student("def f(): return 7\n")
    source = one._source  # the moment between reading and starting, which nothing else reaches
    monkeypatch.setattr(one, "_source", lambda: one._closed.set() or source())
    assert one.call([F]).failure.text == "rays.py: it is closed"
    assert one._program is None


def test_closed_is_closed(student):
    one = student("def f(): return 7\n")
    assert one.call([F]).values == (7,)
    one.close()
    one.close()
    assert one.call([F]).failure.text == "rays.py: it is closed"


@LINUX
@pytest.mark.parametrize(
    "loop",
    ["while True: pass", "sum(__import__('itertools').count())", "os.fork(); time.sleep(9**9)"],
)
def test_it_ends_with_lucida_however_that_ends(tmp_path, nothing_left, loop):
    begun, path = tmp_path / "begun", tmp_path / "rays.py"
    source = f"import os, time\ndef f():\n    open({str(begun)!r}, 'w').close()\n    {loop}\n"
    path.write_text(source, "utf-8")
    lucida = subprocess.Popen(
        [
            sys.executable,
            "-c",
            "import sys\n"
            "from app.checking.calls import Call, Limits\n"
            "from app.checking.running.file import FileStudent\n"
            "FileStudent(sys.argv[1], Limits(1e6)).call([Call('f', ())])",
            str(path),
        ]
    )
    wait_for(begun.exists)
    assert nothing_left()
    os.kill(lucida.pid, signal.SIGKILL)
    lucida.wait()  # and nothing is left, says the fixture
