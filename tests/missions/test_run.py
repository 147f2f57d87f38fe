"""A mission that is being done: steps, hints, stars, and who drives."""

from dataclasses import replace
from typing import Literal

import pytest

from ai4u_edu import Scene
from ai4u_edu.locale import Text
from ai4u_edu.missions.events import Driver, Event, SeenPage
from ai4u_edu.missions.mission import library_missions, read_mission
from ai4u_edu.missions.option import mission_part
from ai4u_edu.missions.run import HINT_DECISIONS, MissionRun
from tests.missions.test_checks import STILL, moved

TEXT = """\
title: Test
scene: maze
steps:
  - say: Drive *2 metres*.
    by: keys
    check: {type: drives, metres: 2}
    done: You drove.
    hints:
      - when: {type: ends, outcome: fell}
        say: It fell.
  - say: Open the code.
    check: {type: opens, tab: code}
stars:
  - say: Reach the exit.
    check: {type: reaches_goal}
"""


@pytest.fixture
def run() -> MissionRun:
    return MissionRun(read_mission(TEXT, "test.yaml"))


def test_steps_are_done_one_after_another(run: MissionRun) -> None:
    for each in moved(0, 1):
        run.see(each)
    assert (run.is_step_done, run.words) == (False, "1.0 of 2 m")
    version = run.version
    run.see(next(moved(2.5)))
    assert (run.is_step_done, run.is_done, run.version > version) == (True, False, True)
    run.begin(1)
    assert (run.index, run.is_step_done) == (1, False)
    run.see(SeenPage("code"))
    assert run.is_done
    assert run.stars == [True, False]


def test_what_is_open_already_counts_for_the_next_step(run: MissionRun) -> None:
    run.see(SeenPage("code"))
    run.begin(1)
    assert run.is_done


TWO_STEPS = """\
title: Test
scene: maze
steps:
  - say: Drive.
    by: keys
    check: {type: drives, metres: 2}
  - say: Reach it.
    by: keys
    check: {type: reaches_goal}
"""


@pytest.mark.parametrize(("others", "is_done"), [((), True), (("program",), False)])
def test_an_episode_that_was_driven_from_its_start_counts_for_the_next_step(
    others: tuple[Driver, ...], is_done: bool
) -> None:
    run = MissionRun(read_mission(TWO_STEPS, "test.yaml"))
    run.see(replace(STILL, step=1))
    for step, driver in enumerate(("keys", *others, "keys"), 2):
        run.see(replace(STILL, step=step, driver=driver))
    run.begin(1)
    run.see(replace(STILL, step=8))
    run.see(replace(STILL, step=9, outcome="goal"))
    assert run.is_done == is_done


def test_a_goal_before_a_step_does_not_count_for_it() -> None:
    run = MissionRun(read_mission(TWO_STEPS, "test.yaml"))
    for each in (replace(STILL, step=1), replace(STILL, step=2, outcome="goal")):
        run.see(each)
    run.begin(1)
    run.see(replace(STILL, step=2, outcome="goal"))
    assert not run.is_done


def test_a_step_beyond_the_last_one_is_the_last_one(run: MissionRun) -> None:
    run.begin(99)
    assert run.index == 1


def test_stars_are_earned_before_and_after_the_last_step(run: MissionRun) -> None:
    goal: list[Event] = [STILL, replace(STILL, step=5, outcome="goal")]
    for each in goal:
        run.see(each)
    assert run.stars == [False, False]
    run.begin(1)
    run.see(SeenPage("code"))
    assert run.stars == [True, True]


def test_a_hint_is_shown_until_the_step_is_done(run: MissionRun) -> None:
    run.see(replace(STILL, step=4, outcome="fell"))
    assert run.hint == "It fell."
    for each in moved(0, 3, episode=2):
        run.see(each)
    assert (run.is_step_done, run.hint) == (True, "")


def test_a_hint_about_one_episode_goes_when_another_ends_without_it(run: MissionRun) -> None:
    run.see(replace(STILL, step=4, outcome="fell"))
    run.see(replace(STILL, step=0, episode=2))
    assert run.hint == "It fell."
    version = run.version
    run.see(replace(STILL, step=9, episode=2, outcome="goal"))
    assert (run.hint, run.version > version) == ("", True)


def test_a_hint_goes_ten_seconds_after_it_was_right_last(run: MissionRun) -> None:
    for episode in (1, 2):
        run.see(replace(STILL, step=4, episode=episode, outcome="fell"))
        for step in range(HINT_DECISIONS):
            run.see(replace(STILL, step=step, episode=episode + 1))
        assert run.hint == "It fell."
    version = run.version
    run.see(replace(STILL, step=200, episode=3))
    assert (run.hint, run.version > version) == ("", True)


def test_a_hint_about_one_of_several_starts_stays_until_as_many_have_ended() -> None:
    text = TEXT.replace("{type: drives, metres: 2}", "{type: reaches_goal, times: 3, of: 3}")
    run = MissionRun(read_mission(text, "test.yaml"))

    def end(episode: int, outcome: Literal["goal", "fell", "time"]) -> str:
        begin = replace(STILL, episode=episode, seed=episode, step=0)
        run.see(begin)
        run.see(replace(begin, step=3, outcome=outcome))
        return run.hint

    hints = [end(1, "goal"), end(2, "fell"), end(3, "goal"), end(4, "time"), end(5, "time")]
    assert hints == ["", "It fell.", "It fell.", "It fell.", ""]


def test_a_hint_counts_once_in_ten_seconds(run: MissionRun) -> None:
    fell = replace(STILL, step=4, outcome="fell")
    for _ in range(5):
        run.see(fell)
    assert run.hints == 1
    for _ in range(HINT_DECISIONS):
        run.see(STILL)
    version = run.version
    run.see(fell)
    assert (run.hints, run.version > version) == (2, True)
    run.begin(1)
    assert run.hints == 0


def test_another_driver_does_not_count_and_is_told(run: MissionRun) -> None:
    for x in range(30):
        run.see(replace(STILL, x=float(x), speed=1.0, driver="program"))
    assert not run.is_step_done
    assert run.driver == (
        "A program is driving. This step is for *you*: let go of the program, or choose keys "
        "again, and drive."
    )
    assert isinstance(run.driver, Text)  # so it is told in the reader's language
    run.see(STILL)
    assert run.driver == ""


def test_a_network_that_drove_before_the_step_is_not_new() -> None:
    run = MissionRun(library_missions().get("teach-2"))
    old = replace(STILL, driver="network", network="networks/box_chase-1.onnx", speed=1.0)
    run.see(old)
    run.begin(1)
    for _ in range(100):
        run.see(old)
    text = "A network is driving. This step is for a *new* network: see *Learn* and *Practise*."
    assert (run.is_step_done, run.driver) == (False, text)
    for _ in range(60):
        run.see(replace(old, network="networks/box_chase-2.onnx"))
    assert (run.is_step_done, run.driver) == (True, "")


def test_in_another_scene_nothing_counts(run: MissionRun) -> None:
    run.see_scene(Scene.load("tag").description)
    assert (run.is_here, run.counts("0")) == (False, False)
    run.see_scene(Scene.load("maze").description)
    assert run.counts("0")
    run.is_watching = True
    assert not run.counts("0")


def test_a_page_shows_all_that_it_needs(run: MissionRun) -> None:
    missions = library_missions()
    part = mission_part("drive-1", MissionRun(missions.get("drive-1")), missions)
    assert (part.title, part.island, part.scene_title) == ("First drive", "Drive", "Box chase")
    assert (part.step, part.steps, part.light) == (0, 4, ("Keys",))
    assert part.next == "drive-2"
    assert [star.is_earned for star in part.stars] == [False, False, False]
    assert part.question is None
    reads = MissionRun(missions.get("sense-1"), 3)
    question = mission_part("sense-1", reads, missions).question
    assert question is not None
    assert question.options == []


def test_the_program_of_the_step_before_gets_no_hint() -> None:
    run = MissionRun(read_mission(TEXT.replace("by: keys", "by: program"), "test.yaml"))
    old = replace(STILL, driver="program")
    run.see(old)
    run.begin(0)
    run.see(replace(old, outcome="fell"))
    assert run.hint == ""
    run.see(replace(old, episode=2))
    run.see(replace(old, episode=2, outcome="fell"))
    assert run.hint == "It fell."


def test_a_first_program_that_goes_on_from_the_keys_gets_hints() -> None:
    run = MissionRun(read_mission(TEXT.replace("by: keys", "by: program"), "test.yaml"))
    run.see(replace(STILL, driver="keys"))
    run.begin(0)
    run.see(replace(STILL, driver="program", outcome="fell"))
    assert run.hint == "It fell."
