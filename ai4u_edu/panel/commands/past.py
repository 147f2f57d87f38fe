"""Commands about recorded episodes. All pages share the player."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from ai4u_edu.base.errors import SetupError
from ai4u_edu.explain import RewardTerms, reward_terms
from ai4u_edu.panel.answers import Answer
from ai4u_edu.panel.commands.handler import Handler
from ai4u_edu.panel.messages import play as m
from ai4u_edu.panel.messages.base import Command
from ai4u_edu.panel.page import Page
from ai4u_edu.recording import Archive, Episode
from ai4u_edu.recording.episode import decode
from ai4u_edu.recording.frame_cache import FrameCache
from ai4u_edu.viewer.replay.replay_player import RUNNING_EPISODE

MAX_POINTS = 300
"""Most points of a term's curve."""
MOMENTS = 5
"""Decisions that are told of those that paid most."""


async def _episode(page: Page, command: m.OpenEpisode) -> Answer:
    archive = _archive(page)
    if command.number != RUNNING_EPISODE and archive.find(command.number) is None:
        raise SetupError(f"episode {command.number} is not kept any more")
    page.context.viewer.player.open(command.number, page.view.agent)
    page.view.ask_again("past")
    return Answer()


async def _step(page: Page, command: m.GoToStep) -> Answer:
    chosen_episode(page)
    page.context.viewer.player.go_to(command.step)
    return Answer()


async def _play(page: Page, _command: m.Play) -> Answer:
    chosen_episode(page)
    page.context.viewer.player.play()
    return Answer()


async def _stop(page: Page, _command: m.Stop) -> Answer:
    page.context.viewer.player.play(on=False)
    return Answer()


async def _play_speed(page: Page, command: m.SetPlaySpeed) -> Answer:
    page.context.viewer.player.speed = command.speed
    return Answer()


async def _back_to_live(page: Page, _command: m.BackToLive) -> Answer:
    await page.result(page.context.viewer.player.return_to_present())
    return Answer()


async def _continue(page: Page, _command: m.ContinueHere) -> Answer:
    chosen_episode(page)
    # it waits until the episode was replayed up to there
    await page.result(await page.in_thread(page.context.viewer.player.continue_from_here))
    return Answer("The world runs on from here.")


async def _race(page: Page, _command: m.Race) -> Answer:
    frame_cache = chosen_episode(page)
    runner, viewer = page.context.runner, page.context.viewer
    number = frame_cache.number
    viewer.player.cancel()
    viewer.ghosts.race(frame_cache.episode, f"episode {number}")
    runner.reset(frame_cache.episode.seed)
    await page.result(runner.resume())
    return Answer(f"Race against episode {number}: it starts as you do.")


async def _remove_ghost(page: Page, _command: m.RemoveGhost) -> Answer:
    page.context.viewer.ghosts.race(None)
    return Answer("The ghost is gone.")


async def _paid(page: Page, _command: m.AskPaid) -> Answer:
    frame_cache = chosen_episode(page)
    told = reward_terms(frame_cache.episode, frame_cache.record.id)
    count = len(told.amounts)
    places = np.linspace(0, count - 1, min(count, MAX_POINTS)).round().astype(int)
    sums = told.amounts.cumsum(axis=0)[places]
    return Answer(
        more={
            "terms": [
                {"term": name, "total": float(told.totals[index]), "curve": sums[:, index].tolist()}
                for index, name in enumerate(told.terms)
                if told.amounts[:, index].any()
            ],
            "moments": [
                {"step": step, "terms": _amounts(told, step)} for step in told.moments(MOMENTS)
            ],
        }
    )


def _amounts(told: RewardTerms, step: int) -> list[dict[str, Any]]:
    amounts = zip(told.terms, told.amounts[step].tolist(), strict=True)
    return [{"term": name, "amount": amount} for name, amount in amounts if amount]


async def _pin(page: Page, command: m.Pin) -> Answer:
    _archive(page).pin(command.number, on=command.on)
    kept = "is kept" if command.on else "is no longer pinned"
    return Answer(f"Episode {command.number} {kept}.")


async def _open_recording(page: Page, command: m.OpenRecording) -> Answer:
    archive = _archive(page)
    data = page.upload.take(command.size)
    episode = await page.in_thread(lambda: decode(Episode, data, command.name))
    number = archive.append(episode, command.name).number
    page.context.viewer.player.open(number)
    return Answer(f"Opened {command.name} as episode {number}.", {"number": number})


def _archive(page: Page) -> Archive:
    archive = page.context.viewer.player.archive
    if archive is None:
        raise SetupError("episodes are not recorded here")
    return archive


def chosen_episode(page: Page) -> FrameCache:
    """Return the episode that the player has.

    Raises:
        SetupError: none is chosen.
    """
    frame_cache = page.context.viewer.player.frame_cache
    if frame_cache is None:
        raise SetupError("choose an episode first")
    return frame_cache


HANDLERS: Mapping[type[Command], Handler] = {
    m.OpenEpisode: _episode,
    m.GoToStep: _step,
    m.Play: _play,
    m.Stop: _stop,
    m.SetPlaySpeed: _play_speed,
    m.BackToLive: _back_to_live,
    m.ContinueHere: _continue,
    m.Race: _race,
    m.RemoveGhost: _remove_ghost,
    m.AskPaid: _paid,
    m.Pin: _pin,
    m.OpenRecording: _open_recording,
}
"""Handlers by the type of their command."""
