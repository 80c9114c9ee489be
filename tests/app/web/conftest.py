"""A browser, and the lectures that its pages show."""

import pytest
from both_lectures import both_lectures

from tests.support.browser import chromium


@pytest.fixture(scope="module")
def lecture():
    return both_lectures()


@pytest.fixture(scope="session")
def browser():
    with chromium() as found:
        yield found
