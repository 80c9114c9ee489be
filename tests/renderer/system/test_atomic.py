"""Atomic file writes: the old file or the new one, and nothing left behind."""

import os
import time

import pytest

from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError


def write(path, content):
    with atomic_write(path) as file:
        file.write(content)


def names(folder):
    return sorted(entry.name for entry in folder.iterdir())


@pytest.mark.parametrize("name", ["ä" * 127 + "x", "\U0001f4f7" * 63 + ".tx", "x" * 255])
def test_names_as_long_as_names_can_be(tmp_path, name):
    assert len(os.fsencode(name)) == 255
    for content in (b"one", b"two"):
        write(tmp_path / name, content)
        assert names(tmp_path) == [name]
        assert (tmp_path / name).read_bytes() == content


def test_the_mode_is_the_old_file_s_or_the_user_s(tmp_path):
    (tmp_path / "plain").write_bytes(b"")
    write(tmp_path / "new", b"x")
    assert (tmp_path / "new").stat().st_mode == (tmp_path / "plain").stat().st_mode
    (tmp_path / "plain").chmod(0o640)
    write(tmp_path / "plain", b"y")
    assert (tmp_path / "plain").stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("old", [None, b"old"])
@pytest.mark.parametrize("error", [KeyboardInterrupt, OSError(28, "No space left on device")])
@pytest.mark.parametrize("call", ["write", "flush", "fsync", "replace"])
def test_an_exception_at_any_step_leaves_the_folder_as_it_was(
    tmp_path, monkeypatch, call, error, old
):
    def fail(*arguments):
        raise error

    if call in ("fsync", "replace"):
        monkeypatch.setattr(os, call, fail)
    if old is not None:
        (tmp_path / "file").write_bytes(old)
    before = {name: (tmp_path / name).read_bytes() for name in names(tmp_path)}
    expected = KeyboardInterrupt if error is KeyboardInterrupt else LucidaError

    def save():
        with atomic_write(tmp_path / "file") as file:
            file.write(b"new")
            if call == "flush":
                file.flush()
            if call in ("write", "flush"):
                raise error

    with pytest.raises(expected) as told:
        save()
    if expected is LucidaError:
        assert str(told.value).endswith("file: cannot be written: no space left on device")
    assert {name: (tmp_path / name).read_bytes() for name in names(tmp_path)} == before


def test_all_of_the_file_is_synced_before_it_is_renamed(tmp_path, monkeypatch):
    synced = []
    monkeypatch.setattr(os, "fsync", lambda number: synced.append(os.fstat(number).st_size))
    write(tmp_path / "file", b"12345")
    assert synced == [5]


def test_only_what_a_dead_process_left_a_day_ago_is_deleted(tmp_path):
    kept = [".hidden.part", "film.part", ".lucida-notes", "lucida-1.part", ".lucida-new.part"]
    for name in (*kept, ".lucida-old.part", "elsewhere"):
        (tmp_path / name).write_bytes(b"")
        if name != ".lucida-new.part":
            os.utime(tmp_path / name, (0, time.time() - 90_000))
    (tmp_path / ".lucida-link.part").symlink_to("elsewhere")
    (tmp_path / ".lucida-folder.part").mkdir()
    write(tmp_path / "file", b"x")
    assert set(names(tmp_path)) == {
        *kept, "elsewhere", "file", ".lucida-link.part", ".lucida-folder.part"
    }  # fmt: skip
