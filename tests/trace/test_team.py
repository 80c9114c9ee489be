"""A team's threads: woken on different processors after a rest, and only asked for then."""

from __future__ import annotations

import math
import os
import threading

import pytest

from renderer.trace.threads import processors, thread_pool
from renderer.trace.threads.thread_pool import Team

HERE, OTHERS = 0, {1, 2}


@pytest.fixture
def asked(monkeypatch):
    """Return the requests to the system's scheduler, on a machine of three processors."""
    confined = []
    monkeypatch.setattr(thread_pool, "others_than_here", lambda: (OTHERS, {HERE, *OTHERS}))
    monkeypatch.setattr(
        thread_pool, "confine", lambda threads, to: confined.append((list(threads), to))
    )
    return confined


def run(team, size=None):
    """The threads that a kernel ran in."""
    together = threading.Barrier(team.size if size is None else size)
    met = []

    def kernel():
        met.append(threading.get_native_id())
        together.wait(60)

    team.run(kernel, size=size)
    return met


def test_after_a_rest_helpers_are_woken_beside_their_caller(asked, monkeypatch):
    team = Team(3)
    try:
        helpers = set(run(team)) - {threading.get_native_id()}
        monkeypatch.setattr(thread_pool, "REST_S", 0.0)
        asked.clear()
        run(team)
        # Before they are woken; and each by itself, once it is awake.
        assert asked[0] == ([*asked[0][0]], OTHERS)
        assert set(asked[0][0]) == helpers
        assert asked[1:] == [([0], {HERE, *OTHERS})] * 2
    finally:
        team.close()


def test_nothing_is_asked_from_one_kernel_to_the_next_or_for_one_thread(asked, monkeypatch):
    team = Team(2)
    try:
        run(team)
        assert asked
        asked.clear()
        monkeypatch.setattr(thread_pool, "REST_S", math.inf)
        run(team)
        monkeypatch.setattr(thread_pool, "REST_S", 0.0)
        run(team, size=1)
        assert asked == []
    finally:
        team.close()


@pytest.mark.skipif(processors.others_than_here() is None, reason="needs Linux, two processors")
def test_threads_may_run_on_all_processors_while_they_work(monkeypatch):
    monkeypatch.setattr(thread_pool, "REST_S", 0.0)
    allowed = os.sched_getaffinity(0)
    confined, met = [], []
    confine = processors.confine

    def watched(threads, to):
        confine(threads, to)
        confined.append([os.sched_getaffinity(thread) for thread in threads])

    monkeypatch.setattr(thread_pool, "confine", watched)
    team = Team(2)
    try:
        team.run(lambda: met.append(os.sched_getaffinity(0)))
    finally:
        team.close()
    assert met == [allowed, allowed]
    (while_asleep,), (awake,) = confined
    assert while_asleep < allowed
    assert awake == allowed
    assert os.sched_getaffinity(0) == allowed


def test_the_calling_thread_s_own_restriction_holds_for_its_helpers(monkeypatch):
    """As after `taskset -a`, which may come at any time."""
    monkeypatch.setattr(processors, "here", lambda: 5)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {5, 7}, raising=False)
    assert processors.others_than_here() == ({7}, {5, 7})
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {5}, raising=False)
    assert processors.others_than_here() is None


def test_where_the_system_forbids_it_all_goes_on(monkeypatch):
    def forbidden(thread, to):
        raise PermissionError

    monkeypatch.setattr(os, "sched_setaffinity", forbidden, raising=False)
    monkeypatch.setattr(thread_pool, "REST_S", 0.0)
    team = Team(2)
    try:
        assert len(set(run(team))) == 2
    finally:
        team.close()


def test_where_the_system_does_not_tell_nothing_is_asked(monkeypatch):
    monkeypatch.setattr(processors.sys, "platform", "darwin")
    assert processors.find_here() is None
    monkeypatch.setattr(processors, "here", None)
    assert processors.others_than_here() is None
