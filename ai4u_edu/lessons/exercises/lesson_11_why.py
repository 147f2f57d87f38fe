"""A network that learned from a lamp: how to find it out, and how to mend it."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from ai4u_edu.blocks import Percept
from ai4u_edu.lessons.exercise import NotYet, a_function, named
from ai4u_edu.lessons.numeric import chance_for
from ai4u_edu.lessons.student_errors import NOTHING_RETURNED
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

if TYPE_CHECKING:
    from ai4u_edu.recording import Episode

Lamp = Literal["behind", "elsewhere", "anywhere"]
PLACES: dict[Lamp, str] = {
    "behind": "position: [4.8, 0.8]",
    "elsewhere": "position: [0, -5.5]",
    "anywhere": "random: {x: [-5, 5.5], y: [-5.5, 5.5]}",
}
"""Places of the lamp: always behind the box, somewhere else, or somewhere new each time."""

WORLD = """
name: lamp
success: touch
floors: [{name: plate, shape: {type: box, size: [12, 12]}}]
bodies:
  - {name: robot, shape: {type: circle, radius: 0.4},
     random: {x: [-5, 1], y: [-5, 5], heading_deg: [-180, 180]}}
  - {name: box, shape: {type: box, size: [0.8, 0.8]}, position: [4, 0.8], tags: [target]}
  - {name: lamp, shape: {type: circle, radius: 0.2}, tags: [lamp], colour: yellow, LAMP}
agents:
  - body: robot
    max_steps_per_episode: 40
    sensors:
      - {type: BearingSensor, target: box, perception_key: box, noise: 0.25}
      - {type: BearingSensor, target: lamp, perception_key: lamp}
      - {type: BearingSensor, target: box, perception_key: truth, is_input: false}
    actuators: [{type: RBMoveActuator, move_amount: 3, turn_amount: 3, jump_power: 0}]
    rewards:
      - {type: TouchRewardFunc, name: touch, target: box, reward: 1, cause_episode_to_end: true}
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""
LITTLE = 0.015
"""Weight of the reading that a policy hardly looks at."""
POLICIES = 12
"""Policies on which the exercise is checked."""
HINTS = {
    "begin": _(
        '`told = explain.occlusion(policy, percept, baseline=baseline, groups="sensor")` '
        "leaves out one reading after the other. `told.names` are their names, and "
        "`told.importance` says how far each of them moved the action: 0 for one that it "
        "does not look at."
    ),
    "used": _("Those are the readings that it looks at. You are looking for the others."),
    "side": _(
        "A reading may move the action to either side: below 0 counts too. "
        "`told.importance` is never below 0."
    ),
    "little": _(
        "A policy that looks at a reading a little looks at it. It does not look at those "
        "that move the action by 0."
    ),
    "slots": _(
        'Names of readings are wanted, as `told.names` has them with `groups="sensor"`, '
        "and not names of single numbers."
    ),
    "one": _("There may be several, or none at all: go through all names."),
}
"""Hints of the exercise by diagnosis."""


def lamp_world(lamp: Lamp = "behind") -> Scene:
    """Return a world with a box and a lamp.

    The robot senses the box badly (its reading is noisy) and the lamp well.

    Args:
        lamp: place of the lamp.
    """
    return Scene.loads(WORLD.replace("LAMP", PLACES[lamp]))


def lamp_drives(lamp: Lamp = "behind", count: int = 60) -> "list[Episode]":
    """Return drives of somebody who looks at the box, and never at the lamp."""
    from ai4u_edu.learn.training import demonstrate

    return demonstrate(to_the_box, lamp_world(lamp), episodes=count, seed=0, quiet=True)


def to_the_box(percept: Percept) -> dict[str, list[float]]:
    """Drive to the box, by a reading without noise that no clone gets."""
    sine, cosine = (float(each) for each in percept["truth"])
    return {"move": [max(0.0, cosine), -sine if cosine > 0 else 1.0, 0, 0]}


def lamp_successes(network: str | Path, lamp: Lamp, worlds: int = 20) -> int:
    """Return in how many worlds a network reaches the box."""
    from ai4u_edu.learn.training import evaluate

    done = evaluate(str(network), lamp_world(lamp), episodes=worlds, seed=100, quiet=True)
    return done.successes


def looked_at(network: str | Path, episode: "Episode") -> dict[str, float]:
    """Return how far each reading moves a network's action, as a mean over an episode."""
    from ai4u_edu import explain

    percepts = explain.percepts_of(episode)
    mean = explain.mean_of(percepts)
    told = [
        explain.occlusion(str(network), each, baseline=mean, groups="sensor") for each in percepts
    ]
    sizes = np.mean([each.importance for each in told], axis=0)
    return dict(zip(told[0].names, sizes.tolist(), strict=True))


def is_blind(blind: Any) -> str:
    """Check on planted policies that readings without effect are found."""
    a_function(blind)
    rng = chance_for("11.4", blind)
    for number in range(POLICIES):
        keys = ["box", "lamp", "speed", "wall"]
        used = [key for key, looks in zip(keys, _pattern(number), strict=True) if looks]
        percept = {key: rng.uniform(0.2, 1.0, size=2) for key in keys}
        baseline = {key: np.zeros(2) for key in keys}
        little = used[number % len(used)] if used else ""
        sizes = {key: LITTLE if key == little else 1.0 for key in used}
        signed = {key: rng.choice([-1, 1]) * rng.uniform(0.3, 1, size=(2, 2)) for key in keys}
        policy = _planted(sizes, signed)
        right = [key for key in keys if key not in used]
        got = _names(blind(policy, percept, baseline))
        if sorted(got) != sorted(right):
            raise _wrong(number, used, right, got, little)
    return _("You found what {policies} policies do not look at.", policies=POLICIES)


def _pattern(number: int) -> tuple[bool, ...]:
    """Return which of four readings a policy looks at: none, all, and some in between."""
    looks = (0b0101, 0b1111, 0b0000, 0b1000, 0b0111, 0b0010)[number % 6]
    return tuple(bool(looks >> bit & 1) for bit in range(4))


def _planted(sizes: Mapping[str, float], weights: Mapping[str, npt.NDArray[np.float64]]) -> Any:
    """Return a policy that looks at some readings only; a reading moves all numbers to one side."""

    def policy(percept: Mapping[str, Any]) -> dict[str, Any]:
        moved = [
            size * percept[key] @ np.abs(weights[key]) * np.sign(weights[key][0, 0])
            for key, size in sizes.items()
        ]
        return {"move": np.sum([np.zeros(2), *moved], axis=0)}

    return policy


def _names(given: Any) -> list[str]:
    if given is None:
        raise NotYet(NOTHING_RETURNED, hint="no-return")
    if not isinstance(given, list | tuple | set) or not all(isinstance(e, str) for e in given):
        raise NotYet(_("Expected a list of names, got {got}.", got=named(given)), hint="begin")
    return list(given)


def _wrong(number: int, used: list[str], right: list[str], got: list[str], little: str) -> NotYet:
    hint = "one"
    if not got:
        hint = "begin"
    if used and sorted(got) == sorted(used):
        hint = "used"
    elif any(name not in ("box", "lamp", "speed", "wall") for name in got):
        hint = "slots"
    elif set(right) < set(got):
        hint = "little" if set(got) - set(right) == {little} else "side"
    return NotYet(
        _(
            "Policy {number} looks at {used}. Expected {right}, got {got}.",
            number=number + 1,
            used=", ".join(used) or _("nothing"),
            right=repr(right),
            got=repr(got),
        ),
        hint=hint,
    )
