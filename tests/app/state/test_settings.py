"""The settings file: whatever stands in its place, the window opens."""

import platformdirs
import pytest

from lucida.app.state.settings import settings_file

GOOD = "[AppWindow]\nWindowSize=1280,720\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(platformdirs, "user_config_path", lambda *_, **__: tmp_path / "lucida")
    return tmp_path / "lucida"


def test_the_folder_is_made(folder):
    assert settings_file() == folder / "window.ini"
    assert folder.is_dir()


def test_a_good_file_is_kept(folder):
    folder.mkdir()
    (folder / "window.ini").write_text(GOOD)
    assert settings_file() == folder / "window.ini"
    assert (folder / "window.ini").read_text() == GOOD


@pytest.mark.parametrize(
    "content",
    [
        b"\xff\xfe\x00 nonsense",
        b"",
        GOOD.replace("1280", "0").encode(),
        GOOD.replace("720", "-7").encode(),
        GOOD.replace("1280", "2000000000").encode(),
        GOOD.replace("1280", "abc").encode(),
        GOOD.encode() + b"x" * (1 << 20),
    ],
)
def test_a_broken_file_is_moved_aside(folder, content):
    folder.mkdir()
    (folder / "window.ini").write_bytes(content)
    assert settings_file() == folder / "window.ini"
    assert not (folder / "window.ini").exists()
    assert (folder / "window.broken").read_bytes() == content


def test_a_fresh_start_puts_the_layout_aside(folder):
    folder.mkdir()
    (folder / "window.ini").write_text(GOOD)
    assert settings_file(fresh=True) == folder / "window.ini"
    assert not (folder / "window.ini").exists()
    assert (folder / "window.before").read_text() == GOOD


def test_where_no_file_can_be_there_is_none(folder, monkeypatch):
    folder.write_text("a file in the folder's place")
    assert settings_file() is None
    folder.unlink()
    (folder / "window.ini").mkdir(parents=True)
    assert settings_file() is None

    def no_home(*_, **__):
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.setattr(platformdirs, "user_config_path", no_home)
    assert settings_file() is None
