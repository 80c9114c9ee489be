"""The environments of the peers: made once, with whatever can be installed."""

from __future__ import annotations

import subprocess

import pytest

from tests import peer_environment


class TestEnvironment:
    def test_requirements(self):
        text = "# all\nfirst==1.0  # why\n\nsecond==2.0\n"
        assert peer_environment.wanted(text) == ["first==1.0", "second==2.0"]

    @pytest.mark.parametrize(
        ("name", "peers"),
        [
            ("bench", {"mitsuba", "open3d"}),
            ("conformance", {"opencv-python-headless", "pycolmap", "pygltflib"}),
            ("notebooks", {"jupyterlab", "marimo"}),
        ],
    )
    def test_every_peer_is_wanted_in_one_version(self, name, peers):
        text = peer_environment.requirements_of(name).read_text()
        lines = peer_environment.wanted(text)
        assert all("==" in line for line in lines)
        assert {line.partition("==")[0] for line in lines} == peers

    def test_installed_once_failures_named_and_tried_again(self, tmp_path, monkeypatch):
        commands: list[list[str]] = []

        def pip(command, **_):
            commands.append(command)
            failed = command[-1].startswith("bad")
            return subprocess.CompletedProcess(command, failed, "", "hint\nERROR: no such thing\n")

        def create(folder, **_):
            (folder / "own").mkdir(parents=True)

        monkeypatch.setattr(peer_environment.venv, "create", create)
        monkeypatch.setattr(peer_environment, "ask", lambda folder, code: str(folder / "own"))
        monkeypatch.setattr(peer_environment.subprocess, "run", pip)
        requirements = tmp_path / "requirements.txt"
        requirements.write_text("good==1\nbad==1\n")
        folder = tmp_path / "env"
        for _ in range(2):
            assert peer_environment.prepare(folder, requirements) == {"bad==1": "no such thing"}
        assert [command[-1] for command in commands] == ["good==1", "bad==1", "bad==1"]
        assert "numpy==" in (folder / peer_environment.CONSTRAINTS).read_text()
        assert (folder / "own" / "lucida-runtime.pth").exists()
