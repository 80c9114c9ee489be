"""Who may import whom: the layers, held by the source itself."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
SOURCES = sorted([*ROOT.glob("app/**/*.py"), *ROOT.glob("renderer/**/*.py")])

# A folder or file, and what nothing in it may import, at its top or inside a function.
FORBIDDEN = {
    "renderer": ["app", "glfw", "imgui_bundle"],
    "renderer/camera.py": ["renderer.scene", "renderer.raster", "renderer.trace", "moderngl"],
    "renderer/scene": ["renderer.raster", "renderer.trace", "moderngl", "numba"],
    "renderer/images": ["renderer.raster", "renderer.trace", "renderer.scene", "moderngl", "numba"],
    # Parity means something only between renderers that share no code below the flat scene.
    "renderer/raster": ["renderer.trace", "renderer.compare", "numba"],
    "renderer/trace": ["renderer.raster", "renderer.compare", "moderngl"],
    # Panels get the state and give a new one; they draw no scene.
    "app/panels": ["renderer.raster", "renderer.trace", "moderngl", "app.viewer", "app.cli"],
    "app/teach": ["app.views", "app.panels", "glfw", "imgui_bundle", "moderngl"],
    "app/commands": ["glfw", "imgui_bundle", "moderngl", "numba"],
}


def imports(path: Path, source: str | None = None) -> Iterator[str]:
    """The full names of everything that the file imports, wherever it does."""
    package = path.relative_to(ROOT).parent.parts
    for node in ast.walk(ast.parse(path.read_text("utf-8") if source is None else source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else ()
            base = ".".join([*above, *([node.module] if node.module else [])])
            yield from (f"{base}.{alias.name}" for alias in node.names)


def is_within(name: str, package: str) -> bool:
    return name == package or name.startswith(package + ".")


@pytest.mark.parametrize("place", FORBIDDEN)
def test_layers_import_downwards_only(place):
    files = [path for path in SOURCES if path.is_relative_to(ROOT / place)]
    assert files or not (ROOT / place).exists()
    wrong = [
        f"{path.relative_to(ROOT)} imports {name}"
        for path in files
        for name in imports(path)
        if any(is_within(name, package) for package in FORBIDDEN[place])
    ]
    assert not wrong


def test_the_check_sees_every_form_of_import():
    source = "import a.b\nfrom c import d\ndef f():\n    from . import e\n    from ..g import h"
    found = set(imports(ROOT / "renderer" / "scene" / "x.py", source))
    assert found == {"a.b", "c.d", "renderer.scene.e", "renderer.g.h"}


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))
def test_every_file_says_what_it_owns(path):
    source = path.read_text("utf-8")
    assert not source.strip() or ast.get_docstring(ast.parse(source))
