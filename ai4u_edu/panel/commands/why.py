"""Commands about the reasons of an agent's action, beside those that only show them."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from functools import partial
from typing import Any

from ai4u_edu.explain.elsewhere import Elsewhere, Pose
from ai4u_edu.explain.sentence import Axis
from ai4u_edu.explain.what_if import WhatIf
from ai4u_edu.panel.answers import Answer
from ai4u_edu.panel.commands.handler import Handler
from ai4u_edu.panel.messages import play as m
from ai4u_edu.panel.messages.base import Command
from ai4u_edu.panel.page import Page


async def _what_if(page: Page, command: m.AskWhatIf) -> Answer:
    changes = {(each.key, each.index): each.value for each in command.changes}
    ask = partial(page.context.explanations.explainer.what_if, page.view.agent, changes)
    return Answer(more=_plain(await page.in_thread(ask)))


async def _elsewhere(page: Page, command: m.AskElsewhere) -> Answer:
    x, y, degrees = command.x, command.y, command.heading_deg
    asked = None
    if x is not None and y is not None and degrees is not None:
        asked = Pose(x, y, math.radians(degrees))
    trial = page.context.explanations.pose_trial
    found = await page.in_thread(partial(trial.at, page.view.agent, asked))
    page.view.show_elsewhere(found)
    return Answer(more=_plain_elsewhere(found))


async def _hide_elsewhere(page: Page, _command: m.HideElsewhere) -> Answer:
    page.view.show_elsewhere(None)
    return Answer()


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


HANDLERS: Mapping[type[Command], Handler] = {
    m.AskWhatIf: _what_if,
    m.AskElsewhere: _elsewhere,
    m.HideElsewhere: _hide_elsewhere,
}
"""Handlers by the type of their command."""
