"""Waiting for what another thread or process does."""

from __future__ import annotations

import time

import psutil

PATIENT_S = 140.0  # below the limit of a test, which would not say where


def wait_for(condition) -> None:
    end_s = time.monotonic() + PATIENT_S
    while not condition():
        assert time.monotonic() < end_s, "nothing happened"
        time.sleep(0.01)


def is_running(process: int) -> bool:
    """Return False for a process that has ended, even if its parent has not waited for it yet."""
    try:
        return psutil.Process(process).status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False
