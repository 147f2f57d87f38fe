"""Export of an episode as GIF or MP4, drawn without a browser."""

import contextlib
import subprocess
from collections.abc import Iterator
from itertools import chain, repeat
from pathlib import Path
from typing import IO, cast

import numpy as np
import numpy.typing as npt
from PIL import Image

from ai4u_edu.base.atomic_write import partial_file, reason
from ai4u_edu.base.optional_deps import need
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.replay import Replay
from ai4u_edu.snapshot.raster import draw_snapshot

Frame = npt.NDArray[np.uint8]

GIF_MAX_FPS, MP4_MAX_FPS = 20, 30
"""Frames per second."""
GIF_END_S = 1.5
"""Time for which a GIF shows its end before it begins again."""
SIDE_MULTIPLE_PX = 2
"""The encoder wants sides that are multiples of this."""


def write_gif(replay: Replay, path: Path, *, longest: int = 360) -> Path:
    """Write an animated GIF at the speed of world time, and return the path.

    Args:
        replay: of the episode; it is drawn as far as it is exact.
        path: of the file.
        longest: pixels of the longer side.
    """
    every = _every(replay, GIF_MAX_FPS)
    end = round(GIF_END_S * _rate(replay) / every)
    frames = (
        # few colours: smaller files, and no flicker
        Image.fromarray(frame).quantize(64, method=Image.Quantize.FASTOCTREE)
        for frame in _with_end(_frames(replay, every, longest), end)
    )
    first = next(frames)
    hundredths = 100 * every / _rate(replay)
    with partial_file(path) as partial:
        first.save(
            partial,
            format="GIF",
            save_all=True,
            append_images=frames,
            duration=max(20, round(hundredths) * 10),  # browsers show shorter frames for 100 ms
            loop=0,
        )
    return path


def write_mp4(replay: Replay, path: Path, *, longest: int = 640) -> Path:
    """Write an MP4 (H.264), and return the path; needs ``pip install "ai4u-edu[video]"``.

    Args:
        replay: of the episode; it is drawn as far as it is exact.
        path: of the file.
        longest: pixels of the longer side.

    Raises:
        SetupError: imageio-ffmpeg is not installed.
        RecordingError: the file can't be written.
    """
    need("video", "imageio_ffmpeg")
    from imageio_ffmpeg import get_ffmpeg_exe

    every = _every(replay, MP4_MAX_FPS)
    frames = (_even(frame) for frame in _frames(replay, every, longest))
    try:
        with partial_file(path) as partial:
            message = _encode(get_ffmpeg_exe(), frames, _rate(replay) / every, partial)
            if message is not None:
                raise RecordingError(
                    _(
                        "{path}: the video can't be written: {message}",
                        path=str(path),
                        message=message,
                    )
                )
    except OSError as error:
        raise RecordingError(
            _("{path}: the video can't be written: {reason}", path=str(path), reason=reason(error))
        ) from None
    return path


def _no_video(path: Path, reason: str) -> str:
    return _("{file}: the video can't be written: {reason}", file=str(path), reason=reason)


def _encode(ffmpeg: str, frames: Iterator[Frame], fps: float, path: Path) -> str | None:
    """Encode frames with ffmpeg; return its message if it fails, and None otherwise."""
    first = next(frames)
    height, width = first.shape[:2]
    command = [ffmpeg, "-y", "-loglevel", "error"]
    command += ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}"]
    command += ["-r", str(fps), "-i", "-"]
    command += ["-c:v", "libx264", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"]
    command += [str(path.absolute())]  # absolute, since a name could begin like an option
    with subprocess.Popen(  # noqa: S603 - the only variable argument is a path
        command, stdin=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        try:
            with contextlib.suppress(BrokenPipeError):  # ffmpeg's own message follows
                for frame in chain([first], frames):
                    cast(IO[bytes], process.stdin).write(frame.data)
        except BaseException:
            process.kill()  # the incomplete video is useless
            raise
        _, told = process.communicate()
    return told.decode().strip() if process.returncode else None


def _frames(replay: Replay, every: int, longest: int) -> Iterator[Frame]:
    for picture in replay.snapshots(every):
        if picture.tick % every == 0:  # the last snapshot may come after fewer ticks
            yield draw_snapshot(picture, longest=longest)


def _with_end(frames: Iterator[Frame], count: int) -> Iterator[Frame]:
    """Give frames, then the last one again, which takes no room in a GIF."""
    for frame in frames:
        yield frame
    yield from repeat(frame, count)


def _rate(replay: Replay) -> int:
    return replay.episode.scene.world.ticks_per_second


def _every(replay: Replay, rate: int) -> int:
    return max(1, round(_rate(replay) / rate))


def _even(frame: Frame) -> Frame:
    height, width = (length - length % SIDE_MULTIPLE_PX for length in frame.shape[:2])
    return np.ascontiguousarray(frame[:height, :width])
