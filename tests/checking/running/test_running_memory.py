"""The memory of processes, as the system tells it."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys

import pytest

from app.checking.running import memory


@pytest.fixture
def holding(nothing_left):
    """A process that holds 50 MB, and its number."""
    source = "held = b'x' * (50 << 20); print('held', flush=True); input()"
    with subprocess.Popen(
        [sys.executable, "-c", source], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as process:
        assert process.stdout
        process.stdout.readline()
        yield process.pid
        process.communicate(b"\n")


def test_what_a_process_holds(holding):
    assert 50 << 20 < memory.memory_of(holding) < 100 << 20


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere a process counts alone")
def test_what_it_has_started_counts(holding):
    assert holding in memory.tree_of(os.getpid())
    assert memory.memory_of(os.getpid()) > 50 << 20


@pytest.mark.skipif(sys.platform != "win32" and shutil.which("ps") is None, reason="no ps")
def test_what_another_program_says(holding):
    assert 50 << 20 < memory.told_by_system(holding) < 100 << 20


def test_a_process_that_is_not_there_holds_nothing(holding):
    assert memory.memory_of(2**22 + 1) == 0
    assert memory.told_by_system(2**22 + 1) == 0


def test_where_nobody_can_tell_there_is_no_limit(monkeypatch):
    monkeypatch.setenv("PATH", "")
    assert memory.told_by_system(os.getpid()) == 0
