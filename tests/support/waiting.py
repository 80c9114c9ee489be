"""Waiting for what another thread or process does."""

from __future__ import annotations

import time

PATIENT_S = 140.0  # below the limit of a test, which would not say where


def wait_for(condition) -> None:
    end_s = time.monotonic() + PATIENT_S
    while not condition():
        assert time.monotonic() < end_s, "nothing happened"
        time.sleep(0.01)
