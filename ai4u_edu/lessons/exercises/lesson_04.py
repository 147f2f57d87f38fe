"""Sensors: what can it know?"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import (
    BearingSensor,
    LocalBrain,
    OrientationSensor,
    Percept,
    RBMoveActuator,
    Sensor,
    TouchRewardFunc,
)
from ai4u_edu.lessons.calls import Calls, function_exercise
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, a_list_of, exercise
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import chance_for, finite_number, finite_numbers, is_close
from ai4u_edu.lessons.pictures import picture
from ai4u_edu.lessons.rollouts import as_brain, drive, seeds_of
from ai4u_edu.lessons.worlds import plate
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.world import BoxShape, CircleShape, World

STATUS = ("done", "id")
"""Perception keys that every agent has."""
GOLD_NUMBERS = 3


def _look(
    sensors: Sequence[Sensor], box: tuple[float, float], *, wall: bool = False
) -> ControlRequestor:
    """Return the percept of a robot in the middle that looks right, with a box somewhere."""
    world = World()
    world.add_floor("plate", BoxShape(size=(24, 24)))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",))
    world.add_body("box", BoxShape(size=(1, 1)), position=box, tags=("target",))
    if wall:
        middle, angle = (box[0] * 0.6, box[1] * 0.6), math.degrees(math.atan2(box[1], box[0]))
        shape = BoxShape(size=(0.3, 2.4))
        world.add_body(
            "wall", shape, kind="static", position=middle, heading_deg=angle, tags=("wall",)
        )
    idle = LocalBrain(controller=lambda _: {})
    agent = BasicAgent(body="robot", sensors=list(sensors), brains=[idle])
    sim = ControlRequestor(world, [agent])
    sim.reset(1)
    return sim


def _readings(percept: Percept) -> dict[str, Any]:
    return {key: np.asarray(value) for key, value in percept.items() if key not in STATUS}


def _same(one: Percept, other: Percept) -> bool:
    ones, others = _readings(one), _readings(other)
    return all(np.allclose(ones[key], others[key], atol=1e-4) for key in ones)


def _same_of(sensor: Sensor, one: Percept, other: Percept) -> bool:
    key = sensor.perception_key
    return bool(np.allclose(one[key], other[key], atol=1e-4))


@exercise(
    "04.1",
    _("The twin"),
    hints={
        "other": _(
            "You gave the same place. There is a second one: think of a mirror along the "
            "line in which the robot faces."
        ),
        "behind": _(
            "The cosine is not the same there. Ahead must stay ahead: only left and right "
            "change places."
        ),
        "far": _("The distance is not the same there. The twin is as far away as the box."),
    },
)
def finds_the_twin(twin: Any) -> Done:
    """Check for the other place that has the same orientation."""
    a_function(twin)
    for x, y in _places(twin):
        given = twin(x, y)
        u, v = finite_numbers(
            given, 2, expected=_("For ({x:g}, {y:g}) expected two numbers", x=x, y=y)
        )
        if math.hypot(u - x, v - y) < 0.1:
            raise NotYet(
                _("For ({x:g}, {y:g}) your function gives the same place.", x=x, y=y), hint="other"
            )
        if not 1.5 < math.hypot(u, v) < 11:
            raise NotYet(
                _("({u:g}, {v:g}) is inside the robot, or far off the plate.", u=u, v=v), hint="far"
            )
        one = _look([OrientationSensor(target="box", normalized=False)], (x, y))
        (cosine, distance) = one.agents[0].percept["orientation"]
        other = _look([OrientationSensor(target="box", normalized=False)], (u, v))
        (twins_cosine, twins_distance) = other.agents[0].percept["orientation"]
        if not is_close(twins_distance, distance, 0.01):
            raise NotYet(
                _(
                    "At ({x:g}, {y:g}) the robot reads a distance of {distance:.2f}, at "
                    "({u:g}, {v:g}) {twins_distance:.2f}.",
                    x=x,
                    y=y,
                    distance=distance,
                    u=u,
                    v=v,
                    twins_distance=twins_distance,
                ),
                hint="far",
                picture=picture(capture_snapshot(other)),
            )
        if not is_close(twins_cosine, cosine, 0.01):
            raise NotYet(
                _(
                    "At ({x:g}, {y:g}) the robot reads a cosine of {cosine:.2f}, at ({u:g}, "
                    "{v:g}) {twins_cosine:.2f}.",
                    x=x,
                    y=y,
                    cosine=cosine,
                    u=u,
                    v=v,
                    twins_cosine=twins_cosine,
                ),
                hint="behind",
                picture=picture(capture_snapshot(other)),
            )
    return Done(_("In eight worlds the robot can't tell the box from its twin."))


def _places(twin: Any) -> list[tuple[float, float]]:
    """Return places all around the robot, none straight ahead or behind."""
    chance = chance_for("04.1", twin)
    found = [(3.0, 1.0), (-3.0, 2.5)]
    for _number in range(6):
        angle, away = chance.uniform(0.3, math.pi - 0.3), chance.uniform(2, 5)
        side = chance.choice([-1.0, 1.0])
        found.append(
            (round(float(away * np.cos(angle)), 1), round(float(side * away * np.sin(angle)), 1))
        )
    return found


@exercise(
    "04.2",
    _("Search"),
    hints={
        "turn": _(
            "Two cases: if the cosine is large, drive; otherwise turn on the spot, always in "
            "the same direction."
        ),
        "narrow": _(
            "The robot turns past the box again and again. In one decision it turns by up to "
            "14 degrees: accept a smaller cosine, or turn more slowly."
        ),
        "blind": _("It does the same whatever it senses. Ask for the cosine: `if cosine > ...:`."),
        "stays": _(
            "It turns and never drives. Where the cosine is large, the box is ahead: drive."
        ),
        "away": _("It drives away from the box. When it faces the box, the cosine is large."),
        "wide": _(
            "The robot drives although it does not face the box. A cosine of 0 means that "
            "the box is beside it: ask for more."
        ),
    },
)
def finds_by_turning(search: Any) -> Done:
    """Check that it gets to the box with one cosine."""
    arrived = TouchRewardFunc(name="arrived", target="box", reward=1, cause_episode_to_end=True)
    agent = BasicAgent(
        body="robot",
        sensors=[OrientationSensor(target="box", info="angle")],
        actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
        rewards=[arrived],
        brains=[LocalBrain(controller=lambda _: {})],
    )
    sim = ControlRequestor(plate(), [agent])
    agent.use_brain(as_brain(search))
    seeds = seeds_of("04.2")
    for count, seed in enumerate(seeds):
        turned: list[float] = []
        driven: list[float] = []
        towards: list[float] = []  # speed towards the box, of what was driven

        def watch(
            _: object,
            turned: list[float] = turned,
            driven: list[float] = driven,
            towards: list[float] = towards,
        ) -> None:
            action = next(iter(agent.last_action.values()), ())
            turned.append(abs(action[1]) if len(action) > 1 else 0.0)
            driven.append(abs(action[0]) if action else 0.0)
            towards.append((action[0] if action else 0.0) * float(agent.percept["orientation"][0]))

        done = drive(sim, agent, seed, 360, watch)
        if not is_close(agent.ledger.episode_total, 1, 1e-6):
            how = _("fell off the plate") if done.fell else _("did not get to the box")
            why = _search_mistake(turned, driven, towards)
            raise done.not_yet(
                _(
                    "The robot {how} ({where}). In {count} worlds before that it got there.",
                    how=how,
                    where=done.where,
                    count=count,
                ),
                why,
            )
    return Done(
        _("With one number it found the box in {count} worlds.", count=len(seeds)), done.picture()
    )


def _search_mistake(turned: list[float], driven: list[float], towards: list[float]) -> str:
    """Return the diagnosis that fits how a robot searched."""
    if not any(turned):
        return "turn"
    if not any(driven):
        return "stays"
    if sum(towards) < 0:
        return "away"
    if len(set(turned[1:])) == 1 and len(set(driven[1:])) == 1:
        return "blind"
    return "wide" if sum(driven) > 0.3 * len(driven) else "narrow"


@function_exercise(
    "04.3",
    _("The angle"),
    hints={
        "begin": _("`math.degrees(math.atan2(sine, cosine))`: the sine comes first."),
        "degrees": _("That is the angle in radians: `math.degrees` turns it into degrees."),
        "mirrored": _("Left and right are swapped: above 0 is to the left."),
        "swapped": _("`math.atan2` takes the sine first, then the cosine."),
        "side": _(
            "The size is right, the side is not. A function of the cosine alone can't tell "
            "left from right."
        ),
        "behind": _(
            "Ahead it is right, behind it is not. A function of the sine alone can't tell "
            "ahead from behind: `math.atan2` takes both."
        ),
    },
)
def computes_the_angle(chance: np.random.Generator) -> Calls:
    """Check the degrees computed from a sine and a cosine."""
    found: list[tuple[float, float]] = []
    drawn = [
        round(float(sign * chance.uniform(low, low + 70))) for sign in (1, -1) for low in (10, 100)
    ]
    for angle in (20, -35, 110, -170, *drawn):
        turned = math.radians(angle)
        box = (4 * math.cos(turned), 4 * math.sin(turned))
        percept = _look([BearingSensor(target="box")], box).agents[0].percept
        given = yield (percept,)
        found.append((float(angle), finite_number(given)))
    wrong = [(true, given) for true, given in found if not is_close(given, true, 0.5)]
    if wrong:
        true, given = wrong[0]
        raise NotYet(
            _(
                "The box is at {true:g} degrees, your function says {given:.1f}.",
                true=true,
                given=given,
            ),
            hint=_why(found),
        )
    return Done(_("Eight directions all around the robot, and every angle was right."))


def _why(found: list[tuple[float, float]]) -> str:
    """Return the hint that fits how angles are wrong."""

    def fits(wrong: Any) -> bool:
        return all(is_close(given, wrong(true), 0.5) for true, given in found)

    if fits(math.radians):
        return "degrees"
    if fits(lambda true: -true):
        return "mirrored"
    if fits(lambda true: math.remainder(90 - true, 360)):
        return "swapped"
    if fits(abs):
        return "side"
    if all(is_close(given, true, 0.5) for true, given in found if abs(true) < 90):
        return "behind"
    return "begin"


@exercise(
    "04.4",
    _("Tell them apart"),
    hints={
        "mirror": _("The mirrored worlds look the same. Which sensor tells left from right?"),
        "distance": _("Near and far look the same: one of the sensors has to tell a distance."),
        "wall": _("The wall is not seen. Which sensor can't look through a wall?"),
        "narrow": _(
            "The rays look ahead only. `field_of_view` is the angle that they cover, and "
            "between few rays there are gaps: `number_of_rays`."
        ),
        "many": _("It works, and with fewer sensors too: two are enough."),
    },
)
def tells_apart(sensors: Any) -> Done:
    """Check that three pairs of worlds have different percepts."""
    sensors = _active(sensors)
    _check_pairs(sensors)
    if len(sensors) > 2:
        raise NotYet(
            _("You tell all pairs apart, with {count} sensors.", count=len(sensors)), hint="many"
        )
    return Done(_("Three pairs of worlds, told apart by {count} sensor(s).", count=len(sensors)))


@exercise(
    "04.5",
    _("Gold: as few numbers as possible"),
    hints={
        "mirror": _(
            "The mirrored worlds look the same. One number is enough for the side: which "
            "sensor has it?"
        ),
        "distance": _("Near and far look the same. One number is enough for a distance."),
        "wall": _(
            "The wall is not seen. Not only rays are stopped by a wall: look at the "
            "parameter `visibility_test` of the OrientationSensor."
        ),
        "narrow": _(
            "No ray hits the box. It takes many rays to be sure of hitting it, and each "
            "gives a number or two: look for sensors without rays."
        ),
        "many": _(
            "It works, and with fewer numbers too. `info` lets an OrientationSensor read "
            "only one of its two numbers."
        ),
    },
)
def tells_apart_with_few_numbers(sensors: Any) -> Done:
    """Check that three pairs of worlds are told apart by at most three numbers."""
    sensors = _active(sensors)
    _check_pairs(sensors)
    percept = _look(sensors, (4, 1)).agents[0].percept
    count = sum(reading.size for reading in _readings(percept).values())
    if count > GOLD_NUMBERS:
        raise NotYet(
            _(
                "You tell all pairs apart, with {count} numbers; {gold_numbers} are enough.",
                count=count,
                gold_numbers=GOLD_NUMBERS,
            ),
            hint="many",
        )
    return Done(_("Gold: three pairs of worlds, told apart by {count} numbers.", count=count))


def _active(sensors: Any) -> list[Sensor]:
    """Return a person's sensors without those that are turned off, which read nothing."""
    return [sensor for sensor in a_list_of(Sensor, sensors) if sensor.is_active]


def _check_pairs(sensors: Sequence[Sensor]) -> None:
    """Check that the mirrored, the far and the hidden box give another percept.

    Raises:
        NotYet: one of them does not.
    """
    for angle in (20.0, 35.0, 50.0):
        turned = math.radians(angle)
        ahead, side = math.cos(turned), math.sin(turned)
        left = _look(sensors, (4 * ahead, 4 * side)).agents[0].percept
        shown = _("the box at {angle:g} degrees", angle=angle)
        if _same(left, _look(sensors, (4 * ahead, -4 * side)).agents[0].percept):
            raise NotYet(
                _(
                    "With {shown} on the left, or as much on the right, the percept is the same.",
                    shown=shown,
                ),
                hint="mirror",
            )
        if _same(left, _look(sensors, (7 * ahead, 7 * side)).agents[0].percept):
            raise NotYet(
                _("With {shown}, 4 or 7 metres away, the percept is the same.", shown=shown),
                hint="distance",
            )
        hidden = _look(sensors, (4 * ahead, 4 * side), wall=True)
        if _same(left, hidden.agents[0].percept):
            rays = [each for each in sensors if "RayCasting" in type(each).__name__]
            nowhere = _look(sensors, (-11, -11)).agents[0].percept
            misses = rays and all(_same_of(each, left, nowhere) for each in rays)
            same: str = _(
                "With {shown}, in sight or behind a wall, the percept is the same.", shown=shown
            )
            if misses:
                why = _("No ray hits the box there: they need a wider field of view, or more rays.")
                same = join([same, why])
            raise NotYet(
                same,
                hint="narrow" if misses else "wall",
                picture=picture(capture_snapshot(hidden)),
            )


exit_ticket(
    "04.exit",
    Question(
        "b",
        {
            "a": _("Straight ahead the cosine is 1."),
            "c": _("On the right it is 0 as well. Left and right are in the sine."),
        },
    ),
    Question(
        "a",
        {
            "b": _(
                "The controller sees the percept only. How should it notice that the worlds "
                "are different?"
            ),
            "c": _("The same numbers in give the same action out. That may be any action."),
        },
    ),
    Question(
        "c",
        {
            "a": _(
                "That only divides the distance by a fixed number. It still says nothing "
                "about before."
            ),
            "b": _(
                "It would read the same number at the same moment. What is needed is the "
                "number of the moment before."
            ),
        },
    ),
)
