"""Your own controller: rules and memory."""

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import (
    BearingSensor,
    Brain,
    GroupTouchSensor,
    LocalBrain,
    RayCastingSensor,
    RBMoveActuator,
    Sensor,
    TouchSensor,
)
from ai4u_edu.lessons.exercise import Done, exercise
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.rollouts import Drive, as_brain, drive, seeds_of
from ai4u_edu.lessons.worlds import ANYWHERE
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.world import BoxShape, CircleShape, Variation, World

POSTS = ("red", "blue")
ENOUGH = 6
"""Rests at posts that are needed."""
REST_DECISIONS = 24
"""Decisions for which the robot has to stand still: 2 s."""
AT_POST_M = 1.25
"""Distance of the centres within which a robot is at a post; they touch at 1 m."""
STILL_M = 0.001
"""Largest change of position (m) and heading (rad) since a rest began."""
SLOW_TURN_RAD = 0.1
"""A robot that turns by less in a decision is not on its way to another post."""
MAX_PUSHING_DECISIONS = 12
"""Decisions for which a robot may push against a post before it rests there."""
BETWEEN_POSTS_M = (3.2, 7.5, 4.0, 6.5, 5.0, 3.6, 7.0, 4.5)
"""Distance of the posts in each world of 06.2: no way takes as long as another one."""
MAX_BUMP_DECISIONS = 3
"""Decisions for which a robot may push against a wall in 06.3 before it leaves it or stops."""
EDGE = Variation(x=(-4.3, 4.3), y=(3.4, 4.2), heading_deg=(-180, 180))
"""Places near an edge: a robot that drives a circle blindly falls there."""
GOLD_M = 55.0
"""Way that is long enough in 06.4; a robot that turns on the spot covers 51 m."""
FAR_M = 4.0
"""Distance between the farthest two places that a stroll has to reach."""


def _robot(brain: Brain, sensors: list[Sensor]) -> BasicAgent:
    return BasicAgent(
        body="robot",
        sensors=sensors,
        actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
        brains=[brain],
    )


def _reacts(stroll: Any) -> bool:
    """Return True if a function's action depends on the feelers at all."""
    if isinstance(stroll, type) or not callable(stroll):
        return True
    felt = ([1, 1, 1], [0, 0, 0], [0, 1, 1], [1, 1, 0], [1, 0, 1])
    return len({repr(stroll({"feelers": each})) for each in felt}) > 1


def _turns_away(stroll: Any) -> bool:
    """Return True for a function that turns away from an edge on one side."""
    if isinstance(stroll, type) or not callable(stroll):
        return False
    actions = [stroll({"feelers": each}) for each in ([0, 1, 1], [1, 1, 0])]
    if not all(isinstance(each, dict) and "move" in each for each in actions):
        return False
    left_edge, right_edge = (each["move"][1] for each in actions)
    return bool(left_edge > 0 > right_edge)


def _length(done: Drive) -> float:
    """Return the length of the trail, metres."""
    return sum(math.dist(here, there) for here, there in pairwise(done.trail))


@exercise(
    "06.1",
    _("Stay on the plate"),
    hints={
        "begin": _(
            "Where `ahead` is 0 there is no floor in front: then turn on the spot, without driving."
        ),
        "brake": _(
            "It sees the edge and turns, but drives on while it turns. In a corner that is "
            "one step too far: turn on the spot."
        ),
        "spin": _("It stays in one place. If all three feelers read 1, drive."),
        "dither": _(
            "In a corner it turns left, right, left: first one feeler is over the edge, then "
            "the other one. Always turn the same way, until all feelers read 1."
        ),
        "blind": _(
            "It drives in a circle without looking. Read the feelers: go straight on while "
            "all of them read 1."
        ),
        "towards": _(
            "It looks to one side only. The edge may be on the left, ahead, or on the right."
        ),
    },
)
def stays_on_the_plate(stroll: Any) -> Done:
    """Check for 30 seconds and 15 metres without a fall."""
    for done, turns in _strolls(stroll, "06.1"):
        if _length(done) < 15:
            raise done.not_yet(
                _(
                    "In 30 seconds the robot covered {length:.1f} m, not 15 ({where}).",
                    length=_length(done),
                    where=done.where,
                ),
                "dither" if len(turns) > 1 else "spin",
            )
    return Done(_("30 seconds in each of 10 worlds, and no fall."), done.picture())


@exercise(
    "06.4",
    _("Gold: a fast stroll"),
    hints={
        "begin": _("Begin with your `stroll` of 06.1: it has to stay on the plate, and to get on."),
        "brake": _("It falls. Where there is no floor *ahead*, it must not drive at all."),
        "towards": _(
            "It turns towards the edge. Where the left feeler reads 0, turn to the right, "
            "and the other way round."
        ),
        "dithers": _(
            "It stays on the plate, but in a corner it turns left, right, left. Always turn "
            "the same way, until all feelers read 1."
        ),
        "stops": _(
            "It stays on the plate. But it loses metres each time that it stops in order to "
            "turn. When the edge is only beside the robot, it can drive and turn."
        ),
        "blind": _("It drives in a circle without looking. Read the feelers."),
    },
)
def strolls_fast(quick_stroll: Any) -> Done:
    """Check for 55 metres in 30 seconds without a fall."""
    shortest = math.inf
    for done, turns in _strolls(quick_stroll, "06.4"):
        shortest = min(shortest, _length(done))
        if shortest < GOLD_M:
            raise done.not_yet(
                _(
                    "In 30 seconds the robot covered {shortest:.1f} m, not {gold_m:g} ({where}).",
                    shortest=shortest,
                    gold_m=GOLD_M,
                    where=done.where,
                ),
                "stops" if shortest > 15 else "dithers" if len(turns) > 1 else "begin",
            )
    return Done(
        _("Gold: at least {shortest:.1f} m in each of 10 worlds, and no fall.", shortest=shortest),
        done.picture(),
    )


def stroll_world() -> ControlRequestor:
    """Return the world of 06.1: a plate, and a robot with three feelers near an edge."""
    agent = _robot(
        LocalBrain(controller=lambda _: {}),
        [
            RayCastingSensor(
                perception_key="feelers",
                rows=1,
                columns=3,
                field_of_view=140,
                vertical_field_of_view=1,
                vertical_shift=27,
                vision_max_distance=2,
                group_code={"floor": 1},
                flattened=True,
            )
        ],
    )
    world = World()
    world.add_floor("plate", BoxShape(size=(10, 10)))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), random=EDGE)
    return ControlRequestor(world, [agent])


def _strolls(stroll: Any, exercise_id: str) -> Iterator[tuple[Drive, set[bool]]]:
    """Run 30 seconds in each of 10 worlds; yield each, with the sides to which the robot turned.

    Raises:
        NotYet: the robot fell, or it saw little of the plate.
    """
    sim = stroll_world()
    sim.agents[0].use_brain(as_brain(stroll))
    for seed in seeds_of(exercise_id, 10):
        turns: set[bool] = set()
        actions: set[tuple[float, ...]] = set()

        def watch(
            done: Drive, turns: set[bool] = turns, actions: set[tuple[float, ...]] = actions
        ) -> None:
            move = tuple(done.agent.last_action.get("move", (0.0, 0.0)))
            if done.steps:
                actions.add(move)
            if move[1]:
                turns.add(move[1] > 0)

        done = drive(sim, sim.agents[0], seed, 360, watch)
        if done.fell:
            steady = len(actions) == 1 and bool(turns) and not _reacts(stroll)
            is_aware = len(turns) > 1 or _turns_away(stroll)
            hint = "begin" if not turns else "brake" if is_aware else "towards"
            raise done.not_yet(
                _("The robot fell off the plate ({where}).", where=done.where),
                "blind" if steady else hint,
            )
        yield done, turns
        widest = max(math.dist(one, two) for one in done.trail[::6] for two in done.trail[::6])
        if widest < FAR_M:
            raise done.not_yet(
                _(
                    "The robot saw little of the plate: its way is {widest:.1f} m wide, "
                    "expected {far_m:g} ({where}).",
                    widest=widest,
                    far_m=FAR_M,
                    where=done.where,
                ),
                "blind",
            )


@exercise(
    "06.2",
    _("Patrol"),
    hints={
        "begin": _(
            "It gets to one post, and stays there. When it has rested, set `self.goal` to "
            "the other post; and drive to the post that `self.goal` names."
        ),
        "pushes": _(
            "It gets to a post and goes on pushing for more than a second. It rests where it "
            "*touches* the post, not after a number of decisions: the way is longer in some "
            "worlds."
        ),
        "turns": _(
            "It turns a little while it should stand still. Standing still means an action "
            "of zeros."
        ),
        "empty": _(
            "`{}` leaves the motor as it is: it starts no robot, and one in motion rolls on. "
            "To stand still, return an action of zeros."
        ),
        "short": _(
            "It does not rest. Count the decisions in which it stands still, in "
            "`self.waited`: 2 seconds are 24 of them."
        ),
        "forgets": _(
            "It never rests anywhere for 2 seconds, nor does it get from post to post. What "
            "has to last until the next decision belongs in `self`, with a value at the "
            "beginning."
        ),
        "back": _(
            "It stays at the second post: resting there has to change the goal as well. And "
            "the count has to start again each time."
        ),
    },
)
def patrols(patrol: Any) -> Done:
    """Check that it rests at the posts in turn."""
    for seed, between in zip(seeds_of("06.2", 8), BETWEEN_POSTS_M, strict=True):
        world = World()
        world.add_floor("plate", BoxShape(size=(10, 10)))
        chance = np.random.default_rng(seed)
        angle = float(chance.uniform(0.4, 1.1) + chance.integers(4) * math.pi / 2)
        x, y = between / 2 * math.cos(angle), between / 2 * math.sin(angle)
        post = CircleShape(radius=0.5)
        world.add_body("red", post, kind="static", position=(x, y), colour="vermillion")
        world.add_body("blue", post, kind="static", position=(-x, -y), colour="blue")
        world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), random=ANYWHERE)
        senses: list[Sensor] = []
        for name in POSTS:
            senses.append(BearingSensor(target=name, perception_key=f"to {name}"))
            senses.append(TouchSensor(target=name, perception_key=f"at {name}"))
        agent = _robot(as_brain(patrol), senses)
        visits = _Visits()
        done = drive(ControlRequestor(world, [agent]), agent, seed, 720, visits.watch)
        if len(visits.rested) < ENOUGH:
            shown = ", ".join(visits.rested) or _("no post")
            raise done.not_yet(
                _(
                    "In a minute the robot rested 2 s at {shown}; it touched {touched} ({where}).",
                    shown=shown,
                    touched=", ".join(visits.touched[:8]) or _("none"),
                    where=done.where,
                ),
                visits.why(),
            )
    rested = ", ".join(visits.rested[:6])
    return Done(_("In 8 worlds the robot rested at {rested} ...", rested=rested), done.picture())


class _Visits:
    """The posts that a robot touched, and at which it rested."""

    def __init__(self) -> None:
        self.touched: list[str] = []
        self.rested: list[str] = []
        self._empty = 0
        self._still = self._pushing = 0
        self._pose = self._last_pose = (0.0, 0.0, 0.0)
        self._pushes = self._turns = 0

    def watch(self, done: Drive) -> None:
        """Look after a decision."""
        body = done.agent.body
        pose = (*body.position, body.heading)
        drives = any(next(iter(done.agent.last_action.values()), ()))
        self._empty += done.steps > 0 and not done.agent.last_action
        # compared with the rest's beginning: a slow movement is a movement
        if drives or math.dist(pose, self._pose) >= STILL_M:
            self._pose, self._still = pose, 0
        else:
            self._still += 1
        for name in POSTS:
            is_touched = done.agent.percept[f"at {name}"][0] == 1
            if is_touched and self.touched[-1:] != [name]:
                self.touched.append(name)
                self._pushing = 0
            if self.rested[-1:] == [name]:
                continue
            if is_touched and drives:
                self._count_push(done, pose)
            is_at_rest = self._still >= REST_DECISIONS and self._pushing <= MAX_PUSHING_DECISIONS
            if is_at_rest and body.distance(done.sim.world[name]) < AT_POST_M:
                self.rested.append(name)
        self._last_pose = pose

    def _count_push(self, done: Drive, pose: tuple[float, float, float]) -> None:
        """Count a decision in which the robot drives at a post where it has not rested yet."""
        self._pushing += 1
        way, turn = math.dist(pose[:2], self._last_pose[:2]), abs(pose[2] - self._last_pose[2])
        if way < STILL_M and turn < SLOW_TURN_RAD:
            goes_on = any(next(iter(done.agent.last_action.values()), ())[:1])
            self._pushes += goes_on
            self._turns += not goes_on

    def why(self) -> str:
        """Return the diagnosis."""
        if self._empty > REST_DECISIONS:
            return "empty"
        if len(self.touched) == 1 and self._pushes > REST_DECISIONS:
            return "begin"
        if max(self._pushes, self._turns) > REST_DECISIONS:
            return "pushes" if self._pushes > self._turns else "turns"
        if self.rested:
            return "back" if len(self.rested) > 1 else "begin"
        return "short" if len(self.touched) > 3 else "forgets"


@exercise(
    "06.3",
    _("Three bumps"),
    hints={
        "begin": _(
            "It pushes against the first wall and never leaves it. When it bumps, the speed "
            "has to change, and stay changed: `self.speed = -self.speed`."
        ),
        "back": _(
            "It gets to the second wall and stays there. -1 means backward, however often "
            "you set it: take the opposite of the speed that it had. And is it three bumps "
            "that you wait for?"
        ),
        "still": _(
            "It rests for a moment at the third bump, and then drives on. While it rests at "
            "the wall, the bumper still reads 1, so the count goes on: ask for 3 *or more*."
        ),
        "pushes": _(
            "It goes on pushing against a wall. Ask the bumper at each decision, and change "
            "the direction at once where it reads 1: in each world the walls are somewhere "
            "else."
        ),
        "spins": _(
            "After the third bump it turns on the spot. To rest, both numbers have to be 0."
        ),
        "early": _(
            "It rests too early. Count the bumps, in `self.bumps`, and only where the bumper "
            "reads 1."
        ),
        "on": _(
            "It drives on after the third bump. Count the bumps in `self.bumps`, and return "
            "an action of zeros as soon as there were three."
        ),
    },
)
def rests_after_three_bumps(machine: Any) -> Done:
    """Check that the robot drives to and fro between walls, and rests after the third bump."""
    for seed in seeds_of("06.3", 8):
        bumper = GroupTouchSensor(group="wall", perception_key="bumper")
        agent = _robot(as_brain(machine), [bumper])
        touched: list[str] = []
        pauses: list[bool] = []
        pushing = longest_push = 0

        def watch(done: Drive, touched: list[str] = touched, pauses: list[bool] = pauses) -> None:
            nonlocal pushing, longest_push
            pauses.append(done.steps > 0 and not any(done.agent.last_action.get("move", ())))
            bumps = done.agent.percept["bumper"][0] == 1
            pushing = pushing + 1 if bumps and not pauses[-1] else 0
            longest_push = max(longest_push, pushing)
            if bumps:
                wall = "ahead" if done.agent.body.position[0] > done.trail[0][0] else "behind"
                if touched[-1:] != [wall]:
                    touched.append(wall)

        done = drive(ControlRequestor(_corridor(seed), [agent]), agent, seed, 360, watch)
        is_still = math.dist(done.trail[-1], done.trail[-REST_DECISIONS]) < STILL_M
        rests = is_still and all(pauses[-REST_DECISIONS:])
        move = [*done.agent.last_action.get("move", ()), 0.0, 0.0]
        if touched == ["ahead", "behind", "ahead"] and is_still and move[1] and not move[0]:
            raise done.not_yet(
                _("The robot turns on the spot, and does not rest ({where}).", where=done.where),
                "spins",
            )
        if touched == ["ahead", "behind", "ahead"] and longest_push > MAX_BUMP_DECISIONS:
            raise done.not_yet(
                _(
                    "The robot pushed against a wall for {longest_push} decisions ({where}); "
                    "{max_bump_decisions} are enough to notice it.",
                    longest_push=longest_push,
                    where=done.where,
                    max_bump_decisions=MAX_BUMP_DECISIONS,
                ),
                "pushes",
            )
        if touched != ["ahead", "behind", "ahead"] or not rests:
            names = {"ahead": _("ahead"), "behind": _("behind")}
            shown = join([names[each] for each in touched[:6]], ", ") if touched else _("none")
            raise done.not_yet(
                _(
                    "Expected bumps ahead, behind, ahead, and then a rest; got {shown} ({where}).",
                    shown=shown,
                    where=done.where,
                )
                if rests
                else _(
                    "Expected bumps ahead, behind, ahead, and then a rest; got {shown}, and "
                    "no rest ({where}).",
                    shown=shown,
                    where=done.where,
                ),
                _bump_mistake(touched, done, rests, any(pauses)),
            )
    return Done(_("In 8 worlds the robot rested after the third bump."), done.picture())


def _corridor(seed: int) -> World:
    """Return a corridor with a wall at each end, and a robot somewhere in it."""
    chance = np.random.default_rng(seed)
    world = World()
    world.add_floor("plate", BoxShape(size=(16, 4)))
    start = float(chance.uniform(-1, 1))
    world.add_body("robot", CircleShape(radius=0.5), tags=("agent",), position=(start, 0))
    for name, side in (("ahead", 1), ("behind", -1)):
        place = (start + side * float(chance.uniform(1.8, 6)), 0)
        shape = BoxShape(size=(0.4, 3))
        world.add_body(name, shape, kind="static", position=place, tags=("wall",))
    return world


def _bump_mistake(touched: list[str], done: Drive, rests: bool, paused: bool) -> str:
    """Return the diagnosis that fits the walls that a robot touched."""
    pushes = any(next(iter(done.agent.last_action.values()), ()))
    if len(touched) == 2:
        return "back"
    if len(touched) < 2:
        return "early" if touched and rests and not pushes else "begin"
    return "still" if paused else "on"


exit_ticket(
    "06.exit",
    Question(
        "b",
        {
            "a": _(
                "Nobody told the robot what is urgent. The first rule that fits decides, and "
                "the battery stands first."
            ),
            "c": _(
                "`return` ends the function. Only one of the two rules can answer in a decision."
            ),
        },
    ),
    Question(
        "c",
        {
            "a": _(
                "The distance to the wall is in the percept. A rule can compare it at each "
                "decision."
            ),
            "b": _("The feelers say on which side the edge is. Nothing has to be remembered."),
        },
    ),
    Question(
        "a",
        {
            "b": _(
                "Whatever it is, it is gone when the method returns. In fact Python stops at "
                "once, as there is no such variable yet."
            ),
            "c": _(
                "Methods compute like other functions. The question is where the result is kept."
            ),
        },
    ),
)
