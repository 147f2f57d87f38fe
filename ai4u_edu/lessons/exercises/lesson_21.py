"""Traces and signals: ink on the ground, and messages."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import (
    ColourSensor,
    HeadingSensor,
    HearSensor,
    LineSensor,
    LocalBrain,
    PenActuator,
    PositionSensor,
    RBMoveActuator,
    SpeakActuator,
    TouchRewardFunc,
)
from ai4u_edu.lessons.calls import Calls, function_exercise
from ai4u_edu.lessons.exercise import Done, NotYet, exercise
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import finite_numbers, is_close
from ai4u_edu.lessons.rollouts import Drive, as_brain, drive, seeds_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene
from ai4u_edu.world import BoxShape, CircleShape, Variation, World

STRIPE_COLOURS = ("orange", "sky blue")
"""Colours of the stripes of 21.1: the first should be inked. They are almost equally bright."""
ROAD_M = 11.0
"""Way from the robot to the end of the road in 21.1."""
ROAD_DECISIONS = 240
SAMPLE_M = 0.05
"""Distance of the points of the road at which 21.1 looks for ink."""
LEAST_INKED, MOST_ELSEWHERE = 0.75, 0.35
"""Share of an orange stripe that needs ink, and largest share of the rest that has some."""
FOLLOW_DECISIONS = 330
LOST_M = 1.0
"""Distance from the trail beyond which a robot has lost it."""
FIELD_M = 10.0
"""Metres that the largest number of a message stands for in 21.3."""
FIND_DECISIONS = 170


# -- the pen ---------------------------------------------------------------------------------------


def road(paint: Any, seed: int = 0) -> ControlRequestor:
    """Return the world of 21.1: a white road with stripes, and a robot with a pen.

    Args:
        paint: its driver: a function, a controller or a brain.
        seed: of the places and colours of the stripes.
    """
    rng = np.random.default_rng(seed)
    world = World()
    world.add_floor("paper", BoxShape(size=(14, 4)), colour="white")
    colours = [*STRIPE_COLOURS, *rng.choice(STRIPE_COLOURS, 2)]
    x = -4.6
    for number, colour in enumerate(rng.permutation(colours), 1):
        length = float(rng.uniform(0.8, 1.5))
        x += float(rng.uniform(0.5, 0.8)) + length
        world.add_area(
            f"stripe {number}",
            BoxShape(size=(length, 0.3)),
            position=(x - length / 2, 0),
            tags=(str(colour),),
            colour=str(colour),
            paint=True,
        )
    world.add_body("robot", CircleShape(radius=0.35), tags=("agent",), position=(-5.5, 0))
    world.add_body("end", BoxShape(size=(0.4, 3)), kind="static", position=(6, 0), tags=("target",))
    agent = BasicAgent(
        body="robot",
        sensors=[ColourSensor(ahead=0.2)],
        actuators=[
            RBMoveActuator(move_amount=1.5, turn_amount=2),
            PenActuator(colours=["blue"], width=0.3),
        ],
        rewards=[TouchRewardFunc(name="end", target="end", reward=1, cause_episode_to_end=True)],
        brains=[as_brain(paint)],
    )
    return ControlRequestor(world, [agent], success="end")


@exercise(
    "21.1",
    _("Ink the orange stripes"),
    hints={
        "begin": _(
            "The pen is up all the time. `pen` gets 1 where it should be down: choose by "
            '`percept["colour"]`.'
        ),
        "always": _("The pen is down wherever it drives. Put it down over orange alone."),
        "bright": _(
            "It inks the blue stripes, too. Both colours are about equally bright, so "
            "brightness can't tell them apart. How much *blue* is in each of them?"
        ),
        "paper": _(
            "It inks the white paper. White has as much red in it as orange: white is all "
            "three colours together. Which of the three has orange none of?"
        ),
        "reversed": _("It inks what it should leave, and leaves what it should ink."),
        "other": _("It inks the blue stripes, and not the orange ones."),
        "stands": _(
            "It does not get to the end of the road. Drive straight on all the time: "
            '`"move": [1, 0, 0, 0]`.'
        ),
        "away": _(
            "It leaves the middle of the road. Drive straight on: the second number of "
            "`move` stays 0."
        ),
    },
)
def inks_orange(paint: Any) -> Done:
    """Check for ink on the orange stripes of six roads, and hardly any elsewhere."""
    seeds = seeds_of("21.1", 6)
    for seed in seeds:
        sim = road(paint, seed)
        done = drive(sim, sim.agents[0], seed, ROAD_DECISIONS)
        inked = {"orange": 0.0, "sky blue": 0.0, "paper": 0.0}
        points = dict.fromkeys(inked, 0)
        areas = list(sim.world.areas.values())
        for x in np.arange(-5.3, 5.2, SAMPLE_M):
            tags = [area.tags[0] for area in areas if area.contains(float(x), 0.0)]
            place = tags[0] if tags else "paper"
            points[place] += 1
            inked[place] += bool(sim.world.ink.at(float(x), 0.0))
        share = {place: inked[place] / points[place] for place in points}
        elsewhere = (inked["sky blue"] + inked["paper"]) / (points["sky blue"] + points["paper"])
        if max(abs(y) for _, y in done.trail) > 0.3:
            raise done.not_yet(
                _("It did not stay in the middle of the road ({where}).", where=done.where), "away"
            )
        if not done.won:
            raise done.not_yet(
                _("It did not get to the end of the road ({where}).", where=done.where), "stands"
            )
        if share["orange"] < LEAST_INKED or elsewhere > MOST_ELSEWHERE:
            orange, blue, paper = (share[each] for each in ("orange", "sky blue", "paper"))
            raise done.not_yet(
                _(
                    "There is ink on {orange:.0%} of the orange stripes, on {blue:.0%} of "
                    "the blue ones and on {paper:.0%} of the paper ({where}).",
                    orange=orange,
                    blue=blue,
                    paper=paper,
                    where=done.where,
                ),
                _ink_mistake(share),
            )
    return Done(
        _("Orange stripes have ink, and nothing else: {count} roads.", count=len(seeds)),
        done.picture(),
    )


def _ink_mistake(share: dict[str, float]) -> str:
    """Return the diagnosis that fits the shares that have ink."""
    orange, blue, paper = (share[each] > 0.5 for each in ("orange", "sky blue", "paper"))
    found = {
        (False, False, False): "begin",
        (True, True, True): "always",
        (True, True, False): "bright",
        (True, False, True): "paper",
        (False, True, True): "reversed",
        (False, True, False): "other",
        (False, False, True): "reversed",
    }
    return found.get((orange, blue, paper), "begin")


# -- a trail ---------------------------------------------------------------------------------------


@dataclass
class _Scout:
    """Drives a bow that swings to both sides, and then stops."""

    bend: float
    """Turn of the whole way, radians."""
    swing: float
    """Largest turn to the side, radians."""
    swings: float
    """Swings on the whole way."""
    decisions: int
    _count: int = field(default=0, init=False)

    def __call__(self, _: object) -> dict[str, list[float]]:
        """Return the action of the next decision."""
        share = self._count / self.decisions
        self._count += 1
        if share >= 1:
            return {"move": [0, 0, 0, 0], "pen": [0]}
        around = math.tau * self.swings
        # radians a decision, and of what the actuator turns in one
        turn = (self.bend + self.swing * around * math.cos(around * share)) / self.decisions
        return {"move": [1, -turn * 12 / 3, 0, 0], "pen": [1]}


def trail(follow: Any, seed: int = 0) -> ControlRequestor:
    """Return the world of 21.2: a scout that draws its way, and a robot behind it.

    Args:
        follow: the robot's driver: a function, a controller or a brain.
        seed: of the scout's way.
    """
    rng = np.random.default_rng(seed)
    heading = float(rng.uniform(-180, 180))
    start = 0.9 * math.cos(math.radians(heading)), 0.9 * math.sin(math.radians(heading))
    side = 1 if seed % 2 else -1
    scout = _Scout(
        bend=side * float(rng.uniform(1.0, 2.2)),
        swing=float(rng.choice([-1, 1]) * rng.uniform(0.3, 0.6)),
        swings=float(rng.uniform(1.0, 1.6)),
        decisions=int(rng.integers(75, 105)),
    )
    world = World()
    world.add_floor("field", BoxShape(size=(24, 24)), colour="white")
    round_body = CircleShape(radius=0.35)
    world.add_body("robot", round_body, tags=("agent",), heading_deg=heading)
    world.add_body(
        "scout", round_body, tags=("target",), position=start, heading_deg=heading, colour="purple"
    )
    move = RBMoveActuator(move_amount=1.2, turn_amount=3)
    touch = TouchRewardFunc(name="there", target="scout", reward=1, cause_episode_to_end=True)
    robot = BasicAgent(
        body="robot",
        sensors=[LineSensor(points=5, ahead=0.4, width=0.6)],
        actuators=[move],
        rewards=[touch],
        brains=[as_brain(follow)],
        priority=1,
    )
    ahead = BasicAgent(
        id="scout",
        body="scout",
        actuators=[
            RBMoveActuator(move_amount=1.2, turn_amount=3),
            PenActuator(colours=["purple"], width=0.15),
        ],
        brains=[LocalBrain(controller=scout)],
    )
    return ControlRequestor(world, [robot, ahead], success="there")


@exercise(
    "21.2",
    _("Follow the trail"),
    hints={
        "begin": _(
            "It does the same whatever its eyes see. If the left eyes see the trail, turn to "
            "the left; if the right ones see it, turn to the right."
        ),
        "mirrored": _(
            "It turns away from the trail. The first eye is the leftmost one, and a turn "
            "below 0 goes to the left."
        ),
        "late": _(
            "It turns too little, so it runs off where the trail bends. Turn more, or drive "
            "more slowly."
        ),
        "too-slow": _(
            "It stays on the trail, and is too slow: the time was up before it was there."
        ),
        "stands": _("It does not move on. While no eye sees the trail, drive straight on."),
    },
)
def follows_the_trail(follow: Any) -> Done:
    """Check that it finds the scout at the end of its trail in eight worlds."""
    seeds = seeds_of("21.2", 8)
    for count, seed in enumerate(seeds):
        sim = trail(follow, seed)
        scouts_way: list[tuple[float, float]] = []

        def watch(done: Drive, way: list[tuple[float, float]] = scouts_way) -> None:
            way.append(done.sim.agent("scout").body.position)

        done = drive(sim, sim.agents[0], seed, FOLLOW_DECISIONS, watch)
        if not done.won:
            off = max(min(math.dist(here, each) for each in scouts_way) for here in done.trail)
            how = _("lost the trail") if off > LOST_M else _("did not get to its end in time")
            raise done.not_yet(
                _(
                    "The robot {how} ({where}). On {count} trails before that it got there.",
                    how=how,
                    where=done.where,
                    count=count,
                ),
                _trail_mistake(follow, done, off),
            )
    return Done(
        _("It found the scout at the end of {count} trails.", count=len(seeds)), done.picture()
    )


def _trail_mistake(follow: Any, done: Drive, off: float) -> str:
    """Return the diagnosis that fits a robot that did not find the scout."""
    if done.moved < 0.3:
        return "stands"
    if callable(follow) and not isinstance(follow, type):
        left, right = (
            follow({**done.agent.percept, "line": np.array(eyes)})
            for eyes in ([1.0, 1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0, 1.0])
        )
        if repr(left) == repr(right):
            return "begin"
        are_actions = isinstance(left, dict) and isinstance(right, dict)
        if are_actions and float(left["move"][1]) > float(right["move"][1]):
            return "mirrored"
    return "late" if off > LOST_M else "too-slow"


# -- messages --------------------------------------------------------------------------------------


def _places(chance: np.random.Generator) -> list[tuple[list[float], list[float]]]:
    """Return readings of a HearSensor, each with the place known before."""

    def known() -> list[float]:
        return [float(round(each)) for each in chance.uniform(1, 9, 2) * chance.choice([-1, 1], 2)]

    def told() -> list[float]:
        return [round(float(each), 2) for each in chance.uniform(0.1, 0.9, 2)]

    x, y = told()
    return [
        ([1.0, x, -y], known()),
        ([0.0, 0.0, 0.0], known()),
        ([1.0, 0.0, 0.0], known()),
        ([1.0, 0.0, y], known()),
        ([1.0, -x, 0.0], known()),
        *[([1.0, *told()], known()) for _ in range(3)],
        ([0.0, 0.0, 0.0], known()),
    ]


@function_exercise(
    "21.3",
    _("Zero, or silence?"),
    hints={
        "begin": _(
            "`heard` is the first number of the reading. If it is 1, the place is 10 times "
            "the other two numbers; else it is the place known before."
        ),
        "silence": _(
            "When nobody speaks, all numbers are 0. That does not mean that the flag is in "
            "the middle: ask for `heard` first."
        ),
        "flag": _(
            "A 0 may have been said: the middle of the field is a place, too. Only `heard` "
            "says whether somebody spoke."
        ),
        "scale": _("The numbers of a message go from -1 to 1. Here 1 stands for 10 metres."),
        "swapped": _("x comes first, then y."),
    },
)
def hears_a_place(chance: np.random.Generator) -> Calls:
    """Check the place that is known after a message, or after silence."""
    asked = []
    for hear, before in _places(chance):
        given = yield (np.array(hear), list(before))
        asked.append((hear, before, finite_numbers(given, 2, expected=_("Expected two numbers"))))
    for hear, before, got in asked:
        wanted = _told(hear, before)
        if not is_close(got, wanted, 1e-6):
            said = f"[{hear[0]:g}, {hear[1]:g}, {hear[2]:g}]"
            raise NotYet(
                _(
                    "Heard {said}, known before {before}: expected {shown}, got {shown2}.",
                    said=said,
                    before=str(before),
                    shown=_shown(wanted),
                    shown2=_shown(got),
                ),
                hint=_message_mistake(asked),
            )
    return _("{count} readings, and it always knew the place that was told last.", count=len(asked))


def _told(hear: Sequence[float], before: list[float]) -> list[float]:
    return [FIELD_M * hear[1], FIELD_M * hear[2]] if hear[0] else before


def _shown(place: Sequence[float]) -> str:
    return "[" + ", ".join(f"{round(each, 3):g}" for each in place) + "]"


_Slip = Callable[[Sequence[float], list[float]], Sequence[float]]


def _message_mistake(asked: Sequence[tuple[list[float], list[float], list[float]]]) -> str:
    """Return the diagnosis that fits all answers."""
    slips: dict[str, _Slip] = {
        "begin": lambda _, before: before,
        "silence": lambda hear, _: [FIELD_M * each for each in hear[1:]],
        "silence ": lambda hear, _: hear[1:],
        "flag": lambda hear, before: _told([float(any(hear[1:])), *hear[1:]], before),
        "flag ": lambda hear, before: _told([float(all(hear[1:])), *hear[1:]], before),
        "flag  ": lambda hear, before: _told([hear[1], *hear[1:]], before),
        "scale": lambda hear, before: hear[1:] if hear[0] else before,
        "swapped": lambda hear, before: _told([hear[0], hear[2], hear[1]], before),
    }
    for name, slip in slips.items():
        if all(is_close(got, list(slip(hear, before)), 1e-6) for hear, before, got in asked):
            return name.strip()
    return "begin"


# -- two robots ------------------------------------------------------------------------------------


def tower(spot: Any, run: Any, *, reach: float = 30.0) -> ControlRequestor:
    """Return the world of 21.4: a tower that sees a flag, and a robot that does not.

    Args:
        spot: the tower's driver: a function, a controller or a brain.
        run: the robot's driver.
        reach: distance up to which the tower is heard, metres.
    """
    world = World()
    world.add_floor("field", BoxShape(size=(18, 18)))
    world.add_body("tower", BoxShape(size=(1, 1)), kind="static", position=(0, 0), colour="purple")
    anywhere = Variation(x=(-7, 7), y=(-7, 7), heading_deg=(-180, 180), clearance=1.5)
    flag = CircleShape(radius=0.4)
    world.add_body("flag", flag, kind="static", tags=("target",), random=anywhere)
    world.add_body("robot", CircleShape(radius=0.35), tags=("agent",), random=anywhere)
    robot = BasicAgent(
        body="robot",
        sensors=[
            HearSensor(size=2),
            PositionSensor(normalized=False),
            HeadingSensor(),
        ],
        actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
        rewards=[TouchRewardFunc(name="found", target="flag", reward=1, cause_episode_to_end=True)],
        brains=[as_brain(run)],
        priority=1,
    )
    speaker = BasicAgent(
        id="tower",
        body="tower",
        sensors=[PositionSensor(perception_key="flag", target="flag", normalized=False)],
        actuators=[SpeakActuator(size=2, reach=reach)],
        brains=[as_brain(spot)],
    )
    return ControlRequestor(world, [robot, speaker], success="found")


@exercise(
    "21.4",
    _("A tower that tells"),
    hints={
        "begin": _(
            "The tower says two numbers from -1 to 1: the flag's x and y, divided by 10. The "
            "robot multiplies what it heard by 10, and goes there."
        ),
        "silent": _("The tower does not speak: the first number of `speak` has to be above 0.5."),
        "deaf": _('The robot does the same whatever it hears: read `percept["hear"]`.'),
        "range": _("A message has numbers from -1 to 1 alone. Metres are too large: divide them."),
        "code": _(
            "The two don't mean the same by their numbers. What the tower divides by, the "
            "robot has to multiply by; and x comes first for both, or y does."
        ),
        "too-slow": _("It goes to the right place, and does not get there in time."),
        "elsewhere": _(
            "It finds the flag without hearing a word: the robot knows from elsewhere where "
            "it is. Two robots share no variables; the tower has to *say* it."
        ),
    },
)
def finds_by_messages(spot: Any, run: Any) -> Done:
    """Check that the robot finds a flag that only the tower sees, in ten worlds."""
    seeds = seeds_of("21.4", 10)
    sim = tower(spot, run)
    for count, seed in enumerate(seeds):
        said: list[Sequence[float]] = []

        def listen(done: Drive, said: list[Sequence[float]] = said) -> None:
            speak = done.sim.agent("tower").last_action.get("speak", ())
            if len(speak) and speak[0] > 0.5:
                said.append(tuple(map(float, speak)))

        done = drive(sim, sim.agents[0], seed, FIND_DECISIONS, listen)
        if not done.won:
            raise done.not_yet(
                _(
                    "The robot did not get to the flag ({where}). In {count} worlds before "
                    "that it did.",
                    where=done.where,
                    count=count,
                ),
                _telling_mistake(run, said, done),
            )
    unheard = tower(spot, run, reach=0.1)
    if all(drive(unheard, unheard.agents[0], seed, FIND_DECISIONS).won for seed in seeds[:4]):
        raise NotYet(_("It finds the flag where nobody can hear the tower, too."), hint="elsewhere")
    return Done(
        _("The tower told, and the robot went: {count} worlds.", count=len(seeds)), done.picture()
    )


def _telling_mistake(run: Any, said: Sequence[Sequence[float]], done: Drive) -> str:
    """Return the diagnosis that fits a robot that did not find the flag."""
    is_deaf = False
    if callable(run) and not isinstance(run, type):
        answers = {
            repr(run({**done.agent.percept, "hear": np.array(hear)}))
            for hear in ([1.0, 0.4, 0.7], [1.0, -0.6, 0.2], [1.0, 0.5, -0.5])
        }
        is_deaf = len(answers) == 1
    if not said:
        return "begin" if is_deaf else "silent"
    if all(max(map(abs, each[1:])) >= 1 for each in said):
        return "range"
    if is_deaf:
        return "deaf"
    place = done.sim.world["flag"].position
    nearer = math.dist(done.trail[0], place) - math.dist(done.trail[-1], place)
    return "too-slow" if nearer > 0.5 * math.dist(done.trail[0], place) else "code"


def loads_home(*, has_ink: bool) -> int:
    """Return how many loads the five ants bring home in a minute.

    Args:
        has_ink: False wipes their trails away at once.
    """
    sim = Scene.load("ants").build()
    sim.agents[0].use_brain(LocalBrain(controller=lambda _: {}))
    sim.reset(1)
    end = sim.world.time + 60
    while sim.world.time < end:
        sim.tick()
        if not has_ink:
            sim.world.ink.clear()
    loads = sum(agent.ledger.episode_terms.get("harvest", 0.0) for agent in sim.agents[1:])
    return round(loads / 10)


exit_ticket(
    "21.exit",
    Question(
        "a",
        {
            "b": _(
                "The other robot was there long ago. It need not be there any more, nor hear "
                "anything."
            ),
            "c": _("Ink stays until it is wiped away or the world begins anew."),
        },
    ),
    Question(
        "c",
        {
            "a": _("Silence reads 0 as well, and so does the middle of a field when it is said."),
            "b": _("The number after it may be anything, in a message too."),
        },
    ),
    Question(
        "b",
        {
            "a": _("It hears all robots in reach, whatever they mean by their numbers."),
            "c": _(
                "Numbers have no meaning of their own: whoever speaks and whoever hears have "
                "to agree on it."
            ),
        },
    ),
)
