"""Valid commands of a page reach the runner; forged ones do not."""

import math
from collections.abc import Iterator

import pytest

from ai4u_edu.runtime.runner import Runner
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.panel.controls import Controls
from ai4u_edu.viewer.panel.page_controls import PageControls, _Page
from ai4u_edu.viewer.scene.view import Mode
from tests.viewer.pages import Page, page, part_of, shown, until


@pytest.fixture
def controls(viewer: Viewer) -> Controls:
    (controls,) = (each.part for each in viewer.parts if isinstance(each.part, Controls))
    return controls


@pytest.fixture
def here(viewer: Viewer, runner: Runner) -> Iterator[Page]:
    runner.start()
    viewer.start()
    with page(viewer) as here:
        until(lambda: viewer.viewer_clients)
        yield here
    runner.stop()


def test_pause_and_resume(here: Page, controls: Controls, runner: Runner) -> None:
    here.change(controls.time_buttons, "Pause")
    until(lambda: runner.latest.paused)
    until(lambda: "Resume" in controls.time_buttons.options)
    here.change(controls.time_buttons, "Resume")
    until(lambda: not runner.latest.paused)
    until(lambda: "Pause" in controls.time_buttons.options)


@pytest.mark.parametrize(("button", "ticks"), [("Tick", 1), ("Decision", 5)])
def test_steps_pause_and_let_so_many_ticks_pass(
    here: Page, controls: Controls, runner: Runner, button: str, ticks: int
) -> None:
    runner.sim.agents[0].brain.skip_frame = 4
    here.change(controls.time_buttons, "Pause")
    until(lambda: runner.latest.paused)
    while runner.latest.agents[0].phase.tick % 5:
        runner.step().result(5)
    tick = runner.latest.tick
    here.change(controls.time_buttons, button)
    until(lambda: runner.latest.tick == tick + ticks)
    assert runner.latest.paused


def test_reset_begins_an_episode(here: Page, controls: Controls, runner: Runner) -> None:
    here.change(controls.time_buttons, "Reset")
    until(lambda: runner.latest.episode == 2)
    until(lambda: controls.seed.value == runner.latest.seed)


def test_a_seed_that_is_typed_in_counts_once_it_is_sent(
    here: Page, controls: Controls, runner: Runner
) -> None:
    here.change(controls.seed, 77)
    until(lambda: controls.seed.value == 77)
    assert runner.latest.episode == 1
    here.submit(controls.seed_form)
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
    here.change(controls.seed, -5)
    until(lambda: told)
    assert told == ["Seed: expected a whole number from 0 to 9007199254740991, got -5"]
    here.change(controls.seed, 7)
    until(lambda: controls.seed.value == 7)


def test_a_seed_that_browsers_do_not_count_exactly_is_told_in_words(
    here: Page, controls: Controls, runner: Runner
) -> None:
    runner.reset(2**60 + 1).result(5)
    until(lambda: controls.seed.label == "Seed (now 1152921504606846977)")
    assert controls.seed.value != 2**60
    runner.reset(2**53 - 1).result(5)
    until(lambda: controls.seed.value == 2**53 - 1)
    assert controls.seed.label == "Seed"


def test_the_speed_can_be_chosen(here: Page, controls: Controls, runner: Runner) -> None:
    here.change(controls.speed, "2x")
    until(lambda: runner.latest.time_scale == 2.0)


def test_a_speed_that_is_set_elsewhere_is_shown(
    here: Page, controls: Controls, runner: Runner
) -> None:
    runner.scale_time(3.0)
    until(lambda: controls.speed.value == "3x")
    runner.scale_time(math.inf)
    until(lambda: controls.speed.value == "as fast as it goes")
    assert runner.latest.time_scale == math.inf  # showing it must not ask for it


def test_the_fastest_speed_can_be_chosen(here: Page, controls: Controls, runner: Runner) -> None:
    here.change(controls.speed, "as fast as it goes")
    until(lambda: runner.latest.time_scale == math.inf)


@pytest.fixture
def camera(viewer: Viewer, here: Page) -> _Page:
    controls = part_of(viewer, PageControls)
    until(lambda: controls.pages)
    (own,) = controls.pages.values()
    return own


@pytest.mark.parametrize("made_up", ["Explode", "", "1e999x"])
def test_what_is_made_up_is_ignored(
    here: Page, camera: _Page, controls: Controls, runner: Runner, made_up: str
) -> None:
    before = (runner.latest.episode, runner.latest.time_scale)
    here.change(controls.time_buttons, made_up)
    here.change(controls.speed, made_up)
    here.change(camera.camera, made_up)
    here.change(camera.dark, True)
    until(lambda: camera.dark.value)
    assert (runner.latest.episode, runner.latest.time_scale) == before
    assert not runner.latest.paused


def test_the_camera_is_chosen_page_by_page(here: Page, camera: _Page, viewer: Viewer) -> None:
    (viewer_client,) = viewer.viewer_clients.values()
    for place, mode in enumerate(Mode, start=1):
        here.change(camera.camera, mode.value)
        until(lambda mode=mode: viewer_client.view.mode is mode)  # type: ignore[misc]
        until(lambda place=place: f'data-on="{place}"' in camera.mark.content)  # type: ignore[misc]


def test_one_page_is_dark_and_another_is_not(
    here: Page, camera: _Page, viewer: Viewer, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[tuple[object, object]] = []
    monkeypatch.setattr(
        "viser.GuiApi.configure_theme",
        lambda gui, **how: asked.append((gui._owner, how["dark_mode"])),
    )
    here.change(camera.dark, True)
    until(lambda: asked)
    (client,) = viewer.server.get_clients().values()
    assert asked == [(client, True)]


def test_who_likes_it_dark_has_it_dark_from_the_beginning(viewer: Viewer, runner: Runner) -> None:
    with page(viewer, dark=True):
        shown(viewer)
        (dark,) = part_of(viewer, PageControls).pages.values()
        assert dark.dark.value
        with page(viewer):
            until(lambda: len(viewer.server.get_clients()) == 2)
            shown(viewer)
            light = max(part_of(viewer, PageControls).pages.items())[1]
            assert not light.dark.value


def test_of_an_agent_that_decides_no_more_a_single_tick_passes(runner: Runner) -> None:
    agent = runner.sim.agents[0]
    agent.brain.skip_frame = 4
    agent.terminated = True
    runner.step_decision("0")
    runner.advance()
    assert runner.latest.tick >= 1
    tick = runner.sim.world.ticks
    runner.paused = True
    asked = runner.step_decision()
    runner._run_commands()
    assert asked.done()
    assert runner.sim.world.ticks == tick + 1
