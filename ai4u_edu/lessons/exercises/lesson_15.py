"""Remote control: a script drives a robot that is somewhere else."""

import math
import socket
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from json import dumps
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import (
    Actuator,
    BearingSensor,
    FallReward,
    LocalBrain,
    Percept,
    RBMoveActuator,
    RemoteBrain,
    TouchRewardFunc,
)
from ai4u_edu.learn.envs.spaces_of import outputs_of
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import chance_for, finite_numbers, is_close
from ai4u_edu.lessons.rollouts import Drive, drives, seeds_of
from ai4u_edu.lessons.worlds import plate
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext
from ai4u_edu.scenes import Scene
from ai4u_edu.wire.ai4u import decode_request
from ai4u_edu.world import Body

if TYPE_CHECKING:
    from ai4u_edu.remote import Robot

LIMIT = 300
RECEIVE_TIMEOUT_MS = 20_000
"""Time for which the world waits for an action, milliseconds."""
MAX_DIALOGUE_S = 10
"""Time after which :func:`overheard` ends, whatever was said."""
LAG_DECISIONS = 3
"""Lag of the percepts, in decisions of 1/12 s each."""
SCENES = ("box_chase", "line_follow", "strong", "parking")
"""Robots that are asked for; ``strong`` is one whose numbers go beyond 1."""


class Winch(Actuator):
    """Robot's motor with ranges of its own."""

    high: tuple[float, ...] = (3.0, 0.5, 0.25)
    """Highest numbers: forward, turn, and spare ones."""

    def space(self) -> Box:
        """Return the ranges, from -1 on."""
        high = np.array(self.high, np.float32)
        return Box(np.full_like(high, -1), high)

    def act(self, body: Body, action: Any) -> None:
        """Drive and turn."""
        body.apply_force(float(action[0]), 0.0)


@contextmanager
def served(sim: ControlRequestor) -> "Iterator[Robot]":
    """Yield a robot of a world served on this machine, in lockstep at full speed."""
    from ai4u_edu.page.server import Rules, ServerThread, room_app
    from ai4u_edu.remote import connect
    from ai4u_edu.runtime.runner import Runner

    runner = Runner(sim, time_scale=math.inf)
    # a machine that is busy with thirty students' checks may keep a script waiting
    rules = Rules(receive_timeout=RECEIVE_TIMEOUT_MS)
    app = room_app(runner, viser_port=1, title="exercise", rules=rules)
    runner.start()
    try:
        with ServerThread(app) as server, connect(server.url, mode="lockstep") as robot:
            yield robot
    finally:
        runner.stop()


def late(controller: Callable[[Any], Any], lag: int = LAG_DECISIONS) -> ControlRequestor:
    """Return a robot on a plate with a box, whose driver gets old percepts.

    Args:
        controller: the driver.
        lag: age of the percepts, in decisions.
    """
    seen: deque[Percept] = deque(maxlen=lag + 1)

    def drive(percept: Percept) -> Any:
        if agent.steps == 0:
            seen.clear()
        seen.append(percept)
        return controller(seen[0])

    agent = BasicAgent(
        body="robot",
        sensors=[BearingSensor(target="box")],
        actuators=[RBMoveActuator(move_amount=3, turn_amount=6)],
        rewards=[
            TouchRewardFunc(target="box", reward=1, cause_episode_to_end=True),
            FallReward(),
        ],
        brains=[LocalBrain(controller=drive)],
    )
    return ControlRequestor(plate(), [agent], success="touch")


def overheard(brain: Callable[[int], RemoteBrain], answers: Sequence[str]) -> Iterator[str]:
    """Yield what a world and an AI4U script say to each other, until the script is silent.

    Args:
        brain: makes the robot's brain from the script's port.
        answers: the script's answers in AI4U's protocol, one for each decision; then it is silent.
    """
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as script:
        script.bind(("127.0.0.1", 0))
        script.setblocking(False)
        agent = BasicAgent(
            body="robot",
            sensors=[BearingSensor(target="box")],
            actuators=[RBMoveActuator(move_amount=3, turn_amount=3)],
            brains=[brain(script.getsockname()[1])],
        )
        sim = ControlRequestor(plate(), [agent])
        sim.reset(1)
        remote = agent.brain
        greeting = ["__reset__;1;0", f"max_steps;1;0@id;1;{agent.id}"]
        try:
            yield from _said(sim, script, [*greeting, *answers])
        finally:
            remote.close()


def _said(sim: ControlRequestor, script: socket.socket, answers: list[str]) -> Iterator[str]:
    """Yield the states that a world sends, and a script's answers to them."""
    end = time.monotonic() + MAX_DIALOGUE_S
    status = cast(RemoteBrain, sim.agents[0].brain).status
    said = 0
    while time.monotonic() < end and not (said > len(answers) and status().reason):
        sim.tick()
        try:
            request, world = script.recvfrom(2**16)
        except BlockingIOError:
            time.sleep(0.001)
            continue
        fields = {field.name: field.value for field in decode_request(request)}
        if "bearing" in fields:
            told = (f"{name}={fields[name]}" for name in ("bearing", "steps", "reward", "done"))
            yield f"world:  {' '.join(told)}"
        if said < len(answers):
            script.sendto(answers[said].encode(), world)
            if not answers[said].startswith(("__", "max_steps")):
                yield f"script: {answers[said]}"
        said += 1
    yield f"world:  {status().reason}"


def _short(name: str, high: Sequence[float] = (3.0, 0.5, 0.25)) -> ControlRequestor:
    """Return a scene whose episodes end soon, whatever a script does.

    Args:
        name: a scene's name, or ``strong`` or ``unknown`` for a robot with ranges of its own.
        high: highest numbers that such a robot takes.
    """
    if name in ("strong", "unknown"):
        agent = BasicAgent(
            body="robot",
            max_steps_per_episode=LIMIT,
            sensors=[BearingSensor(target="box")],
            actuators=[Winch(action_name="winch", high=tuple(high))],
            brains=[LocalBrain(controller=lambda _: {})],
        )
        return ControlRequestor(plate(), [agent])
    plain = Scene.load(name).plain()
    plain["agents"][0]["max_steps_per_episode"] = LIMIT
    return Scene.loads(dumps(plain), name=name).build()  # JSON is YAML as well


@exercise(
    "15.1",
    _("A script drives"),
    call_limit_s=15,
    hints={
        "loop": _(
            "One action is one decision, 1/12 s. Go on until the episode is over: `for "
            "percept in robot:`, and in the loop one `robot.act(move=...)`."
        ),
        "look": _(
            'It acts again and again, but never looks. `percept["orientation"][0]` is the '
            "cosine of the direction to the box: turn until it is above 0.99, then go."
        ),
    },
)
def drives_from_afar(script: Any) -> Done:
    """Check a script in three served worlds."""
    drive = a_function(script)
    sim = _short("box_chase")
    agent = sim.agents[0]
    with served(sim) as robot:
        for seed in seeds_of("15.1", 3):
            robot.reset(seed=seed)
            done = Drive(sim, agent, seed, [agent.body.position])
            drive(robot)
            percept = robot.percept if robot.percept and robot.percept.done else robot.sense()
            if percept.reward_terms.get("touch", 0.0) <= 0:
                how = (
                    _(
                        "The robot's episode ended without the box, after {step} decisions",
                        step=percept.step,
                    )
                    if percept.done
                    else _(
                        "Your script ended after {step} decisions, before the episode did",
                        step=percept.step,
                    )
                )
                raise NotYet(
                    _("{how} (seed {seed}).", how=how, seed=seed),
                    hint="look" if percept.done else "loop",
                    picture=done.picture(),
                )
            done.trail.append(agent.body.position)
    return Done(_("Over the network it found the box, in three worlds."), done.picture())


@exercise(
    "15.2",
    _("Late news"),
    hints={
        "fast": _(
            "It turns on what was true a quarter of a second ago, and by then it looks "
            "elsewhere. Turn less for the same sine, and drive more slowly: late news is "
            "less wrong about a slow robot."
        ),
        "blind": _("It does the same whatever it senses: look at the bearing."),
        "away": _(
            "It turns away from the box: for a box on the left (sine above 0) turn left (below 0)."
        ),
        "still": _("It never drives. Where the box is ahead, drive slowly."),
    },
)
def copes_with_lag(careful: Any) -> Done:
    """Check twenty worlds with percepts that are a quarter of a second old."""
    worlds = 20
    drive_late = a_function(careful)
    for done in drives(lambda: late(drive_late), None, seeds_of("15.2", worlds), limit=LIMIT):
        if not done.won:
            how = _("fell") if done.fell else _("did not get there in time")
            raise done.not_yet(
                _(
                    "With percepts {lag_decisions} decisions old the robot {how} ({where}).",
                    lag_decisions=LAG_DECISIONS,
                    how=how,
                    where=done.where,
                ),
                _why(drive_late),
            )
    return Done(
        _("A quarter of a second late, and it found the box in {worlds} worlds.", worlds=worlds),
        done.picture(),
    )


def _why(careful: Callable[..., Any]) -> str:
    """Return the diagnosis that fits how a driver answers."""
    seen = {"left": (0.8, 0.6), "right": (-0.8, 0.6), "ahead": (0.0, 1.0)}
    moves = {}
    for name, bearing in seen.items():
        answer = careful({"bearing": np.array(bearing)})
        move = answer.get("move", ()) if isinstance(answer, dict) else ()
        moves[name] = [float(each) for each in move]
    if len({repr(each) for each in moves.values()}) == 1:
        return "blind"
    if len(moves["left"]) == 4 and moves["left"][1] > moves["right"][1]:
        return "away"
    return "still" if not any(move[:1] != [0.0] for move in moves.values()) else "fast"


@exercise(
    "15.3",
    _("A robot that you don't know"),
    hints={
        "ask": _(
            "Robots differ: this one takes another number of numbers, or another range. Ask "
            "it: `robot.spaces.action.high` are the highest numbers that it takes."
        ),
        "one": _(
            "It gives 1 for each number. Not every robot's range ends at 1: ask for the "
            "highest numbers."
        ),
        "full": _(
            "The robot takes that, but it is not full power: each number should be the "
            "highest that its range allows."
        ),
    },
)
def asks_the_robot(full_power: Any) -> str:
    """Check the function with four robots."""
    ask = a_function(full_power)
    chance = chance_for("15.3", full_power)
    drawn = chance.uniform(0.3, 6, int(chance.integers(2, 6))).round(2).tolist()
    for name in (*SCENES, "unknown"):
        sim = _short(name, drawn) if name == "unknown" else _short(name)
        (output,) = outputs_of(sim.agents[0])
        with served(sim) as robot:
            robot.reset()
            high = np.ravel(robot.spaces.action.high)  # type: ignore[attr-defined]
            takes = ngettext(
                "The robot of `{name}` takes {n} number",
                "The robot of `{name}` takes {n} numbers",
                len(high),
                name=name,
            )
            got = finite_numbers(ask(robot), len(high), expected=takes, hint="ask")
            if not is_close(got, high, 1e-5):
                raise NotYet(
                    _(
                        "For the robot of `{name}` full power is {power}, and it got {got}.",
                        name=name,
                        power=str(high.tolist()),
                        got=str(got),
                    ),
                    hint="one" if set(got) == {1.0} else "full",
                )
            robot.sense()
            robot.act({output: got})
            robot.sense()
    return _("Five different robots, each at full power.")


exit_ticket(
    "15.exit",
    Question(
        "b",
        {
            "a": _(
                "In realtime nobody waits, and by default nothing stops the robot: see the "
                'three ways in "When the script falls silent".'
            ),
            "c": _("The world stands still in lockstep. In realtime it goes on."),
        },
    ),
    Question(
        "c",
        {
            "a": _("A faster robot turns farther in 0.25 s, so it overshoots even more."),
            "b": _(
                "It would decide more often about the same old news: each percept is still "
                "0.25 s late."
            ),
        },
    ),
    Question(
        "a",
        {
            "b": _(
                "In lockstep the world waits until the receive time-out is over, which is 2 "
                "seconds if you say nothing. Then it goes on."
            ),
            "c": _(
                "In realtime the world's time goes on while the program computes, even if "
                "the robot stands still."
            ),
        },
    ),
)
