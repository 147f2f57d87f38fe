"""The part "past": the kept episodes, and the one that is played."""

from typing import Literal

from msgspec import Struct

from ai4u_edu.base.optional_deps import has
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.block import default_name
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, library_text
from ai4u_edu.page.panel.context import PanelContext
from ai4u_edu.page.panel.gallery import words_of
from ai4u_edu.page.panel.parts.part import PanelPart
from ai4u_edu.recording import ArchiveEntry
from ai4u_edu.recording.episode import MAX_RECORDING_BYTES
from ai4u_edu.runtime.replay_player import RUNNING_EPISODE
from ai4u_edu.snapshot import Snapshot

FORMATS = {
    "html": _("Web page"),
    "gif": "GIF",
    "mp4": "MP4",
    "csv": _("Table (CSV)"),
    "episode": _("Recording"),
}
"""Titles of the download formats, by file extension."""

DRIVERS = {
    "Recording": _("Recording"),
    "a script": _("a script"),
}
"""Drivers whose titles a recording has in English words."""
FALLS = ("FallReward", "DynamicFallReward")
"""Classes of rewards that are paid when their agent falls."""


class KeptEpisode(Struct, frozen=True):
    """A recorded episode that is kept."""

    number: int
    """Number from 1, in order of arrival; never reused."""
    scene: str
    """Title of its scene."""
    is_here: bool
    """True if its scene is the one that runs now."""
    picture: str
    """Address of a picture of its start, relative to the page."""
    driver: str
    """Title of the driver, or the file that it was loaded from."""
    is_person: bool
    """True if a person took most decisions, by keys."""
    end: Literal["goal", "fell", "time", "over"]
    """Its end: an agent reached the goal, the one that acts first fell, or the time was up."""
    reward: float
    """Sum of the rewards of the agent that acts first."""
    decisions: int
    """Decisions of the agent that acts first."""
    seconds: float
    """Duration (s) in world time."""
    seed: str
    """Its seed, a whole number as text."""
    is_pinned: bool
    """True if it is kept however many others come."""
    is_best: bool
    """True for the best of its scene."""
    source: str
    """The file that it was loaded from; empty if it was recorded here."""


class PlayedEpisode(Struct, frozen=True):
    """The chosen episode, and the state of the player."""

    number: int
    """Its number; 0 for the one that runs."""
    scene: str
    """Title of its scene."""
    is_here: bool
    """True if its scene is the one that runs now."""
    step: int
    """The decision that is shown, from 0."""
    steps: int
    """The last decision that can be shown."""
    world_episode: int
    """Number by which the world counted it; 0 if it was loaded."""
    is_playing: bool
    speed: float
    """Speed of playing; 1 is the recorded speed."""


class DownloadLink(Struct, frozen=True):
    """A file of the chosen episode to download."""

    format: str
    """Extension of the file."""
    title: str
    url: str
    """Address, relative to the page."""


class PastPart(PanelPart, frozen=True, kw_only=True):
    """The kept episodes, and the state of the player."""

    name: Literal["past"] = "past"
    episodes: list[KeptEpisode]
    """The kept episodes, the latest first."""
    playing: PlayedEpisode | None
    """The chosen episode; null if none is, or nothing of it can be shown yet."""
    is_showing: bool
    """True if pages see a moment of the past."""
    shown: str
    """Label of that moment; empty for the present."""
    ghost: str
    """State of the race against a ghost, as a sentence; empty without one."""
    problem: str
    """The reason why an episode could not be recorded, kept or replayed; empty if all went well."""
    downloads: list[DownloadLink]
    """Files of the chosen episode; empty if none is chosen."""
    max_recording_bytes: int = MAX_RECORDING_BYTES
    """Size of a recording at most."""


def past_part(context: PanelContext, snapshot: Snapshot) -> PastPart:
    """Return the kept episodes, the latest first, and the state of the player."""
    player, recorder = context.player, context.runner.recorder
    archive, frame_cache = player.archive, player.frame_cache
    entries = () if archive is None else archive.entries
    bests = frozenset() if archive is None else archive.bests()
    here = _scene_name(context)
    problem = player.problem or (frame_cache.problem if frame_cache is not None else "")
    if not problem and recorder is not None:
        problem = recorder.problem or recorder.save_problem
    return PastPart(
        episodes=[
            _episode(
                entry,
                is_best=entry.number in bests,
                is_here=entry.episode.scene.name == here,
            )
            for entry in reversed(entries)
        ],
        playing=_playing(context),
        is_showing=bool(snapshot.past),
        shown=snapshot.past,
        ghost=context.ghosts.text(snapshot),
        problem=problem,
        downloads=_downloads(context, entries),
    )


def driver_words(title: str) -> str:
    """Return a brain's title in words.

    >>> driver_words("LocalBrain(WASDRBMoveController)")
    'Keys W, A, S, D'
    >>> driver_words("Recording, RemoteBrain(a script)")
    'Recording, a script'
    """
    parts = [part.rstrip(")").rpartition("(")[2] for part in title.split(", ")]
    titles = [words_of(part).title if part in Block.types else part for part in parts]
    return join([DRIVERS.get(title, title) for title in titles], ", ")


def _scene_name(context: PanelContext) -> str:
    """Return the name of the scene that runs now; empty if it has none."""
    if context.editor is not None:
        return context.editor.state.description.name
    recorder = context.runner.recorder
    return "" if recorder is None or recorder.scene is None else recorder.scene.name


def _episode(entry: ArchiveEntry, *, is_best: bool, is_here: bool) -> KeptEpisode:
    episode = entry.episode
    return KeptEpisode(
        number=entry.number,
        scene=library_text(episode.scene.title or episode.scene.name),
        is_here=is_here,
        picture=f"api/past/{entry.number}.png?v={episode.seed}-{episode.ticks}",
        driver=entry.source or driver_words(entry.first.driver),
        is_person=entry.is_person,
        end=_end(entry),
        reward=entry.first.total,
        decisions=len(entry.first),
        seconds=round(episode.seconds, 2),
        seed=str(episode.seed),
        is_pinned=entry.is_pinned,
        is_best=is_best,
        source=entry.source,
    )


def _end(entry: ArchiveEntry) -> Literal["goal", "fell", "time", "over"]:
    """Return how an episode ended. A recording tells a fall by what it cost."""
    if entry.success:
        return "goal"
    record = entry.first
    if not len(record) or not (last := record[len(record) - 1]).ended:
        return "over"
    agents = (each for each in entry.episode.scene.agents if str(each.get("id", "0")) == record.id)
    falls = {
        str(reward.get("name") or default_name(Block.types[reward["type"]], "Reward"))
        for agent in agents
        for reward in agent.get("rewards", ())
        if reward["type"] in FALLS
    }
    if last.terminated and any(last.reward_terms.get(name) for name in falls):
        return "fell"
    return "time" if last.truncated else "over"


def _playing(context: PanelContext) -> PlayedEpisode | None:
    """Return the chosen episode; None if none is, or nothing of it can be shown yet."""
    player = context.player
    frame_cache = player.frame_cache
    if frame_cache is None or player.number is None or frame_cache.last < 0:
        return None
    scene = frame_cache.episode.scene
    return PlayedEpisode(
        number=player.number,
        scene=library_text(scene.title or scene.name),
        is_here=scene.name == _scene_name(context),
        step=player.step,
        steps=max(frame_cache.last, 1),
        world_episode=_world_episode(context, player.number),
        is_playing=player.is_playing,
        speed=player.speed,
    )


def _world_episode(context: PanelContext, number: int) -> int:
    """Return the number by which the world counted the chosen episode; 0 if it was loaded."""
    recorder, archive = context.runner.recorder, context.player.archive
    if number == RUNNING_EPISODE:
        return 0 if recorder is None else recorder.world_episode
    entry = None if archive is None else archive.find(number)
    return 0 if entry is None else entry.world_episode


def _downloads(context: PanelContext, entries: tuple[ArchiveEntry, ...]) -> list[DownloadLink]:
    number = context.player.number
    if not any(entry.number == number for entry in entries):
        return []
    return [
        DownloadLink(name, title, f"api/past/{number}.{name}")
        for name, title in FORMATS.items()
        if name != "mp4" or has("imageio_ffmpeg")
    ]
