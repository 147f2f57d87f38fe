"""An episode as a moving picture, drawn without a browser."""

import contextlib
import subprocess
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import IO, cast

import numpy as np
import numpy.typing as npt
from PIL import Image

from ai4u_edu.base.optional_deps import need
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.replay import Replay
from ai4u_edu.snapshot.raster import draw_snapshot

Frame = npt.NDArray[np.uint8]

GIF_RATE, MP4_RATE = 20, 30
"""Pictures a second, at most."""
EVEN = 2
"""A video's sides are multiples of this."""


def write_gif(replay: Replay, path: Path, *, longest: int = 360) -> Path:
    """Writes an animated GIF, at the pace of the world's time.

    Args:
        replay: of the episode; pictures go as far as it is exact.
        path: of the file.
        longest: pixels of the longer side.
    """
    every = _every(replay, GIF_RATE)
    frames = (
        # the same few colours in all pictures: they pack better, and nothing flickers
        Image.fromarray(frame).quantize(64, method=Image.Quantize.FASTOCTREE)
        for frame in _frames(replay, every, longest)
    )
    first = next(frames)
    hundredths = 100 * every / _rate(replay)
    first.save(
        path,
        format="GIF",
        save_all=True,
        append_images=frames,
        duration=max(
            20, round(hundredths) * 10
        ),  # browsers show what is shorter at a tenth a second
        loop=0,
    )
    return path


def write_mp4(replay: Replay, path: Path, *, longest: int = 640) -> Path:
    """Writes an MP4 (H.264); needs ``pip install "ai4u-edu[video]"``.

    Args:
        replay: of the episode; pictures go as far as it is exact.
        path: of the file.
        longest: pixels of the longer side.

    Raises:
        SetupError: imageio-ffmpeg is not installed.
        RecordingError: the file can't be written.
    """
    need("video", "imageio_ffmpeg")
    from imageio_ffmpeg import get_ffmpeg_exe

    every = _every(replay, MP4_RATE)
    frames = (_even(frame) for frame in _frames(replay, every, longest))
    first = next(frames)
    height, width, _ = first.shape
    command = [get_ffmpeg_exe(), "-y", "-loglevel", "error"]
    command += ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}"]
    command += ["-r", str(_rate(replay) / every), "-i", "-"]
    command += ["-c:v", "libx264", "-pix_fmt", "yuv420p", "-movflags", "+faststart"]
    command += [str(path.absolute())]  # absolute: a name may begin like an option
    with subprocess.Popen(  # noqa: S603 - a program of the extra's, and nothing but a path is given
        command, stdin=subprocess.PIPE, stderr=subprocess.PIPE
    ) as ffmpeg:
        try:
            with contextlib.suppress(BrokenPipeError):  # it says itself what is wrong
                for frame in chain([first], frames):
                    cast(IO[bytes], ffmpeg.stdin).write(frame.data)
        except BaseException:
            ffmpeg.kill()  # nobody wants what there is so far
            raise
        _, told = ffmpeg.communicate()
    if ffmpeg.returncode:
        raise RecordingError(f"{path}: the video can't be written: {told.decode().strip()}")
    return path


def _frames(replay: Replay, every: int, longest: int) -> Iterator[Frame]:
    for picture in replay.snapshots(every):
        if picture.tick % every == 0:  # the very last one would be too soon
            yield draw_snapshot(picture, longest=longest)


def _rate(replay: Replay) -> int:
    return replay.episode.scene.world.ticks_per_second


def _every(replay: Replay, rate: int) -> int:
    return max(1, round(_rate(replay) / rate))


def _even(frame: Frame) -> Frame:
    height, width = (length - length % EVEN for length in frame.shape[:2])
    return np.ascontiguousarray(frame[:height, :width])
