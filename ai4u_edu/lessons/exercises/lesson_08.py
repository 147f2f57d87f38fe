"""The decision cycle."""

import math
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import FallReward, LocalBrain, Percept, RayCastingSensor, RBMoveActuator
from ai4u_edu.lessons.calls import Calls, function_exercise
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise, named
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import difference, finite_number, is_close
from ai4u_edu.lessons.rollouts import drive
from ai4u_edu.lessons.student_errors import NOTHING_RETURNED
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BoxShape, CircleShape, World

LAZY = 16
"""Value of ``skip_frame`` that passes; with more than 18 the robot can fall."""


def feeler_runway(
    controller: Any, skip_frame: int, *, speed: float = 3, start: float = -9.0
) -> ControlRequestor:
    """Return a runway with a robot that feels whether there is floor ahead."""
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


@function_exercise(
    "08.1",
    _("Blind"),
    hints={
        "begin": _(
            "From one decision to the next skip_frame + 1 ticks pass, and a tick is 1/60 of "
            "a second. How far does the robot get in that time?"
        ),
        "one-more": _(
            "Nearly. With `skip_frame=0` the agent decides at every tick, and drives for one "
            "tick in between: it is one tick more than you count."
        ),
        "seconds": _("A tick is not a second: there are 60 of them in a second."),
        "twelve": _(
            "Twelve decisions a second are right only for `skip_frame=4`. With another "
            "number, a decision takes more or less time."
        ),
        "ticks": _(
            "That is the number of ticks or seconds. How far does the robot get in that time?"
        ),
    },
)
def computes_the_blind_way(chance: np.random.Generator) -> Calls:
    """Check the metres from one decision to the next."""
    for number in range(6):
        speed = round(float(chance.uniform(1, 4)), 1)
        skip_frame = 0 if number == 1 else int(chance.integers(5, 30))
        sim = feeler_runway(_go, skip_frame, speed=speed)
        done = drive(sim, sim.agents[0], 1, limit=1)
        found = finite_number((yield speed, skip_frame))
        if not is_close(found, done.moved, 0.005):
            ticks = skip_frame + 1
            slips = {
                "one-more": (_("one tick less than there are"), speed * skip_frame / 60),
                "seconds": (_("right if a tick were a second"), speed * ticks),
                "twelve": (_("right only for `skip_frame=4`"), speed / 12),
                "ticks": (_("the time in seconds, not the way"), ticks / 60),
            }
            slip = difference(found, slips, 1e-4)
            raise done.not_yet(
                _(
                    "At {speed:g} m/s with skip_frame={skip_frame} the robot drove "
                    "{moved:.3f} m in one decision; your function says {found:.3f}{words}.",
                    speed=speed,
                    skip_frame=skip_frame,
                    moved=done.moved,
                    found=found,
                    words=slip.words,
                ),
                slip.name if found else "begin",
            )
    return Done(_("Six speeds, six ways, and each was right."))


def _careful(percept: Percept) -> dict[str, list[float]]:
    return {"move": [1 if percept["feeler"][0] else 0, 0, 0, 0]}


@exercise(
    "08.2",
    _("As lazy as possible"),
    hints={
        "lazier": _(
            "It never falls, and could be lazier. The feeler sees 0.98 m ahead of the "
            "robot's middle. How many ticks does it take to drive a metre?"
        ),
        "whole": _(
            "A tick is the smallest piece of time in the world. Round your result: which of "
            "the two numbers is safe?"
        ),
        "falls": _(
            "It drives too far before it looks again. The blind way has to be shorter than "
            "the 0.98 m that the feeler sees ahead."
        ),
    },
)
def is_lazy(skip_frame: Any) -> Done:
    """Check that it never falls, and decides seldom."""
    given = finite_number(skip_frame)
    if given != round(given):
        low = math.floor(given)
        raise NotYet(
            _(
                "`skip_frame` counts ticks, so it is a whole number: is it {low} or {low2}?",
                low=low,
                low2=low + 1,
            ),
            hint="whole",
        )
    skip_frame = round(given)
    if not 0 <= skip_frame <= 600:
        raise NotYet(
            _("Expected a number from 0 to 600, got {skip_frame}.", skip_frame=skip_frame),
            hint="falls",
        )
    for number in range(40):
        sim = feeler_runway(_careful, skip_frame, start=-9.0 + 0.05 * number)
        done = drive(sim, sim.agents[0], number, limit=480 // (skip_frame + 1) + 2)
        if done.fell:
            raise done.not_yet(
                _(
                    "With skip_frame={skip_frame} the robot fell when it started at x = "
                    "{value:.2f}.",
                    skip_frame=skip_frame,
                    value=-9.0 + 0.05 * number,
                ),
                "falls",
            )
    if skip_frame < LAZY:
        raise NotYet(
            _(
                "With skip_frame={skip_frame} it never fell in 40 runs. It can be lazier.",
                skip_frame=skip_frame,
            ),
            hint="lazier",
            picture=done.picture(),
        )
    return Done(
        _(
            "With skip_frame={skip_frame} the robot never fell, from 40 places.",
            skip_frame=skip_frame,
        ),
        done.picture(),
    )


@exercise(
    "08.3",
    _("A diary"),
    hints={
        "begin": _(
            "Connect a function that appends to `notes`, like "
            '`agent.end_of_step.connect(lambda agent: notes.append("decision"))`.'
        ),
        "copy": _(
            "Your functions were called, but what they wrote is not in the list that you "
            "returned. Return `notes` itself, and no copy of it; and don't make a new list "
            "later."
        ),
        "late": _(
            "All notes say the same. A function that is made in a loop looks at the loop's "
            "variable when it is called, and by then the loop is over. Write a line for each "
            "event."
        ),
        "begins": _('The first note has to be "begin": connect with `begin_of_episode`.'),
        "counted": _(
            "It is right as long as an episode takes as many decisions as you thought. This "
            "one ended earlier: connect a function, so that each note is written when it "
            "happens."
        ),
        "ticks": _(
            "You wrote more than once for a decision. `begin_of_apply_action` comes at each "
            "tick; `end_of_step` comes once a decision."
        ),
        "end": _('The last note of an episode has to be "end": connect with `end_of_episode`.'),
    },
)
def keeps_a_diary(diary: Any) -> Done:
    """Check for entries of the begin, the decisions and the end."""
    a_function(diary)
    for limit, start in ((7, -9.0), (3, -9.0), (60, 2.0)):  # the last one falls before
        sim = feeler_runway(_go, 4, start=start)
        falls = FallReward(cause_episode_to_end=True)
        agent = sim.agents[0].changed(max_steps_per_episode=limit, rewards=[falls])
        sim = ControlRequestor(sim.world, [agent])
        notes = diary(agent)
        if notes is None:
            raise NotYet(NOTHING_RETURNED, hint="no-return")
        if not isinstance(notes, list):
            raise NotYet(
                _("Expected that `diary` returns a list, got {got}.", got=named(notes)),
                hint="begin",
            )
        done = drive(sim, agent, 1)
        wanted = ["begin", *["decision"] * done.steps, "end"]
        if notes != wanted:
            count = notes.count("decision")
            hint = "begin"
            if not notes and _listens(agent):
                hint = "copy"
            elif len(notes) == len(wanted) and len(set(map(repr, notes))) == 1:
                hint = "late"
            elif count == limit > done.steps:
                hint = "counted"
            elif count > done.steps:
                hint = "ticks"
            elif count == done.steps:
                hint = "end" if notes[:1] == ["begin"] else "begins"
            said = f"{notes[:12]!r}{' ...' if len(notes) > 12 else ''}"
            expected = repr(wanted[:12])
            raise NotYet(
                _(
                    "In an episode of {steps} decisions your diary says {said}, not {expected}.",
                    steps=done.steps,
                    said=said,
                    expected=expected,
                ),
                hint=hint,
            )
    return Done(_("Three episodes, three diaries without a mistake."))


def _listens(agent: BasicAgent) -> bool:
    """Return True if a function is connected to one of the diary's events."""
    events = (agent.begin_of_episode, agent.end_of_step, agent.begin_of_step, agent.end_of_episode)
    return any(event.handlers for event in events)


exit_ticket(
    "08.exit",
    Question(
        "c",
        {
            "a": _("Nearly: a decision takes skip_frame + 1 ticks."),
            "b": _("A tick is not a second. 30 ticks are half a second."),
        },
    ),
    Question(
        "b",
        {
            "a": _("Then the blind way would be twice as long."),
            "c": _("Then the blind way would be four times as long."),
        },
    ),
    Question(
        "c",
        {
            "a": _(
                "`end_of_step` comes once for each decision. An event for each tick is "
                "`begin_of_apply_action`."
            ),
            "b": _("Once for the whole episode comes `end_of_episode`."),
        },
    ),
)
