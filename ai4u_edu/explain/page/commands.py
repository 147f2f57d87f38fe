"""Commands about the reasons of an agent's action, and what they paid."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from functools import partial
from typing import Any

import numpy as np

from ai4u_edu.explain import RewardTerms, reward_terms
from ai4u_edu.explain.elsewhere import Elsewhere, Pose, PoseTrial
from ai4u_edu.explain.live import LiveExplainer
from ai4u_edu.explain.live_maps import MapChoice
from ai4u_edu.explain.page import messages as m
from ai4u_edu.explain.page.choice import OPTION, choice_of
from ai4u_edu.explain.sentence import Axis
from ai4u_edu.explain.what_if import WhatIf
from ai4u_edu.page.messages import PageCommand
from ai4u_edu.page.panel.answers import Answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.commands.past import chosen_episode
from ai4u_edu.page.panel.page import Page


class WhyCommands:
    """Handlers of the commands that ask about one world's agents.

    Args:
        explainer: explains the agents' actions.
        pose_trial: tries an agent at another place.
    """

    def __init__(self, explainer: LiveExplainer, pose_trial: PoseTrial) -> None:
        self._explainer, self._pose_trial = explainer, pose_trial
        self.handlers: Mapping[type[PageCommand], Handler] = {
            m.ShowWhy: self._why,
            m.ShowMaps: self._maps,
            m.AskWhatIf: self._what_if,
            m.AskElsewhere: self._elsewhere,
            m.HideElsewhere: self._hide_elsewhere,
            m.AskPaid: _paid,
        }
        """Handlers by the type of their command."""

    async def _why(self, page: Page, command: m.ShowWhy) -> Answer:
        choice = choice_of(page.view)._replace(is_why_shown=command.on)
        page.view.choose(OPTION, choice, "why")
        return Answer()

    async def _maps(self, page: Page, command: m.ShowMaps) -> Answer:
        maps = MapChoice(command.field, command.values, command.facing)
        page.view.choose(OPTION, choice_of(page.view)._replace(maps=maps), "maps")
        return Answer()

    async def _what_if(self, page: Page, command: m.AskWhatIf) -> Answer:
        changes = {(each.key, each.index): each.value for each in command.changes}
        ask = partial(self._explainer.what_if, page.view.agent, changes)
        return Answer(more=_plain(await page.in_thread(ask)))

    async def _elsewhere(self, page: Page, command: m.AskElsewhere) -> Answer:
        x, y, degrees = command.x, command.y, command.heading_deg
        asked = None
        if x is not None and y is not None and degrees is not None:
            asked = Pose(x, y, math.radians(degrees))
        found = await page.in_thread(partial(self._pose_trial.at, page.view.agent, asked))
        page.view.choose(OPTION, choice_of(page.view)._replace(elsewhere=found))
        return Answer(more=_plain_elsewhere(found))

    async def _hide_elsewhere(self, page: Page, _command: m.HideElsewhere) -> Answer:
        page.view.choose(OPTION, choice_of(page.view)._replace(elsewhere=None))
        return Answer()


async def _paid(page: Page, _command: m.AskPaid) -> Answer:
    frame_cache = chosen_episode(page)
    told = reward_terms(frame_cache.episode, frame_cache.record.id)
    count = len(told.amounts)
    places = np.linspace(0, count - 1, min(count, 300)).round().astype(int)
    sums = told.amounts.cumsum(axis=0)[places]
    return Answer(
        more={
            "terms": [
                {"term": name, "total": float(told.totals[index]), "curve": sums[:, index].tolist()}
                for index, name in enumerate(told.terms)
                if told.amounts[:, index].any()
            ],
            "moments": [{"step": step, "terms": _amounts(told, step)} for step in told.moments(5)],
        }
    )


def _amounts(told: RewardTerms, step: int) -> list[dict[str, Any]]:
    amounts = zip(told.terms, told.amounts[step].tolist(), strict=True)
    return [{"term": name, "amount": amount} for name, amount in amounts if amount]


def _plain(found: WhatIf) -> dict[str, Any]:
    rows = zip(found.axes, found.now, found.then, strict=True)
    return {"dials": [asdict(each) for each in found.dials], "action": plain_action(rows)}


def _plain_elsewhere(found: Elsewhere) -> dict[str, Any]:
    then = found.now if found.then is None else found.then
    return {
        "x": round(found.pose.x, 3),
        "y": round(found.pose.y, 3),
        "heading_deg": round(math.degrees(found.pose.heading), 1),
        "can_stand": found.then is not None,
        "action": plain_action(zip(found.axes, found.now, then, strict=True)),
    }


def plain_action(rows: Iterable[tuple[Axis, float, float]]) -> list[dict[str, Any]]:
    """Return two actions for the page: each number with its axis."""
    return [
        {
            "name": axis.name.replace("_", " "),
            "low": axis.low,
            "high": axis.high,
            "has_effect": axis.has_effect,
            "now": round(now, 4),
            "then": round(then, 4),
        }
        for axis, now, then in rows
    ]
