"""The decision cycle."""

from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import LocalBrain, Percept, RayCastingSensor, RBMoveActuator
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise
from ai4u_edu.lessons.numeric import finite_number, is_close
from ai4u_edu.lessons.rollouts import drive
from ai4u_edu.world import BoxShape, CircleShape, World

LAZY = 16
"""Value of ``skip_frame`` that passes; with more than 18 the robot can fall."""


def _runway(controller: Any, skip_frame: int, *, speed: float = 3, start: float = -9.0) -> Any:
    world = World()
    world.add_floor("runway", BoxShape(size=(20, 4)))
    world.add_body("robot", CircleShape(radius=0.5), position=(start, 0), tags=("agent",))
    feeler = RayCastingSensor(
        perception_key="feeler",
        rows=1,
        columns=1,
        vertical_field_of_view=1,
        vertical_shift=27,
        vision_max_distance=2,
        group_code={"floor": 1},
        flattened=True,
    )
    agent = BasicAgent(
        body="robot",
        sensors=[feeler],
        actuators=[RBMoveActuator(move_amount=speed, turn_amount=3)],
        brains=[LocalBrain(controller=controller, skip_frame=skip_frame)],
    )
    return ControlRequestor(world, [agent])


def _go(_: Percept) -> dict[str, list[float]]:
    return {"move": [1, 0, 0, 0]}


@exercise(
    "06.1",
    "Blind",
    hints={
        "begin": "From one decision to the next skip_frame + 1 ticks pass, and a tick is 1/60 of a "
        "second. How far does the robot get in that time?",
        "one-more": "Nearly. With `skip_frame=0` the agent decides at every tick, and drives for "
        "one tick in between: it is one tick more than you count.",
        "seconds": "A tick is not a second: 60 of them are.",
    },
)
def computes_the_blind_way(blind_way: Any) -> Done:
    """Check the metres from one decision to the next."""
    a_function(blind_way)
    for speed, skip_frame in ((2.0, 4), (3.0, 0), (1.0, 9), (4.0, 29), (2.5, 14)):
        sim = _runway(_go, skip_frame, speed=speed)
        done = drive(sim, sim.agents[0], 1, limit=1)
        found = finite_number(blind_way(speed, skip_frame))
        if not is_close(found, done.moved, 0.005):
            hint = "begin"
            if is_close(found, speed * skip_frame / 60, 1e-6) and found:
                hint = "one-more"
            elif found > 20 * done.moved:
                hint = "seconds"
            raise done.not_yet(
                f"At {speed:g} m/s with skip_frame={skip_frame} the robot drove "
                f"{done.moved:.3f} m in one decision; your function says {found:.3f}.",
                hint,
            )
    return Done("Five speeds, five ways, and each was right.")


def _careful(percept: Percept) -> dict[str, list[float]]:
    return {"move": [1 if percept["feeler"][0] else 0, 0, 0, 0]}


@exercise(
    "06.2",
    "As lazy as possible",
    hints={
        "lazier": "It never falls, and could be lazier. The feeler sees 0.98 m ahead of the "
        "robot's middle. How many ticks does it take to drive a metre?",
        "falls": "It drives too far before it looks again. The blind way has to be shorter than "
        "the 0.98 m that the feeler sees ahead.",
    },
)
def is_lazy(skip_frame: Any) -> Done:
    """Check that it never falls, and decides seldom."""
    if isinstance(skip_frame, bool) or not isinstance(skip_frame, int):
        raise NotYet(f"Expected a whole number, got `{skip_frame!r}`.")
    if not 0 <= skip_frame <= 600:
        raise NotYet(f"Expected a number from 0 to 600, got {skip_frame}.", hint="falls")
    for number in range(40):
        sim = _runway(_careful, skip_frame, start=-9.0 + 0.05 * number)
        done = drive(sim, sim.agents[0], number, limit=480 // (skip_frame + 1) + 2)
        if done.fell:
            raise done.not_yet(
                f"With skip_frame={skip_frame} the robot fell when it started at "
                f"x = {-9.0 + 0.05 * number:.2f}.",
                "falls",
            )
    if skip_frame < LAZY:
        raise NotYet(
            f"With skip_frame={skip_frame} it never fell in 40 runs. It can be lazier.",
            hint="lazier",
            picture=done.picture(),
        )
    return Done(
        f"With skip_frame={skip_frame} the robot never fell, from 40 places.", done.picture()
    )


@exercise(
    "06.3",
    "A diary",
    hints={
        "begin": "Connect a function that appends to `notes`, like `agent.end_of_step.connect("
        'lambda agent: notes.append("decision"))`.',
        "ticks": "You wrote more than once for a decision. `begin_of_apply_action` comes at each "
        "tick; `end_of_step` comes once a decision.",
        "end": 'The last note of an episode has to be "end": connect with `end_of_episode`.',
    },
)
def keeps_a_diary(diary: Any) -> Done:
    """Check for entries of the begin, the decisions and the end."""
    a_function(diary)
    for limit in (7, 3, 11):
        sim = _runway(_go, 4)
        agent = sim.agents[0].changed(max_steps_per_episode=limit)
        sim = ControlRequestor(sim.world, [agent])
        notes = diary(agent)
        if not isinstance(notes, list):
            raise NotYet(f"Expected that `diary` returns a list, got `{notes!r}`.", hint="begin")
        drive(sim, agent, 1)
        wanted = ["begin", *["decision"] * limit, "end"]
        if notes != wanted:
            count = notes.count("decision")
            hint = "ticks" if count > limit else "end" if count == limit else "begin"
            raise NotYet(
                f"In an episode of {limit} decisions your diary says {notes[:12]!r}"
                f"{' ...' if len(notes) > 12 else ''}, not {wanted[:12]!r}.",
                hint=hint,
            )
    return Done("Three episodes, three diaries without a mistake.")
