"""Needs: a creature that gets hungry."""

from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import (
    AndRewardFunc,
    BearingSensor,
    CollectActuator,
    EvalFloatValue,
    HomeostaticReward,
    HomeostaticSensor,
    HomeostaticVariable,
    OrRewardFunc,
    RBMoveActuator,
)
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise
from ai4u_edu.lessons.numeric import finite_number, is_close
from ai4u_edu.lessons.rollouts import Drive, as_brain, drive, seeds_of
from ai4u_edu.world import BoxShape, CircleShape, Variation, World

DECISIONS_PER_MINUTE = 720
"""Number of decisions in a minute."""
LOW, HIGH = 0.4, 0.8
"""Ends of the comfort zone, as shares of the range."""
ROOM = Variation(x=(-4, 4), y=(-4, 4), heading_deg=(-180, 180), clearance=0.3)


def creature(controller: Any) -> ControlRequestor:
    """Return a creature on a plate with food and water.

    Args:
        controller: a function, a controller or a brain; drives it.
    """
    needs = _needs()
    agent = BasicAgent(
        body="creature",
        max_steps_per_episode=DECISIONS_PER_MINUTE,
        sensors=[
            HomeostaticSensor(perception_key="inside"),
            BearingSensor(target="food", perception_key="to food"),
            BearingSensor(target="water", perception_key="to water"),
        ],
        actuators=[
            RBMoveActuator(move_amount=3, turn_amount=3),
            CollectActuator(
                action_name="eat", group="food", adds={"energy": 40}, comes_back_after=3
            ),
            CollectActuator(
                action_name="drink", group="water", adds={"water": 40}, comes_back_after=3
            ),
        ],
        rewards=[
            HomeostaticReward(reward=10, variables=needs),
            OrRewardFunc(
                name="ran out",
                children=[
                    EvalFloatValue(property=f"inside[{index}]", min_value=0, max_value=0)
                    for index in (0, 1)
                ],
                reward=-10,
                cause_episode_to_end=True,
            ),
            AndRewardFunc(
                name="well",
                children=[
                    EvalFloatValue(property=f"inside[{index}]", min_value=LOW, max_value=HIGH)
                    for index in (0, 1)
                ],
                reward=0.01,
            ),
        ],
        brains=[as_brain(controller)],
    )
    return ControlRequestor(_meadow(), [agent])


def _meadow() -> World:
    """Return a plate with the creature's body, food and water at random places."""
    world = World()
    world.add_floor("meadow", BoxShape(size=(12, 12)))
    world.add_body("creature", CircleShape(radius=0.5), tags=("agent",), random=ROOM)
    world.add_body(
        "food",
        CircleShape(radius=0.45),
        kind="static",
        tags=("food",),
        random=ROOM,
        colour="green",
        label="food",
    )
    world.add_body(
        "water",
        BoxShape(size=(0.8, 0.8)),
        kind="static",
        tags=("water",),
        random=ROOM,
        colour="sky blue",
        label="water",
    )
    return world


def _needs() -> list[HomeostaticVariable]:
    return [
        HomeostaticVariable(
            name=name,
            range_max=100,
            comfort_min=100 * LOW,
            comfort_max=100 * HIGH,
            value=60,
            drift_per_second=-loss,
        )
        for name, loss in (("energy", 3.0), ("water", 4.0))
    ]


@exercise(
    "13.1",
    "How long?",
    hints={
        "begin": "How much is there to lose until 40? And how much of it goes in a second?",
        "empty": "That is how long it takes until nothing is left. Comfort ends at 40.",
        "below": "Below 40 there is no comfort left: the answer is 0, not less.",
    },
)
def computes_comfort(seconds: Any) -> Done:
    """Check the seconds until a level reaches 40."""
    a_function(seconds)
    for level, loss in ((60.0, 4.0), (80.0, 2.0), (45.0, 0.5), (100.0, 3.0), (30.0, 2.0)):
        found = finite_number(seconds(level, loss))
        wanted = max(0.0, (level - 40) / loss)
        if not is_close(found, wanted, 0.01):
            hint = "begin"
            if is_close(found, level / loss, 0.01):
                hint = "empty"
            elif level < 40:
                hint = "below"
            raise NotYet(
                f"With a level of {level:g} and a loss of {loss:g} a second it takes {wanted:g} s, "
                f"your function says {found:g}.",
                hint=hint,
            )
    return Done("Five levels, five times right.")


def _life(controller: Any, seed: int) -> tuple[Drive, float, int]:
    """Return an episode, the share with both levels in the zone, and the empty level (or -1)."""
    sim = creature(controller)
    inside: list[tuple[float, ...]] = []
    done = drive(
        sim,
        sim.agents[0],
        seed,
        DECISIONS_PER_MINUTE,
        lambda done: inside.append(_levels(done.agent)),
    )
    well = sum(all(LOW <= level <= HIGH for level in levels) for levels in inside) / len(inside)
    last = inside[-1]
    return done, well, last.index(min(last)) if done.agent.terminated else -1


def _levels(agent: BasicAgent) -> tuple[float, ...]:
    return tuple(float(level) for level in agent.percept["inside"])


@exercise(
    "13.2",
    "Stay alive",
    hints={
        "thirst": "It dies although there is enough of both. It has to go for what it has less of: "
        "compare `energy` and `water`.",
        "reversed": "It goes for what it has more of. Where energy is the smaller one, food is "
        "needed.",
    },
)
def stays_alive(live: Any) -> Done:
    """Check that it lives for a minute in 8 worlds."""
    for seed in seeds_of("13.2", 8):
        done, _, ran_out = _life(live, seed)
        if ran_out >= 0:
            name = ("energy", "water")[ran_out]
            other = ("water", "energy")[ran_out]
            level = _levels(done.agent)[1 - ran_out]
            hint = "reversed" if _goes_for_more(live, done) else "thirst"
            raise done.not_yet(
                f"After {done.steps / 12:.0f} seconds its {name} had run out, with {other} at "
                f"{100 * level:.0f} ({{where}}).",
                hint,
            )
    return Done("In 8 worlds it lived for a minute.", done.picture())


def _goes_for_more(live: Any, done: Drive) -> bool:
    """Return True if its actions depend on its levels at all: then they are mixed up."""
    if not callable(live):
        return False
    percept = dict(done.agent.percept)
    answers = [live({**percept, "inside": [one, 1 - one]}) for one in (0.1, 0.9)]
    return repr(answers[0]) != repr(answers[1])


@exercise(
    "13.3",
    "Live well",
    hints={
        "begin": "Three cases: all is well, then rest; energy is lower, then food; water is lower, "
        "then water.",
        "greedy": "It has too much most of the time. Eat when a level has sunk towards 40, not "
        "before.",
        "late": "It waits too long. On the way to the food the levels go on sinking: start a bit "
        "above 40.",
    },
)
def lives_well(live: Any) -> Done:
    """Check for both levels in the zone in 70 of 100 decisions."""
    shares = []
    for seed in seeds_of("13.3", 6):
        done, well, ran_out = _life(live, seed)
        shares.append(well)
        mean = sum(_levels(done.agent)) / 2
        if ran_out >= 0:
            still = done.moved < 0.1
            raise done.not_yet(
                f"It died after {done.steps / 12:.0f} seconds ({{where}}).",
                "begin" if still else "late",
            )
        if well < 0.7:
            raise done.not_yet(
                f"It felt well in {100 * well:.0f} of 100 decisions, not 70 ({{where}}).",
                "greedy" if mean > 0.6 else "late",
            )
    share = 100 * sum(shares) / len(shares)
    return Done(f"It felt well in {share:.0f} of 100 decisions.", done.picture())
