"""State machines."""

import math
from collections.abc import Mapping
from itertools import pairwise, product
from typing import Any

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import (
    BearingSensor,
    RBMoveActuator,
    Sensor,
    TouchRewardFunc,
    TouchSensor,
)
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.lessons.exercise import Done, NotYet, exercise, named
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import is_close
from ai4u_edu.lessons.rollouts import Drive, as_brain, drive, seeds_of
from ai4u_edu.lessons.worlds import ANYWHERE
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BodyView, BoxShape, CircleShape, Variation, World, WorldView

PLACES = ("station", "site")
WALL_DECISIONS = 720
"""Decisions of an episode in 07.1: a minute."""
STILL_M = 0.01
"""Way (m) in a decision below which a robot that touches a wall does not get on."""
AT_M = 1.25
"""Distance of the centres within which a robot is at a place; they touch at 1 m."""
FULL = 0.999
"""Level at which a battery counts as full."""
NOT_LOW = 0.35
"""Level of a battery from which on a robot need not go to the station."""
MAX_FULL_DECISIONS = 36
"""Decisions for which a robot may stay at the station with a full battery: 3 s."""
MAX_PUSHING_DECISIONS = 12
"""Decisions for which a robot may push against the wall of 07.1 before it does something."""
MAX_DETOUR = 1.5
"""Longest way to the box where no wall is in between, as a multiple of the straight one."""
STRAIGHT_WORLDS = (2, 6)
"""Worlds of 07.1 in which no wall is in the way."""
LIMIT = 1440
"""Decisions of an episode in 07.2: 2 minutes."""
ENOUGH_WORK = 360
"""Decisions at the site that are enough in 07.2: half a minute."""
SHORT_VISITS = 8
"""Visits of the station in 2 minutes that are not more than a full battery needs."""


CHARGES = (0.01, 0.018, 0.006)
"""Parts of a full battery that a station gives in a decision; which one is drawn."""


class BatterySensor(Sensor):
    """Level of a battery that empties with time, and is charged at a station.

    Reading: (1,), 0 (empty) to 1 (full).
    """

    station: str
    """Name of the body at which it is charged."""
    full: float = 1.0
    """Level at the beginning of an episode."""
    drain: float = 0.004
    """Part of a full battery that a decision costs."""
    charge: float = 0.01
    """Part of a full battery that the station gives in a decision."""
    later_charge: float = 0.01
    """The same from the episode's second minute on."""

    def space(self) -> Box:
        """Return the range 0..1."""
        return Box(0.0, 1.0, (1,))

    def on_reset(self, _agent: AgentView, _view: WorldView) -> None:
        """Begin with the first level."""
        self._level, self._reads = self.full, 0

    def read(self, body: BodyView, view: WorldView) -> float:
        """Return the level after another decision."""
        is_there = body.distance(view[self.station]) < AT_M
        self._reads += 1
        charge = self.charge if self._reads <= LIMIT / 2 else self.later_charge
        self._level += charge if is_there else -self.drain
        self._level = min(1.0, max(0.0, self._level))
        return self._level


def battery_world(controller: Any, seed: int = 1) -> ControlRequestor:
    """Return a world with a station and a site, and a robot with a battery.

    Args:
        controller: the robot's driver.
        seed: seed of the places and of the battery.
    """
    chance = np.random.default_rng(seed)
    away, around = chance.uniform(4, 5), chance.uniform(0, 2 * np.pi)
    x, y = away * float(np.cos(around)), away * float(np.sin(around))
    world = World()
    world.add_floor("plate", BoxShape(size=(16, 16)))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), random=ANYWHERE)
    post = CircleShape(radius=0.5)
    world.add_body("station", post, kind="static", position=(x, y), colour="green")
    world.add_body("site", post, kind="static", position=(-x, -y), colour="orange")
    battery = BatterySensor(
        station="station",
        perception_key="battery",
        full=float(chance.uniform(0.5, 1)),
        drain=float(chance.uniform(0.002, 0.0033)),
        charge=CHARGES[seed % 3],
        later_charge=CHARGES[(seed + 1 + seed // 3 % 2) % 3],
    )
    bearings = [BearingSensor(target=name, perception_key=f"to {name}") for name in PLACES]
    sensors: list[Sensor] = [battery, *bearings]
    return ControlRequestor(world, [robot_with(as_brain(controller), sensors)])


def robot_with(brain: Any, sensors: list[Sensor], *rewards: TouchRewardFunc) -> BasicAgent:
    """Return a robot that drives at 2 m/s and turns at 3 rad/s."""
    return BasicAgent(
        body="robot",
        sensors=sensors,
        actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
        rewards=list(rewards),
        brains=[brain],
    )


@exercise(
    "07.1",
    _("Around the wall"),
    hints={
        "begin": _(
            "It pushes against the wall and never leaves it. When the bumper reads 1, change "
            "the state; in the state `back off`, drive backward."
        ),
        "again": _(
            "It backs off and drives at the same place of the wall again. It needs a third "
            "state: turn aside and drive for a while, before it seeks."
        ),
        "pushes": _(
            "It gets there, but pushes against the wall for more than a second before it "
            "does something. Ask the bumper at each decision."
        ),
        "detour": _(
            "No wall is in the way here, and it drives a detour all the same. Only the "
            "bumper can tell whether there is a wall: leave the state `seek` where it reads "
            "1."
        ),
        "forever": _(
            "It leaves the wall and does not come back. Count the decisions that are left in "
            "a state, and change the state when there are none."
        ),
    },
)
def gets_around(machine: Any) -> Done:
    """Check that it gets to the box behind the wall."""
    for number, seed in enumerate(seeds_of("07.1", 10)):
        is_straight = number in STRAIGHT_WORLDS
        world = wall_world(seed, has_arm=number % 2 == 1, is_aside=is_straight)
        bumper = TouchSensor(target="wall", perception_key="bumper")
        arrived = TouchRewardFunc(name="arrived", target="box", reward=1, cause_episode_to_end=True)
        agent = robot_with(as_brain(machine), [bumper, BearingSensor(target="box")], arrived)
        sim = ControlRequestor(world, [agent])
        bumps: list[int] = []
        pushing = longest_push = 0

        def watch(done: Drive, bumps: list[int] = bumps) -> None:
            nonlocal pushing, longest_push
            drives = any(next(iter(done.agent.last_action.values()), ()))
            is_still = done.steps > 0 and math.dist(*done.trail[-2:]) < STILL_M
            bumps_now = done.agent.percept["bumper"][0] == 1
            pushing = pushing + 1 if drives and is_still and bumps_now else 0
            longest_push = max(longest_push, pushing)
            if bumps_now:
                bumps.append(done.steps)

        done = drive(sim, agent, seed, WALL_DECISIONS, watch)
        if not is_close(agent.ledger.episode_total, 1, 1e-6):
            gaps = [later - sooner for sooner, later in pairwise(bumps)]
            hint = "again" if any(gap > 1 for gap in gaps) else "begin"
            if done.fell or (bumps and done.steps - bumps[-1] > 60):
                hint = "forever"
            raise done.not_yet(
                _("The robot did not get to the box ({where}).", where=done.where), hint
            )
        if longest_push > MAX_PUSHING_DECISIONS:
            raise done.not_yet(
                _(
                    "The robot pushed against the wall for {longest_push} decisions ({where}).",
                    longest_push=longest_push,
                    where=done.where,
                ),
                "pushes",
            )
        straight = math.dist(done.trail[0], done.trail[-1])
        way = sum(math.dist(*step) for step in pairwise(done.trail))
        if is_straight and way > MAX_DETOUR * straight:
            raise done.not_yet(
                _(
                    "No wall was in the way, and the robot drove {way:.1f} m for "
                    "{straight:.1f} m ({where}).",
                    way=way,
                    straight=straight,
                    where=done.where,
                ),
                "detour",
            )
    return Done(_("In 10 worlds the robot got to the box."), done.picture())


def wall_world(seed: int, *, has_arm: bool, is_aside: bool = False) -> World:
    """Return a plate with a wall between robot and box.

    The wall is 8 m long, or 6 m with an arm at one end that points to the robot's side: a curve
    drawn blindly around it ends in the corner or beyond the box.

    Args:
        seed: seed of the places.
        has_arm: True for the shorter wall with an arm.
        is_aside: True for a wall that is not between robot and box.
    """
    chance = np.random.default_rng(seed)
    length = 6.0 if has_arm else 8.0
    side, shift, x = chance.choice([-1.0, 1.0]), chance.uniform(-0.7, 0.7), chance.uniform(-1, 1)
    world = World()
    world.add_floor("plate", BoxShape(size=(24, 24)))
    start = Variation(x=(-5, -3.5), y=(-1.5, 1.5), heading_deg=(-180, 180))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), random=start)
    place = (float(x), float(shift) + 9 * is_aside)
    world.add_body(
        "wall", BoxShape(size=(0.4, length)), kind="static", position=place, tags=("wall",)
    )
    if has_arm:
        end = (place[0] - 0.75, place[1] + float(side * length / 2))
        arm = BoxShape(size=(1.5, 0.4))
        world.add_body("arm", arm, kind="static", position=end, tags=("wall",))
    there = Variation(x=(7, 9), y=(-3, -2)) if is_aside else Variation(x=(3, 5), y=(-1, 1))
    world.add_body("box", BoxShape(size=(1, 1)), kind="static", tags=("target",), random=there)
    return world


@exercise(
    "07.2",
    _("The battery"),
    hints={
        "begin": _(
            "Two states: `work` and `charge`. Two arrows: in the state `work`, if the "
            "battery is low, change to `charge`; in the state `charge`, if it is nearly "
            "full, change to `work`. The state says where to drive."
        ),
        "between": _(
            "It leaves the station as soon as it has a little charge, and has to turn back "
            "at once. Going to the station and leaving it need two different numbers."
        ),
        "late": _(
            "The battery is empty before the robot gets to the station. The way there costs "
            "up to a quarter of the battery: leave earlier."
        ),
        "stays": _(
            "It stays at the station. In the state `charge`, ask whether the battery is "
            "nearly full; a reading of more than 1 never comes."
        ),
        "percent": _(
            "It drives to the station although the battery is not low. The battery reads "
            "from 0 to 1: 30 percent are 0.3."
        ),
        "clock": _(
            "It stays at the station although the battery is full. Don't count decisions: "
            "stations charge at different speeds, and only the battery says when it is full."
        ),
        "seldom": _("It works too little. How full does the battery have to be before it leaves?"),
    },
)
def works_and_charges(worker: Any) -> Done:
    """Check that the battery never gets empty, and that the robot works."""
    for seed in seeds_of("07.2", 8):
        sim = battery_world(worker, seed)
        at_site, at_station, visits, empty, full, low = 0, 0, 0, False, 0, 1.0

        def watch(done: Drive) -> None:
            nonlocal at_site, at_station, visits, empty, full, low
            body, world = done.agent.body, done.sim.world
            level = float(done.agent.percept["battery"][0])
            at_site += body.distance(world["site"]) < AT_M
            is_there = body.distance(world["station"]) < AT_M
            visits += is_there and not at_station
            at_station = is_there
            low = level if visits == 0 else low
            empty = empty or level <= 0
            full = full + 1 if is_there and level > FULL else 0
            if full > MAX_FULL_DECISIONS:
                is_early = not at_site and low > NOT_LOW
                why = "clock" if visits > 1 else "percent" if is_early else "stays"
                raise done.not_yet(
                    _(
                        "The robot stayed at the station for {full} s with a full battery "
                        "({where}).",
                        full=full // 12,
                        where=done.where,
                    ),
                    why,
                )

        done = drive(sim, sim.agents[0], seed, LIMIT, watch)
        if empty:
            raise done.not_yet(
                _("The battery was empty ({where}).", where=done.where),
                "late" if visits else "begin",
            )
        if at_site < ENOUGH_WORK:
            why = "stays" if visits == 1 else "between" if visits > SHORT_VISITS else "seldom"
            raise done.not_yet(
                _(
                    "In 2 minutes the robot was at the site for {at_site:.0f} s, not 30; it "
                    "came to the station {visits} times ({where}).",
                    at_site=at_site / 12,
                    visits=visits,
                    where=done.where,
                ),
                why,
            )
    return Done(_("In 8 worlds the robot worked, and its battery was never empty."), done.picture())


STATES = ("patrol", "listen", "chase")
EVENTS = ("noise", "quiet", "thief", "gone")
ARROWS = {
    ("patrol", "noise"): "listen",
    ("patrol", "thief"): "chase",
    ("listen", "quiet"): "patrol",
    ("listen", "thief"): "chase",
    ("chase", "gone"): "listen",
}
"""Table of the drawing in 07.3."""


@exercise(
    "07.3",
    _("A machine as a table"),
    hints={
        "begin": _(
            "One line for each arrow of the drawing: where it begins, what happens, and "
            "where it ends. There are five arrows."
        ),
        "swapped": _("In the brackets the state comes first, then the event."),
        "extra": _("Your table has an arrow that is not in the drawing."),
        "target": _("One of your arrows ends in another state than in the drawing."),
        "names": _(
            "A state or an event has another name in the drawing. Copy the words letter by letter."
        ),
        "pairs": _(
            'Each line has the form `("patrol", "noise"): "listen",`: a pair in brackets, a '
            "colon, and a word."
        ),
    },
)
def is_the_drawing(arrows: Any) -> Done:
    """Check a table of arrows against the drawing, by all sequences of events."""
    table = _table_of(arrows)
    for length in range(1, 5):
        for events in product(EVENTS, repeat=length):
            wanted, got = _end(ARROWS, events), _end(table, events)
            if wanted != got:
                raise NotYet(
                    _(
                        "After {listed} the robot should be in the state `{wanted}`; with "
                        "your table it is in `{got}`.",
                        listed=", ".join(events),
                        wanted=wanted,
                        got=got,
                    ),
                    hint=_table_mistake(table),
                )
    if table != ARROWS:
        raise NotYet(_("It works, but your table has more lines than the drawing."), hint="extra")
    return Done(_("Five arrows, and your machine does what the drawing says."))


def _table_of(given: Any) -> dict[tuple[str, str], str]:
    """Return a student's table.

    Raises:
        NotYet: it is none, or it has other states or events.
    """
    if not isinstance(given, Mapping):
        raise NotYet(
            _("Expected a table in curly brackets, got {got}.", got=named(given)), hint="pairs"
        )
    for key, state in given.items():
        if not isinstance(key, tuple) or len(key) != 2:
            raise NotYet(
                _("Expected a state and an event, got {got}.", got=named(key)), hint="pairs"
            )
        if key[0] in EVENTS and key[1] in STATES:
            raise NotYet(
                _("{key}: the state comes first, then the event.", key=repr(key)), hint="swapped"
            )
        for name, known in ((key[0], STATES), (key[1], EVENTS), (state, STATES)):
            if not isinstance(name, str) or name not in known:
                raise NotYet(
                    _(
                        "Expected one of {listed}; got {got}.",
                        listed=", ".join(known),
                        got=named(name),
                    ),
                    hint="names",
                )
    return dict(given)


def _end(table: Mapping[tuple[str, str], str], events: tuple[str, ...]) -> str:
    """Return the state after some events, from `patrol` on."""
    state = "patrol"
    for event in events:
        state = table.get((state, event), state)
    return state


def _table_mistake(table: Mapping[tuple[str, str], str]) -> str:
    """Return the diagnosis that fits a wrong table."""
    if not table.keys() <= ARROWS.keys():
        return "extra"
    wrong = any(table[key] != ARROWS[key] for key in table)
    return "target" if wrong else "begin"


exit_ticket(
    "07.exit",
    Question(
        "b",
        {
            "a": _(
                "With closed doors the same button means: drive. The percept alone does not "
                "say which."
            ),
            "c": _("That number changes nothing: with open doors it must not drive."),
        },
    ),
    Question(
        "a",
        {
            "b": _(
                "An exact thermometer notices even smaller changes, so the heater clicks "
                "even more often."
            ),
            "c": _(
                "Then it clicks at 25 degrees. A single number is always the place where it "
                "changes to and fro."
            ),
        },
    ),
    Question(
        "c",
        {
            "a": _("There is such an arrow: the robot does back off."),
            "b": _(
                "The robot was in that state before it bumped. The question is how it leaves "
                "the one in which it is."
            ),
        },
    ),
)
