"""A vehicle with two wires."""

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import DifferentialDriveActuator, LightSensor
from ai4u_edu.lessons.exercise import Done, exercise
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.rollouts import Drive, as_brain, drive, seeds_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BoxShape, CircleShape, World

FARTHEST = 3.6
"""Distance in 05.3 that still counts as 3.5 m."""
TOUCH = 1.0
"""Distance of the centres at which vehicle and lamp touch, and a little more; metres."""


def vehicle(wires: Any, seed: int) -> ControlRequestor:
    """Make a vehicle 4 to 6 m from a lamp, which is in front of it or beside it."""
    chance = np.random.default_rng(seed)
    around, away = chance.uniform(-math.pi, math.pi), chance.uniform(4, 6)
    aside = math.radians(chance.uniform(20, 95)) * chance.choice([-1.0, 1.0])
    world = World()
    world.add_floor("plate", BoxShape(size=(16, 16)))
    world.add_body(
        "vehicle",
        CircleShape(radius=0.5),
        position=(away * math.cos(around), away * math.sin(around)),
        heading_deg=math.degrees(around + math.pi + aside),
    )
    world.add_body("lamp", CircleShape(radius=0.4), kind="static", tags=("lamp",), colour="yellow")
    agent = BasicAgent(
        body="vehicle",
        sensors=[
            LightSensor(perception_key="left eye", group="lamp", angle_deg=60, reach=4),
            LightSensor(perception_key="right eye", group="lamp", angle_deg=-60, reach=4),
        ],
        actuators=[
            DifferentialDriveActuator(action_name="wheels", max_wheel_speed=3, axle_width=1)
        ],
        brains=[as_brain(wires)],
    )
    return ControlRequestor(world, [agent])


def _drives(
    wires: Any,
    exercise_id: str,
    limit: int,
    watch: Callable[[Drive], object] = lambda _: None,
) -> Iterator[tuple[Drive, list[float]]]:
    """Run episodes, with the distances of the centres to the lamp on the way; metres."""
    for seed in seeds_of(exercise_id, 12):
        sim = vehicle(wires, seed)
        done = drive(sim, sim.agents[0], seed, limit, watch)
        yield done, [math.hypot(x, y) for x, y in done.trail]


def _aside(done: Drive) -> float:
    """Return the angle between the vehicle's heading and the lamp; degrees."""
    return abs(math.degrees(done.agent.body.bearing(done.sim.world["lamp"])))


@exercise(
    "05.1",
    _("Attack"),
    hints={
        "begin": _(
            "Each wheel gets the number of one eye. There are only two ways to do that: try "
            "both, and watch."
        ),
        "reverse": _("It backs away. A number above 0 turns a wheel forward: no minus is needed."),
        "sides": _(
            "It turns away from the lamp. The wheel on the lamp's side is faster: connect "
            "each eye with the other wheel."
        ),
        "straight": _(
            "Both wheels turn equally fast, so the vehicle can't turn. Each wheel needs "
            "another eye."
        ),
    },
)
def attacks(wires: Any) -> Done:
    """Check that it hits the lamp."""
    speeds: list[float] = []

    def watch(done: Drive) -> None:
        if done.steps == 0:
            speeds.clear()
        speeds.append(sum(done.agent.last_action.get("wheels", ())))

    for done, away in _drives(wires, "05.1", 150, watch):
        if done.moved < 0.2:
            raise done.not_yet(_("The vehicle stands still ({where}).", where=done.where), "begin")
        if min(away) > TOUCH and sum(speeds) < 0:
            raise done.not_yet(
                _("The vehicle runs backward ({where}).", where=done.where), "reverse"
            )
        if min(away) > TOUCH:
            hint = "sides" if _aside(done) > 100 else ""
            raise done.not_yet(
                _(
                    "The vehicle did not hit the lamp: it came as near as {away:.1f} m ({where}).",
                    away=min(away),
                    where=done.where,
                ),
                hint if _turned(done) else "straight",
            )
    return Done(_("In 12 worlds the vehicle hit the lamp."), done.picture())


def _turned(done: Drive) -> bool:
    """Return True if it ever turned."""
    return bool(abs(done.agent.body.heading - _vehicle_heading(done)) > 0.05)


def _vehicle_heading(done: Drive) -> float:
    """Return its heading at the beginning; radians."""
    return float(vehicle(lambda _: {}, done.seed).world["vehicle"].heading)


@exercise(
    "05.2",
    _("Fear"),
    hints={
        "begin": _(
            "There are two ways to connect two eyes with two wheels. You have used one of them."
        ),
        "sides": _(
            "It turns towards the lamp. This time the wheel on the lamp's side has to be the "
            "faster one."
        ),
        "backward": _(
            "It backs away, with its eyes on the lamp. It should turn round: both wheels "
            "turn forward, the one on the lamp's side faster."
        ),
        "straight": _(
            "Both wheels turn equally fast, so the vehicle can't turn. Each wheel needs "
            "another eye."
        ),
        "blind": _(
            "It turned to the lamp's side, and all the way round. Wherever the lamp is, the "
            "wheel on its side has to be the faster one: the wheels have to get what the "
            "eyes see."
        ),
        "rest": _(
            "It runs on and on, and falls off the plate in the end. Without light its wheels "
            "have to stand still: nothing may be added."
        ),
    },
)
def is_afraid(wires: Any) -> Done:
    """Check that it turns away, and comes to rest."""
    speeds: list[float] = []
    flights: list[float] = []  # how much faster the wheel on the lamp's side is, at each decision
    side = 0.0

    def watch(done: Drive) -> None:
        nonlocal side
        left, right = (*done.agent.last_action.get("wheels", ()), 0.0, 0.0)[:2]
        if done.steps == 0:
            speeds.clear()
            flights.clear()
        else:
            flights.append((left - right) * side)
        speeds.append(left + right)
        side = math.copysign(1, done.agent.body.bearing(done.sim.world["lamp"]))

    for done, away in _drives(wires, "05.2", 300, watch):
        if len(done.trail) > 1 and max(math.dist(done.trail[0], each) for each in done.trail) < 0.2:
            raise done.not_yet(_("The vehicle stands still ({where}).", where=done.where), "begin")
        if sum(speeds) < 0:
            raise done.not_yet(
                _("The vehicle runs backward ({where}).", where=done.where), "backward"
            )
        if done.fell or away[-1] > 11:
            hint = "rest" if _turned(done) else "straight"
            raise done.not_yet(
                _("The vehicle runs on, off the plate ({where}).", where=done.where), hint
            )
        if _aside(done) < 90 or min(away) < 1.5:
            raise done.not_yet(
                _(
                    "At the end the lamp is {away:.1f} m away, {aside:.0f} degrees from "
                    "where the vehicle looks ({where}). It should have turned away.",
                    away=away[-1],
                    aside=_aside(done),
                    where=done.where,
                ),
                "sides" if _turned(done) else "straight",
            )
        pace = math.dist(done.trail[-1], done.trail[-2])
        if pace > 0.05:
            raise done.not_yet(
                _("The vehicle does not come to rest ({where}).", where=done.where), "rest"
            )
        if not _turned(done):
            raise done.not_yet(
                _("The vehicle drove straight on, past the lamp ({where}).", where=done.where),
                "straight",
            )
        if sum(flights) <= 0:
            raise done.not_yet(
                _(
                    "It turned its back on the lamp by going round past it ({where}).",
                    where=done.where,
                ),
                "blind",
            )
    return Done(_("In 12 worlds it turned its back on the lamp, and came to rest."), done.picture())


@exercise(
    "05.3",
    _("Love"),
    hints={
        "begin": _(
            "In the dark the wheels have to turn: begin with 1, and take something away for "
            "the light that an eye sees."
        ),
        "reverse": _("It backs away. A number above 0 turns a wheel forward: no minus is needed."),
        "sides": _(
            "It turns away from the lamp. The wheel on the bright side has to be the slower "
            "one: each eye brakes the wheel on its own side."
        ),
        "weak": _(
            "It runs into the lamp: the brakes are too weak. Take a larger number times the "
            "brightness."
        ),
        "strong": _(
            "It stops too far away, or never comes: the brakes are too strong. Take a "
            "smaller number times the brightness."
        ),
    },
)
def loves(wires: Any) -> Done:
    """Check that it comes, and stays 1 to 3.5 m in front of the lamp."""
    for done, away in _drives(wires, "05.3", 240):
        if len(done.trail) > 1 and max(math.dist(done.trail[0], each) for each in done.trail) < 0.2:
            idle = not any(done.agent.last_action["wheels"])
            hint = "begin" if idle else "strong"
            raise done.not_yet(_("The vehicle stands still ({where}).", where=done.where), hint)
        seen = _("At the end the lamp is {away:.1f} m away", away=away[-1])
        if min(away) < TOUCH:
            raise done.not_yet(
                _("The vehicle runs into the lamp ({where}).", where=done.where), "weak"
            )
        if done.fell or away[-1] > 8:
            raise done.not_yet(
                _("{seen} ({where}). The vehicle has left it.", seen=seen, where=done.where),
                "sides",
            )
        if not 1 <= away[-1] <= FARTHEST:
            raise done.not_yet(
                _("{seen}, not 1 to 3.5 ({where}).", seen=seen, where=done.where), "strong"
            )
        if _aside(done) > 45:
            raise done.not_yet(
                _(
                    "{seen}, but {aside:.0f} degrees from where the vehicle looks ({where}).",
                    seen=seen,
                    aside=_aside(done),
                    where=done.where,
                ),
                "sides",
            )
        if math.dist(done.trail[-1], done.trail[-2]) > 0.05:
            raise done.not_yet(
                _("{seen}, but the vehicle does not rest ({where}).", seen=seen, where=done.where),
                "strong",
            )
    return Done(_("In 12 worlds it came to the lamp, and stayed."), done.picture())


exit_ticket(
    "05.exit",
    Question(
        "a",
        {
            "b": _(
                "The left eye sees more light, so the *left* wheel turns faster. To which "
                "side does that push the vehicle?"
            ),
            "c": _(
                "The two eyes do not get the same light, so the wheels do not turn equally fast."
            ),
        },
    ),
    Question(
        "c",
        {
            "a": _("You have seen all of the code: two lines that compute two numbers."),
            "b": _(
                "Nothing in it names a lamp. The eyes give numbers, and the wires carry them "
                "to the wheels."
            ),
        },
    ),
    Question(
        "a",
        {
            "b": _("That is an actuator such as the wheels, which takes any number in a range."),
            "c": _("3 is the line that was chosen. The table may have more lines."),
        },
    ),
)
