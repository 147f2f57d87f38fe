"""What a page asks for reaches the runner; what a page makes up does not."""

import asyncio
import math
from collections.abc import Iterator
from typing import Any

import pytest

from ai4u_edu.runner import Runner
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.controls import Controls
from tests.viewer.pages import Page, page, until


@pytest.fixture
def controls(viewer: Viewer) -> Controls:
    (controls,) = (each._part for each in viewer._parts if isinstance(each._part, Controls))
    return controls


@pytest.fixture
def here(viewer: Viewer, runner: Runner) -> Iterator[Page]:
    runner.start()
    viewer.start()
    with page(viewer) as here:
        until(lambda: viewer._views)
        yield here
    runner.stop()


def test_pause_and_resume(here: Page, controls: Controls, runner: Runner) -> None:
    here.change(controls._time, "Pause")
    until(lambda: runner.latest.paused)
    until(lambda: "Resume" in controls._time.options)
    here.change(controls._time, "Resume")
    until(lambda: not runner.latest.paused)
    until(lambda: "Pause" in controls._time.options)


def test_step_pauses_and_lets_one_tick_pass(here: Page, controls: Controls, runner: Runner) -> None:
    here.change(controls._time, "Pause")
    until(lambda: runner.latest.paused)
    tick = runner.latest.tick
    here.change(controls._time, "Step")
    until(lambda: runner.latest.tick == tick + 1)
    assert runner.latest.paused


def test_reset_begins_an_episode(here: Page, controls: Controls, runner: Runner) -> None:
    here.change(controls._time, "Reset")
    until(lambda: runner.latest.episode == 2)
    until(lambda: controls._seed.value == runner.latest.seed)


def test_a_seed_that_is_typed_in_counts_once_it_is_sent(
    here: Page, controls: Controls, runner: Runner
) -> None:
    here.change(controls._seed, 77)
    until(lambda: controls._seed.value == 77)
    assert runner.latest.episode == 1
    here.submit(controls._form)
    until(lambda: runner.latest.episode == 2)
    assert runner.latest.seed == 77


def test_a_refused_seed_is_told_to_who_asked(
    here: Page, controls: Controls, runner: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[str] = []
    monkeypatch.setattr(
        "viser.ClientHandle.add_notification",
        lambda _client, title, body, **_options: told.append(body),
    )
    here.change(controls._seed, -5)
    until(lambda: controls._seed.value == -5)
    here.submit(controls._form)
    until(lambda: told)
    assert "whole number >= 0" in told[0]


def test_the_speed_can_be_chosen(here: Page, controls: Controls, runner: Runner) -> None:
    here.change(controls._speed, "2x")
    until(lambda: runner.latest.time_scale == 2.0)


def test_a_speed_that_is_set_elsewhere_is_shown(
    here: Page, controls: Controls, runner: Runner
) -> None:
    runner.scale_time(3.0)
    until(lambda: controls._speed.value == "3x")
    runner.scale_time(math.inf)
    until(lambda: controls._speed.value == "as fast as it goes")
    assert runner.latest.time_scale == math.inf  # showing it must not ask for it


@pytest.mark.parametrize("made_up", ["Explode", "", "1e999x"])
def test_what_is_made_up_is_ignored(
    here: Page, controls: Controls, runner: Runner, made_up: str
) -> None:
    before = (runner.latest.episode, runner.latest.time_scale)
    here.change(controls._time, made_up)
    here.change(controls._speed, made_up)
    here.change(controls._camera, made_up)
    here.change(controls._shown, False)
    until(lambda: not controls._rays.shown)
    assert (runner.latest.episode, runner.latest.time_scale) == before
    assert not runner.latest.paused


def test_follow_and_back(here: Page, controls: Controls, viewer: Viewer) -> None:
    (view,) = viewer._views.values()
    here.change(controls._camera, "Follow")
    until(lambda: view._followed == "robot")
    here.change(controls._camera, "Whole arena")
    until(lambda: view._followed == "")


def test_a_command_of_nobody_is_no_error(controls: Controls) -> None:
    event: Any = type("Event", (), {"client": None, "client_id": None, "target": controls._camera})
    asyncio.run(controls._on_camera(event))
