"""Rollouts of a student's work in worlds that they have not seen."""

import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import Brain, Controller, LocalBrain
from ai4u_edu.lessons.exercise import NotYet, named
from ai4u_edu.lessons.pictures import picture
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene
from ai4u_edu.snapshot import Snapshot, capture_agent, capture_snapshot

DEFAULT_MAX_DECISIONS = 600
"""Decisions after which an episode is truncated in a scene without a limit."""


@dataclass
class Drive:
    """Rollout of one episode."""

    sim: ControlRequestor
    agent: BasicAgent
    seed: int
    trail: list[tuple[float, float]] = field(default_factory=list)
    """Position of the agent at each decision, the beginning first; metres."""

    @property
    def steps(self) -> int:
        """Decisions taken."""
        return len(self.trail) - 1

    @property
    def won(self) -> bool:
        """True if the scene's success term was paid."""
        return self.agent.ledger.episode_terms.get(self.sim.success, 0.0) > 0

    @property
    def fell(self) -> bool:
        """True if the agent's episode ended because it fell."""
        return capture_agent(self.agent, self.sim.success).fell

    @property
    def moved(self) -> float:
        """Distance between the beginning and now, metres."""
        (x, y), (u, v) = self.trail[0], self.trail[-1]
        return float(((x - u) ** 2 + (y - v) ** 2) ** 0.5)

    @property
    def where(self) -> str:
        """Seed and step, for a sentence."""
        return _("seed {seed}, step {step}", seed=self.seed, step=self.steps)

    def picture(self) -> bytes:
        """Return the world as it is now, with the agent's trail; PNG."""
        shown: Snapshot = capture_snapshot(self.sim)
        return picture(shown, self.trail)

    def not_yet(self, text: str, hint: str = "") -> NotYet:
        """Return the reason why an exercise is not solved, with this rollout's picture.

        Args:
            text: a text; in a plain string ``{where}`` stands for the seed and the step.
            hint: the name of the hint.
        """
        if "{where}" in text:
            text = text.replace("{where}", self.where)
        return NotYet(text, hint=hint, picture=self.picture())


def seeds_of(exercise_id: str, count: int = 20) -> list[int]:
    """Return seeds for an exercise's worlds: always the same, and none that a notebook shows."""
    first = 10_000 + zlib.crc32(exercise_id.encode()) % 100_000
    return list(range(first, first + count))


def driven_by(trained: Any, scene: Scene) -> ControlRequestor:
    """Return a scene's world whose first agent is driven by a trained policy."""
    from ai4u_edu.learn.training.policies import entrant_of

    policy = entrant_of(trained)
    sim = policy.fitted(scene).build()
    sim.agents[0].use_brain(policy.brain(sim.agents[0]))
    return sim


def as_brain(thing: Any) -> Brain:
    """Return a student's controller, function or brain as a brain.

    Raises:
        NotYet: it is none of these.
    """
    if isinstance(thing, Brain):
        return thing
    if isinstance(thing, type) and issubclass(thing, Controller | Brain):
        return as_brain(thing())
    cls = thing if isinstance(thing, type) else type(thing)
    if hasattr(cls, "get_action") and not issubclass(cls, Controller):
        raise NotYet(
            _(
                "`{name}` has a `get_action`, and is no Controller yet: begin with "
                "`class {name}(Controller):`.",
                name=cls.__name__,
            ),
            hint="no-base",
        )
    if isinstance(thing, Controller) or (callable(thing) and not isinstance(thing, type)):
        return LocalBrain(controller=thing)
    raise NotYet(
        _(
            "Expected a function that gets a percept and returns an action, got {got}. Give the "
            "function's name, without brackets.",
            got=named(thing),
        ),
        hint="not-a-function",
    )


def brain_for(thing: Any, agent: BasicAgent) -> Brain:
    """Return a student's work as a brain that decides as often as the agent's own."""
    brain, before = as_brain(thing), agent.brain
    if isinstance(thing, Brain):
        return brain
    return brain.changed(skip_frame=before.skip_frame, repeat_action=before.repeat_action)


def drives(
    source: str | Scene | Callable[[], ControlRequestor],
    thing: Any,
    seeds: list[int],
    *,
    agent: str = "",
    limit: int = DEFAULT_MAX_DECISIONS,
    watch: Callable[[Drive], object] = lambda _: None,
) -> Iterator[Drive]:
    """Run one episode for each seed, driven by a student's work.

    Args:
        source: a scene, its name, or a function that makes a world with its agents.
        thing: a function, a controller, a brain; None where the agent has its own.
        seeds: seeds of the episodes.
        agent: id of the driven agent; default: the one that acts first.
        limit: decisions after which an episode is truncated.
        watch: called at the beginning and after each decision; may raise :class:`NotYet`.
    """
    if isinstance(source, str):
        source = Scene.load(source)
    sim = source.build() if isinstance(source, Scene) else source()
    driven = sim.agent(agent) if agent else sim.agents[0]
    if thing is not None:
        driven.use_brain(brain_for(thing, driven))
    for seed in seeds:
        yield drive(sim, driven, seed, limit, watch)


_observer: ContextVar[Callable[[Drive], object]] = ContextVar("observer", default=lambda _: None)


@contextmanager
def observed(observer: Callable[[Drive], object]) -> Iterator[None]:
    """Call a function at the beginning of all rollouts in this context, and after each decision."""
    token = _observer.set(observer)
    try:
        yield
    finally:
        _observer.reset(token)


def drive(
    sim: ControlRequestor,
    agent: BasicAgent,
    seed: int,
    limit: int = DEFAULT_MAX_DECISIONS,
    watch: Callable[[Drive], object] = lambda _: None,
) -> Drive:
    """Run one episode, from a reset to its end or the limit."""
    sim.reset(seed)
    done, observer = Drive(sim, agent, seed, [agent.body.position]), _observer.get()
    observer(done)
    watch(done)
    episode = sim.episode
    while not agent.done and done.steps < limit:
        sim.step(agent)
        if sim.episode != episode or agent.stopped or agent.paused:
            break  # it gave up
        done.trail.append(agent.body.position)
        observer(done)
        watch(done)
    return done
