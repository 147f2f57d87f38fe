"""Pictures that lie on the ground, such as a printed mat: checked and decoded."""

import base64
import binascii
import io
import math
import re
import struct
import zlib
from collections.abc import Sequence
from functools import lru_cache
from typing import Annotated

import numpy as np
import numpy.typing as npt
from pydantic import AfterValidator, Field

from ai4u_edu.base.errors import shorten
from ai4u_edu.locale import gettext as _

MAX_PICTURE_BYTES = 2**20
"""Size of a picture's file, and of all those of a scene together."""
MAX_PICTURE_PIXELS = 4_000_000
"""Pixels of a picture, and of all those of a scene together; they take 16 MB in memory."""
MAX_PICTURE_CHARS = 4 * MAX_PICTURE_BYTES // 3 + 64
"""Length of a picture as text."""
_DATA = re.compile(r"data:image/(png|jpeg);base64,")
_SIGNATURES = {b"\x89PNG\r\n\x1a\n": "png", b"\xff\xd8\xff": "jpeg"}
OPAQUE = 128
"""Opacity, of 255, from which on sensors see a pixel, and not what is under it."""
_DARK = 128
"""Brightness, of 255, from which on a pixel counts as light."""
_LUMA = np.array([299, 587, 114])
"""Thousandths of red, green and blue in brightness, as in television (ITU-R BT.601)."""

Pixels = npt.NDArray[np.uint8]


def picture_data(file: bytes) -> str:
    """Return the file of a picture as text, as a scene has it.

    Args:
        file: PNG or JPEG.

    Raises:
        ValueError: it is no such file, it is damaged, or it is too large; says how to mend it.

    >>> picture_data(b"GIF89a")
    Traceback (most recent call last):
    ...
    ValueError: expected a PNG or JPEG file, got another kind of file; save the picture as PNG
    """
    kind = next((kind for start, kind in _SIGNATURES.items() if file.startswith(start)), None)
    if kind is None:
        raise ValueError(
            _("expected a PNG or JPEG file, got another kind of file; save the picture as PNG")
        )
    if len(file) > MAX_PICTURE_BYTES:
        raise _too_large(len(file))
    data = f"data:image/{kind};base64,{base64.b64encode(file).decode()}"
    picture_size(data)
    return data


@lru_cache(maxsize=4)  # each may take 16 MB
def decode_picture(data: str) -> Pixels:
    """Return a picture's pixels: (rows, columns, 4), red, green, blue and opacity, the top first.

    Args:
        data: ``data:image/png;base64,...`` or ``data:image/jpeg;base64,...``.

    Raises:
        ValueError: it is no picture, it is damaged, or it is too large; says how to mend it.
    """
    start = _DATA.match(data)
    if start is None:
        raise ValueError(
            _(
                "expected data:image/png;base64,... or the name of a PNG or JPEG file beside the "
                "scene's file, got {data}; lay the picture in the tab World, or put its file there",
                data=repr(data[:40]),
            )
        )
    try:
        file = base64.b64decode(data[start.end() :], validate=True)
    except (binascii.Error, ValueError):
        raise _damaged(_("its text is no base64")) from None
    if len(file) > MAX_PICTURE_BYTES:
        raise _too_large(len(file))
    return _decode(file, start[1])


def _decode(file: bytes, kind: str) -> Pixels:
    # only scenes with a picture wait for this import
    from PIL import Image, ImageOps, UnidentifiedImageError

    try:
        with Image.open(io.BytesIO(file), formats=[kind.upper()]) as image:
            columns, rows = image.size
            if columns * rows > MAX_PICTURE_PIXELS:  # before anything is decoded
                raise _too_many(columns, rows)
            image.load()
            upright = ImageOps.exif_transpose(image)  # photos of phones say how they were held
            if upright.mode.startswith("I"):  # 16 bits, of which Pillow would cut the upper ones
                grey = (np.asarray(upright, np.int64) >> 8).clip(0, 255).astype(np.uint8)
                upright = Image.fromarray(grey)
            pixels = np.array(upright.convert("RGBA"), np.uint8)
    except _PictureSizeError:
        raise
    except (Image.DecompressionBombError, Image.DecompressionBombWarning):
        raise ValueError(
            _(
                "expected a picture of at most {megapixels:g} megapixels, got a far "
                "larger one; make it smaller with a program for pictures",
                megapixels=MAX_PICTURE_PIXELS / 1e6,
            )
        ) from None
    except UnidentifiedImageError:
        raise _damaged(_("its beginning is wrong")) from None
    except (OSError, SyntaxError, ValueError, EOFError, struct.error, zlib.error) as error:
        raise _damaged(str(error)) from None
    pixels.setflags(write=False)  # everybody shares them
    return pixels


class _PictureSizeError(ValueError):
    """A picture with too many pixels."""


def are_dark(pixels: Pixels) -> npt.NDArray[np.bool_]:
    """Return for each pixel, (n, 4), True if it is darker than half way to white."""
    dark: npt.NDArray[np.bool_] = pixels[:, :3] @ _LUMA < 1000 * _DARK
    return dark


@lru_cache(maxsize=16)
def picture_size(data: str) -> tuple[int, int]:
    """Return rows and columns of a picture; errors as :func:`decode_picture`."""
    rows, columns, _ = decode_picture(data).shape
    return rows, columns


def check_pictures(pictures: Sequence[str]) -> None:
    """Check the pictures of a scene together.

    Args:
        pictures: each was checked by itself.

    Raises:
        ValueError: they are too large together.
    """
    if len(pictures) < 2:
        return
    chars = sum(map(len, pictures))
    pixels = sum(math.prod(picture_size(data)) for data in pictures)
    if chars > MAX_PICTURE_CHARS or pixels > MAX_PICTURE_PIXELS:
        raise ValueError(
            _(
                "expected pictures of together at most {mb} MB and "
                "{megapixels:g} megapixels, got {got_mb:.1f} MB and {got:.1f} "
                "megapixels; take one out, or make them smaller",
                mb=MAX_PICTURE_BYTES // 2**20,
                megapixels=MAX_PICTURE_PIXELS / 1e6,
                got_mb=0.75 * chars / 2**20,
                got=pixels / 1e6,
            )
        )


@lru_cache(maxsize=16)
def mean_colour(data: str) -> tuple[int, int, int]:
    """Return the mean red, green and blue of a picture, for drawings of a few pixels."""
    red, green, blue = decode_picture(data)[::8, ::8, :3].reshape(-1, 3).mean(axis=0)
    return round(float(red)), round(float(green)), round(float(blue))


def _checked(data: str) -> str:
    picture_size(data)
    return data


PictureData = Annotated[
    str,
    Field(max_length=MAX_PICTURE_CHARS),
    AfterValidator(_checked),
]
"""A PNG or JPEG picture as text."""


def _too_large(size: int) -> ValueError:
    return ValueError(
        _(
            "expected a picture of at most {mb} MB, got {size:.1f} MB; save it "
            "with fewer pixels, or a photo as JPEG",
            mb=MAX_PICTURE_BYTES // 2**20,
            size=size / 2**20,
        )
    )


def _too_many(columns: int, rows: int) -> _PictureSizeError:
    return _PictureSizeError(
        _(
            "expected a picture of at most {megapixels:g} megapixels, got {columns} x "
            "{rows} pixels; make it smaller with a program for pictures",
            megapixels=MAX_PICTURE_PIXELS / 1e6,
            columns=columns,
            rows=rows,
        )
    )


def _damaged(why: str) -> ValueError:
    return ValueError(
        _("the picture can't be read: {why}; save it again as PNG", why=shorten(why, 100))
    )
