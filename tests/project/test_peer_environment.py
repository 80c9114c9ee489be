"""The environments of the peers: made once, with whatever can be installed."""

from __future__ import annotations

import json
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
            ("conformance", {"bpy", "mitsuba", "opencv-python-headless", "pycolmap", "pygltflib"}),
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

    def test_one_that_wants_another_numpy_lies_apart(self, tmp_path, monkeypatch):
        commands: list[list[str]] = []
        (tmp_path / "env").mkdir()
        monkeypatch.setattr(peer_environment, "made", lambda folder: None)
        monkeypatch.setattr(peer_environment.subprocess, "run", _noting(commands))
        requirements = tmp_path / "requirements.txt"
        requirements.write_text("bpy==1\nother==1\n")
        assert peer_environment.prepare(tmp_path / "env", requirements) == {}
        apart, other = commands
        assert apart[-3:] == ["--target", str(tmp_path / "env" / "apart" / "bpy"), "bpy==1"]
        assert "--constraint" not in apart and "--constraint" in other

    @pytest.mark.parametrize("there", [True, False])
    def test_packages_of_node(self, there, tmp_path, monkeypatch):
        """Installed once, in the version that is wanted; left out where there is no node."""
        commands: list[list[str]] = []
        folder = tmp_path / "env"
        folder.mkdir()
        monkeypatch.setattr(peer_environment, "made", lambda folder: None)
        monkeypatch.setattr(peer_environment.subprocess, "run", _noting(commands))
        found = "/somewhere/npm" if there else None
        monkeypatch.setattr(peer_environment.shutil, "which", lambda name: found)
        (tmp_path / "requirements.txt").write_text("")
        packages = tmp_path / "package.json"
        packages.write_text('{"dependencies": {"three": "1.2.3"}}')
        parts = folder, tmp_path / "requirements.txt", packages
        failed = peer_environment.prepare(*parts)
        if not there:
            assert failed == {"three@1.2.3": "node and npm are not there"} and not commands
            return
        assert failed == {} and commands[0][:2] == [found, "install"]
        assert commands[0][-1] == "three@1.2.3"
        stamp = folder / "node_modules" / "three" / "package.json"
        stamp.parent.mkdir(parents=True)
        stamp.write_text('{"version": "1.2.3"}')
        assert peer_environment.prepare(*parts) == {} and len(commands) == 1

    def test_node_s_packages_are_pinned(self):
        packages = json.loads(peer_environment.packages_of("conformance").read_text())
        assert set(packages["dependencies"]) == {"three"}
        assert all(version[0].isdigit() for version in packages["dependencies"].values())


def _noting(commands: list[list[str]]):
    def run(command, **_):
        commands.append(command)
        return subprocess.CompletedProcess(command, 0, "", "")

    return run
