"""Commands that run, pause and reset the world."""

import math
from collections.abc import Mapping

from ai4u_edu.page.panel.answers import Answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.messages import play as m
from ai4u_edu.page.panel.messages.base import Command
from ai4u_edu.page.panel.page import Page


async def _pause(page: Page, _command: m.Pause) -> Answer:
    await page.result(page.context.runner.pause())
    return Answer()


async def _resume(page: Page, _command: m.Resume) -> Answer:
    await page.result(page.context.runner.resume())
    return Answer()


async def _tick(page: Page, _command: m.Tick) -> Answer:
    runner = page.context.runner
    runner.pause()
    await page.result(runner.step())
    return Answer()


async def _decision(page: Page, _command: m.Decision) -> Answer:
    runner = page.context.runner
    runner.pause()
    await page.result(runner.step_decision(page.view.agent))
    return Answer()


async def _try_again(page: Page, _command: m.TryAgain) -> Answer:
    await page.result(page.context.runner.try_again())
    return Answer("The same start again.")


async def _new_start(page: Page, _command: m.NewStart) -> Answer:
    await page.result(page.context.runner.new_start())
    return Answer("A new start.")


async def _seed(page: Page, command: m.SetSeed) -> Answer:
    await page.result(page.context.runner.reset(int(command.seed)))
    return Answer(f"Started with seed {command.seed}.")


async def _lock_seed(page: Page, command: m.LockSeed) -> Answer:
    await page.result(page.context.runner.lock_seed(command.on))
    return Answer("Each reset repeats this start." if command.on else "Resets draw new starts.")


async def _speed(page: Page, command: m.SetSpeed) -> Answer:
    speed = math.inf if isinstance(command.speed, str) else command.speed
    await page.result(page.context.runner.scale_time(speed))
    return Answer()


HANDLERS: Mapping[type[Command], Handler] = {
    m.Pause: _pause,
    m.Resume: _resume,
    m.Tick: _tick,
    m.Decision: _decision,
    m.TryAgain: _try_again,
    m.NewStart: _new_start,
    m.SetSeed: _seed,
    m.LockSeed: _lock_seed,
    m.SetSpeed: _speed,
}
"""Handlers by the type of their command."""
