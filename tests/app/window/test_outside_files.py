"""Files that a scene or a lecture names outside of its folder: told, asked about, refused."""

import os
from pathlib import Path

import pytest
from opened_things import found
from waiting import wait_for

from lucida.app.cli import main
from lucida.app.lecture.reading import load_lecture
from lucida.app.window.files import Files, outside_question
from lucida.app.window.opening import OpenedScene, open_sources
from lucida.app.window.scene_saving import title
from lucida.renderer.files import load_scene
from lucida.renderer.files.outside import OutsideError, kept_inside, model_files, outside
from lucida.renderer.system.errors import LucidaError

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
INSIDE = ("m.obj", "models/m.obj", "models/../m.obj", "./m.obj")
ELSEWHERE = ("../m.obj", "models/../../m.obj", "{top}/m.obj", "link.obj", "linked/m.obj")


@pytest.fixture
def folder(tmp_path):
    """A folder `mine` with models inside and around it, and links that lead out."""
    mine = tmp_path / "mine"
    (mine / "models").mkdir(parents=True)
    for place in (tmp_path, mine, mine / "models"):
        (place / "m.obj").write_text(TRIANGLE)
    (mine / "link.obj").symlink_to(tmp_path / "m.obj")
    (mine / "linked").symlink_to(tmp_path)
    return mine


def scene_file(folder, *names):
    path = folder / "scene.toml"
    tables = (f"[[objects]]\ntype = 'model'\nfile = '{name}'\n" for name in names)
    path.write_text("".join(tables).format(top=folder.parent))
    return path


@pytest.mark.parametrize("name", INSIDE)
def test_what_is_inside_is_read_without_a_word(name, folder):
    path = scene_file(folder, name)
    scene = found(open_sources([str(path)], dropped=True), OpenedScene).scene
    assert scene is not None
    assert outside(model_files(scene), folder) == ()
    assert title(scene) == "Lucida: scene"


@pytest.mark.parametrize("name", ELSEWHERE)
def test_what_is_outside_is_told_and_not_read_for_a_dropped_scene(name, folder, monkeypatch):
    path = scene_file(folder, "m.obj", name)
    scene = found(open_sources([str(path)]), OpenedScene).scene  # the user has named it
    assert scene is not None
    (file,) = outside(model_files(scene), folder)
    assert os.path.realpath(file) == str(folder.parent.resolve() / "m.obj")
    with monkeypatch.context() as patch:
        patch.setattr("lucida.renderer.files.scene_parts.load_model", None)  # nothing is read
        with pytest.raises(OutsideError) as caught:
            open_sources([str(path)], dropped=True)
    assert caught.value.files == (file,)
    assert str(caught.value) == (
        f"{path}: names a file outside of its folder: {file}; "
        "agree to that, or copy them into its folder"
    )
    opened = open_sources([str(path)], dropped=True, agreed=frozenset([file]))
    assert found(opened, OpenedScene).agreed == frozenset([file])
    with pytest.raises(OutsideError, match="outside of its folder"):
        open_sources([str(path), "spheres"], dropped=True)  # among others, too


def test_all_of_them_are_named_once_and_only_what_is_agreed_to_is_read(folder):
    path = scene_file(folder, "../m.obj", "m.obj", "../m.obj", "../n.obj")
    with pytest.raises(OutsideError) as caught:
        open_sources([str(path)], dropped=True)
    assert caught.value.files == (folder.parent / "m.obj", folder.parent / "n.obj")
    with pytest.raises(OutsideError) as caught:
        open_sources([str(path)], dropped=True, agreed=frozenset([folder.parent / "m.obj"]))
    assert caught.value.files == (folder.parent / "n.obj",)


def test_a_folder_that_is_reached_by_a_link_is_the_same_folder(folder):
    scene_file(folder, "{top}/mine/m.obj", "m.obj")
    (folder.parent / "other").symlink_to(folder)
    other = folder.parent / "other" / "scene.toml"
    assert open_sources([str(other)], dropped=True).find(OpenedScene) is not None


def test_loops_of_links_and_names_that_are_none_are_told_by_reading(folder):
    (folder / "loop.obj").symlink_to(folder / "loop.obj")
    for name in ("loop.obj", "a\\u0000b.obj"):
        path = folder / "scene.toml"
        path.write_text(f'[[objects]]\ntype = "model"\nfile = "{name}"\n')
        with pytest.raises(LucidaError, match="cannot be read"), kept_inside(path):
            load_scene(path)
    assert outside(["\0"], folder) == ()


def test_the_window_asks_and_opens_what_was_agreed_to(folder):
    files = Files(lambda: None)
    files.open_all([str(scene_file(folder, "../m.obj"))], dropped=True)
    wait_for(lambda: files.poll() is not None or files.question is not None)
    asked = files.question
    assert asked is not None
    assert not files.message
    assert asked.text == (
        f"scene.toml names files outside of its folder:\n    {folder.parent / 'm.obj'}"
    )
    (yes,) = asked.answers.values()
    yes()
    assert files.question is None
    opened = None
    while opened is None:
        opened = files.poll()
    assert opened.find(OpenedScene) is not None
    files.close()


def test_a_question_about_many_files_has_an_end():
    told = outside_question("s.toml", [Path(f"/{n}") for n in range(1000)])
    assert len(told.splitlines()) == 10
    assert told.endswith("and 992 more")


# Lectures.

STEP = "[[steps]]\ntitle = 'T'\n"


@pytest.mark.parametrize(
    "text",
    [
        STEP + "scene = '../out.toml'\n",
        STEP + "camera = '../view.toml'\n",
        STEP + "scene = 's'\n[scenes.s]\nobjects = [{type = 'model', file = '../m.obj'}]\n",
        STEP + "scene = 'scene.toml'\n",  # which is inside, and names a model that is not
    ],
    ids=range(4),
)
def test_a_lecture_keeps_to_its_folder_unless_the_user_agrees(text, folder, capsys):
    scene_file(folder, "../m.obj")
    (folder.parent / "out.toml").write_text("objects = []\n")
    (folder.parent / "view.toml").write_text("[camera]\n")
    path = folder / "lecture.toml"
    path.write_text("title = 'L'\n" + text)
    with pytest.raises(OutsideError) as caught:
        load_lecture(path)
    (file,) = caught.value.files
    assert file.parent == folder.parent
    lecture = load_lecture(path, frozenset([file]))
    assert lecture.outside == (file,)
    assert load_lecture(path, None).outside == (file,)
    for source in ([str(path)], [str(path), "spheres"]):
        with pytest.raises(OutsideError, match="outside of its folder"):
            open_sources(source)
    assert main(["lecture", str(path), "--check"]) == 0
    out = capsys.readouterr().out
    assert f"reads {file}, outside of its folder: the window asks first" in out
    for export in ([], ["--export", str(folder / "slides")]):
        assert main(["lecture", str(path), *export]) == 2
        assert "add --outside to agree" in capsys.readouterr().err
    assert not (folder / "slides").exists()


# The command line.


def test_scene_says_what_a_scene_reads_and_where_its_files_are(folder, capsys):
    path = scene_file(folder, "m.obj", "../m.obj")
    assert main(["scene", str(path)]) == 0
    assert capsys.readouterr().out.endswith(
        f"  reads {folder}/m.obj\n  reads {folder}/../m.obj, outside of its folder\n"
    )
    assert main(["scene", "spheres"]) == 0
    assert "reads" not in capsys.readouterr().out


def files_of(source):
    origin = load_scene(source).origin
    assert origin is not None
    return list(origin.files)


def test_a_scene_s_files_are_its_own_and_its_models(folder):
    path = scene_file(folder, "m.obj", "m.obj", "models/m.obj")
    assert files_of(path) == [path, folder / "m.obj", folder / "models/m.obj"]
    assert files_of(folder / "m.obj") == [folder / "m.obj"]
    assert files_of("spheres") == []
