"""The rules of imports: the floors and the pure cores, held by the source itself."""

import ast
import functools
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOURCES = sorted(
    path for top in ("app", "lucida", "renderer") for path in ROOT.glob(f"{top}/**/*.py")
)

# From the ground up, as docs/architecture.md says. A module belongs to the longest name here that
# it is within, and imports from its own layer and from those before it; local imports count, and
# those that are only for types.
LAYERS = (
    ("lucida.renderer.system",),
    ("lucida.renderer.camera.checks", "lucida.renderer.camera.pixels", "lucida.renderer.images"),
    ("lucida.renderer.camera", "lucida.renderer.images.samples"),
    ("lucida.renderer.scene",),
    ("lucida.renderer.files",),
    ("lucida.renderer.editing",),
    ("lucida.renderer.raster",),
    ("lucida.renderer.trace.compile",),
    ("lucida.renderer.trace.vector",),
    ("lucida.renderer.trace.arguments", "lucida.renderer.trace.threads"),
    ("lucida.renderer.trace.reference",),
    ("lucida.renderer.trace.bvh",),
    ("lucida.renderer.trace.rays",),
    ("lucida.renderer.trace.tiles",),
    ("lucida.renderer.trace",),
    ("lucida.renderer.compare",),
    ("lucida.renderer.notebook", "lucida.renderer.system.doctor"),
    ("lucida.renderer", "lucida.app", "lucida"),
    ("lucida.app.state",),
    ("lucida.app.ui", "lucida.app.images", "lucida.app.cameras"),
    ("lucida.app.instruments", "lucida.app.lecture", "lucida.app.checking", "lucida.app.web"),
    ("lucida.app.window", "lucida.app.commands", "lucida.app.cli", "lucida.__main__"),
)
LAYER = {name: number for number, names in enumerate(LAYERS) for name in names}

# What a place may not import, beside what stands above it.
FORBIDDEN = {
    "renderer": ["glfw", "imgui_bundle"],
    "renderer/scene": ["moderngl", "numba"],
    "renderer/images": ["moderngl", "numba"],
    # Parity means something only between renderers that share no code below the flat scene.
    "renderer/raster": ["numba"],
    "renderer/trace": ["lucida.renderer.raster", "moderngl"],
    "app/commands": ["glfw", "imgui_bundle", "moderngl", "numba"],
}

# What computes: what these files import, and what that imports, draws nothing.
GRAPHICS = ("glfw", "imgui_bundle", "moderngl")
PURE = (
    "app/state/**/*.py",
    "app/ui/explaining/**/*.py",
    "app/cameras/*.py",
    "app/checking/*.py",
    "app/checking/[!y]*/**/*.py",  # the view your_code/ draws
    "app/web/**/*.py",
    "app/instruments/*/model.py",
)


@functools.cache
def tree_of(path):
    return ast.parse(path.read_text("utf-8"))


def statements(node):
    """All statements within a node. ast.walk takes five times as long, because of expressions."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.stmt | ast.excepthandler | ast.match_case):
            yield child
            yield from statements(child)


@functools.cache
def imports(path):
    """The full names of everything that the file imports, wherever it does."""
    return tuple(_imports(path))


def _imports(path):
    package = name_of(path.with_name("__init__.py")).split(".")
    for node in statements(tree_of(path)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else ()
            base = ".".join([*above, *([node.module] if node.module else [])])
            yield from (f"{base}.{alias.name}" for alias in node.names)


def is_within(name, package):
    return name == package or name.startswith(package + ".")


def name_of(path):
    """Return the name that the file is imported by: lucida/ has links to app/ and renderer/."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    parts = parts if parts[0] == "lucida" else ("lucida", *parts)
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {name_of(path): path for path in SOURCES}


@functools.cache
def imported(module):
    """The project's own modules that a module imports."""
    names = imports(MODULES[module])
    found = {name if name in MODULES else name.rpartition(".")[0] for name in names}
    return frozenset((found & MODULES.keys()) - {module})


def layer(module):
    names = [name for name in LAYER if is_within(module, name)]
    # A package's own __init__ is what the layer is named by; other files need a package.
    assert names and (
        module in LAYER or max(names, key=len) not in ("lucida", "lucida.app", "lucida.renderer")
    ), f"{module} belongs to no layer: put it into a package, or name it in LAYERS"
    return LAYER[max(names, key=len)]


def test_imports_point_down():
    up = {
        f"{module} imports {name}, which is above it"
        for module in MODULES
        for name in imported(module)
        if layer(name) > layer(module)
    }
    assert not up


def test_no_files_import_each_other_in_a_circle():
    done = set()

    def walk(module, way):
        assert module not in way, " -> ".join((*way[way.index(module) :], module))
        if module not in done:
            for name in sorted(imported(module)):
                walk(name, (*way, module))
            done.add(module)

    for module in MODULES:
        walk(module, ())


@pytest.mark.parametrize("place", FORBIDDEN)
def test_what_a_place_must_not_know(place):
    files = [path for path in SOURCES if path.is_relative_to(ROOT / place)]
    assert files
    wrong = [
        f"{path.relative_to(ROOT)} imports {name}"
        for path in files
        for name in imports(path)
        if any(is_within(name, package) for package in FORBIDDEN[place])
    ]
    assert not wrong


def test_cores_draw_nothing():
    """Nor does anything of the window that they import. The rasterizer's OpenGL does not count."""
    seen = set()
    todo = [name_of(path) for pattern in PURE for path in ROOT.glob(pattern)]
    assert todo
    while todo:
        module = todo.pop()
        if module in seen or not is_within(module, "lucida.app"):
            continue
        seen.add(module)
        todo.extend(imported(module))
        drawn = [n for n in imports(MODULES[module]) if n.split(".")[0] in GRAPHICS]
        assert not drawn, f"{module}, which a core reaches, imports {drawn}"


@pytest.mark.parametrize(
    "path",
    # By its text: each process that collects the tests would parse all files.
    [path for path in SOURCES if re.search(r"^\s*import glfw\b", path.read_text("utf-8"), re.M)],
    ids=lambda path: path.name,
)
def test_the_window_s_library_is_loaded_first(path):
    """Otherwise glfw brings its own, which is older and has no platform without a display."""
    names = [name.partition(".")[0] for name in imports(path)]
    assert "imgui_bundle" in names[: names.index("glfw")]
