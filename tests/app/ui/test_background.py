"""Work beside the window: none that must be done is left out."""

from __future__ import annotations

import threading

from waiting import PATIENT_S, wait_for

from lucida.app.ui.background import Background


def test_every_work_is_done_in_its_turn_and_told() -> None:
    gate, done = threading.Event(), []
    background: Background[int] = Background("test", lambda: None, every=True)

    def work(number: int) -> int:
        assert gate.wait(PATIENT_S)
        done.append(number)
        return number

    for number in range(3):
        background.submit(lambda number=number: work(number))
    assert background.busy and background.poll() is None
    gate.set()
    wait_for(lambda: len(done) == 3)
    background.close(PATIENT_S)
    outcomes = [background.poll() for _ in range(4)]
    assert [one.value for one in outcomes if one is not None] == done == [0, 1, 2]
    assert not background.busy


def test_closing_waits_for_what_must_be_done_and_drops_the_rest() -> None:
    for every in (True, False):
        begun, gate, done = threading.Event(), threading.Event(), []
        background: Background[None] = Background("test", lambda: None, every)

        def hold(begun=begun, gate=gate) -> None:
            begun.set()
            assert gate.wait(PATIENT_S)

        background.submit(hold)
        assert begun.wait(PATIENT_S)
        background.submit(lambda done=done: done.append("waited"))
        background.close(0.0)
        background.submit(lambda done=done: done.append("too late"))
        gate.set()
        background.close(PATIENT_S)
        assert done == (["waited"] if every else [])
