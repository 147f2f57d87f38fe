"""Learn from yourself: a network that imitates you, and a race."""

from collections.abc import Callable, Mapping
from functools import cache
from json import dumps
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import Brain, LocalBrain, NeuralNetController, Percept
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise, named
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import chance_for
from ai4u_edu.lessons.rollouts import Drive, as_brain, drives, seeds_of
from ai4u_edu.lessons.student_errors import NOTHING_RETURNED
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext, translate
from ai4u_edu.scenes import Scene

if TYPE_CHECKING:
    from ai4u_edu.recording import Episode

ENOUGH = 5
WORLDS, NEEDED, LIMIT = 40, 20, 300
MAX_RACE_STEPS = 300
"""Steps after which a race is over."""
PLACES = (0, 1, 5, 7, 9)
"""Seeds of the scripted player's episodes, which begin in five different places."""
ODD_ONE = 3
"""Index of the episode whose clone does worst: it reaches the box in about one world of seven."""


def player(percept: Percept) -> dict[str, list[float]]:
    """Drive as the scripted player: turn until the box is ahead, then go."""
    cosine = percept["orientation"][0]
    return {"move": [1.0, 0, 0, 0] if cosine > 0.99 else [0, 0.2, 0, 0]}


def straight_on(_percept: Percept) -> dict[str, list[float]]:
    """Drive on, and over the edge."""
    return {"move": [1, 0.1, 0, 0]}


@cache
def _shown(count: int) -> "tuple[Episode, ...]":
    from ai4u_edu.learn.training import demonstrate

    seeds = [
        PLACES[number % len(PLACES)] + 100 * (number // len(PLACES)) for number in range(count)
    ]
    return tuple(
        episode
        for seed in seeds
        for episode in demonstrate(player, "box_chase", episodes=1, seed=seed, quiet=True)
    )


def my_drives(folder: str | Path = "drives", count: int = ENOUGH) -> "list[Episode]":
    """Return the last episodes of the box chase that you recorded; end the world that is shown.

    If there are fewer than asked for, a scripted player drives the others, and it says so.

    Args:
        folder: the folder of ``show(..., record=folder)``.
        count: number of episodes.
    """
    from ai4u_edu.lessons import stop
    from ai4u_edu.recording import Episode

    stop()
    files = sorted(Path(folder).glob("*.episode"), key=lambda file: file.stat().st_mtime)
    yours = [Episode.load(file) for file in files]
    won = [each for each in yours if each.scene.name == "box_chase" and each.success][-count:]
    if len(won) < count:
        print(  # noqa: T201 - for the notebook
            translate(
                _(
                    "{won} drives of yours reached the box; a scripted player drove the other "
                    "{others}.",
                    won=len(won),
                    others=count - len(won),
                )
            )
        )
    return [*won, *_shown(count - len(won))]


def scripted_drives(count: int) -> "list[Episode]":
    """Return drives of the scripted player, which reach the box."""
    return list(_shown(count))


def one_drive() -> "list[Episode]":
    """Return a drive of the scripted player that teaches little about other places."""
    return list(_shown(len(PLACES))[ODD_ONE : ODD_ONE + 1])


def best_network() -> str:
    """Return the network of lesson 10, if you kept it; else the package's."""
    return "sac.onnx" if Path("sac.onnx").is_file() else "zoo:box_chase"


def track(blue: Any, purple: Any) -> ControlRequestor:
    """Return the box chase for two, equally far from the box, one on each side of it.

    Args:
        blue: drives the blue robot: a network's file, a function, a controller.
        purple: drives the other one.
    """
    plain = Scene.load("box_chase").plain()
    bodies = {each["name"]: each for each in plain["bodies"]}
    robot = {**bodies["robot"], "random": {"heading_deg": [-180, 180]}}
    plain["bodies"] = [
        {**robot, "name": "blue", "position": [-3, -2]},
        {**robot, "name": "purple", "position": [3, 2], "colour": "purple"},
        {**bodies["box"], "position": [0, 0], "random": {"heading_deg": [0, 90]}},
    ]
    (agent,) = plain["agents"]
    agent["actuators"] = [each for each in agent["actuators"] if each["type"] == "RBMoveActuator"]
    plain["agents"] = [{**agent, "id": name, "body": name} for name in ("blue", "purple")]
    sim = Scene.loads(dumps(plain), name="race").build()  # JSON is YAML as well
    for agent, driver in zip(sim.agents, (blue, purple), strict=True):
        agent.use_brain(_driver(driver, agent))
    return sim


def _driver(who: Any, agent: BasicAgent) -> Brain:
    path = getattr(who, "path", who)
    if isinstance(path, str | Path):
        # it may not begin a new episode when it is done: that would be one for both
        controller = NeuralNetController(model_path=str(path), repeat=False)
        return LocalBrain(controller=controller, **controller.network.rhythm)
    return as_brain(who).changed(
        skip_frame=agent.brain.skip_frame, repeat_action=agent.brain.repeat_action
    )


@exercise(
    "11.1",
    _("Good enough to learn from"),
    hints={
        "all": _(
            "Drives in which the robot fell are among them too, and it would learn to fall. "
            "An episode knows whether the goal was reached: `episode.success`."
        ),
        "parts": _("The list has to hold the episodes, not their seeds or seconds."),
        "twice": _("Each episode belongs in the list once."),
        "some": _("You left some out that reached the box: go through the whole list."),
        "none": _("Your list is empty."),
        "quick": _(
            "A fall can be quick too, and a good drive may be long, when the way is. Ask "
            "whether the goal was reached: `episode.success`."
        ),
    },
)
def chooses(good: Any) -> str:
    """Check that exactly the episodes that reached the box are chosen."""
    from ai4u_edu.learn.training import demonstrate

    a_function(good)
    seed = seeds_of("11.1", 1)[0]
    drivers = (player, _slowly, straight_on, _tired)
    given = [
        episode
        for each in drivers
        for episode in demonstrate(each, "box_chase", episodes=3, seed=seed, quiet=True)
    ]
    order = chance_for("11.1", good).permutation(len(given))
    given = [given[number] for number in order]
    right = [each for each in given if each.success]
    got = good(list(given))
    if got is None:
        raise NotYet(NOTHING_RETURNED, hint="no-return")
    if not isinstance(got, list | tuple) or not all(any(e is g for g in given) for e in got):
        part = named(got[0]) if isinstance(got, list | tuple) and got else named(got)
        raise NotYet(
            _(
                "Expected a list with some of the episodes themselves, and found {part} in it.",
                part=part,
            ),
            hint="parts",
        )
    if len({id(each) for each in got}) < len(got):
        raise NotYet(_("The same episode is in your list more than once."), hint="twice")
    bad = [each for each in got if not each.success]
    if bad:
        raise NotYet(
            _(
                "Of {count} episodes {count2} reached the box. You chose {count3}, and in "
                "{count4} of those the robot did not.",
                count=len(given),
                count2=len(right),
                count3=len(got),
                count4=len(bad),
            ),
            hint="all" if len(got) == len(given) else "quick",
        )
    if len(got) != len(right):
        raise NotYet(
            _(
                "Of {count} episodes {count2} reached the box, and you chose {count3} of them.",
                count=len(given),
                count2=len(right),
                count3=len(got),
            ),
            hint="some" if got else "none",
        )
    return _(
        "Of {count} episodes you chose the {count2} that reached the box.",
        count=len(given),
        count2=len(right),
    )


def _tired(percept: Percept) -> dict[str, list[float]]:
    """Crawl towards the edge, so that a fall takes longer than most good drives."""
    return {"move": [0.15, 0, 0, 0]} if percept["orientation"][0] < 2 else {}


def _slowly(percept: Percept) -> dict[str, list[float]]:
    return {"move": [0.4 * each for each in player(percept)["move"]]}


@exercise(
    "11.2",
    _("Show it"),
    hints={
        "few": _(
            "It was shown a single way, from a single place. Elsewhere it only guesses. Let "
            "it learn from five drives that began in different places: `clone(my_drives(), "
            "...)`."
        ),
        "sloppy": _(
            "It does what it was shown, detours and falls too. Leave those out, or record "
            "new drives, each of them as you would want it to drive: turn until you look at "
            "the box, then go."
        ),
    },
)
def is_shown(cloned: Any) -> Done:
    """Check for success in half of the worlds, from demonstrations."""
    path = getattr(cloned, "path", None)
    if not isinstance(path, Path) or not hasattr(cloned, "decisions"):
        raise NotYet(_("Expected what `clone(...)` returned, got {got}.", got=named(cloned)))
    controller = NeuralNetController(model_path=str(path))
    about = controller.network.about
    brain = LocalBrain(controller=controller, **controller.network.rhythm)
    count = int(about.get("demonstrations", 0))
    shown = ngettext("{n} drive", "{n} drives", count)
    won = lost = 0
    for done in drives("box_chase", brain, seeds_of("11.2", WORLDS), limit=LIMIT):
        won, lost = won + done.won, lost + (not done.won)
        if lost > WORLDS - NEEDED:
            raise done.not_yet(
                _(
                    "It reached the box in {won} of {won2} worlds; expected {needed:.0%}. It "
                    "was shown {shown} with {decisions} decisions. The last one that failed: "
                    "{where}.",
                    won=won,
                    won2=won + lost,
                    needed=NEEDED / WORLDS,
                    shown=shown,
                    decisions=cloned.decisions,
                    where=done.where,
                ),
                "few" if count < ENOUGH else "sloppy",
            )
    return Done(
        _(
            "It reached the box in {won} of {worlds} worlds, after {shown} with {decisions} "
            "decisions.",
            won=won,
            worlds=WORLDS,
            shown=shown,
            decisions=cloned.decisions,
        ),
        done.picture(),
    )


DRIVER_NAMES = {
    "a good one": _("a good one"),
    "a slow one": _("a slow one"),
    "one that falls": _("one that falls"),
    "one that sleeps": _("one that sleeps"),
}
"""Drivers of the races for the referee, in words."""


@exercise(
    "11.3",
    _("The referee"),
    call_limit_s=30,
    hints={
        "begin": _(
            "Nobody has run yet. Begin with `sim.reset(seed)`, call `sim.step()` until one "
            "of the two is `done`, and then look who it is."
        ),
        "draw": _(
            "Both are still on their way: nobody has won yet. Go on until one of the two is `done`."
        ),
        "fell": _(
            "The first to be done has not always won: it may have fallen. `touched(agent)` "
            "says whether it was the box; if it was not, the other one has won."
        ),
        "time": _(
            "Two who never arrive would keep you waiting for ever. After 300 steps return `None`."
        ),
    },
)
def referees(race: Any) -> Done:
    """Check the referee in races of known drivers."""
    a_function(race)
    drivers: dict[str, Callable[..., Any]] = {
        "a good one": player,
        "a slow one": _slowly,
        "one that falls": straight_on,
        "one that sleeps": lambda _: {"move": [0, 0, 0, 0]},
    }
    pairs = [
        ("a slow one", "a good one"),
        ("a good one", "a slow one"),
        ("a good one", "one that sleeps"),
        ("a good one", "a slow one"),
        ("one that sleeps", "a good one"),
        ("one that falls", "a good one"),
        ("a slow one", "one that falls"),
        ("one that falls", "one that sleeps"),
        ("one that sleeps", "one that falls"),
        ("one that sleeps", "one that sleeps"),
    ]
    shown = b""
    for seed, (blue, purple) in zip(seeds_of("11.3", len(pairs)), pairs, strict=True):
        sim = track(drivers[blue], drivers[purple])
        right, drive = _result(sim, seed)
        shown = shown or drive.picture()
        got = race(track(drivers[blue], _patient(drivers[purple], seed)), seed)
        if isinstance(got, BasicAgent):
            raise NotYet(
                _(
                    "You returned the agent {id!r} itself. Return its name in quotes, or None.",
                    id=got.id,
                )
            )
        if not (got is None or isinstance(got, str)) or got != right:
            hint = "fell" if "falls" in blue + purple else "time" if right is None else "begin"
            raise NotYet(
                _(
                    "Blue, {blue}, against purple, {purple}, with seed {seed}: expected "
                    "`{right}`, got {got}.",
                    blue=DRIVER_NAMES[blue],
                    purple=DRIVER_NAMES[purple],
                    seed=seed,
                    right=repr(right),
                    got=named(got),
                ),
                hint=hint,
                picture=drive.picture(),
            )
    return Done(_("Ten races, and you saw who won each of them."), shown)


def _patient(driver: Callable[..., Any], seed: int) -> Callable[[Percept], Any]:
    """Return a driver that ends a race that the referee does not end."""
    left = 5 * MAX_RACE_STEPS

    def drive(percept: Percept) -> Any:
        nonlocal left
        left -= 1
        if left < 0:
            raise NotYet(
                _(
                    "The race with seed {seed} was not over after {max_race_steps} decisions.",
                    seed=seed,
                    max_race_steps=5 * MAX_RACE_STEPS,
                ),
                hint="time",
            )
        return driver(percept)

    return drive


def touched(agent: BasicAgent) -> bool:
    """Return True if a robot's last decision ended at the box."""
    return agent.reward_terms.get("touch", 0.0) > 0


def _result(sim: ControlRequestor, seed: int) -> tuple[str | None, Drive]:
    sim.reset(seed)
    first, second = sim.agents
    drive = Drive(sim, first, seed, [first.body.position])
    while not (first.done or second.done) and drive.steps < MAX_RACE_STEPS:
        sim.step()
        drive.trail.append(first.body.position)
    for agent, other in ((first, second), (second, first)):
        if agent.done:
            return (agent if touched(agent) else other).id, drive
    return None, drive


Lamp = Literal["behind", "elsewhere", "anywhere"]
_LAMP_PLACES: dict[Lamp, str] = {
    "behind": "position: [4.8, 0.8]",
    "elsewhere": "position: [0, -5.5]",
    "anywhere": "random: {x: [-5, 5.5], y: [-5.5, 5.5]}",
}
"""Places of the lamp: always behind the box, somewhere else, or somewhere new each time."""
_LAMP_WORLD = """
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


def lamp_world(lamp: Lamp = "behind") -> Scene:
    """Return a world with a box and a lamp.

    The robot senses the box badly (its reading is noisy) and the lamp well.

    Args:
        lamp: place of the lamp.
    """
    return Scene.loads(_LAMP_WORLD.replace("LAMP", _LAMP_PLACES[lamp]))


def lamp_drives(lamp: Lamp = "behind", count: int = 60) -> "list[Episode]":
    """Return drives of somebody who looks at the box, and never at the lamp."""
    from ai4u_edu.learn.training import demonstrate

    return demonstrate(_to_the_box, lamp_world(lamp), episodes=count, seed=0, quiet=True)


def _to_the_box(percept: Percept) -> dict[str, list[float]]:
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


@exercise(
    "11.4",
    _("What does it not look at?"),
    hints={
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
    },
)
def is_blind(blind: Any) -> str:
    """Check on planted policies that readings without effect are found."""
    a_function(blind)
    rng = chance_for("11.4", blind)
    policies = 12
    for number in range(policies):
        keys = ["box", "lamp", "speed", "wall"]
        # one bit a reading: some of them, all, none
        looks = (0b0101, 0b1111, 0b0000, 0b1000, 0b0111, 0b0010)[number % 6]
        used = [key for bit, key in enumerate(keys) if looks >> bit & 1]
        percept = {key: rng.uniform(0.2, 1.0, size=2) for key in keys}
        baseline = {key: np.zeros(2) for key in keys}
        little = used[number % len(used)] if used else ""
        sizes = {key: 0.015 if key == little else 1.0 for key in used}
        signed = {key: rng.choice([-1, 1]) * rng.uniform(0.3, 1, size=(2, 2)) for key in keys}
        policy = _planted(sizes, signed)
        right = [key for key in keys if key not in used]
        got = _names(blind(policy, percept, baseline))
        if sorted(got) != sorted(right):
            raise _wrong(number, used, right, got, little)
    return _("You found what {policies} policies do not look at.", policies=policies)


exit_ticket(
    "11.exit",
    Question(
        "c",
        {
            "a": _("It never compares ways. It is trained to answer each percept as you did."),
            "b": _("A clone needs no reward. It copies the actions that you took."),
        },
    ),
    Question(
        "a",
        {
            "b": _("It is the other way round: cloning needs somebody who shows it."),
            "c": _(
                "Right answers for each percept are what cloning learns from. A reward only "
                "says how good something was."
            ),
        },
    ),
    Question(
        "b",
        {
            "a": _("However long it trains, these drives say nothing about the edge."),
            "c": _("From those it would learn to fall: it copies whatever it is shown."),
        },
    ),
)
