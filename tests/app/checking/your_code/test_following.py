"""A saved file is noticed while nobody draws; and the place where it is opened to be edited."""

from __future__ import annotations

import threading
from pathlib import Path

from waiting import wait_for

from lucida.app.checking.your_code import following
from lucida.app.checking.your_code.following import FileFollower


def save(file: Path, text: str) -> None:
    """As editors do: no look finds half of it."""
    new = file.with_name("new")
    new.write_text(text)
    new.replace(file)


def test_a_saved_file_is_another_version_and_wakes_the_window(tmp_path: Path):
    file = tmp_path / "rays.py"
    file.write_text("one")
    woken = threading.Event()
    follower = FileFollower(woken.set, lambda: False)
    try:
        assert follower.version == 0
        follower.follow((str(file),))
        first = follower.version
        assert first == 1
        save(file, "two")
        wait_for(lambda: follower.version == first + 1)
        wait_for(woken.is_set)
        file.unlink()
        save(file, "three, back again")
        wait_for(lambda: follower.version == first + 2)
        follower.again()
        assert follower.version == first + 3
        follower.follow((str(tmp_path / "other.py"),))
        assert follower.version == first + 4
        follower.rest()
        follower.follow((str(tmp_path / "other.py"),))
        assert follower.version == first + 4  # it was only out of sight
        follower.forget()
        follower.follow((str(tmp_path / "other.py"),))
        assert follower.version == first + 5
    finally:
        follower.close()


def test_a_module_that_it_needs_is_looked_at_too(tmp_path: Path):
    file, module, later = (tmp_path / name for name in ("rays.py", "vectors.py", "later.py"))
    file.write_text("one")
    module.write_text("one")
    follower = FileFollower(lambda: None, lambda: False)
    try:
        follower.follow((str(file),))
        follower.follow((str(file),), (str(module), str(later)))
        assert follower.version == 1  # it has been run with them
        save(module, "two, saved")
        wait_for(lambda: follower.version == 2)
        save(later, "was looked for in vain")
        wait_for(lambda: follower.version == 3)
        later.unlink()
        save(file, "two, saved")
        wait_for(lambda: follower.version == 4)
    finally:
        follower.close()


def test_each_platform_s_editor_never_what_would_run_it(monkeypatch):
    monkeypatch.setattr(following.shutil, "which", lambda name: f"/usr/bin/{name}")
    for platform, command in (
        ("linux", ["xdg-open", "rays.py"]),
        ("darwin", ["open", "-t", "rays.py"]),
        ("win32", ["notepad.exe", "rays.py"]),
    ):
        monkeypatch.setattr(following.sys, "platform", platform)
        assert following.editor_command("rays.py") == command
