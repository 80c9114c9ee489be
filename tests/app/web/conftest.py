"""The lectures that pages show."""

import pytest
from both_lectures import both_lectures


@pytest.fixture(scope="module")
def lecture():
    return both_lectures()
