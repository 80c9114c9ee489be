"""The compare view's marks on pixels, enlarged to be visible."""

import numpy as np

from lucida.app.images.compare.pictures import RIM, enlarged, marked_picture
from lucida.renderer.compare.raster_and_ray import AGREE, LABEL_COLORS, SHADING, UNEXPLAINED


def test_marked_pixels_have_their_causes_colours():
    labels = np.zeros((70, 130), np.uint8)
    labels[2, 3], labels[4, 5], labels[6, 12] = 1, SHADING, UNEXPLAINED
    picture = marked_picture(labels, is_large=True)
    assert (picture[..., :3][labels != AGREE] == LABEL_COLORS[labels[labels != AGREE]]).all()
    assert (picture[..., 3] == np.where(labels == AGREE, 0, 255)).all()


def test_single_pixels_are_enlarged():
    labels = np.zeros((40, 50), np.uint8)
    labels[0, 0], labels[20, 20], labels[20, 22] = 1, 2, UNEXPLAINED
    large = enlarged(labels)
    assert (large[:2, :2] == 1).all()
    assert large[2, 2] == RIM
    assert (large[19:22, 19:21] == 2).all()
    assert (large[19:22, 21:24] == UNEXPLAINED).all()  # over the known cause
    assert large[20, 18] == large[18, 20] == large[22, 24] == RIM
    assert large[39, 49] == AGREE
    assert (LABEL_COLORS[RIM] == 0).all()
    labels = np.zeros((900, 1000), np.uint8)
    labels[500, 500] = 3
    assert (enlarged(labels) == 3).sum() == 7 * 7
    assert (enlarged(labels) == RIM).sum() == 9 * 9 - 7 * 7
    labels[500, 501] = UNEXPLAINED
    assert enlarged(labels)[500, 500] == 3  # a pixel's own label stays


def test_many_marks_are_not_enlarged():
    labels = np.zeros((40, 50), np.uint8)
    labels[10:20] = SHADING
    assert (enlarged(labels) == labels).all()
    labels[30, 30] = 1
    large = enlarged(labels)
    assert (large[10:20] == SHADING).all()
    assert (large[29:32, 29:32] == 1).all()
