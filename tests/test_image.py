"""Pictures as bytes, read back by other programs and by ourselves."""

import io
import struct
import zlib

import numpy as np
import pytest
from PIL import Image

from lumiar import image
from lumiar.errors import Mistake

RNG = np.random.default_rng(3)


@pytest.mark.parametrize("size", [(1, 1), (7, 5), (640, 3), (33, 200)])
@pytest.mark.parametrize("rows", [1, 2, 1000])
def test_a_png_says_what_was_drawn(size, rows):
    width, height = size
    pixels = RNG.integers(0, 256, (height, width, 3), np.uint8)
    strips = [pixels[i : i + rows].tobytes() for i in range(0, height, rows)]
    data = b"".join(image.png(size, strips))
    picture = Image.open(io.BytesIO(data))
    picture.verify()
    assert (np.asarray(Image.open(io.BytesIO(data))) == pixels).all()


def test_the_chunks_of_a_png_are_whole():
    data = b"".join(image.png((4, 4), [bytes(48)], [(b"iTXt", b"k\0\0\0\0\0text")]))
    kinds, at = [], 8
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        body = data[at + 4 : at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length : at + 12 + length])[0] == zlib.crc32(body)
        kinds.append(body[:4])
        at += 12 + length
    assert kinds[:3] == [b"IHDR", b"sRGB", b"iTXt"] and kinds[-1] == b"IEND"


def test_npy_is_numpys(tmp_path):
    pixels = RNG.normal(size=(5, 9, 3)).astype("<f4")
    data = b"".join(image.npy((9, 5), [pixels[:2].tobytes(), pixels[2:].tobytes()]))
    (tmp_path / "x.npy").write_bytes(data)
    assert (np.load(tmp_path / "x.npy") == pixels).all()
    found, linear = image.read(tmp_path / "x.npy")
    assert linear and (found == pixels).all()


@pytest.mark.parametrize("width", [1, 7, 8, 130, 300, 40000])
def test_hdr_comes_back_within_its_precision(tmp_path, width):
    values = 10.0 ** RNG.uniform(-6, 6, (2, width, 3))
    values[0, 0] = 0.0
    data = b"".join(image.hdr((width, 2), [values.astype("<f4").tobytes()]))
    (tmp_path / "x.hdr").write_bytes(data)
    found, linear = image.read(tmp_path / "x.hdr")
    assert linear and found.shape == (2, width, 3)
    # one exponent for three channels, 8 bits each, rounded down (G. Ward, 1991)
    assert (np.abs(found - values) <= values.max(2, keepdims=True) / 128.0 + 1e-30).all()
    assert (found[0, 0] == 0.0).all()


def test_hdr_is_the_published_encoding(tmp_path):
    """1.0 is 128, 128, 128, 129; 0.5, 0.25, 1.0 is 64, 32, 128, 129 (Ward's own example form)."""
    for rgb, expected in (((1, 1, 1), (128, 128, 128, 129)), ((0.5, 0.25, 1), (64, 32, 128, 129))):
        data = b"".join(image.hdr((1, 1), [np.array(rgb, "<f4").tobytes()]))
        assert data.startswith(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n")
        assert tuple(data[-4:]) == expected


def test_hdr_with_runs_is_read(tmp_path):
    runs = (
        b"\x02\x02\x00\x0a" + b"\x8a\x80" + b"\x8a\x40" + b"\x03\x01\x02\x03\x87\x09" + b"\x8a\x81"
    )
    (tmp_path / "r.hdr").write_bytes(b"#?RGBE\nGAMMA=1\n\n-Y 1 +X 10\n" + runs)
    found, _ = image.read(tmp_path / "r.hdr")
    assert np.allclose(found[0, :, 0], 1.0) and np.allclose(found[0, :, 1], 0.5)
    assert np.allclose(found[0, :4, 2] * 128, [1, 2, 3, 9])


def test_hdr_clips_what_it_cannot_hold():
    values = np.array([[1e38, 3e38, 0], [np.inf, 0, 0], [np.nan, 1, 1], [-5, 1, 1]], "<f4")
    data = b"".join(image.hdr((1, 4), [values.tobytes()]))
    pixels = np.frombuffer(data[-16:], np.uint8).reshape(4, 4)
    assert pixels[0, 3] == 255
    assert (pixels[1] == pixels[2]).all() and pixels[1, 1] == 0 and pixels[1, 0] > 0  # magenta
    assert pixels[3, 0] == 0


def test_reading_what_others_wrote(tmp_path):
    pixels = RNG.integers(0, 256, (6, 8, 3), np.uint8)
    Image.fromarray(pixels).save(tmp_path / "a.png")
    Image.fromarray(pixels).convert("L").save(tmp_path / "grey.png")
    Image.fromarray(pixels).save(tmp_path / "a.jpg")
    found, linear = image.read(tmp_path / "a.png")
    assert not linear and np.allclose(found * 255, pixels, atol=1e-4)
    assert image.read(tmp_path / "grey.png")[0].shape == (6, 8, 3)
    assert image.read(tmp_path / "a.jpg")[0].shape == (6, 8, 3)


def test_sixteen_bits_of_grey_are_their_eight_bit_twin(tmp_path):
    """65535 / 255 = 257."""
    grey = RNG.integers(0, 256, (6, 8), np.uint8)
    Image.fromarray(grey).save(tmp_path / "8.png")
    Image.fromarray(grey.astype(np.uint16) * 257).save(tmp_path / "16.png")
    a, b = (image.read(tmp_path / f"{bits}.png") for bits in (8, 16))
    assert a[1] == b[1] and np.abs(a[0] - b[0]).max() < 1e-7


def bomb(width, height):
    """Return a small PNG that claims to be large."""
    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    body = zlib.compress(bytes(1000))
    chunks = ((b"IHDR", head), (b"IDAT", body), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(c)) + k + c + struct.pack(">I", zlib.crc32(k + c)) for k, c in chunks
    )


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("a.png", b""),
        ("a.png", b"\x89PNG\r\n\x1a\n"),
        ("a.png", b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n"),
        ("a.png", bomb(30000, 30000)),
        ("a.png", bomb(12000, 12000)),
        ("a.npy", b"\x93NUMPY\x01\x00"),
        ("a.npy", b"nothing"),
        ("a.hdr", b"#?RADIANCE\n\n-Y 99999999 +X 99999999\n"),
        ("a.hdr", b"#?RADIANCE\n\n-Y 2 +X 9\n\x02\x02\x00\x09\x89"),
        ("a.hdr", b"#?RADIANCE\n\n-Y 2 +X 9\n\x02\x02\x00\x09\xff\x00"),
        ("a.hdr", b"#?RADIANCE\n\n+Y 2 +X 9\n"),
        ("a.hdr", b"P6"),
        ("a.txt", b"text"),
    ],
)
def test_a_broken_picture_is_one_line(tmp_path, name, data):
    (tmp_path / name).write_bytes(data)
    with pytest.raises(Mistake, match=name):
        image.read(tmp_path / name)


def npy(header):
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header


@pytest.mark.parametrize(
    "data",
    [
        b"",
        npy(b"{'descr': '<f4', 'fortran_order': False, 'shape': (99999999, 99999999, 3), }\n"),
        npy(
            b"{'descr': '<f4', 'fortran_order': False, 'shape': (900000, 900000, 3), }\n" + bytes(9)
        ),
        npy(b"{'descr': '<f4', 'fortran_order': False, 'shape': (2, -2, 3), }\n" + bytes(48)),
        npy(b"{'descr': 'f4,f4', 'fortran_order': False, 'shape': (2, 2, 3), }\n" + bytes(96)),
        npy(b"{'descr': '<f4', 'shape': (2, 2, 3), }\n" + bytes(48)),
        npy(b"{" * 3000),
        npy(b"\xff\n"),
    ],
    ids=range(8),
)
def test_an_npy_that_is_none_is_one_line(tmp_path, data):
    (tmp_path / "a.npy").write_bytes(data)
    with pytest.raises(Mistake, match=r"a\.npy: not a picture that can be read"):
        image.read(tmp_path / "a.npy")


def test_an_npz_under_the_name_of_an_npy_is_one_line(tmp_path):
    np.savez(tmp_path / "a.npz", a=np.zeros((2, 2, 3), np.float32))
    (tmp_path / "a.npz").rename(tmp_path / "a.npy")
    with pytest.raises(Mistake, match=r"a\.npy: not a picture that can be read"):
        image.read(tmp_path / "a.npy")


def test_what_is_beyond_float32_is_infinite(tmp_path):
    """pytest makes any warning an error."""
    np.save(tmp_path / "a.npy", np.full((2, 2, 3), 1e300))
    assert np.isinf(image.read(tmp_path / "a.npy")[0]).all()


@pytest.mark.parametrize(
    "array", [np.zeros((4, 4)), np.zeros((4, 4, 4)), np.array(["x"]), np.zeros((2, 2, 3), complex)]
)
def test_an_array_that_is_no_picture_is_refused(tmp_path, array):
    np.save(tmp_path / "a.npy", array)
    with pytest.raises(Mistake):
        image.read(tmp_path / "a.npy")


def test_a_pickle_is_never_loaded(tmp_path):
    np.save(tmp_path / "a.npy", np.array([print], object), allow_pickle=True)
    with pytest.raises(Mistake, match="not a picture"):
        image.read(tmp_path / "a.npy")


def test_only_endings_we_write_are_taken():
    assert image.ending("a/b.PNG") == ".png"
    with pytest.raises(Mistake, match=r"ends in \.png, \.hdr, \.npy"):
        image.ending("a.jpg")
