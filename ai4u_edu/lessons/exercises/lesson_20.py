"""Project: your own world."""

import math
from collections.abc import Sequence
from itertools import combinations
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.blocks import LocalBrain, Percept
from ai4u_edu.lessons.exercise import Done, NotYet, exercise, named
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.pictures import picture
from ai4u_edu.lessons.rollouts import Drive, drive, drives, seeds_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import listed
from ai4u_edu.scenes import Scene
from ai4u_edu.snapshot import capture_snapshot

MIN_SPREAD_M, MIN_SPREAD_DEG = 0.5, 20
"""Difference of two beginnings from which on they count as different."""
SOLVED = 6
"""Episodes of 10 in which the solver has to succeed in a hard world."""
WANTED = ("goal", "controls", "rewards")


def _scene(text: Any) -> Scene:
    if isinstance(text, Scene):
        return text
    if not isinstance(text, str):
        raise NotYet(_("Expected the text of a scene, got {got}.", got=named(text)))
    if not text.strip():
        raise NotYet(
            _("There is no scene yet: write `my_scene` in exercise 20.1, and run its cell."),
            hint="unfinished",
        )
    try:
        return Scene.loads(text, name="my_world")
    except AI4UError as error:
        raise NotYet(text_of(error), hint="yaml") from error


@exercise(
    "20.1",
    _("A complete scene"),
    hints={
        "complete": _(
            "Look at a scene of the library: `print(Scene.load('box_chase').dumps())`. What "
            "has it got that yours has not?"
        ),
        "yaml": _(
            "Every name is followed by a colon and a space. What belongs to something stands "
            "two spaces further to the right; in a list each thing begins with a dash."
        ),
        "success": _(
            "`success: touch` at the top level says which reward term means that the task is "
            "done. A reward function's `name` is its term."
        ),
        "random": _(
            "`random: {x: [-4, 4], y: [-4, 4]}` at a body lets it begin somewhere else in "
            "each episode."
        ),
    },
)
def is_complete(text: Any) -> Done:
    """Check for a scene that others can play."""
    scene = _scene(text)
    told = scene.description
    missing = [name for name in WANTED if len(getattr(told, name).strip()) < 8]
    if missing:
        raise NotYet(
            _("There is no {missing} in words yet.", missing=f"`{missing[0]}`"), hint="complete"
        )
    sim = scene.build()
    sim.reset(1)
    agent = sim.agents[0]
    for name, count, least in (
        (_("sensors"), len(agent.sensors), 2),
        (_("actuators"), len(agent.actuators), 1),
        (_("reward functions"), len(agent.rewards), 2),
    ):
        if count < least:
            raise NotYet(
                _(
                    "The first agent has {count} {name}; at least {least} are needed.",
                    count=count,
                    name=name,
                    least=least,
                ),
                hint="complete",
            )
    if not told.success:
        raise NotYet(
            _("Nothing says when the task is done: `success:` is missing."), hint="success"
        )
    taking_part = _taking_part(agent)
    places = []
    for seed in seeds_of("20.1", 10):
        sim.reset(seed)
        bodies = [sim.world[name] for name in taking_part]
        places.append([(*body.position, body.heading) for body in bodies])
    if not any(_differs(poses) for poses in zip(*places, strict=True)):
        names = listed([f"`{name}`" for name in taking_part])
        raise NotYet(
            _(
                "All episodes begin in nearly the same way for {names}: in 10 of them no "
                "place is {min_spread_m:g} m from another one, and no heading "
                "{min_spread_deg:g} degrees.",
                names=names,
                min_spread_m=MIN_SPREAD_M,
                min_spread_deg=MIN_SPREAD_DEG,
            ),
            hint="random",
        )
    return Done(
        _("{title}: complete.", title=told.title or told.name), picture(capture_snapshot(sim))
    )


def _differs(poses: Sequence[tuple[float, float, float]]) -> bool:
    """Return True if a body's beginnings are not nearly the same."""
    return any(
        math.dist(one[:2], other[:2]) >= MIN_SPREAD_M
        or abs(math.degrees(math.remainder(one[2] - other[2], math.tau))) >= MIN_SPREAD_DEG
        for one, other in combinations(poses, 2)
    )


def _taking_part(agent: BasicAgent) -> list[str]:
    """Return the bodies of the task: the agent's, and those that the rewards and sensors name."""
    names = [agent.body.name]
    for block in (*agent.rewards, *agent.sensors):
        target = getattr(block, "target", "")
        if isinstance(target, str) and target and target not in names:
            names.append(target)
    return names


@exercise(
    "20.2",
    _("Solved"),
    hints={
        "begin": _("Write `solve` for your scene. What did you do in lessons 03 and 06?"),
        "never": _(
            "It moves, and never gets there. Watch an episode: `film(Scene.loads(my_scene), "
            "solve, seed=...)`. What should it do at the moment in which it goes wrong?"
        ),
        "seldom": _(
            "It works sometimes. Watch an episode that failed: `film(Scene.loads(my_scene), "
            "solve, seed=...)`."
        ),
        "idle": _("The robot begins where it should get to. Put it farther away."),
        "yaml": _("The scene itself is not in order yet: first solve exercise 20.1."),
    },
)
def is_solved(text: Any, solve: Any) -> Done:
    """Check for success on 8 of 10 seeds."""
    scene, won = _scene(text), 0
    if not scene.description.success:
        raise NotYet(_("The scene does not say what success is: see exercise 20.1."), hint="begin")
    idle = sum(done.won for done in drives(scene, _idle, seeds_of("20.2", 10), limit=100))
    if idle > 2:
        raise NotYet(
            _(
                "In {idle} of 10 episodes it succeeds without doing anything: the task is "
                "done before it begins.",
                idle=idle,
            ),
            hint="idle",
        )
    reason = None
    for done in drives(scene, solve, seeds_of("20.2", 10)):
        won += done.won
        if not done.won and reason is None:
            reason = done.not_yet(
                _("No success ({where}).", where=done.where), "seldom" if done.moved else "begin"
            )
    if won < 8 and reason is not None:
        reason.text = _(
            "{won} of 10 episodes succeeded, 8 are needed. {text}", won=won, text=reason.text
        )
        if not won and reason.hint == "seldom":
            reason.hint = "never"
        raise reason
    return Done(_("{won} of 10 episodes succeeded.", won=won), done.picture())


@exercise(
    "20.3",
    _("Worth something"),
    hints={
        "easy": _(
            "Chance succeeds too often. Put the target farther away, behind something, near "
            "an edge; give less time; or ask for two things in turn."
        ),
        "impossible": _(
            "Chance fails, and so does your `solve`. Make the world easier, or `solve` "
            "better; it is the one of exercise 20.2."
        ),
        "yaml": _("The scene itself is not in order yet: first solve exercise 20.1."),
    },
)
def is_no_chance(text: Any, solve: Any) -> Done:
    """Check that a solver succeeds in most episodes, and chance in fewer than 3 of 10."""
    scene = _scene(text)
    if not scene.description.success:
        raise NotYet(_("The scene does not say what success is: see exercise 20.1."), hint="easy")
    drives_by_chance = [_driven_by_chance(scene, seed) for seed in seeds_of("20.3", 10)]
    won, done = sum(each.won for each in drives_by_chance), drives_by_chance[-1]
    if won >= 3:
        raise NotYet(
            _("With random actions {won} of 10 episodes succeeded.", won=won),
            hint="easy",
            picture=done.picture(),
        )
    solved = sum(done.won for done in drives(scene, solve, seeds_of("20.3", 10)))
    if solved < SOLVED:
        raise NotYet(
            _(
                "With random actions {won} of 10 episodes succeeded, with your `solve` "
                "{solved}. A world that nobody can solve is not worth much: {solved2} are "
                "needed.",
                won=won,
                solved=solved,
                solved2=SOLVED,
            ),
            hint="impossible",
        )
    return Done(
        _(
            "With random actions {won} of 10 episodes succeeded, with `solve` {solved}.",
            won=won,
            solved=solved,
        ),
        done.picture(),
    )


def won_by_chance(text: str, episodes: int = 10) -> int:
    """Return in how many episodes of a scene random actions succeed.

    Args:
        text: the scene's text.
        episodes: number of episodes, with the seeds 0, 1, 2 and so on.

    Raises:
        SceneError: the text is no scene.
    """
    scene = Scene.loads(text, name="my_world")
    return sum(_driven_by_chance(scene, seed).won for seed in range(episodes))


def _driven_by_chance(scene: Scene, seed: int) -> Drive:
    sim = scene.build()
    agent = sim.agents[0]
    brain = LocalBrain(controller=_by_chance(agent, seed), skip_frame=agent.brain.skip_frame)
    agent.use_brain(brain)
    return drive(sim, agent, seed)


def _idle(_percept: Percept) -> dict[str, list[float]]:
    """Do nothing."""
    return {}


def _by_chance(agent: BasicAgent, seed: int) -> Any:
    """Return a controller that gives random actions."""
    spaces = {each.action_name: each.space() for each in agent.actuators if each.is_output}
    for index, space in enumerate(spaces.values()):
        space.seed(seed + index)
    return lambda _: {name: np.asarray(space.sample()) for name, space in spaces.items()}


exit_ticket(
    "20.exit",
    Question(
        "b",
        {
            "a": _("The same seed gives the same episode: it was tried once, ten times over."),
            "c": _("With one episode it may have been luck. Chance succeeds now and then, too."),
        },
    ),
    Question(
        "a",
        {
            "b": _("Compare it with what chance achieves."),
            "c": _(
                "One episode more of ten is easily luck. Many more episodes, or a harder "
                "task, would tell."
            ),
        },
    ),
    Question(
        "c",
        {
            "a": _(
                "You changed it until it fitted these ten. Other worlds tell how good it really is."
            ),
            "b": _("It was fitted to these as well."),
        },
    ),
)
