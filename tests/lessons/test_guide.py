"""The tables of lessons/README.md: what they name of the AI4U guide is in the notebooks."""

import re
from collections.abc import Iterator
from functools import cache

import pytest

from ai4u_edu.agent.events import EVENTS
from ai4u_edu.lessons.course import course_folder, lessons

SEEN_AS = {
    "the events": "".join(f"(?=.*\\b{each}\\b)" for each in EVENTS),  # all of them
    "a Q-table on grid_world": "Q-table.*grid_world|grid_world.*Q-table",
    "installation": "ready",
    "installing": "ready",
    "the sample scene": "box_chase",
    "the first scene": "box_chase",
    "driving it by keys": "W A S D",
    "the parts of an agent": "BasicAgent",
    "the agent": "agent",
    "its parts": "five parts",
    "their kinds": "sensor",
    "perception keys": "perception_key",
    "stacked observations": "stacked_observations",
    "normalising": "normalized",
    "ray casting": "RayCastingSensor",
    "field of view": "field.of.view",
    "controllers": "controller",
    "codes": "group_code",
    "groups": "group_code",
    "actuators": "actuator",
    "what an action is": "action",
    "reward functions": "reward function",
    "the end of an episode": "cause_episode_to_end",
    "how an episode ends": "cause_episode_to_end",
    "training with Gymnasium": "Gymnasium",
    "a Python script": "connect\\(",
    "recorded demonstrations": "demonstration",
    "networks as ONNX files": "ONNX",
    "several agents": "agents",
    "homeostatic variables": "homeosta",
    "your own components": "class \\w+\\(Sensor\\)",
    "your own project": "project",
    "time-outs": "time-?out",
}
"""Regular expression by the topic in a table, where a notebook has other words for it."""
TERMS = {
    *("BasicAgent", "ControlRequestor", "LocalBrain", "RBMoveActuator", "OrientationSensor"),
    *("RemoteBrain", "protocol", "time-outs", "time scale"),
    *("training with Gymnasium", "Stable-Baselines3", "NeuralNetController"),
    *("the events", "add_reward", "DiscreteActuator", "search", "a Q-table on grid_world"),
    *("stacked observations", "normalising", "is_active", "resetable"),
    *("FloatArrayCompositeSensor", "StepSensor", "RewardSensor", "DoneSensor", "IDSensor"),
}
"""Terms of the guide that the tables must name."""


@cache
def words_of(number: str) -> str:
    """Return text and code of a notebook, without line breaks."""
    (one,) = (each for each in lessons() if each.number == number)
    return " ".join(" ".join(cell.source for cell in one.cells).split())


def rows() -> Iterator[tuple[str, list[str]]]:
    """Yield each row on the guide in the tables: its topics, and the numbers of its lessons."""
    for line in (course_folder() / "README.md").read_text(encoding="utf-8").splitlines():
        cells = [each.strip() for each in line.strip("|").split("|")]
        if len(cells) == 5 and (number := re.match(r"\d\d\b", cells[0])):
            yield cells[4], [number[0]]
        elif len(cells) == 2 and re.fullmatch(r"\d\d(, \d\d)*", cells[1]):
            yield cells[0], cells[1].split(", ")


def topics_of(text: str) -> list[str]:
    """Return the topics in a cell of a table.

    >>> topics_of("events: `on_reset` and a film, and its time; none")
    ['events', 'on_reset', 'a film', 'its time']
    """
    parts = re.split(r"[;:,]| and ", text.replace("`", ""))
    topics = [each.strip().removeprefix("and ") for each in parts]
    return [each for each in topics if each not in ("", "none")]


FOUND = {
    f"{'+'.join(numbers)} {topic}": (topic, numbers)
    for text, numbers in rows()
    for topic in topics_of(text)
}
CASES = [pytest.param(*case, id=name) for name, case in FOUND.items()]


@pytest.mark.parametrize(("topic", "numbers"), CASES)
def test_a_topic_of_the_tables_is_in_a_notebook_that_its_row_names(
    topic: str, numbers: list[str]
) -> None:
    pattern = re.compile(SEEN_AS.get(topic, re.escape(topic)), re.IGNORECASE)
    assert [each for each in numbers if pattern.search(words_of(each))]


def test_the_tables_name_all_terms_of_the_guide() -> None:
    assert TERMS - {topic for topic, _ in FOUND.values()} == set()
    assert SEEN_AS.keys() - {topic for topic, _ in FOUND.values()} == set()
