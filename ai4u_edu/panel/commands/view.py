"""Commands about what one page shows; other pages have views of their own."""

from collections.abc import Mapping

from ai4u_edu.panel.answers import Answer
from ai4u_edu.panel.commands.handler import Handler
from ai4u_edu.panel.messages import play as m
from ai4u_edu.panel.messages.base import Command
from ai4u_edu.panel.page import Page


async def _agent(page: Page, command: m.ShowAgent) -> Answer:
    agent = page.context.runner.sim.agent(command.agent)  # an error if there is none
    page.view.choose_agent(agent.id)
    return Answer()


async def _camera(page: Page, command: m.Camera) -> Answer:
    page.view.choose_camera(command.mode)
    return Answer()


async def _sensor(page: Page, command: m.ShowSensor) -> Answer:
    page.view.show_sensor(command.key, command.on)
    return Answer()


async def _trail(page: Page, command: m.ShowTrail) -> Answer:
    page.view.show_trail(command.on)
    return Answer()


async def _dark(page: Page, command: m.Dark) -> Answer:
    page.view.choose_dark(command.on)
    return Answer()


async def _reduce_motion(page: Page, command: m.ReduceMotion) -> Answer:
    page.view.reduce_motion(command.on)
    return Answer()


HANDLERS: Mapping[type[Command], Handler] = {
    m.ShowAgent: _agent,
    m.Camera: _camera,
    m.ShowSensor: _sensor,
    m.ShowTrail: _trail,
    m.Dark: _dark,
    m.ReduceMotion: _reduce_motion,
}
"""Handlers by the type of their command."""
