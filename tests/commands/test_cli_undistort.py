"""`lucida camera FILE --undistort OUT`: cameras and photographs without their lens."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app.cli import main
from renderer.camera_formats import read_cameras
from renderer.camera_formats.given import given

K1 = -0.2
LINES = "1 RADIAL 64 48 60 32 24 -0.2 0.01\n"
IMAGES = "1 1 0 0 0 0 0 0 1 a/one.png\n\n2 1 0 0 0 1 0 0 1 two.png\n\n"
POINTS = "7 0.5 -1 2 10 20 30 0.1\n"


def model(folder: Path) -> Path:
    """Write a model of COLMAP's, with one of its two photographs."""
    (folder / "sparse").mkdir(parents=True)
    for name, text in (("cameras", LINES), ("images", IMAGES), ("points3D", POINTS)):
        (folder / "sparse" / f"{name}.txt").write_text(text)
    (folder / "images/a").mkdir(parents=True)
    ramp = np.broadcast_to(np.arange(64, dtype=np.uint8)[None, :, None] * 4, (48, 64, 3))
    Image.fromarray(np.ascontiguousarray(ramp)).save(folder / "images/a/one.png")
    return folder


def test_a_model_of_colmaps(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source, out = model(tmp_path / "bent"), tmp_path / "flat"
    assert main(["camera", str(source), "--undistort", str(out)]) == 0
    said, complaints = capsys.readouterr()
    assert "colmap, 2 cameras, 1 photograph" in said
    assert complaints.count("\n") == 1 and "two.png" in complaints
    found = read_cameras(given(out))
    assert [posed.name for posed in found.cameras] == ["a/one.png", "two.png"]
    one, two = found.cameras
    assert one.camera.lens is None and two.camera.eye == pytest.approx((-1, 0, 0))
    assert found.points is not None and found.points.tolist() == [[0.5, -1, 2]]
    picture = np.asarray(Image.open(one.image))
    assert one.size == picture.shape[1::-1]
    (fx, _, cx), _, _ = one.camera.intrinsics(one.size, "corner").K.tolist()
    x = (np.arange(one.size[0]) + 0.5 - cx) / fx  # along the middle row
    y = np.zeros_like(x) + (0.5 if one.size[1] % 2 == 0 else 0.0) / fx
    s = x * x + y * y
    wanted = (60 * x * (1 + K1 * s + 0.01 * s * s) + 32 - 0.5) * 4
    assert np.abs(picture[one.size[1] // 2, 1:-1, 0] - wanted[1:-1]).max() <= 1


def test_a_transforms_json_whose_photographs_lie_elsewhere(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    below = tmp_path / "below"
    below.mkdir()
    Image.new("RGBA", (32, 24), (200, 100, 50, 128)).save(tmp_path / "one.png")
    Image.new("RGB", (24, 24)).save(tmp_path / "two.jpg")
    table = {"w": 32, "h": 24, "fl_x": 30, "k1": 0.1}
    pose = np.eye(4).tolist()
    frames = [{"file_path": f"../{name}", "transform_matrix": pose} for name in ("one", "two.jpg")]
    (below / "t.json").write_text(json.dumps(table | {"frames": frames}))
    out = tmp_path / "flat"
    assert main(["camera", str(below / "t.json"), "--undistort", str(out)]) == 0
    assert "two.jpg: is 24x24, its camera's image 32x24" in capsys.readouterr().err
    one = read_cameras(given(out / "t.json")).cameras[0]
    assert one.camera.lens is None and Path(one.image) == out / "one.png"
    assert np.asarray(Image.open(one.image))[5, 5].tolist() == [199, 100, 50, 128]
    assert sorted(path.name for path in out.iterdir()) == ["one.png", "t.json"]


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["--undistort", "full"], "--undistort: 'full' exists"),
        (["--undistort", "no/where"], "--undistort: 'no/where' cannot be made"),
        (["--undistort", "out", "--to", "view"], "--to: is given beside --undistort"),
        (["--undistort", "out", "--frame", "9"], "holds no camera 9"),
    ],
)
def test_a_mistake_is_one_line(
    words: list[str],
    complaint: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    model(tmp_path)
    (tmp_path / "full").mkdir()
    (tmp_path / "full/kept").touch()
    assert main(["camera", ".", *words]) == 2
    error = capsys.readouterr().err
    assert complaint in error and error.count("\n") == 1
    assert not (tmp_path / "out").exists()
