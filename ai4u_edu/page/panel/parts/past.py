"""The part "past": the kept episodes, and the one that is played."""

from typing import Any

from ai4u_edu.base.optional_deps import has
from ai4u_edu.blocks import Block
from ai4u_edu.page.panel.context import PanelContext
from ai4u_edu.page.panel.gallery import words_of
from ai4u_edu.recording import ArchiveEntry
from ai4u_edu.runtime.replay_player import RUNNING_EPISODE
from ai4u_edu.snapshot import Snapshot

FORMATS = {
    "html": "Web page",
    "gif": "GIF",
    "mp4": "MP4",
    "csv": "Table (CSV)",
    "episode": "Recording",
}
"""Titles of the download formats, by file extension."""


def past_part(context: PanelContext, snapshot: Snapshot) -> dict[str, Any]:
    """Return the kept episodes, the latest first, and the state of the player."""
    player, recorder = context.player, context.runner.recorder
    archive, frame_cache = player.archive, player.frame_cache
    entries = () if archive is None else archive.entries
    bests = frozenset() if archive is None else archive.bests()
    here = _scene_name(context)
    problem = player.problem or (frame_cache.problem if frame_cache is not None else "")
    if not problem and recorder is not None:
        problem = recorder.problem or recorder.save_problem
    return {
        "type": "part",
        "name": "past",
        "episodes": [
            _episode(each, is_best=each.number in bests, is_here=each.episode.scene.name == here)
            for each in reversed(entries)
        ],
        "playing": _playing(context),
        "is_showing": bool(snapshot.past),
        "shown": snapshot.past,
        "ghost": context.ghosts.text(snapshot),
        "problem": problem,
        "downloads": _downloads(context, entries),
    }


def driver_words(title: str) -> str:
    """Return a brain's title in words.

    >>> driver_words("LocalBrain(WASDRBMoveController)")
    'Keys W, A, S, D'
    >>> driver_words("Recording, RemoteBrain(a script)")
    'Recording, a script'
    """
    parts = [part.rstrip(")").rpartition("(")[2] for part in title.split(", ")]
    return ", ".join(words_of(part).title if part in Block.types else part for part in parts)


def _scene_name(context: PanelContext) -> str:
    """Return the name of the scene that runs now; empty if it has none."""
    if context.editor is not None:
        return context.editor.state.description.name
    recorder = context.runner.recorder
    return "" if recorder is None or recorder.scene is None else recorder.scene.name


def _episode(entry: ArchiveEntry, *, is_best: bool, is_here: bool) -> dict[str, Any]:
    episode = entry.episode
    return {
        "number": entry.number,
        "scene": episode.scene.title or episode.scene.name,
        "is_here": is_here,
        "driver": entry.source or driver_words(entry.first.driver),
        "is_person": entry.is_person,
        "result": entry.success,
        "reward": entry.first.total,
        "decisions": len(entry.first),
        "seconds": round(episode.seconds, 2),
        "seed": str(episode.seed),
        "is_pinned": entry.is_pinned,
        "is_best": is_best,
        "source": entry.source,
    }


def _playing(context: PanelContext) -> dict[str, Any] | None:
    """Return the chosen episode; None if none is, or nothing of it can be shown yet."""
    player = context.player
    frame_cache = player.frame_cache
    if frame_cache is None or player.number is None or frame_cache.last < 0:
        return None
    scene = frame_cache.episode.scene
    return {
        "number": player.number,
        "scene": scene.title or scene.name,
        "is_here": scene.name == _scene_name(context),
        "step": player.step,
        "steps": max(frame_cache.last, 1),
        "world_episode": _world_episode(context, player.number),
        "is_playing": player.is_playing,
        "speed": player.speed,
    }


def _world_episode(context: PanelContext, number: int) -> int:
    """Return the number by which the world counted the chosen episode; 0 if it was loaded."""
    recorder, archive = context.runner.recorder, context.player.archive
    if number == RUNNING_EPISODE:
        return 0 if recorder is None else recorder.world_episode
    entry = None if archive is None else archive.find(number)
    return 0 if entry is None else entry.world_episode


def _downloads(context: PanelContext, entries: tuple[ArchiveEntry, ...]) -> list[dict[str, str]]:
    number = context.player.number
    if not any(entry.number == number for entry in entries):
        return []
    return [
        {"format": name, "title": title, "url": f"api/past/{number}.{name}"}
        for name, title in FORMATS.items()
        if name != "mp4" or has("imageio_ffmpeg")
    ]
