"""Commands about recorded episodes. All pages share the player."""

from collections.abc import Mapping
from typing import Annotated

from msgspec import Meta

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.messages import Name, Number, PageCommand
from ai4u_edu.page.panel.answers import Answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.page import Page
from ai4u_edu.recording import Archive, Episode
from ai4u_edu.recording.episode import decode
from ai4u_edu.recording.frame_cache import FrameCache
from ai4u_edu.runtime.replay_player import RUNNING_EPISODE


class OpenEpisode(PageCommand, tag="episode"):
    """Choose a recorded episode; 0 is the one that runs."""

    number: Number


async def _episode(page: Page, command: OpenEpisode) -> Answer:
    archive = _archive(page)
    if command.number != RUNNING_EPISODE and archive.find(command.number) is None:
        raise SetupError(_("episode {n} is not kept any more", n=command.number))
    page.context.player.open(command.number, page.view.agent)
    page.view.ask_again("past")
    return Answer()


class GoToStep(PageCommand, tag="step"):
    """Show a decision of the chosen episode, counted from 0."""

    step: Number


async def _step(page: Page, command: GoToStep) -> Answer:
    chosen_episode(page)
    page.context.player.go_to(command.step)
    return Answer()


class Play(PageCommand, tag="play"):
    """Play the chosen episode."""


async def _play(page: Page, _command: Play) -> Answer:
    chosen_episode(page)
    page.context.player.play()
    return Answer()


class Stop(PageCommand, tag="stop"):
    """Stop playing."""


async def _stop(page: Page, _command: Stop) -> Answer:
    page.context.player.play(on=False)
    return Answer()


class SetPlaySpeed(PageCommand, tag="play_speed"):
    """Set the speed of playing; 1 is the recorded speed."""

    speed: Annotated[float, Meta(ge=0.1, le=16)]


async def _play_speed(page: Page, command: SetPlaySpeed) -> Answer:
    page.context.player.speed = command.speed
    return Answer()


class BackToLive(PageCommand, tag="back_to_live"):
    """Show the present again."""


async def _back_to_live(page: Page, _command: BackToLive) -> Answer:
    await page.result(page.context.player.return_to_present())
    return Answer()


class ContinueHere(PageCommand, tag="continue"):
    """Let the world run on from the shown decision."""


async def _continue(page: Page, _command: ContinueHere) -> Answer:
    chosen_episode(page)
    # it waits until the episode was replayed up to there
    await page.result(await page.in_thread(page.context.player.continue_from_here))
    return Answer(_("The world runs on from here."))


class Race(PageCommand, tag="race"):
    """Begin an episode with the same start, against a ghost of the chosen one."""


async def _race(page: Page, _command: Race) -> Answer:
    frame_cache = chosen_episode(page)
    context, runner = page.context, page.context.runner
    number = frame_cache.number
    context.player.cancel()
    context.ghosts.race(frame_cache.episode, _("episode {n}", n=number))
    runner.reset(frame_cache.episode.seed)
    await page.result(runner.resume())
    return Answer(_("Race against episode {n}: it starts as you do.", n=number))


class RemoveGhost(PageCommand, tag="remove_ghost"):
    """Remove the ghost."""


async def _remove_ghost(page: Page, _command: RemoveGhost) -> Answer:
    page.context.ghosts.race(None)
    return Answer(_("The ghost is gone."))


class Pin(PageCommand, tag="pin"):
    """Keep an episode however many others come, or no longer."""

    number: Number
    on: bool


async def _pin(page: Page, command: Pin) -> Answer:
    _archive(page).pin(command.number, on=command.on)
    if command.on:
        return Answer(_("Episode {n} is kept.", n=command.number))
    return Answer(_("Episode {n} is no longer pinned.", n=command.number))


class OpenRecording(PageCommand, tag="open_recording"):
    """Open the recording that was sent in binary messages before."""

    name: Name
    size: Number


async def _open_recording(page: Page, command: OpenRecording) -> Answer:
    archive = _archive(page)
    data = page.upload.take(command.size)
    episode = await page.in_thread(lambda: decode(Episode, data, command.name))
    number = archive.append(episode, command.name).number
    page.context.player.open(number)
    text = _("Opened {file} as episode {n}.", file=command.name, n=number)
    return Answer(text, {"number": number})


def _archive(page: Page) -> Archive:
    archive = page.context.player.archive
    if archive is None:
        raise SetupError(_("episodes are not recorded here"))
    return archive


def chosen_episode(page: Page) -> FrameCache:
    """Return the episode that the player has.

    Raises:
        SetupError: none is chosen.
    """
    frame_cache = page.context.player.frame_cache
    if frame_cache is None:
        raise SetupError(_("choose an episode first"))
    return frame_cache


HANDLERS: Mapping[type[PageCommand], Handler] = {
    OpenEpisode: _episode,
    GoToStep: _step,
    Play: _play,
    Stop: _stop,
    SetPlaySpeed: _play_speed,
    BackToLive: _back_to_live,
    ContinueHere: _continue,
    Race: _race,
    RemoveGhost: _remove_ghost,
    Pin: _pin,
    OpenRecording: _open_recording,
}
"""Handlers by the type of their command."""
