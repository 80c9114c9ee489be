"""The status line's words, and what gives way in a narrow window."""

from dataclasses import replace

from lucida.app.window.status import (
    Status,
    agreement_text,
    fitting,
    milliseconds,
    ray_text,
    right_texts,
    time_texts,
)
from lucida.renderer.camera.pixels import Indexing

STATUS = Status(0.001, 1, 0.02, (640, 480), 1, "raster and ray: all pixels agree", True)


def test_texts_keep_their_width():
    assert {len(milliseconds(time_s)) for time_s in (0.0, 1e-4, 0.0123, 0.9, 1.5, 99.0)} == {8}
    assert len({len(ray_text(replace(STATUS, factor=factor))) for factor in (0, 1, 4, 8)}) == 1


def test_an_image_that_no_view_has_wanted_has_no_time():
    assert [text.split()[0] for text in time_texts(STATUS)] == ["raster", "ray"]
    assert time_texts(replace(STATUS, raster_s=0.0, ray_s=0.0, factor=0, awaited=False)) == []
    first = time_texts(replace(STATUS, ray_s=0.0, factor=0))  # it is being traced
    assert first[1].split() == ["ray", "...,", "640x480"]


def test_the_right_side_has_pixel_object_and_work():
    assert right_texts(STATUS) == [""]
    pixel = replace(STATUS, pixel=(3, 4), seen="ball, t = 2")
    assert right_texts(pixel)[0] == "ball, t = 2  pixel (4, 5) from 1"
    counted = replace(pixel, indexing=Indexing.ARRAY)
    assert right_texts(counted)[1:] == ["pixel (3, 4) from 0", "pixel (3, 4)", ""]
    assert right_texts(replace(pixel, loading="bunny.obj"))[0] == "loading bunny.obj ..."


def test_an_agreement_that_will_not_come_is_not_awaited():
    unknown = replace(STATUS, agreement="")
    assert agreement_text(STATUS) == STATUS.agreement
    assert agreement_text(unknown) == "raster and ray: ..."
    for status in (STATUS, unknown):  # nobody looks at both
        assert agreement_text(replace(status, awaited=False)) == ""


def test_texts_that_do_not_fit_are_left_out_before_they_overlap():
    lefts, rights = [100.0, 100.0, 100.0], [200.0, 90.0, 0.0]
    assert fitting(lefts, rights, 600) == (0, 0)
    assert fitting(lefts, rights, 500) == (0, 1)
    assert fitting(lefts, rights, 400) == (0, 2)
    assert fitting(lefts, rights, 300) == (1, 2)
    assert fitting(lefts, rights, 10) == (2, 2)
    assert fitting([], rights, 100) == (0, 1)
