"""The memory of processes, as the system tells it."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
from students import called

from app.checking.running import memory


@pytest.fixture
def holding():
    """A process that holds 50 MB, and its number."""
    source = "held = b'x' * (50 << 20); print('held', flush=True); input()"
    with subprocess.Popen(
        [sys.executable, "-c", source], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as process:
        assert process.stdout
        process.stdout.readline()
        yield process.pid
        process.communicate(b"\n")


def test_what_a_process_has_started_counts(holding):
    before = memory.memory_of(os.getpid())
    assert before > 50 << 20


def test_a_process_that_is_not_there_holds_nothing():
    assert memory.memory_of(2**22 + 1) == 0


@pytest.mark.skipif(sys.platform != "linux", reason="orphans are adopted on Linux")
def test_what_a_daemon_holds_counts(student):
    one = student(
        """
        import os, time
        def f():
            if os.fork() == 0:
                os.setsid()
                for _ in range(4):
                    if os.fork() == 0:
                        held = bytearray(os.urandom(1 << 20)) * 150
                        time.sleep(10**6)
                os._exit(0)
            time.sleep(10**6)
        """,
        memory_mb=250,
    )
    failure = one.call([called("f")]).failure
    assert failure.kind == "memory"
    assert "rays.py: needs more than the memory limit of 250 MB in call 1 of 1: f()" in failure.text
