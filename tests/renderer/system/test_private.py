"""Folders that only this user can write into; and that compiled kernels are kept in no others."""

import logging
import os
import stat
from pathlib import Path

import pytest
from numba.core import config

from lucida.renderer.system.errors import LucidaError
from lucida.renderer.system.private_folder import private_folder
from lucida.renderer.trace.compile import cache_folder, compiled

ROOT = Path(__file__).parents[3]
pytestmark = pytest.mark.skipif(not hasattr(os, "geteuid"), reason="POSIX's owners and rights")


@pytest.fixture
def mine(tmp_path):
    """A folder as a user has it."""
    folder = tmp_path / "mine"
    folder.mkdir()
    folder.chmod(0o755)
    return folder


def rights(folder):
    return stat.S_IMODE(folder.stat().st_mode)


def test_new_folders_are_the_users_alone_whatever_the_umask(mine):
    before = os.umask(0)
    try:
        folder = private_folder(mine / "a" / "b")
    finally:
        os.umask(before)
    assert folder == (mine / "a" / "b").resolve()
    assert rights(mine / "a") == rights(mine / "a" / "b") == 0o700
    assert private_folder(mine / "a" / "b") == folder
    assert rights(mine) == 0o755


@pytest.mark.parametrize("mode", [0o777, 0o775, 0o770, 0o757, 0o702])
def test_what_others_can_write_into_is_refused(mine, mode):
    (mine / "a").mkdir()
    (mine / "a").chmod(mode)
    for folder in (mine / "a", mine / "a" / "new" / "below"):
        with pytest.raises(LucidaError, match=r"others can write into .*/a; chmod go-w") as caught:
            private_folder(folder)
        assert str(mine / "a") in caught.value.problem
    assert list((mine / "a").iterdir()) == []  # nothing was left there


def test_a_sticky_folder_is_no_danger_above_but_not_good_enough_itself(mine):
    (mine / "tmp").mkdir()
    (mine / "tmp").chmod(0o1777)
    assert rights(private_folder(mine / "tmp" / "a")) == 0o700
    with pytest.raises(LucidaError, match="others can write"):
        private_folder(mine / "tmp")
    (mine / "tmp" / "a").chmod(0o777)  # as if somebody had made it first
    with pytest.raises(LucidaError, match="others can write"):
        private_folder(mine / "tmp" / "a" / "b")


def test_somebody_elses_folder_is_refused(mine, monkeypatch):
    (mine / "a").mkdir()
    owner = os.stat(mine).st_uid
    monkeypatch.setattr(os, "geteuid", lambda: owner + 1)
    with pytest.raises(LucidaError, match="belongs to somebody else"):
        private_folder(mine / "a")


def test_where_users_have_no_numbers_it_is_only_made(mine, monkeypatch):
    mine.chmod(0o777)
    monkeypatch.delattr(os, "geteuid")  # Windows
    assert private_folder(mine / "a").is_dir()


# The cache of compiled kernels.


@pytest.fixture
def fresh():
    """The place of the cache is looked for again."""
    cache_folder.find_cache_folder.cache_clear()
    yield
    cache_folder.find_cache_folder.cache_clear()


def test_a_cache_that_others_can_write_into_is_passed_over_and_told_once(
    mine, fresh, monkeypatch, caplog
):
    (mine / "shared").mkdir()
    (mine / "shared").chmod(0o777)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(mine / "shared"))
    monkeypatch.setattr(
        cache_folder.platformdirs, "user_cache_dir", lambda *_, **__: str(mine / "own")
    )
    for _ in range(2):
        folder = cache_folder.cache_folder()
        assert folder is not None
        assert folder.is_relative_to(mine / "own")
        assert rights(folder) == 0o700
    assert [record.levelno for record in caplog.records] == [logging.WARNING]
    told = caplog.records[0].getMessage()
    assert "\n" not in told
    assert told.startswith(f"lucida: compiled kernels are not kept in {mine / 'shared'}")
    assert f"chmod go-w '{mine / 'shared'}'" in told
    assert cache_folder.cache_problem() in told
    assert list((mine / "shared").iterdir()) == []


def test_a_good_cache_is_used_and_nothing_is_said(mine, fresh, monkeypatch, caplog):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(mine / "new"))
    folder = cache_folder.cache_folder()
    assert folder is not None
    assert folder.is_relative_to(mine / "new")
    assert rights(mine / "new") == rights(folder) == 0o700
    assert cache_folder.cache_problem() == ""
    assert not caplog.records


def test_a_relative_folder_which_may_have_come_with_the_users_files_is_passed_over(
    mine, fresh, monkeypatch
):
    monkeypatch.chdir(mine)
    monkeypatch.setenv("NUMBA_CACHE_DIR", "theirs")
    monkeypatch.setattr(cache_folder.platformdirs, "user_cache_dir", lambda *_, **__: "also-theirs")
    folder = cache_folder.cache_folder()
    assert folder is None or not folder.is_relative_to(mine)
    assert list(mine.iterdir()) == []


def test_the_folder_beside_the_package_is_judged_too(mine, fresh, monkeypatch):
    (mine / "trace").mkdir()
    (mine / "trace").chmod(0o777)
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.setattr(cache_folder, "TRACE_FOLDER", mine / "trace")
    (mine / "file").write_text("")
    monkeypatch.setattr(
        cache_folder.platformdirs, "user_cache_dir", lambda *_, **__: str(mine / "file" / "below")
    )
    assert cache_folder.cache_folder() is None
    assert "trace" in cache_folder.cache_problem()


def test_a_setting_of_numba_does_not_choose_the_cache(mine, fresh, monkeypatch):
    """numba also reads settings from the current folder; the user's environment decides."""
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.setattr(config, "CACHE_DIR", str(mine / "theirs"))
    monkeypatch.setattr(
        cache_folder.platformdirs, "user_cache_dir", lambda *_, **__: str(mine / "own")
    )
    assert compiled.kernel(tripled)(4) == 12
    assert list((mine / "own").rglob("*tripled*.nbc"))
    assert str(mine / "theirs") == config.CACHE_DIR
    assert not (mine / "theirs").exists()


def tripled(x):
    return 3 * x
