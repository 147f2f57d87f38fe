"""The content of a scene file as data."""

import json
import zlib
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, Self, get_args

from pydantic import Field, model_validator

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.ledger import HANDLERS
from ai4u_edu.base.errors import suggest
from ai4u_edu.base.parameters import DataPath, Name, ParameterProblem, quantity
from ai4u_edu.blocks.rewards.combined import CombinedRewardFunc
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes.serialization import PlainDataError, make
from ai4u_edu.world import (
    AreaDescription,
    BodyDescription,
    FieldDescription,
    FloorDescription,
    WorldSettings,
)
from ai4u_edu.world.pictures import check_pictures
from ai4u_edu.world.shapes import Description

Level = Literal["easy", "medium", "hard"]
LEVELS: tuple[Level, ...] = get_args(Level)
"""Difficulties of a scene, the lowest first."""
THINGS = ("floors", "areas", "bodies")
"""Fields of a scene with its things."""
TASK_FIELDS = {"success", "world", "floors", "areas", "bodies"}
TASK_PARTS = ("body", "actuators", "rewards", "max_steps_per_episode")
"""Fields of a scene, and parameters of its agents, that decide how long reaching the goal takes."""
Text = Annotated[str, Field(max_length=2000)]


class SceneDescription(Description):
    """A world and its agents as data."""

    name: Name
    title: Text = ""
    goal: Text = ""
    level: Level | None = None
    """The difficulty of the goal for a person."""
    minutes: Annotated[int, Field(ge=1, le=600)] | None = None
    """Time (minutes) that a person needs to reach the goal for the first time."""
    few_decisions: Annotated[int, Field(ge=1, le=1_000_000)] | None = None
    """Most decisions for a program's third star, on average over ten starts; none where the goal
    takes a fixed time."""
    controls: Text = ""
    rewards: Text = ""
    """The rewards in words."""
    success: Name | None = None
    """The reward term that is paid when the goal is reached."""
    time_scale: Annotated[float, quantity("1", gt=0, le=100)] = 1.0
    spread_decisions: bool = False
    """Spreads the decisions of many agents over ticks, so that no tick has all the work."""
    wait_for_key: bool = True
    """Waits after each reset until a key is pressed, where a person drives in the page."""
    world: WorldSettings = WorldSettings()
    floors: tuple[FloorDescription, ...] = ()
    areas: tuple[AreaDescription, ...] = ()
    bodies: tuple[BodyDescription, ...] = ()
    generate: FieldDescription | None = None
    """A maze, a line or a rescue line that is generated for each episode from its seed."""
    agents: Annotated[tuple[Mapping[str, Any], ...], Field(min_length=1, max_length=64)]
    """Parameters of each agent, blocks as mappings with a ``type``."""

    @property
    def things(self) -> tuple[FloorDescription | AreaDescription | BodyDescription, ...]:
        """Everything that is in the world."""
        return (*self.floors, *self.areas, *self.bodies)

    @property
    def pictures(self) -> tuple[str, ...]:
        """The data of all pictures on the ground."""
        return tuple(area.picture for area in self.areas if area.picture is not None)

    @model_validator(mode="after")
    def _has_room_for_its_pictures(self) -> Self:
        check_pictures(self.pictures)
        return self

    def with_easy_starts(self) -> "SceneDescription | None":
        """Return the scene with its easy starts only; None if it has none."""
        if all(thing.curriculum is None for thing in self.things):
            return None
        kinds = {kind: tuple(map(_eased, getattr(self, kind))) for kind in THINGS}
        return self.model_copy(update=kinds)

    def task_key(self) -> str:
        """Return a key of all that makes times comparable: world, bodies, motion and rewards."""
        # nobody but a learner begins with easy starts
        without: Any = {kind: {"__all__": {"curriculum"}} for kind in THINGS}
        parts = self.model_dump(mode="json", include=TASK_FIELDS, exclude=without)
        if self.generate is not None:
            parts["generate"] = self.generate.model_dump(mode="json")
        parts["agents"] = [{name: agent.get(name) for name in TASK_PARTS} for agent in self.agents]
        text = json.dumps(parts, sort_keys=True, default=str)
        return f"{self.name}-{zlib.crc32(text.encode()):08x}"

    def where_is(self, name: str) -> DataPath:
        """Return the path of the floor, area or body of that name; of several, the last one's."""
        found: DataPath = () if name != "generate" else ("generate",)
        for kind in THINGS:
            for index, thing in enumerate(getattr(self, kind)):
                if thing.name == name:
                    found = (kind, index)
        return found


def _eased(thing: Any) -> Any:
    if thing.curriculum is None:
        return thing
    easy = thing.random.model_copy(update=thing.curriculum.widened(thing.random, 0.0))
    return thing.model_copy(update={"random": easy})


def make_agents(scene: SceneDescription) -> list[BasicAgent]:
    """Make a scene's agents with their blocks.

    Raises:
        PlainDataError: some parameters are wrong; it has all problems.
    """
    problems: list[ParameterProblem] = []
    agents = []
    for index, given in enumerate(scene.agents):
        try:
            agents.append(make(BasicAgent, given, ("agents", index)))
        except PlainDataError as error:
            problems += error.problems
    if problems:
        raise PlainDataError(problems)
    return [agent for agent in agents if isinstance(agent, BasicAgent)]


def check_success(success: str | None, agents: Sequence[BasicAgent]) -> None:
    """Check that some reward function pays the term that stands for reaching the goal.

    Rewards of children of AndRewardFunc and OrRewardFunc are recorded under the parent's name;
    rewards of handlers (``add_reward``) under :data:`HANDLERS` or a reward function's name.

    Raises:
        PlainDataError: none does, so that no episode could succeed.
    """
    terms = {reward.name for agent in agents for reward in agent.rewards}
    if success is None or success in terms or success == HANDLERS:
        return
    parents = [
        reward.name
        for agent in agents
        for reward in agent.rewards
        if isinstance(reward, CombinedRewardFunc) and success in _names_below(reward)
    ]
    hint = suggest(success, terms)
    if parents:
        hint = _("it is paid under the name {name!r}", name=parents[0])
    text = _(
        "no reward function has the name {name!r}, so no episode could succeed; {hint}",
        name=success,
        hint=hint,
    )
    raise PlainDataError([ParameterProblem(("success",), text)])


def _names_below(reward: CombinedRewardFunc) -> set[str]:
    names = {child.name for child in reward.children}
    for child in reward.children:
        if isinstance(child, CombinedRewardFunc):
            names |= _names_below(child)
    return names
