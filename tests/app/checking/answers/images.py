"""Answers to to-gray, to-bitmap and memory-offset, the task's name after right_, wrong_, ..."""

import numpy as np

WEIGHTS = 0.2126, 0.7152, 0.0722


def right_gray_dot(rgb):
    return rgb @ np.array(WEIGHTS)


def right_gray_channels(rgb):
    return 0.2126 * rgb[:, :, 0] + 0.7152 * rgb[:, :, 1] + 0.0722 * rgb[:, :, 2]


def right_gray_float32(rgb):
    return rgb.astype(np.float32).dot(np.float32(WEIGHTS))


def wrong_gray_mean(rgb):
    return rgb.mean(axis=2)


def wrong_gray_bytes(rgb):
    return np.round(rgb @ np.array(WEIGHTS) * 255)


def unusable_gray_three(rgb):
    return np.repeat((rgb @ np.array(WEIGHTS))[..., None], 3, axis=2)


def right_bitmap_array(gray, threshold):
    return gray >= threshold


def right_bitmap_where(gray, threshold):
    return np.where(gray < threshold, 0, 1)


def right_bitmap_white(gray, threshold):
    return ((gray >= threshold) * 255).astype(np.uint8)


def wrong_bitmap_above(gray, threshold):
    return gray > threshold


def wrong_bitmap_gray(gray, threshold):
    return np.where(gray >= threshold, gray, 0)


def unusable_bitmap_flat(gray, threshold):
    return (gray >= threshold).ravel()


def right_offset_rows(i, j, width):
    return i * width + j


def right_offset_numpy(i, j, width):
    return np.ravel_multi_index((i, j), (i + 1, width))


def right_offset_strides(i, j, width):
    strides = np.empty((1, width), np.int8).strides
    return [int(np.dot((i, j), strides))]


def wrong_offset_bytes(i, j, width):
    return 12 * (i * width + j)


def wrong_offset_nan(i, j, width):
    return float("nan")


def unusable_offset_none(i, j, width):
    return None
