"""The doctor: what works, and that nothing it meets takes it down."""

import json
import os
import sys

import pytest

from lucida.renderer.raster.contexts import candidates
from lucida.renderer.raster.packages import remedy
from lucida.renderer.system import doctor


@pytest.fixture
def patient(monkeypatch, tmp_path):
    """Replaces the checks' process by a script."""

    def become(script):
        path = tmp_path / "python"
        path.write_text(f"#!/bin/sh\n{script}\n")
        path.chmod(0o755)
        monkeypatch.setattr(sys, "executable", str(path))

    return become


def test_the_report_names_everything_in_order(monkeypatch):
    monkeypatch.setattr(
        doctor, "check", lambda name, timeout_s: doctor.Check(name, "p", name == "osmesa", "d", "r")
    )
    checks = doctor.report()
    names = [check.name for check in checks]
    assert names == [*candidates(), *(name for name in doctor.PARTS if name in names[2:])]
    assert set(doctor.PARTS) - set(names) <= {"egl", "default", "osmesa"}
    assert all(remedy(name) for name in doctor.PARTS)
    assert doctor.can_draw(checks)
    assert not doctor.can_draw([check for check in checks if check.name != "osmesa"])


def test_a_platform_that_works(gl_backend):
    check = doctor.check(gl_backend)
    assert check.works, check
    assert "OpenGL" in check.detail
    assert check.remedy == ""


def test_the_tracer_and_its_cores():
    check = doctor.check("tracer")
    assert check.works, check
    assert check.detail.startswith("numba ")


def test_a_locale_that_is_missing(monkeypatch, tmp_path):
    monkeypatch.setenv("LOCPATH", str(tmp_path))
    check = doctor.check("formulas")
    assert not check.works
    assert "en_US.UTF-8" in check.detail
    assert check.remedy == remedy("formulas")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="X11")
@pytest.mark.parametrize(
    ("variables", "told"),
    [
        ({}, "DISPLAY is not set"),
        ({"WAYLAND_DISPLAY": "wayland-0"}, "no XWayland"),
        ({"DISPLAY": ":4711"}, ":4711 does not answer"),
    ],
)
def test_a_display_that_is_missing(capsys, monkeypatch, variables, told):
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    doctor.main("display")
    works, detail = json.loads(capsys.readouterr().out)
    assert not works
    assert told in detail or "libX11 is not installed" in detail


@pytest.mark.skipif(os.name != "posix", reason="shell scripts")
@pytest.mark.parametrize(
    ("script", "told"),
    [
        ("kill -SEGV $$", "crashed (signal 11)"),
        ("sleep 30", "no answer within 0.3 s"),
        ("exit 3", "failed"),
        ("echo one >&2; echo no such module >&2; exit 1", "failed no such module"),
        ("echo 'not JSON'", "failed"),
        ("true", "failed"),
        ("""echo 'noise'; printf '%s' '[false, "no\\ndriver"]'""", "no driver"),
    ],
)
def test_a_driver_that_crashes_hangs_or_babbles(patient, script, told):
    patient(f"exec sh -c '{script}'" if script == "sleep 30" else script)
    check = doctor.check("egl", timeout_s=0.3 if script == "sleep 30" else 60)
    assert not check.works
    assert check.detail == told
    assert check.remedy == remedy("egl")


def test_a_python_that_cannot_be_started(monkeypatch):
    monkeypatch.setattr(sys, "executable", os.path.join(os.sep, "no", "python"))
    check = doctor.check("tracer")
    assert not check.works
    assert check.detail


def test_a_program_with_python_inside_is_not_started_again(monkeypatch):
    monkeypatch.setattr(sys, "executable", os.path.join(os.sep, "opt", "some-program"))
    check = doctor.check("tracer")
    assert not check.works
    assert "Python inside" in check.detail
    assert check.remedy


def test_an_answer_is_one_line_whatever_goes_wrong(capsys, monkeypatch):
    def broken():
        raise ValueError

    monkeypatch.setitem(doctor.PARTS, "egl", doctor.Part("draws", broken))
    doctor.main("egl")
    assert capsys.readouterr().out == '[false, "ValueError()"]\n'


def test_a_package_of_an_extra_that_is_missing(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "av", None)
    doctor.main("films")
    works, told = json.loads(capsys.readouterr().out)
    assert not works
    assert "av" in told
    assert "install av distributed" in remedy("films")


def test_files_that_hide_ours(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    assert doctor.check("imports").works
    (tmp_path / "lucida.py").write_text("")
    check = doctor.check("imports")
    assert not check.works
    assert "lucida.py of this folder" in check.detail
    assert check.remedy == remedy("imports")
