"""The display transform, and image files read back by other readers."""

import io
import os
import stat
import struct

import numpy as np
import OpenEXR
import pytest
from PIL import Image

from lucida.renderer.camera.camera import Camera
from lucida.renderer.images import (
    ENDINGS,
    encode_srgb,
    from_srgb,
    gray_picture,
    picture,
    to_srgb8,
    write_image,
    write_picture,
)
from lucida.renderer.images.frame import Frame, check_size
from lucida.renderer.images.png import write_png
from lucida.renderer.images.samples import supersampled
from lucida.renderer.system.errors import LucidaError

WIDTH, HEIGHT = 11, 5  # neither even nor square, and no whole number of bytes of bits a row


@pytest.fixture
def frame():
    random = np.random.default_rng(1)
    index = random.integers(-1, 12, (HEIGHT, WIDTH)).astype(np.int32)
    index[0, 0], index[-1, -1] = 3, -1
    hit = index >= 0
    depth = np.where(hit, random.uniform(1, 9, hit.shape), np.inf).astype(np.float32)
    normal = random.normal(size=(HEIGHT, WIDTH, 3))
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    normal = np.where(hit[..., None], normal, 0).astype(np.float32)
    color = random.uniform(0, 1.5, (HEIGHT, WIDTH, 3)).astype(np.float32)
    return Frame((WIDTH, HEIGHT), color, depth, normal, index)


def test_every_byte_survives_there_and_back():
    every = np.arange(256, dtype=np.uint8)
    np.testing.assert_array_equal(to_srgb8(from_srgb(every)), every)


def test_the_curve_is_close_to_exact_arithmetic():
    linear = np.linspace(0, 1, 4097)
    exact = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    np.testing.assert_allclose(encode_srgb(linear), exact, atol=3e-7)


def test_a_stop_of_exposure_doubles_the_light():
    np.testing.assert_array_equal(to_srgb8([0.25], 1.0), to_srgb8([0.5]))
    np.testing.assert_array_equal(to_srgb8([0.5], -2.0), to_srgb8([0.125]))


def test_what_is_not_a_colour_is_black_or_white():
    wild = np.array([np.nan, -1, -np.inf, np.inf, 1e38], np.float32)
    assert to_srgb8(wild, 32).tolist() == [0, 0, 0, 255, 255]


def test_a_ramp_is_encoded_without_a_seam_between_blocks():
    long = np.linspace(0, 1, (1 << 20) + 7, dtype=np.float32)
    result = to_srgb8(long)
    assert result[-1] == 255
    assert (np.diff(result.astype(int)) >= 0).all()


@pytest.mark.parametrize("exposure", [np.nan, np.inf, 33])
def test_an_impossible_exposure_is_told(exposure):
    with pytest.raises(LucidaError, match="exposure"):
        to_srgb8([0.5], exposure)


def test_depth_is_bright_near_and_black_where_nothing_is():
    depth = np.array([[1, 2, 3, np.inf]], np.float32)
    shown = picture(Frame((4, 1), depth=depth), "depth")
    np.testing.assert_array_equal(shown[0, :, 0], [255, 153, 51, 0])
    np.testing.assert_array_equal(shown[..., 0], shown[..., 2])


@pytest.mark.parametrize("value", [2.0, np.inf])
def test_depth_of_one_distance_or_none(value):
    depth = np.full((2, 2), value, np.float32)
    expected = 255 if np.isfinite(value) else 0
    assert (picture(Frame((2, 2), depth=depth), "depth") == expected).all()


def test_normals_are_half_plus_half():
    normal = np.array([[[0, 0, 1], [-1, 0, 0], [0, 0, 0]]], np.float32)
    shown = picture(Frame((3, 1), normal=normal), "normal")
    assert shown.tolist() == [[[128, 128, 255], [0, 128, 128], [0, 0, 0]]]


def test_ids_have_colours_apart_and_light():
    index = np.arange(-1, 9, dtype=np.int32)[None]
    frame = Frame((10, 1), id=index)
    shown = picture(frame, "id")
    assert len(np.unique(shown[0], axis=0)) == 10
    assert not shown[0, 0].any()
    # So that a bitmap of the ids is the mask of what was hit.
    np.testing.assert_array_equal(gray_picture(frame, "id")[0] >= 128, index[0] >= 0)


def test_gray_is_luminance_of_linear_light():
    color = np.array([[[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]], np.float32)
    gray = gray_picture(Frame((4, 1), color=color))
    np.testing.assert_array_equal(gray[0], to_srgb8([0.2126, 0.7152, 0.0722, 1.0]))


def test_a_channel_that_was_not_rendered_is_told(frame):
    with pytest.raises(LucidaError, match="primitive"):
        picture(frame, "primitive")


def test_png_and_ppm_hold_the_picture(tmp_path, frame):
    for channel in ("color", "depth", "normal", "id"):
        for ending in ("png", "ppm"):
            path = tmp_path / f"{channel}.{ending}"
            write_image(path, frame, channel, exposure_ev=0.5)
            with Image.open(path) as image:
                assert image.mode == "RGB"
                np.testing.assert_array_equal(image, picture(frame, channel, 0.5))


def test_pgm_holds_the_gray_and_pbm_cuts_it(tmp_path, frame):
    for channel in ("color", "depth", "normal", "id"):
        write_image(tmp_path / "a.pgm", frame, channel)
        write_image(tmp_path / "a.pbm", frame, channel)
        gray = gray_picture(frame, channel)
        with Image.open(tmp_path / "a.pgm") as image:
            np.testing.assert_array_equal(image, gray)
        with Image.open(tmp_path / "a.pbm") as image:
            np.testing.assert_array_equal(image, gray >= 128)
    edge = np.full((1, 2, 3), [[[127], [128]]], np.uint8)
    write_picture(tmp_path / "edge.pbm", edge)
    with Image.open(tmp_path / "edge.pbm") as image:
        np.testing.assert_array_equal(image, [[False, True]])


def test_npy_keeps_every_bit(tmp_path, frame):
    for channel in ("color", "depth", "normal", "id"):
        write_image(tmp_path / "a.npy", frame, channel)
        array = np.load(tmp_path / "a.npy", allow_pickle=False)
        assert array.dtype == (np.int32 if channel == "id" else np.float32)
        np.testing.assert_array_equal(array, frame.channel(channel))


def test_exr_names_its_channels(tmp_path, frame):
    names = {"color": "RGB", "depth": "Z", "normal": ["N.X", "N.Y", "N.Z"], "id": ["id"]}
    for channel, expected in names.items():
        write_image(tmp_path / "a.exr", frame, channel)
        with OpenEXR.File(str(tmp_path / "a.exr"), separate_channels=True) as file:
            planes = [file.channels()[name].pixels for name in expected]
            assert len(file.channels()) == len(planes)
        if channel == "id":
            assert planes[0].dtype == np.uint32
            planes[0] = planes[0].view(np.int32)
            assert planes[0][-1, -1] == -1
        data = np.stack(planes, axis=-1).reshape(frame.channel(channel).shape)
        np.testing.assert_array_equal(data, frame.channel(channel))


def test_pfm_rows_go_from_the_bottom_up(tmp_path, frame):
    write_image(tmp_path / "a.pfm", frame, "color")
    header = b"PF\n11 5\n-1.0\n"
    content = (tmp_path / "a.pfm").read_bytes()
    assert content.startswith(header)
    assert len(content) == len(header) + 4 * 3 * WIDTH * HEIGHT
    # The first number stored is the red of the bottom row's left pixel.
    assert struct.unpack_from("<f", content, len(header))[0] == frame.color[-1, 0, 0]
    data = np.frombuffer(content[len(header) :], "<f4").reshape(HEIGHT, WIDTH, 3)
    np.testing.assert_array_equal(data[::-1], frame.color)


def test_pfm_of_one_number_a_pixel_reads_in_pillow(tmp_path, frame):
    for channel in ("depth", "id"):
        write_image(tmp_path / "a.pfm", frame, channel)
        with Image.open(tmp_path / "a.pfm") as image:
            np.testing.assert_array_equal(image, frame.channel(channel).astype(np.float32))


def test_pbm_is_bit_exact(tmp_path):
    # Black is 1, the leftmost pixel is the highest bit, a row fills up its last byte.
    color = np.ones((2, 9, 3), np.float32)
    color[0, 0] = color[0, 8] = color[1, 1] = 0
    write_image(tmp_path / "a.pbm", Frame((9, 2), color))
    assert (tmp_path / "a.pbm").read_bytes() == b"P4\n9 2\n" + bytes([0x80, 0x80, 0x40, 0])


def test_an_ending_may_be_in_capitals(tmp_path, frame):
    write_image(tmp_path / "A.PNG", frame)
    with Image.open(tmp_path / "A.PNG") as image:
        assert image.format == "PNG"


def test_a_ready_picture_goes_into_the_8_bit_formats_only(tmp_path, frame):
    shown = picture(frame)
    write_picture(tmp_path / "a.png", shown)
    with Image.open(tmp_path / "a.png") as image:
        np.testing.assert_array_equal(image, shown)
    write_picture(tmp_path / "a.pgm", shown)
    with pytest.raises(LucidaError, match=r"\.npy cannot hold this picture"):
        write_picture(tmp_path / "a.npy", shown)


@pytest.mark.parametrize("name", ["a", "a.gif", "a.png.txt", ".png", ""])
def test_an_unknown_ending_is_refused(tmp_path, frame, name):
    with pytest.raises(LucidaError, match=r"ending.*\.png"):
        write_image(tmp_path / name, frame)


def test_a_missing_folder_is_refused(tmp_path, frame):
    with pytest.raises(LucidaError, match=r"a\.png: folder .* does not exist"):
        write_image(tmp_path / "none" / "a.png", frame)


def test_a_folder_in_the_way(tmp_path, frame):
    (tmp_path / "a.png").mkdir()
    with pytest.raises(LucidaError, match="is a folder"):
        write_image(tmp_path / "a.png", frame)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_what_is_no_ordinary_file_is_never_replaced(tmp_path, frame):
    os.mkfifo(tmp_path / "a.png")
    with pytest.raises(LucidaError, match="not an ordinary file"):
        write_image(tmp_path / "a.png", frame)
    assert stat.S_ISFIFO((tmp_path / "a.png").stat().st_mode)


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_full_disk_keeps_the_old_file(tmp_path, frame, ending):
    resource = pytest.importorskip("resource", reason="file size limits are POSIX's")
    path = tmp_path / f"a{ending}"
    path.write_bytes(b"old")
    big = Frame((400, 300), np.random.default_rng(0).random((300, 400, 3), np.float32))
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, hard))
    try:
        with pytest.raises(LucidaError, match="cannot be written"):
            write_image(path, big)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert path.read_bytes() == b"old"
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_a_link_is_followed(tmp_path, frame):
    (tmp_path / "a.npy").write_bytes(b"old")
    (tmp_path / "link.npy").symlink_to("a.npy")
    write_image(tmp_path / "link.npy", frame)
    assert (tmp_path / "link.npy").is_symlink()
    assert np.load(tmp_path / "a.npy").shape == (HEIGHT, WIDTH, 3)
    (tmp_path / "dangling.npy").symlink_to("none/file")
    with pytest.raises(LucidaError, match="does not exist"):
        write_image(tmp_path / "dangling.npy", frame)


def test_rows_of_an_image_lie_in_it():
    for rows in ((0, 1), (3, 8), (0, 8)):
        assert check_size((4, 8), rows) == (4, 8)
    for rows in ((2, 2), (-1, 2), (7, 9)):
        with pytest.raises(LucidaError, match=r"rows: .* not in 0 to 8"):
            check_size((4, 8), rows)


def test_the_time_of_an_image_is_that_of_all_its_samples():
    times = iter([1.0, 2.0, 4.0, 8.0])

    def draw(camera, size, channels, progress):
        return Frame(size, np.zeros((1, 2, 3), np.float32), time_s=next(times))

    assert supersampled(draw, Camera(), (2, 1), ("color",), 4).time_s == 15.0


@pytest.mark.parametrize("samples", [1, 4, 9])
def test_colour_is_the_mean_of_the_samples_and_the_rest_is_the_centre_s(samples):
    camera, size, told = Camera(viewport=(-1, 2, -3, 4)), (2, 1), []

    def light(seen):
        return np.float32(seen.viewport[0] ** 2 + seen.viewport[2])

    def draw(seen, size, channels, progress):
        progress(1.0)
        shape, value = (size[1], size[0]), light(seen)
        color = np.full((*shape, 3), value, np.float32) if "color" in channels else None
        depth = np.full(shape, value, np.float32) if "depth" in channels else None
        return Frame(size, color, depth=depth)

    side = int(samples**0.5)
    shifts = (np.arange(side) + 0.5) / side - 0.5
    mean = np.mean([light(camera.shifted(a, b, size)) for a in shifts for b in shifts])
    found = supersampled(draw, camera, size, ("color", "depth"), samples, told.append)
    assert found.color == pytest.approx(np.full((1, 2, 3), mean), rel=1e-6)
    assert (found.depth == light(camera)).all()
    assert told == pytest.approx(np.arange(1, len(told) + 1) / len(told))
    depth = supersampled(draw, camera, size, ("depth",), samples, told.append)
    assert depth.color is None and (depth.depth == light(camera)).all()


def test_a_png_file_of_bits_holds_every_one():
    bits = np.random.default_rng(1).random((5, 13)) > 0.5
    file = io.BytesIO()
    write_png(file, bits)
    assert (np.asarray(Image.open(file)) == bits).all()
