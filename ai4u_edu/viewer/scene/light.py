"""Light, and colours that come out on the page as they are meant.

viser's page lights what it draws and then applies the ACES film curve to it. Here is the light that
we use instead of viser's own, and the way back through the curve.
"""

import math

import numpy as np
import numpy.typing as npt
from viser import SceneApi

GAIN = 2.0
"""What a white surface that faces up sends out; more than 1, as the curve dims what is bright."""
AMBIENT = 0.22
"""The share of the light that comes from everywhere. The rest comes from straight above: the page
lights by steps, so what faces up gets all of it, rims get three quarters and walls half."""

_INTO = np.array(
    [
        [0.59719, 0.35458, 0.04823],
        [0.07600, 0.90834, 0.01566],
        [0.02840, 0.13383, 0.83777],
    ]
)
_OUT = np.array(
    [
        [1.60475, -0.53108, -0.07367],
        [-0.10208, 1.10813, -0.00605],
        [-0.00327, -0.07276, 1.07602],
    ]
)
_EXPOSURE = 1 / 0.6

Colours = npt.NDArray[np.float64]


def light(scene: SceneApi) -> None:
    """Replaces viser's lights by ours."""
    scene.configure_default_lights(enabled=False)
    scene.configure_environment_map(hdri=None)
    scene.add_light_ambient("/light/ambient", intensity=math.pi * GAIN * AMBIENT)
    scene.add_light_point(
        "/light/lamp",
        intensity=math.pi * GAIN * (1 - AMBIENT),
        decay=0.0,
        position=(0.0, 0.0, 1e6),
    )


def surfaces(colours: npt.ArrayLike) -> npt.NDArray[np.uint8]:
    """What a batch must be given to look like the (n, 3) colours from above: linear numbers."""
    return np.rint(255 * _albedo(colours)).astype(np.uint8)


def strokes(colours: npt.ArrayLike) -> npt.NDArray[np.uint8]:
    """The same for lines, which nothing lights: (..., 3), linear numbers."""
    return np.rint(255 * np.clip(_unfilmed(colours), 0, 1)).astype(np.uint8)


def film(linear: npt.ArrayLike) -> Colours:
    """The page's curve: linear light to what is shown (0..1, sRGB)."""
    seen = np.asarray(linear, np.float64) * _EXPOSURE @ _INTO.T
    curve = (seen * (seen + 0.0245786) - 0.000090537) / (
        seen * (0.983729 * seen + 0.4329510) + 0.238081
    )
    return _encoded(curve @ _OUT.T)


def lit(albedo: npt.ArrayLike) -> Colours:
    """What a surface that faces up looks like (0..1, sRGB), by its own colour (0..1, linear)."""
    return film(GAIN * np.asarray(albedo))


def _albedo(colours: npt.ArrayLike) -> Colours:
    """The way back from :func:`lit`, for 0..255."""
    return np.clip(_unfilmed(colours) / GAIN, 0.0, 1.0)


def _unfilmed(colours: npt.ArrayLike) -> Colours:
    shown = np.asarray(colours, np.float64) / 255
    linear = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
    curve = np.clip(linear @ np.linalg.inv(_OUT).T, 0.0, 0.98)
    # the curve is a ratio of two squares: its way back is a quadratic equation
    a = 1 - 0.983729 * curve
    b = 0.0245786 - 0.4329510 * curve
    c = -0.000090537 - 0.238081 * curve
    seen = (-b + np.sqrt(b * b - 4 * a * c)) / (2 * a)
    back: Colours = seen @ np.linalg.inv(_INTO).T / _EXPOSURE
    return np.maximum(back, 0.0)


def _encoded(linear: Colours) -> Colours:
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
