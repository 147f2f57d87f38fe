"""Commands that run, pause and reset the world."""

import math
from collections.abc import Mapping
from typing import Annotated, Literal

from msgspec import Meta

from ai4u_edu.page.messages import PageCommand
from ai4u_edu.page.panel.answers import Answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.page import Page
from ai4u_edu.page.server.run_commands import RUN_COMMANDS


async def _run(page: Page, command: PageCommand) -> Answer:
    """Carry out a command that pages without a panel may send, too."""
    run = RUN_COMMANDS[type(command)]
    await page.result(run.submit(page.context.runner, command))
    return Answer(run.answer(command))


class Tick(PageCommand, tag="tick"):
    """Pause, and tick once."""


async def _tick(page: Page, _command: Tick) -> Answer:
    runner = page.context.runner
    runner.pause()
    await page.result(runner.step())
    return Answer()


class Decision(PageCommand, tag="decision"):
    """Pause, and run until the agent's decision is over."""


async def _decision(page: Page, _command: Decision) -> Answer:
    runner = page.context.runner
    runner.pause()
    await page.result(runner.step_decision(page.view.agent))
    return Answer()


class SetSpeed(PageCommand, tag="speed"):
    """Set the time scale; 1 is real time."""

    speed: Annotated[float, Meta(gt=0, le=1000)] | Literal["max"]


async def _speed(page: Page, command: SetSpeed) -> Answer:
    speed = math.inf if isinstance(command.speed, str) else command.speed
    await page.result(page.context.runner.scale_time(speed))
    return Answer()


HANDLERS: Mapping[type[PageCommand], Handler] = {
    **dict.fromkeys(RUN_COMMANDS, _run),
    Tick: _tick,
    Decision: _decision,
    SetSpeed: _speed,
}
"""Handlers by the type of their command."""
