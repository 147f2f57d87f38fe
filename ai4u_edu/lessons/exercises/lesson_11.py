"""Learn from yourself: a network that imitates you, and a race."""

from collections.abc import Callable, Mapping
from functools import cache
from json import dumps
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import Brain, LocalBrain, NeuralNetController, Percept
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise, named
from ai4u_edu.lessons.exercises.lesson_11_why import HINTS, is_blind
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


def player(percept: Percept) -> dict[str, list[float]]:
    """Drive as the scripted player: turn until the box is ahead, then go."""
    cosine = percept["orientation"][0]
    return {"move": [1.0, 0, 0, 0] if cosine > 0.99 else [0, 0.2, 0, 0]}


def straight_on(_percept: Percept) -> dict[str, list[float]]:
    """Drive on, and over the edge."""
    return {"move": [1, 0.1, 0, 0]}


PLACES = (0, 1, 5, 7, 9)
"""Seeds of the scripted player's episodes, which begin in five different places."""


ODD_ONE = 3
"""Index of the episode whose clone does worst: it reaches the box in about one world of seven."""


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
    robot = {**_of(plain, "robot"), "random": {"heading_deg": [-180, 180]}}
    plain["bodies"] = [
        {**robot, "name": "blue", "position": [-3, -2]},
        {**robot, "name": "purple", "position": [3, 2], "colour": "purple"},
        {**_of(plain, "box"), "position": [0, 0], "random": {"heading_deg": [0, 90]}},
    ]
    (agent,) = plain["agents"]
    agent["actuators"] = [each for each in agent["actuators"] if each["type"] == "RBMoveActuator"]
    plain["agents"] = [{**agent, "id": name, "body": name} for name in ("blue", "purple")]
    sim = Scene.loads(dumps(plain), name="race").build()  # JSON is YAML as well
    for agent, driver in zip(sim.agents, (blue, purple), strict=True):
        agent.use_brain(_driver(driver, agent))
    return sim


def _of(plain: Mapping[str, Any], name: str) -> dict[str, Any]:
    (body,) = (each for each in plain["bodies"] if each["name"] == name)
    return dict(body)


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


exercise("11.4", _("What does it not look at?"), hints=HINTS)(is_blind)


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
