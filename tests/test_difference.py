"""How two pictures differ: closed forms, and FLIP as its authors' program measures it."""

import numpy as np
import pytest

from lumiar import difference
from lumiar.errors import Mistake


def grey(value, shape=(8, 10)):
    return np.full((*shape, 3), value, np.float32)


def test_a_constant_offset():
    found = difference.measure(grey(0.25), grey(0.5))
    assert found == {"rmse": 0.25, "max": 0.25, "share": 1.0, "not_finite": 0}


def test_one_pixel_of_eighty():
    other = grey(0.5)
    other[3, 4, 1] = 1.0
    found = difference.measure(grey(0.5), other)
    assert found["rmse"] == pytest.approx(np.sqrt(0.25 / 240))
    assert (found["max"], found["share"]) == (0.5, 1 / 80)
    assert difference.measure(grey(0.5), other, threshold=0.5)["share"] == 0.0


def test_what_is_not_finite_never_passes_for_equal():
    other = grey(0.5)
    other[0, 0], other[1, 1] = np.nan, np.inf
    for a, b in ((grey(0.5), other), (other, other)):
        found = difference.measure(a, b, threshold=9.0)
        assert (found["rmse"], found["max"]) == (0.0, 0.0)
        assert (found["not_finite"], found["share"]) == (2, 2 / 80)


def test_flip_of_black_and_white_and_of_equals():
    pytest.importorskip("flip_evaluator")
    assert difference.flip(grey(0.3), grey(0.3), linear=False) == 0.0
    assert difference.flip(grey(0.0), grey(1.0), linear=False) > 0.9
    assert 0.0 < difference.flip(grey(0.3), grey(0.35), linear=False) < 0.3
    assert difference.flip(grey(2.0), grey(2.0), linear=True) == 0.0
    assert difference.flip(grey(1.0), grey(4.0), linear=True) > 0.05


@pytest.mark.parametrize("dark", [0.0, 1e-45, 1e-38, 1e-9, -1.0, np.nan, np.inf])
def test_flip_of_a_reference_without_light_is_told_not_died_of(dark):
    """HDR-FLIP takes its exposures from the reference; of one that is black there are none."""
    pytest.importorskip("flip_evaluator")
    assert difference.flip(grey(dark), grey(dark), linear=True) == 0.0
    assert difference.flip(grey(dark), grey(1.0), linear=True) is None
    assert difference.flip(grey(1.0), grey(0.0), linear=True) > 0.5


def test_the_picture_of_a_difference():
    other = grey(0.5)
    other[0, 0], other[0, 1], other[0, 2] = 0.9, 0.6, np.nan
    pixels, white = difference.picture(grey(0.5), other)
    pixels = np.frombuffer(pixels, np.uint8).reshape(8, 10, 3)
    assert white == pytest.approx(0.4)
    assert (pixels[0, 0] == 255).all() and (pixels[1] == 0).all()
    assert np.abs(pixels[0, 1].astype(int) - 127.5).max() <= 1  # the root of a quarter
    assert tuple(pixels[0, 2]) == (255, 0, 255)


def test_only_like_is_compared_with_like():
    names = ("a.png", "b.png")
    difference.check_alike((grey(0), False), (grey(1), False), names)
    with pytest.raises(Mistake, match=r"a\.png and b\.png differ in size: 10x8 and 4x4"):
        difference.check_alike((grey(0), False), (grey(1, (4, 4)), False), names)
    with pytest.raises(Mistake, match="8-bit sRGB, the other linear"):
        difference.check_alike((grey(0), False), (grey(1), True), names)
