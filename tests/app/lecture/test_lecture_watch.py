"""A lecture's file that is written while the lecture is open."""

from types import SimpleNamespace

from lucida.app.lecture import reading
from lucida.app.lecture.model import Lecture
from lucida.app.lecture.reading import load_lecture
from lucida.app.lecture.session import LectureSession
from lucida.app.state.kept_lecture import Judgement
from lucida.app.ui.watching import FilesWatch
from lucida.renderer.system.file_dependencies import stamp


def test_a_change_is_told_once_it_rests(tmp_path):
    path = tmp_path / "x"
    path.write_text("a")
    watch = FilesWatch({path: stamp(path)})
    assert not watch.changed(0.0)
    path.write_text("ab")
    assert not watch.changed(1.0) and watch.waiting
    path.write_text("abc")
    assert not watch.changed(1.3)  # still being written
    assert watch.changed(1.6)
    assert not watch.changed(2.0) and not watch.waiting


def test_a_file_that_is_replaced(tmp_path):
    path, other = tmp_path / "x", tmp_path / "y"
    path.write_text("a")
    other.write_text("other")
    old, watch = tmp_path / "old", FilesWatch({path: stamp(path)})
    path.rename(old)
    assert not watch.changed(1.0) and not watch.waiting
    other.rename(path)
    assert not watch.changed(1.3)
    assert watch.changed(1.6)
    # Changed and changed back before it rested: nothing to do.
    path.rename(other)
    old.rename(path)
    assert not watch.changed(2.0) and watch.waiting
    path.rename(old)
    other.rename(path)
    assert not watch.changed(2.3) and not watch.waiting
    assert not watch.changed(2.6)


def test_one_of_several_files_and_one_that_comes(tmp_path):
    there, missing = tmp_path / "there", tmp_path / "missing"
    there.write_text("a")
    watch = FilesWatch({there: stamp(there), missing: None})
    assert not watch.changed(1.0) and not watch.waiting
    there.write_text("ab")
    assert not watch.changed(2.0)
    assert watch.changed(2.3)
    missing.write_text("now it is there")
    assert not watch.changed(3.0)
    assert watch.changed(3.3)
    missing.unlink()
    there.write_text("abc")  # whatever else is away
    assert not watch.changed(4.0)
    assert watch.changed(4.3)


def test_a_lecture_s_scene_that_is_saved_while_it_is_read(tmp_path, monkeypatch):
    path, scene = tmp_path / "l.toml", tmp_path / "s.toml"
    path.write_text('title = "L"\n[[steps]]\ntitle = "A"\nscene = "s.toml"\n')
    scene.write_text("[[objects]]\ntype = 'sphere'\n")
    load = reading.load_scene

    def slow(source):
        found = load(source)
        scene.write_text("[[objects]]\ntype = 'sphere'\nradius = 2\n")
        return found

    monkeypatch.setattr(reading, "load_scene", slow)
    session = LectureSession(load_lecture(path), path)
    assert not session.watch.changed(1.0)
    assert session.watch.changed(2.0)


def test_a_reply_is_kept_as_long_as_its_question_counts_pixels_in_the_same_way(tmp_path):
    path = tmp_path / "l.toml"

    def saved(start, title="L"):
        pixel = [2 + start, 6 + start]
        path.write_text(
            f"title = '{title}'\npixels_from = {start}\n[[steps]]\ntitle = 'A'\n"
            "[steps.exercise]\nkind = 'ray'\nquestion = 'Which?'\nsize = [8, 8]\n"
            f"pixel = {pixel}\n"
        )
        return load_lecture(path)

    session = LectureSession(saved(1), path)
    session.answers.texts["origin"] = "(0, 0, 0)"
    session.answers.verdict = said = Judgement("Not yet: pixel (3, 7) is another one.", False)
    session.take(saved(1, "Another title"))
    assert session.answers.verdict is said
    session.take(saved(0))  # the same pixel, called (2, 6)
    assert session.answers.verdict is None
    assert session.answers.texts == {"origin": "(0, 0, 0)"}


def test_in_a_newer_lecture_the_nearest_step_of_that_title_is_shown():
    steps = tuple(SimpleNamespace(title=title) for title in "abaca")
    found = [Lecture.nearest(SimpleNamespace(steps=steps), "a", k) for k in range(-2, 9)]
    assert found == [0, 0, 0, 0, 2, 2, 4, 4, 4, 4, 4]
    # Where there is none, the same number, as far as there are steps.
    found = [Lecture.nearest(SimpleNamespace(steps=steps), "gone", k) for k in range(-2, 9)]
    assert found == [0, 0, 0, 1, 2, 3, 4, 4, 4, 4, 4]
