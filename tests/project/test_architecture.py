"""The ways of docs/architecture.md: their files exist, and are as many as it says."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
MOST = (10, 8, 8)  # a dragged number, a model, a step of a lecture
WAY = r"passes (\d+) files:\n\n((?:\d+\. .*\n)+)"


def test_the_ways_to_both_images_are_as_short_as_the_document_says():
    ways = re.findall(WAY, (ROOT / "docs" / "architecture.md").read_text())
    assert len(ways) == len(MOST)
    for (count, text), most in zip(ways, MOST, strict=True):
        files = re.findall(r"^\d+\. `([^`]+)`: ", text, re.MULTILINE)
        assert len(files) == len(set(files)) == len(text.splitlines()) == int(count) <= most
        assert all((ROOT / name).is_file() for name in files), files
        assert files[-1] == "app/images/request.py"
