"""Commands about the reasons of an agent's action, beside those that only show them."""

from collections.abc import Mapping
from dataclasses import asdict
from functools import partial
from typing import Any

from ai4u_edu.explain.what_if import WhatIf
from ai4u_edu.panel.answers import Answer
from ai4u_edu.panel.commands.handler import Handler
from ai4u_edu.panel.messages import play as m
from ai4u_edu.panel.messages.base import Command
from ai4u_edu.panel.page import Page


async def _what_if(page: Page, command: m.AskWhatIf) -> Answer:
    changes = {(each.key, each.index): each.value for each in command.changes}
    ask = partial(page.context.viewer.explainer.what_if, page.view.agent, changes)
    return Answer(more=_plain(await page.in_thread(ask)))


def _plain(found: WhatIf) -> dict[str, Any]:
    return {
        "dials": [asdict(each) for each in found.dials],
        "action": [
            {
                "name": axis.name.replace("_", " "),
                "low": axis.low,
                "high": axis.high,
                "has_effect": axis.has_effect,
                "now": round(now, 4),
                "then": round(then, 4),
            }
            for axis, now, then in zip(found.axes, found.now, found.then, strict=True)
        ],
    }


HANDLERS: Mapping[type[Command], Handler] = {m.AskWhatIf: _what_if}
"""Handlers by the type of their command."""
