"""Pictures on the ground: what is read, what is refused, and where each pixel lies."""

import io
import struct
import zlib

import numpy as np
import pytest
from PIL import Image

from ai4u_edu import AreaDescription, BoxShape, CircleShape
from ai4u_edu.base.errors import ParameterError
from ai4u_edu.world.pictures import (
    MAX_PICTURE_BYTES,
    MAX_PICTURE_CHARS,
    decode_picture,
    picture_data,
)
from ai4u_edu.world.region import Region

RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)


def file_of(image: Image.Image, kind: str = "PNG", **options: object) -> bytes:
    out = io.BytesIO()
    image.save(out, kind, **options)
    return out.getvalue()


def four_colours() -> Image.Image:
    """Return a picture of 2 x 2 pixels: red, green above; blue, white below."""
    return Image.fromarray(np.array([[RED, GREEN], [BLUE, WHITE]], np.uint8))


def large_header(width: int, height: int) -> bytes:
    """Return the beginning of a PNG file that claims to be very large."""
    head = b"IHDR" + struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = (head, b"IDAT")
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(chunk) - 4) + chunk + struct.pack(">I", zlib.crc32(chunk))
        for chunk in chunks
    )


@pytest.mark.parametrize("kind", ["PNG", "JPEG"])
def test_png_and_jpeg_are_read(kind: str) -> None:
    image = Image.new("RGB", (30, 20), RED)
    pixels = decode_picture(picture_data(file_of(image, kind)))
    assert pixels.shape == (20, 30, 4)
    assert np.abs(pixels.astype(int) - (255, 0, 0, 255)).max() <= 2


@pytest.mark.parametrize("mode", ["1", "L", "P", "LA", "RGBA", "I;16"])
def test_every_kind_of_png_is_read(mode: str) -> None:
    white = Image.new("L", (4, 4), 255)
    if mode == "I;16":
        white = Image.fromarray(np.full((4, 4), 65535, np.uint16))
    image = white.convert(mode) if mode != "I;16" else white
    assert decode_picture(picture_data(file_of(image)))[0, 0].tolist() == [255] * 4


def test_a_photo_lies_as_it_was_held() -> None:
    exif = Image.Exif()
    exif[0x0112] = 6  # turned by a quarter
    pixels = decode_picture(picture_data(file_of(Image.new("RGB", (30, 20)), "JPEG", exif=exif)))
    assert pixels.shape[:2] == (30, 20)


@pytest.mark.parametrize(
    ("file", "told"),
    [
        (b"", "expected a PNG or JPEG file"),
        (b"GIF89a", "expected a PNG or JPEG file"),
        (b"\x89PNG\r\n\x1a\nrubbish", "can't be read"),
        (b"\xff\xd8\xffrubbish", "can't be read"),
        (file_of(four_colours())[:-30], "can't be read"),
        (file_of(Image.new("L", (400, 400)), "JPEG")[:700], "can't be read"),
        (large_header(2001, 2000), "at most 4 megapixels, got 2001 x 2000 pixels"),
        (large_header(60_000, 60_000), "at most 4 megapixels"),
        (b"\x89PNG\r\n\x1a\n" + bytes(MAX_PICTURE_BYTES), "at most 1 MB, got 1.0 MB"),
    ],
    ids=range(9),
)
def test_a_bad_file_gets_a_sentence(file: bytes, told: str) -> None:
    with pytest.raises(ValueError, match=told):
        picture_data(file)


def test_a_large_picture_is_refused_before_it_is_decoded() -> None:
    # 100 million pixels in 13 kB; to decode them takes seconds and 400 MB
    with pytest.raises(ValueError, match="megapixels"):
        picture_data(file_of(Image.new("1", (10_000, 10_000))))


@pytest.mark.parametrize(
    "data", ["mat.png", "data:image/gif;base64,AAAA", "data:image/png;base64,%"]
)
def test_text_that_is_no_picture_is_refused(data: str) -> None:
    with pytest.raises(ParameterError, match=r"picture.*(expected data:image/png|no base64)"):
        AreaDescription(name="mat", shape=BoxShape(), picture=data)


def test_the_largest_file_fits_into_the_text() -> None:
    assert len("data:image/jpeg;base64,") + 4 * -(-MAX_PICTURE_BYTES // 3) <= MAX_PICTURE_CHARS


def test_a_picture_lies_on_a_box() -> None:
    data = picture_data(file_of(four_colours()))
    with pytest.raises(ParameterError, match="a picture lies on a box, got a circle"):
        AreaDescription(name="mat", shape=CircleShape(), picture=data)
    assert data not in repr(AreaDescription(name="mat", shape=BoxShape(), picture=data))


@pytest.mark.parametrize(
    ("heading", "right_ahead"), [(0, GREEN), (90, WHITE), (180, BLUE), (-90, RED)]
)
def test_its_top_left_is_left_and_up_until_it_is_turned(
    heading: float, right_ahead: tuple[int, int, int]
) -> None:
    data = picture_data(file_of(four_colours()))
    region = Region(
        AreaDescription(
            name="mat", shape=BoxShape(size=(4, 4)), picture=data, position=(10, 5),
            heading_deg=heading,
        )
    )  # fmt: skip
    seen = region.picture_at(np.array([11.0, 13.0]), np.array([6.0, 5.0]))
    assert seen.tolist() == [[*right_ahead, 255], [0, 0, 0, 0]]
