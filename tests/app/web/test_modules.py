"""The modules of pages: what their checkers say, and how they become one text."""

import shutil
import subprocess
from pathlib import Path

import pytest

from lucida.app.web import bundle as bundling

HERE = Path(__file__).parent


def test_typescript_and_eslint_find_nothing():
    npm = shutil.which("npm")
    if npm is None or not (HERE / "node_modules").is_dir():
        pytest.skip("no TypeScript and ESLint here: .ci/run sets them up")
    done = subprocess.run([npm, "run", "check"], cwd=HERE, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_bundle_has_each_module_once_before_its_users(monkeypatch):
    texts = {
        "a.js": 'import { b } from "./b.js";\nimport "./c.js";\nexport const a = b;\n',
        "b.js": 'import { c } from "./c.js";\nexport const b = c;\n',
        "c.js": "export function c() {}\n",
    }
    monkeypatch.setattr(bundling, "read_module", texts.__getitem__)
    lines = bundling.bundle("a.js").split()
    assert [lines.index(f"{name}.js") for name in "cba"] == sorted(
        lines.index(f"{name}.js") for name in "abc"
    )
    assert not {"import", "export"} & set(lines)
    texts["b.js"] += "const a = 1;\n"
    with pytest.raises(ValueError, match=r"a is declared in b\.js and in a\.js"):
        bundling.bundle("a.js")
    texts["c.js"] = 'import "./a.js";\n'
    with pytest.raises(ValueError, match="circle"):
        bundling.bundle("a.js")
