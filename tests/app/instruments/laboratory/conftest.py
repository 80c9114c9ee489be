"""An image for the laboratory's tests."""

from __future__ import annotations

import numpy as np
import pytest


@pytest.fixture
def color() -> np.ndarray:
    """37 x 23 pixels of light, 0 to 3, smooth and rough, with pure colours at the corners."""
    random = np.random.default_rng(4)
    image = np.linspace(0, 3, 37 * 23).reshape(23, 37, 1) * random.uniform(0.3, 1, (23, 37, 3))
    image[0, 0], image[0, -1], image[-1, 0] = (1, 0, 0), (0, 1, 0), (0, 0, 1)
    return image.astype(np.float32)
