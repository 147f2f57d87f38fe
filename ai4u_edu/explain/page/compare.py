"""Commands that compare two drivers on a recorded episode."""

import re
from collections.abc import Mapping
from contextlib import suppress
from functools import partial
from typing import Any

import numpy as np

from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.blocks import Block, Controller, LocalBrain, NeuralNetController
from ai4u_edu.explain.comparison import Comparison, compare
from ai4u_edu.explain.errors import NotExplainableError
from ai4u_edu.explain.live import LiveExplainer
from ai4u_edu.explain.page import messages as m
from ai4u_edu.explain.page.commands import plain_action
from ai4u_edu.explain.policy import Policy
from ai4u_edu.explain.statefulness import dependence_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.messages import PageCommand
from ai4u_edu.page.panel.answers import Answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.commands.past import chosen_episode
from ai4u_edu.page.panel.page import Page
from ai4u_edu.recording.frame_cache import FrameCache
from ai4u_edu.snapshot import AgentState

NOT_COMPARED = ("recording:", "ai4u://", "Keyboard: ")
"""Beginnings of the names and titles of drivers that are no policies."""
WHAT_IT_DID = "what-it-did"
"""Value of the choice for the recorded actions, in place of a driver's name."""
CHECKPOINT = re.compile(r"checkpoint-(\d+)\.onnx$")
"""A network of a training's check, with the number of decisions that it learned from."""
MAX_POINTS = 300
"""Most points of the curve of distances."""


class CompareCommands:
    """Handlers of the commands that compare two drivers of one world.

    Args:
        explainer: knows the agents' policies.
    """

    def __init__(self, explainer: LiveExplainer) -> None:
        self._policy = explainer.policy
        self.handlers: Mapping[type[PageCommand], Handler] = {
            m.ListRivals: self._rivals,
            m.CompareDrivers: self._compare,
        }
        """Handlers by the type of their command."""

    async def _rivals(self, page: Page, _command: m.ListRivals) -> Answer:
        return Answer(more={"rivals": await page.in_thread(partial(self._choices, page))})

    async def _compare(self, page: Page, command: m.CompareDrivers) -> Answer:
        frame_cache = chosen_episode(page)
        editor, agent_id = page.context.required_editor(), page.view.agent

        def asked(name: str) -> Policy:
            return _policy(editor, agent_id, name) if name else self._policy(agent_id)

        def compared() -> Comparison:
            first, second = (
                None if name == WHAT_IT_DID else asked(name)
                for name in (command.first, command.second)
            )
            timeout = page.context.timeouts.frame
            return compare(first, second, _states(frame_cache, agent_id, timeout))

        return Answer(more=_plain(await page.in_thread(compared)))

    def _choices(self, page: Page) -> list[dict[str, Any]]:
        """Return what can be asked about an episode: what was done, and drivers by the percept."""
        editor, agent_id = page.context.required_editor(), page.view.agent
        player = page.context.player
        entry = None if player.archive is None else player.archive.find(player.number or 0)
        is_person = entry is not None and entry.is_person
        found: list[dict[str, Any]] = [
            {"value": WHAT_IT_DID, "text": _("What I did") if is_person else _("What it did")}
        ]
        with suppress(AI4UError):
            self._policy(agent_id)
            found.append({"value": "", "text": _("The driver that it has now")})
        found += [
            {"value": each.name, "text": each.title}
            for each in editor.drivers(agent_id)
            if not each.name.startswith(NOT_COMPARED)
            and not each.title.startswith(NOT_COMPARED)
            and not _reason_against(each.title)
            and not editor.reason_against_driver(agent_id, each.name)
        ]
        return [choice | {"steps": _steps_of(choice["value"])} for choice in found]


def _policy(editor: SceneEditor, agent_id: str, driver: str) -> Policy:
    brain = editor.driver_brain(agent_id, driver)
    if not isinstance(brain, LocalBrain):
        raise NotExplainableError(_("a script elsewhere can't be asked about recorded percepts"))
    return Policy(brain)


def _states(frame_cache: FrameCache, agent_id: str, timeout: float) -> list[AgentState]:
    """Return the states of an agent at the decisions of an episode.

    Raises:
        SetupError: the episode was recorded with other agents, or can't be replayed so far.
    """
    if frame_cache.record.id != agent_id:
        raise SetupError(
            _(
                "the chosen episode is shown step by step for agent {id!r}, got agent {agent_id}; "
                "choose the episode again",
                id=frame_cache.record.id,
                agent_id=repr(agent_id),
            )
        )
    found: list[AgentState] = []
    for step in range(len(frame_cache.record)):
        if step > frame_cache.last:
            break  # from there on it can't be replayed exactly
        snapshot = frame_cache.snapshot(step, timeout=timeout)
        if snapshot is None:
            raise SetupError(frame_cache.problem or _("the episode takes too long to replay"))
        found.append(next(agent for agent in snapshot.agents if agent.id == agent_id))
    return found


def _reason_against(title: str) -> str:
    """Return why a controller is no policy, from its driver's title; empty if it may be one."""
    kind = Block.types.get(title.rpartition(": ")[2])
    if kind is None or not issubclass(kind, Controller) or kind is NeuralNetController:
        return ""
    return dependence_of(kind)


def _steps_of(name: str) -> int | None:
    found = CHECKPOINT.search(name)
    return None if found is None else int(found[1])


def _plain(found: Comparison) -> dict[str, Any]:
    places = np.linspace(0, len(found.distance) - 1, min(len(found.distance), MAX_POINTS))
    return {
        "step": found.step,
        "count": len(found.distance),
        "distance": [round(found.distance[int(place)], 4) for place in places],
        "largest": round(max(found.distance), 4),
        "action": plain_action(zip(found.axes, *found.actions, strict=True)),
        "first": found.sentences[0],
        "second": found.sentences[1],
    }
