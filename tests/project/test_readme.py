"""The examples of the README and of docs/ work: commands, files, Python, links."""

import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from textured import saved, slopes

from lucida.app.commands import COMMANDS, view
from lucida.app.commands.arguments import Parser
from lucida.renderer.files import view_from_toml
from lucida.renderer.files.scene_file import scene_from_toml

ROOT = Path(__file__).parents[2]
PAGES = {
    path.name: path.read_text("utf-8") for path in (ROOT / "README.md", *ROOT.glob("docs/*.md"))
}
TEXT = "\n".join(PAGES.values())
RELEASED = "../../releases/latest/download/"  # on GitHub: what a release has put up


def blocks(page):
    """The indented blocks of a page, without their indentation."""
    found = re.findall(r"(?:^    .*\n(?:\n(?=    ))*)+", PAGES[page], re.MULTILINE)
    return [re.sub(r"^    ", "", block, flags=re.MULTILINE) for block in found]


def commands():
    found = re.findall(r"^    (lucida\b(?! =).*)$", TEXT, re.MULTILINE)
    return [re.split(r"\s{2,}", line)[0] for line in found]


def test_every_block_is_indented_from_its_first_line():
    assert re.findall(r"^lucida .*", TEXT, re.MULTILINE) == []


def test_every_command_is_shown():
    shown = {line.split()[1] for line in commands() if " " in line}
    assert {command.NAME for command in COMMANDS} <= shown


@pytest.mark.parametrize("line", commands())
def test_a_command_is_taken(line):
    words = shlex.split(line)[1:]
    command = next((c for c in COMMANDS if words[:1] == [c.NAME]), view)
    parser = Parser("lucida")
    command.configure(parser)
    parser.parse_args(words if command is view else words[1:])


def test_the_documents_view_file_is_read():
    shown = view_from_toml(next(b for b in blocks("files.md") if b.startswith("[camera]")))
    assert shown.camera.far == 100.0


def test_the_documents_scene_file_is_read(tmp_path):
    (tmp_path / "bunny.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    saved(tmp_path, "tiles.png", slopes(2, 2))
    scene = scene_from_toml(blocks("files.md")[0], tmp_path)
    assert len(scene.objects) == 2


def test_the_documents_python_runs(tmp_path, monkeypatch, capsys, gl_backend):
    if gl_backend != "egl":
        pytest.skip("once is enough")
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(blocks("python.md")[0], names)
    assert float(capsys.readouterr().out) == pytest.approx(float(names["t"]), rel=1e-6)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["corner.toml", "depth.png"]
    assert names["shown"].shape == (480, 640, 3)
    assert np.isfinite(names["frame"].depth).any()


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_to_files(page):
    folder = ROOT if page == "README.md" else ROOT / "docs"
    workflow = (ROOT / ".github" / "workflows" / "publish.yml").read_text()
    for link in re.findall(r"\]\(([^)#]+)", PAGES[page]):
        if link.startswith(RELEASED):
            assert f" -o {link.removeprefix(RELEASED)}" in workflow
        else:
            assert link.startswith("https://") or (folder / link).is_file(), link


def test_every_page_is_linked():
    linked = set(re.findall(r"\(docs/(\w[\w-]*\.md)\)", PAGES["README.md"]))
    assert linked == PAGES.keys() - {"README.md"}
