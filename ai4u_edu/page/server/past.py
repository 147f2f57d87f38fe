"""HTTP routes for the kept episodes: a list, and each episode as a file."""

import asyncio
import tempfile
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field
from starlette.requests import Request
from starlette.responses import Response, StreamingResponse

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.scene_pictures import scene_picture
from ai4u_edu.page.server.api import Number
from ai4u_edu.page.server.exports import RETRY_AFTER_S, BusyError, Exports
from ai4u_edu.page.server.reader_language import TextResponse
from ai4u_edu.recording import ArchiveEntry, Episode, Replay
from ai4u_edu.recording.episode import encode
from ai4u_edu.recording.exports.csv_file import write_csv
from ai4u_edu.recording.exports.html_page import write_html
from ai4u_edu.recording.exports.movie import write_gif, write_mp4
from ai4u_edu.recording.scene_export import without_unknown_brains
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import Scene

WRITERS: dict[str, tuple[str, Callable[[Replay, Path], Path]]] = {
    "html": ("text/html; charset=utf-8", write_html),
    "gif": ("image/gif", write_gif),
    "mp4": ("video/mp4", write_mp4),
    "csv": ("text/csv; charset=utf-8", write_csv),
}
"""Media type and writer by file extension."""
RECORDING = "episode"
RECORDING_KIND = "application/octet-stream"
PICTURE = "png"
PICTURE_PX = 160
"""Longer side of the picture of an episode's start."""
MAX_PICTURES = 200
"""Most pictures that are kept."""
PART_BYTES = 64 * 2**10
"""Size of the parts in which a file is sent; a slow client holds one of them in memory."""
HEADERS = {
    "Cache-Control": "no-store",
    # a file that is opened as a page must not act with our origin
    "Content-Security-Policy": "sandbox allow-scripts",
}


class EpisodeView(BaseModel):
    """A kept episode."""

    model_config = ConfigDict(extra="forbid")

    number: int = Field(description="of its file: api/past/NUMBER.episode (.html .csv .gif .mp4)")
    scene: str
    seed: Annotated[int, Field(ge=0)]
    seconds: Number
    decisions: int = Field(description="of the agent that acts first")
    reward: Number = Field(description="of the agent that acts first, altogether")
    success: bool | None = Field(description="null in a scene without a goal")
    driver: str = Field(description="the title of the first agent's brain")
    source: str = Field(description="the file that it came from; empty if it happened here")

    @classmethod
    def of(cls, entry: ArchiveEntry) -> "EpisodeView":
        """Return the view of an entry."""
        episode = entry.episode
        return cls(
            number=entry.number,
            scene=episode.scene.name,
            seed=episode.seed,
            seconds=episode.seconds,
            decisions=len(entry.first),
            reward=entry.first.total,
            success=entry.success,
            driver=entry.first.driver,
            source=entry.source,
        )


class PastView(BaseModel):
    """The kept episodes, the oldest first."""

    model_config = ConfigDict(extra="forbid")

    episodes: list[EpisodeView]


class Past:
    """Routes to the episodes that a room keeps.

    Args:
        runner: the room's.
    """

    def __init__(self, runner: Runner) -> None:
        self._runner = runner
        # replaying and drawing keep a core busy: one file at a time. Recordings need not wait
        self._recordings, self._files = Exports(_recording), Exports(_file)
        self._pictures: dict[int, bytes] = {}
        self._drawing = asyncio.Lock()
        self._listed: tuple[tuple[ArchiveEntry, ...], str] = ((), "")

    def list(self, _: Request) -> Response:
        """Return the list as JSON."""
        entries, text = self._listed
        if not text or entries is not self._entries():
            entries = self._entries()
            text = PastView(episodes=[*map(EpisodeView.of, entries)]).model_dump_json()
            self._listed = entries, text
        headers = {"Cache-Control": "no-store"}
        return Response(text, media_type="application/json", headers=headers)

    async def file(self, request: Request) -> Response:
        """Return an episode as a file: ``3.episode``, ``3.html``, ..."""
        name = str(request.path_params["file"])
        number, _dot, ending = name.partition(".")
        known = (RECORDING, PICTURE, *WRITERS)
        if ending not in known or not (number.isdecimal() and number.isascii()):
            expected = ", ".join(f"NUMBER.{each}" for each in known)
            return TextResponse(
                _("expected one of {expected}, got {name!r}", expected=expected, name=name[:80]),
                404,
            )
        entry = next((each for each in self._entries() if str(each.number) == number), None)
        if entry is None:
            kept = ", ".join(str(each.number) for each in self._entries()) or "none"
            return TextResponse(
                _("no episode {number} is kept; there are {kept}", number=number[:20], kept=kept),
                404,
            )
        if ending == PICTURE:
            return await self._picture(entry)
        try:
            data = await self._made(entry.episode, ending, request)
        except BusyError as error:
            headers = {"Retry-After": str(RETRY_AFTER_S), "Cache-Control": "no-store"}
            return TextResponse(text_of(error), 503, headers)
        except AI4UError as error:
            return TextResponse(text_of(error), 409)
        kind = RECORDING_KIND if ending == RECORDING else WRITERS[ending][0]
        attached = f'attachment; filename="{_plain(entry)}.{ending}"'
        about = {"Content-Disposition": attached, "Content-Length": str(len(data))}
        return StreamingResponse(_parts(data), media_type=kind, headers=HEADERS | about)

    async def _picture(self, entry: ArchiveEntry) -> Response:
        """Return a picture of an episode's start; one is drawn at a time, and once."""
        async with self._drawing:
            if entry.number not in self._pictures:
                if len(self._pictures) >= MAX_PICTURES:
                    self._pictures.clear()
                try:
                    data = await asyncio.to_thread(_drawn, entry.episode)
                except AI4UError as error:
                    return TextResponse(text_of(error), 409)
                self._pictures[entry.number] = data
        headers = {"Cache-Control": "private, max-age=3600"}
        return Response(self._pictures[entry.number], media_type="image/png", headers=headers)

    async def _made(self, episode: Episode, ending: str, request: Request) -> bytes:
        """Wait for a file until the client disconnects."""
        exports = self._recordings if ending == RECORDING else self._files
        making = asyncio.ensure_future(exports.get(episode, ending))
        leaving = asyncio.ensure_future(_has_left(request))
        try:
            await asyncio.wait({making, leaving}, return_when=asyncio.FIRST_COMPLETED)
            return making.result() if making.done() else b""  # the client has disconnected
        finally:
            making.cancel()
            leaving.cancel()

    def _entries(self) -> tuple[ArchiveEntry, ...]:
        recorder = self._runner.recorder
        return _NONE if recorder is None else recorder.episodes.entries


_NONE: tuple[ArchiveEntry, ...] = ()


async def _has_left(request: Request) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass


async def _parts(data: bytes) -> AsyncIterator[bytes]:
    for begin in range(0, len(data), PART_BYTES):
        yield data[begin : begin + PART_BYTES]


def _recording(episode: Episode, _: str, check: Callable[[], None]) -> bytes:
    check()
    return encode(episode)


def _drawn(episode: Episode) -> bytes:
    return scene_picture(Scene(without_unknown_brains(episode.scene)), PICTURE_PX, episode.seed)


def _file(episode: Episode, ending: str, check: Callable[[], None]) -> bytes:
    _kind, write = WRITERS[ending]
    with tempfile.TemporaryDirectory(prefix="ai4u-edu-") as folder:
        replay = Replay(episode, on_step=check)
        return write(replay, Path(folder) / f"episode.{ending}").read_bytes()


def _plain(entry: ArchiveEntry) -> str:
    """Return a file name for a scene's name, which may be any text."""
    name = "".join(each if each.isascii() and each.isalnum() else "_" for each in entry.name)
    return name.strip("_")[:60] or "episode"
