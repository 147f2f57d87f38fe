"""Each mission has a solution that passes; wrong ways do not, and chance hardly ever does."""

import contextlib
import math
import random
import re
import zlib

import numpy as np
import pytest

from ai4u_edu.agent import BasicAgent
from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.built import BUILT, PAGE_HINTS, judge_built
from ai4u_edu.lessons.calls import JUDGES, starting_text
from ai4u_edu.lessons.course import lesson
from ai4u_edu.lessons.exercise import find
from ai4u_edu.missions.checks import Chooses, Opens, Reads, Solves
from ai4u_edu.missions.mission import (
    CONTROLS,
    ISLANDS,
    LIBRARY,
    library_missions,
    read_mission,
)
from ai4u_edu.page.panel.block_words import BLOCK_WORDS
from ai4u_edu.page.panel.field_hints import FIELD_LABELS
from ai4u_edu.program import ProgramError
from ai4u_edu.scenes import Scene
from tests.missions.doing import Action, Doing
from tests.missions.solutions import (
    SOLUTIONS,
    STOP,
    TARGET,
    TOUCH,
    WRONG_ROBOTS,
    add_bodies,
    add_reward,
    change_agent,
    earn_stars,
    hungry,
    move,
    near_rays,
    program,
    thing,
    to,
)

MISSIONS = library_missions().by_name
CHANCE = random.Random(
    zlib.crc32(b"".join(path.read_bytes() for path in sorted(LIBRARY.glob("*.yaml"))))
)
DRAWN = CHANCE.sample(sorted(MISSIONS), max(1, len(MISSIONS) // 10))
"""One in ten, which are others after a change of any."""
NOT_BY_CHANCE = [
    name
    for name, mission in MISSIONS.items()
    if mission.island in ("Sense", "Think", "Code", "Compete")
]
CHANCE_STARTS, MOST_BY_CHANCE, FEW_STARTS = 100, 2, 10
CHANCE_DECISIONS = 720
"""A minute, as long as a hasty person tries."""
HELD_DECISIONS = 12
"""Decisions for which a random driver holds its keys."""
KEYS = [(forward, turn) for forward in (-1, 0, 1) for turn in (-1, 0, 1)]


def drawn(names: list[str]) -> list[object]:
    return [
        pytest.param(name, marks=() if name in DRAWN else pytest.mark.nightly) for name in names
    ]


def test_each_mission_is_as_a_file_of_a_teacher_has_to_be() -> None:
    assert len(MISSIONS) >= 40
    for path in sorted(LIBRARY.glob("*.yaml")):
        mission = read_mission(path.read_text(encoding="utf-8"), path.name)
        assert 3 <= mission.minutes <= 8
        assert mission == MISSIONS[path.stem]
    assert list(SOLUTIONS) == list(MISSIONS)
    assert len(WRONG_ROBOTS) == len(BUILT)


def test_the_words_of_the_course_are_met() -> None:
    text = " ".join(step.done for mission in MISSIONS.values() for step in mission.steps)
    for word in ("body", "percept", "action", "decision cycle", "reward", "episode", "policy"):
        assert f"*{word}*" in text


def test_python_has_as_many_as_blocks() -> None:
    islands = [mission.island for mission in MISSIONS.values()]
    assert islands.count("Code") >= islands.count("Think")
    assert set(islands) == set(ISLANDS) - {"My class"}


def test_the_map_goes_from_island_to_island() -> None:
    islands = [MISSIONS[name].island for name in MISSIONS]
    assert islands == sorted(islands, key=ISLANDS.index)
    missions = library_missions()
    assert missions.after("drive-1") == "drive-2"
    assert missions.after("drive-9") == "sense-1"
    assert missions.after("compete-8") == ""


@pytest.mark.parametrize("name", drawn(list(MISSIONS)))
@pytest.mark.parametrize("seed", [1, 2])
def test_its_solution_passes(name: str, seed: int) -> None:
    do = Doing(name, seed)
    SOLUTIONS[name](do)
    assert do.is_done, (do.run.index, do.run.words, do.run.hint)


@pytest.mark.parametrize("name", drawn([name for name, each in MISSIONS.items() if each.stars]))
def test_each_of_its_stars_can_be_earned(name: str) -> None:
    do = Doing(name, 3)
    earn_stars(do)
    assert all(do.run.stars), (do.run.stars, [star.say for star in do.run.mission.stars])


@pytest.mark.parametrize(("name", "seed"), [("think-2", 4)])
def test_what_is_right_gets_no_hint(name: str, seed: int) -> None:
    do = Doing(name, seed)
    SOLUTIONS[name](do)
    assert (do.is_done, do.run.hints) == (True, 0)


def test_whoever_is_pushed_back_has_not_backed_up() -> None:
    do = Doing("drive-3", 7)
    before = do.agent.body.position
    do.drive(lambda _: STOP, 90)
    assert math.dist(do.agent.body.position, before) > 0.6
    assert (do.run.index, do.run.is_step_done) == (0, False)


@pytest.mark.parametrize("seed", [0, 15, 17, 24])
def test_the_way_to_the_block_pays_often_enough_before_it_is_touched(seed: int) -> None:
    do = Doing("drive-8", seed)
    assert do.drive(to("block", 0.5), 60)
    assert "block" not in do.agent.view.contacts(do.agent.body)


def test_a_car_that_is_only_partly_in_the_bay_is_told_so() -> None:
    do = Doing("drive-6")
    do.run.begin(2)
    bay = do.agent.view.areas["bay"]
    do.agent.body.move_to(bay.x + 0.6, bay.y, heading=math.pi / 2)
    do.drive(lambda _: STOP, 30)
    assert do.run.hint.startswith("Not yet: all of the car")


def test_a_robot_that_has_eaten_too_much_is_told_so() -> None:
    do = Doing("sense-6")
    do.run.begin(1)
    assert do.drive(hungry, 600)
    do.drive(lambda _: STOP, 20)
    assert do.run.hint.startswith("Its energy is above 0.8")


@pytest.mark.parametrize("name", drawn(list(MISSIONS)))
def test_wrong_ways_do_not_pass(name: str) -> None:
    still = Doing(name)
    open_all(still)
    still.drive(lambda _: STOP, CHANCE_DECISIONS, through=True)
    assert not still.is_done

    ahead = Doing(name)
    open_all(ahead)
    ahead.drive(move(1, 0), CHANCE_DECISIONS, through=True)
    assert not ahead.is_done
    if all(isinstance(step.check, Solves | Chooses | Opens) for step in MISSIONS[name].steps):
        return  # in place of another driver, wrong answers are tried below

    other = Doing(name, driver="controller")
    SOLUTIONS[name](other)
    assert not other.is_done


EXERCISES = {name: mission for name, mission in MISSIONS.items() if mission.exercise}
FUNCTIONS = [name for name, mission in EXERCISES.items() if mission.exercise in JUDGES]


@pytest.mark.parametrize("name", EXERCISES)
def test_an_exercise_says_a_sentence_of_its_notebook(name: str) -> None:
    lines = lesson(EXERCISES[name].exercise[:2]).path.read_text(encoding="utf-8")
    text = plain_text(re.sub(r"^# ?", "", lines, flags=re.MULTILINE))
    assert any(plain_text(step.say) in text for step in EXERCISES[name].steps)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_function_to_begin_with_does_not_pass(name: str) -> None:
    exercise = EXERCISES[name].exercise
    assert find(exercise).title == EXERCISES[name].title
    do = Doing(name)
    do.solve(starting_text(exercise))
    assert not do.is_done


def plain_text(text: str) -> str:
    return " ".join(re.sub(r"[*`]|^- ", "", text, flags=re.MULTILINE).split())


@pytest.mark.parametrize("name", FUNCTIONS)
def test_wrong_functions_of_an_exercise_do_not_pass(name: str) -> None:
    answers = answers_to(EXERCISES[name].exercise)
    assert len(answers.wrong) >= 3
    for answer in answers.all:
        if "numpy" in answer.code:
            continue  # the page has none
        do = Doing(name)
        with contextlib.suppress(ProgramError):  # some of them fail, in the page as here
            do.solve("import math\n" + answer.code)
        assert do.is_done == answer.is_right, answer.name


DRIVEN = [name for name in EXERCISES if SOLUTIONS[name] is program]


@pytest.mark.parametrize("name", drawn(DRIVEN))
def test_wrong_programs_of_an_exercise_do_not_pass(name: str) -> None:
    failed = []
    for answer in answers_to(EXERCISES[name].exercise).wrong:
        if answer.hint == "endless":
            continue  # a page stops it; here it would go on for ever
        do = Doing(name)
        program(do, answer.code)
        failed += [] if do.is_done else [answer.name]
    assert len(failed) >= 3, failed


@pytest.mark.parametrize("name", WRONG_ROBOTS)
def test_wrong_robots_of_an_exercise_do_not_pass(name: str) -> None:
    do = Doing(name)
    open_all(do)
    do.check()
    assert not do.is_done
    assert do.run.words
    for kinds in WRONG_ROBOTS[name]:
        change_agent(do, **kinds)
        assert not do.is_done, kinds


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("build-7", "The *speed* of *Drive and jump* is what the number 1 stands for."),
        ("build-9", "Press *Reward*: you need *Reach the target* for the box, and *Fall*."),
    ],
)
def test_hints_on_a_robot_are_in_the_words_of_the_page(name: str, hint: str) -> None:
    scene = Scene(Doing(name).scene)
    assert judge_built(MISSIONS[name].exercise, lambda: scene.build().agents[0]).hint == hint


@pytest.mark.parametrize("exercise", PAGE_HINTS)
def test_hints_of_the_page_are_for_mistakes_that_a_judge_finds(exercise: str) -> None:
    assert set(PAGE_HINTS[exercise]) <= set(find(exercise).hints)


@pytest.mark.parametrize("seed", range(6))
def test_taps_of_a_key_are_fine_enough_to_face_a_thing(seed: int) -> None:
    """One decision of a held key turns by 7 degrees."""
    do = Doing("sense-5", seed)
    for aside in (0.0, math.pi / 2):
        index = do.run.index

        def tap(agent: BasicAgent, aside: float = aside) -> Action:
            ahead, left = agent.body.to_local(*agent.view["block"].position)
            angle = math.degrees(math.remainder(math.atan2(left, ahead) - aside, 2 * math.pi))
            turn = 0.0 if abs(angle) < 3.6 else math.copysign(0.6, -angle)
            return move(0, turn)(agent)

        do.drive(tap, 200)
        assert do.run.index == index + 1


@pytest.mark.parametrize("seed", range(4))
def test_keys_are_slow_enough_to_drive_along_a_wall(seed: int) -> None:
    """A held key drives at 2.4 m/s, and the walls of the maze are short."""
    do = Doing("sense-2", seed)
    do.run.begin(2)

    def hold(agent: BasicAgent) -> Action:
        near = near_rays(agent)
        if near["ahead"] < 0.9:
            return move(0, -0.6)(agent)
        aside = near["right"] - 0.75
        return move(0.8, math.copysign(0.6, aside) if abs(aside) > 0.12 else 0)(agent)

    assert do.drive(hold, 300)


def test_a_way_that_has_to_be_chosen_is_waited_for() -> None:
    for name, mission in MISSIONS.items():
        for step in mission.steps:
            ways = [way for way in ("Blocks", "Python") if f"choose *{way}*" in step.say]
            if ways and isinstance(step.check, Opens):
                assert step.check.way == ways[0].lower(), name


def test_what_lies_in_a_tab_has_the_way_there_lit() -> None:
    for name, mission in MISSIONS.items():
        for step in mission.steps:
            if "Sensors" in step.light:
                assert step.light == ["Details", "Drive", "Sensors"], (
                    name
                )  # else it is not scrolled to


def test_missions_call_what_is_built_as_the_page_does() -> None:
    known = {*CONTROLS, *FIELD_LABELS.values(), *(words.title for words in BLOCK_WORDS.values())}
    known |= {"Sensor", "Reward", "W"}
    for name, mission in MISSIONS.items():
        if mission.island != "Build" or mission.exercise:
            continue
        bold = re.findall(r"\*([^*]+)\*", " ".join(step.say for step in mission.steps))
        assert {word.replace("…", "...") for word in bold} <= known, name


CHOICES = {
    name: mission
    for name, mission in MISSIONS.items()
    if all(isinstance(step.check, Chooses) for step in mission.steps)
}


@pytest.mark.parametrize("name", CHOICES)
def test_wrong_choices_do_not_pass(name: str) -> None:
    do = Doing(name)
    for step in CHOICES[name].steps:
        assert isinstance(step.check, Chooses)
        index = do.run.index
        for option in step.check.options:
            if option != step.check.right:
                do.answer(option)
        assert (do.run.index, do.is_done) == (index, False)
        do.answer(step.check.right)
    assert do.is_done


def test_a_reward_on_the_way_is_not_the_targets() -> None:
    do = Doing("build-6")
    add_bodies(do, *(thing("wall", number, (2, 2 * number - 6)) for number in range(6)))
    add_bodies(do, thing("target", 1, (-4, 0)))
    add_reward(do, **TOUCH)
    add_reward(do, type="MinDistReward", target=TARGET)
    before = do.run.index
    do.drive(to(TARGET), 20)
    assert do.agent.ledger.terms["min_dist"] > 0
    assert do.run.index == before
    assert do.drive(to(TARGET))


def test_chance_does_not_pass_in_a_few_starts() -> None:
    name = CHANCE.choice(NOT_BY_CHANCE)
    assert sum(by_chance(name, seed) for seed in range(FEW_STARTS)) <= 1


@pytest.mark.nightly
@pytest.mark.parametrize("name", NOT_BY_CHANCE)
def test_chance_hardly_ever_passes(name: str) -> None:
    passed = sum(by_chance(name, seed) for seed in range(CHANCE_STARTS))
    assert passed <= MOST_BY_CHANCE


def by_chance(name: str, seed: int) -> bool:
    """Hold random keys for a minute, with all tabs open and a random answer; return the result."""
    do, rng = Doing(name, seed), np.random.default_rng(seed)
    held: Action = STOP

    def policy(agent: object) -> Action:
        nonlocal held
        if do.decisions % HELD_DECISIONS == 0:
            forward, turn = KEYS[rng.integers(len(KEYS))]
            held = {"move": [forward, turn, 0, 0]}
        return held

    while do.decisions < CHANCE_DECISIONS and not do.is_done:
        open_all(do)
        if isinstance(do.run.step.check, Solves):
            return False  # keys write no function
        if isinstance(do.run.step.check, Reads):
            do.answer(f"{rng.uniform(0, 1):.2f}")
            if not do.is_done:
                return False
        do.drive(policy, CHANCE_DECISIONS - do.decisions)
    return do.is_done


def open_all(do: Doing) -> None:
    """Open whatever tab the step asks for."""
    for tab in ("drive", "build", "code", "teach"):
        do.open(tab)
    for way in ("python", "blocks"):
        do.open("code", way)


def test_sensors_that_are_turned_off_do_not_count() -> None:
    do = Doing("build-10")
    off = {"type": "TouchSensor", "target": "box", "is_active": False}
    seen = {"type": "OrientationSensor", "target": "box", "visibility_test": True}
    bearing = {"type": "BearingSensor", "target": "box"}
    change_agent(do, sensors=[bearing, seen, off])
    assert do.is_done
    on = Doing("build-10")
    change_agent(on, sensors=[bearing, seen, {**off, "is_active": True}])
    assert not on.is_done


def test_rays_that_miss_are_told_in_words_of_the_page() -> None:
    do = Doing("build-10")
    rays = {"type": "LinearRayCastingSensor", "number_of_rays": 10, "field_of_view": 360}
    sensors = [{"type": kind, "target": "box"} for kind in ("BearingSensor", "OrientationSensor")]
    do.change(agents=({**do.scene.agents[0], "sensors": [*sensors, rays]},))
    judged = judge_built("04.4", lambda: Scene(do.scene).build().agents[0])
    assert judged.text.endswith("they need a wider field of view, or more rays.")
    assert "*number of rays*" in judged.hint
