"""The kept episodes over HTTP: their list, and each of them as a file."""

import tempfile
from collections.abc import Callable
from pathlib import Path
from threading import Lock
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response

from ai4u_edu.errors import AI4UError
from ai4u_edu.recording import Entry, Replay
from ai4u_edu.recording.csv_file import write_csv
from ai4u_edu.recording.file import encode
from ai4u_edu.recording.movie import write_gif, write_mp4
from ai4u_edu.recording.page import write_html
from ai4u_edu.runner import Runner
from ai4u_edu.server.api import Number

WRITERS: dict[str, tuple[str, Callable[[Replay, Path], Path]]] = {
    "html": ("text/html; charset=utf-8", write_html),
    "gif": ("image/gif", write_gif),
    "mp4": ("video/mp4", write_mp4),
    "csv": ("text/csv; charset=utf-8", write_csv),
}
"""What an episode can be made into, and how."""
RECORDING = "episode"
HEADERS = {
    "Cache-Control": "no-store",
    # whoever opens it all the same gets a page that may not speak in our name
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
    def of(cls, entry: Entry) -> "EpisodeView":
        """The view of an entry."""
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
    """The routes to the episodes that a room keeps.

    Args:
        runner: the room's.
    """

    def __init__(self, runner: Runner) -> None:
        self._runner = runner
        self._turn = Lock()  # to play and to draw takes a processor: one after the other

    def list(self, _: Request) -> Response:
        """All of them, as JSON."""
        view = PastView(episodes=[EpisodeView.of(entry) for entry in self._entries()])
        headers = {"Cache-Control": "no-store"}
        return Response(view.model_dump_json(), media_type="application/json", headers=headers)

    def file(self, request: Request) -> Response:
        """One as a file: ``3.episode``, ``3.html``, ..."""
        name = str(request.path_params["file"])
        number, _, ending = name.partition(".")
        known = (RECORDING, *WRITERS)
        if ending not in known or not (number.isdecimal() and number.isascii()):
            expected = ", ".join(f"NUMBER.{each}" for each in known)
            return PlainTextResponse(f"expected one of {expected}, got {name[:80]!r}\n", 404)
        entry = next((each for each in self._entries() if str(each.number) == number), None)
        if entry is None:
            kept = ", ".join(str(each.number) for each in self._entries()) or "none"
            return PlainTextResponse(f"no episode {number[:20]} is kept; there are {kept}\n", 404)
        try:
            kind, data = self._made(entry, ending)
        except AI4UError as error:
            return PlainTextResponse(f"{error}\n", 409)
        attached = f'attachment; filename="{_plain(entry)}.{ending}"'
        return Response(data, media_type=kind, headers=HEADERS | {"Content-Disposition": attached})

    def _made(self, entry: Entry, ending: str) -> tuple[str, bytes]:
        if ending == RECORDING:
            return "application/octet-stream", encode(entry.episode)
        kind, write = WRITERS[ending]
        with self._turn, tempfile.TemporaryDirectory(prefix="ai4u-edu-") as folder:
            path = write(Replay(entry.episode), Path(folder) / f"episode.{ending}")
            return kind, path.read_bytes()

    def _entries(self) -> tuple[Entry, ...]:
        recorder = self._runner.recorder
        return () if recorder is None else recorder.episodes.entries


def _plain(entry: Entry) -> str:
    """A file's name out of a scene's, which may be anything."""
    name = "".join(each if each.isascii() and each.isalnum() else "_" for each in entry.name)
    return name.strip("_")[:60] or "episode"
