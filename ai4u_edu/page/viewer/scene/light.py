"""Lights, and the colours to send so that the page shows the intended ones.

viser's page lights meshes and then applies ACES filmic tone mapping. This module sets our own
lights, and inverts lighting and tone mapping.
"""

import math

import numpy as np
import numpy.typing as npt
from viser import SceneApi

GAIN = 2.0
"""Linear radiance of a white surface that faces up; above 1, as tone mapping dims bright light."""
AMBIENT_SHARE = 0.22
"""Ambient share of the light. The rest comes from straight above. The page shades in steps (toon
material), so surfaces facing up get all of it, bevels three quarters, walls half."""

_ACES_INPUT = np.array(
    [
        [0.59719, 0.35458, 0.04823],
        [0.07600, 0.90834, 0.01566],
        [0.02840, 0.13383, 0.83777],
    ]
)
_ACES_OUTPUT = np.array(
    [
        [1.60475, -0.53108, -0.07367],
        [-0.10208, 1.10813, -0.00605],
        [-0.00327, -0.07276, 1.07602],
    ]
)
_EXPOSURE = 1 / 0.6

Colours = npt.NDArray[np.float64]


def set_up_lights(scene: SceneApi) -> None:
    """Replace viser's lights with our own."""
    scene.configure_default_lights(enabled=False)
    scene.configure_environment_map(hdri=None)
    scene.add_light_ambient("/light/ambient", intensity=math.pi * GAIN * AMBIENT_SHARE)
    scene.add_light_point(
        "/light/lamp",
        intensity=math.pi * GAIN * (1 - AMBIENT_SHARE),
        decay=0.0,
        position=(0.0, 0.0, 1e6),
    )


def surface_colours(colours: npt.ArrayLike) -> npt.NDArray[np.uint8]:
    """Return the linear colours (n, 3) to give a batch so that it shows sRGB colours from above."""
    return np.rint(255 * _albedo(colours)).astype(np.uint8)


def line_colours(colours: npt.ArrayLike) -> npt.NDArray[np.uint8]:
    """Return the linear colours (..., 3) to give lines, which are not lit, to show sRGB colours."""
    return np.rint(255 * np.clip(_invert_tone_map(colours), 0, 1)).astype(np.uint8)


def tone_map(linear: npt.ArrayLike) -> Colours:
    """Apply the page's ACES tone mapping: linear light to sRGB (0..1)."""
    exposed = np.asarray(linear, np.float64) * _EXPOSURE @ _ACES_INPUT.T
    curve = (exposed * (exposed + 0.0245786) - 0.000090537) / (
        exposed * (0.983729 * exposed + 0.4329510) + 0.238081
    )
    return _encode_srgb(curve @ _ACES_OUTPUT.T)


def shown_colour(albedo: npt.ArrayLike) -> Colours:
    """Return the sRGB colour (0..1) shown for an upward surface with a linear albedo (0..1)."""
    return tone_map(GAIN * np.asarray(albedo))


def _albedo(colours: npt.ArrayLike) -> Colours:
    """Invert :func:`shown_colour`, for sRGB colours of 0..255."""
    return np.clip(_invert_tone_map(colours) / GAIN, 0.0, 1.0)


def _invert_tone_map(colours: npt.ArrayLike) -> Colours:
    shown = np.asarray(colours, np.float64) / 255
    linear = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
    curve = np.clip(linear @ np.linalg.inv(_ACES_OUTPUT).T, 0.0, 0.98)
    # the curve is a ratio of two quadratic polynomials, so its inverse solves a quadratic equation
    a = 1 - 0.983729 * curve
    b = 0.0245786 - 0.4329510 * curve
    c = -0.000090537 - 0.238081 * curve
    exposed = (-b + np.sqrt(b * b - 4 * a * c)) / (2 * a)
    back: Colours = exposed @ np.linalg.inv(_ACES_INPUT).T / _EXPOSURE
    return np.maximum(back, 0.0)


def _encode_srgb(linear: Colours) -> Colours:
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
