"""Commands about what one page shows; other pages have views of their own."""

from collections.abc import Mapping

from ai4u_edu.page.messages import Name, PageCommand
from ai4u_edu.page.panel.answers import Answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.page import Page
from ai4u_edu.page.panel.page_view import CameraMode


class ShowAgent(PageCommand, tag="agent"):
    """Show another agent."""

    agent: Name


async def _agent(page: Page, command: ShowAgent) -> Answer:
    agent = page.context.runner.sim.agent(command.agent)  # an error if there is none
    page.view.choose_agent(agent.id)
    return Answer()


class Camera(PageCommand, tag="camera"):
    """Put the camera somewhere."""

    mode: CameraMode


async def _camera(page: Page, command: Camera) -> Answer:
    page.view.choose_camera(command.mode)
    return Answer()


class ShowSensor(PageCommand, tag="sensor"):
    """Draw a sensor in the picture, or hide it."""

    key: Name
    on: bool


async def _sensor(page: Page, command: ShowSensor) -> Answer:
    page.view.show_sensor(command.key, command.on)
    return Answer()


class ShowTrail(PageCommand, tag="trail"):
    """Draw the agent's trail, or hide it."""

    on: bool


async def _trail(page: Page, command: ShowTrail) -> Answer:
    page.view.show_trail(command.on)
    return Answer()


class Dark(PageCommand, tag="dark"):
    """Draw the picture in dark colours, or light ones."""

    on: bool


async def _dark(page: Page, command: Dark) -> Answer:
    page.view.choose_dark(command.on)
    return Answer()


class ReduceMotion(PageCommand, tag="reduce_motion"):
    """Leave out motion that nothing in the world makes, or not."""

    on: bool


async def _reduce_motion(page: Page, command: ReduceMotion) -> Answer:
    page.view.reduce_motion(command.on)
    return Answer()


class PlayOpening(PageCommand, tag="opening"):
    """Open with a short tilt of the camera, or end it."""

    on: bool


async def _opening(page: Page, command: PlayOpening) -> Answer:
    if command.on:
        page.view.open()
    else:
        page.view.end_opening()
    return Answer()


HANDLERS: Mapping[type[PageCommand], Handler] = {
    ShowAgent: _agent,
    Camera: _camera,
    ShowSensor: _sensor,
    ShowTrail: _trail,
    Dark: _dark,
    ReduceMotion: _reduce_motion,
    PlayOpening: _opening,
}
"""Handlers by the type of their command."""
