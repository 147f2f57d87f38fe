"""Numbers of a world and its agents that a reset may change for one episode."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from numbers import Real
from typing import Any, Protocol

import numpy as np
from gymnasium.spaces import Space
from pydantic import BaseModel, ValidationError

from ai4u_edu.agent.agent import BasicAgent
from ai4u_edu.base.errors import (
    NameNotFoundError,
    ParameterError,
    SetupError,
    shown,
    suggest,
    text_of,
)
from ai4u_edu.base.parameters import DataPath, explain, format_problems, is_open
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.block import default_name
from ai4u_edu.blocks.declared_numbers import DeclaredNumber, declared_numbers
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import AreaDescription, BodyDescription, FloorDescription, World, redescribe

Options = Mapping[str, Any]
"""Numbers, or pairs of numbers, by the name of their parameter, such as ``bodies.box.mass``."""
Thing = BodyDescription | FloorDescription | AreaDescription

AGENT_NUMBERS = ("max_steps_per_episode", "reward_scale")
"""Numbers of an agent itself; its other ones are for AI4U's scripts."""
FIXED = {"ticks_per_second": _("a tick's length"), "priority": _("the order of agents")}
"""Numbers that no reset can change, with what they decide."""
KINDS = {FloorDescription: "floors", AreaDescription: "areas", BodyDescription: "bodies"}


class Sim(Protocol):
    """The part of a ControlRequestor that options need."""

    world: World
    agents: tuple[BasicAgent, ...]


@dataclass(frozen=True)
class OptionParameter:
    """A number of a world that options may change."""

    name: str
    """Such as ``0.vision.noise``, ``bodies.box.mass`` and ``world.gravity``."""
    owner: DataPath
    """Kind and place of what has it."""
    declared: DeclaredNumber
    value: Any
    """Its present value; None if it has none."""


@dataclass(frozen=True)
class _Plan:
    """New descriptions and blocks, all of them checked already."""

    settings: Any
    field: Any
    things: Sequence[Thing]
    agents: Sequence[tuple[BasicAgent, str, Any]]
    blocks: Sequence[tuple[list[Block], int, Block]]


class EpisodeOptions:
    """Changes numbers of a world and its agents for one episode, and restores them.

    What an agent can sense and do stays as it is: a number on which its spaces depend is refused.

    Args:
        sim: the world and its agents; they have been set up.

    >>> from ai4u_edu import Scene
    >>> sim = Scene.load("box_chase").build()
    >>> sim.reset(seed=1, options={"gravity": 1.6, "vision.noise": 0.01})
    >>> sim.world.settings.gravity, sim.agents[0].sensors[0].noise
    (1.6, 0.01)
    >>> sim.reset(seed=1)
    >>> sim.world.settings.gravity
    9.81
    >>> sim.reset(options={"gravty": 1})
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.NameNotFoundError: options: no number is called 'gravty'; did you mean \
'world.gravity'?
    """

    def __init__(self, sim: Sim) -> None:
        self._sim = sim
        self.values: dict[str, Any] = {}
        """Options of this episode, by their whole names."""
        self._restore_steps: list[Callable[[], object]] = []
        self._base_spaces: list[dict[str, Space[Any]]] | None = None

    @contextmanager
    def applied(self, options: Options | None) -> Iterator[None]:
        """Apply options, and take them back if the block raises.

        Args:
            options: of the episode that the block begins; None or empty restores all numbers.

        Raises:
            NameNotFoundError: no number has that name; then nothing has changed.
            ParameterError: a value is not possible; then nothing has changed.
            SetupError: something does not fit any more; then the world is as without options.
        """
        if not options and not self.values:
            yield
            return
        given = self._named(options or {})
        if given == self.values:
            yield
            return
        plan = self._plan(given)
        if self.values:
            self._restore()
            plan = self._plan(given)  # of the scene's own numbers
        try:
            self._apply(plan)
            self.values = given
            yield
            for thing in plan.things:
                if isinstance(thing, BodyDescription):
                    self._check_place(thing.name)
        except BaseException:
            self._restore()
            self._sim.world.rebuild()
            raise

    def parameters(self) -> dict[str, OptionParameter]:
        """Return all numbers of the world and its agents by name, in order.

        The brain of an agent is called ``brain``. Not all of them can be changed by a reset: see
        :meth:`changeable`.
        """
        sim = self._sim
        found: list[OptionParameter] = []
        for index, agent in enumerate(sim.agents):
            own = {each.name: each for each in declared_numbers(BasicAgent)}
            for name in AGENT_NUMBERS:
                value = getattr(agent, name)
                found.append(
                    OptionParameter(f"{agent.id}.{name}", ("agent", index), own[name], value)
                )
            for kind, place, name in named_blocks(agent):
                block = getattr(agent, kind)[place]
                if not type(block).__dict__.get("abstract", False):
                    found += _of_block(f"{agent.id}.{name}", ("block", index, kind, place), block)
        settings = sim.world.settings
        found += _of_model("world", ("world",), settings)
        if sim.world.field is not None:
            found += _of_model("generate", ("field",), sim.world.field)
        for words in KINDS.values():
            for thing in sim.world.described:
                if KINDS[type(thing)] == words:
                    owner = f"{words}.{thing.name}"
                    found += _of_model(owner, ("thing", thing.name), thing)
                    found += _of_model(owner, ("thing", thing.name, "shape"), thing.shape)
                    if thing.random is not None:
                        given = thing.random.model_fields_set
                        found += [
                            each
                            for each in _of_model(
                                f"{owner}.random", ("thing", thing.name, "random"), thing.random
                            )
                            if each.declared.name in given
                        ]
        return {each.name: each for each in found}

    def changeable(self) -> dict[str, OptionParameter]:
        """Return the numbers that a reset can change; each is tried, and the world is reset."""
        found = {}
        for name, parameter in self.parameters().items():
            for value in _other_values(parameter):
                try:
                    plan = self._plan({name: value})
                    try:
                        self._apply(plan)
                    finally:
                        self._restore()
                except (SetupError, NameNotFoundError):
                    continue
                found[name] = parameter
                break
        self._sim.world.rebuild()
        return found

    def sample(
        self, ranges: Mapping[str, Sequence[float]], rng: np.random.Generator
    ) -> dict[str, Any]:
        """Return options for one reset, sampled uniformly from ranges.

        Args:
            ranges: lowest and highest value by the number's name; whole numbers include both ends,
                and a pair of numbers gets one number for both of its places.
            rng: the generator to sample with.

        >>> from ai4u_edu import Scene
        >>> options = EpisodeOptions(Scene.load("box_chase").build())
        >>> options.sample({"bodies.box.mass": (2, 2)}, np.random.default_rng(1))
        {'bodies.box.mass': 2.0}
        """
        known, values = self.parameters(), dict[str, Any]()
        for given, (low, high) in ranges.items():
            name = _resolved(given, known)
            if known[name].declared.is_whole:
                values[name] = int(rng.integers(math.ceil(low), math.floor(high) + 1))
            else:
                values[name] = low + (high - low) * float(rng.random())
            if known[name].declared.is_pair:
                values[name] = [values[name]] * 2
        return values

    def _named(self, options: object) -> dict[str, Any]:
        """Return options by their whole names, with Python's numbers.

        Raises:
            NameNotFoundError: no number has a name.
            ParameterError: a value is no number, or no pair where one is expected.
        """
        if not isinstance(options, Mapping):
            raise ParameterError(
                _(
                    "options: expected numbers by name, as in options={{'gravity': 1.6}}, got "
                    "{got}",
                    got=shown(options),
                )
            )
        known = self.parameters() if options else {}
        named: dict[str, Any] = {}
        for given, value in options.items():
            name = _resolved(given, known)
            if name in named:
                raise ParameterError(
                    _("options: {name} was given twice; expected it once", name=name)
                )
            named[name] = _as_numbers(name, value, is_pair=known[name].declared.is_pair)
        return named

    def _plan(self, values: Mapping[str, Any]) -> _Plan:
        """Return what has to change for values, which are valid then.

        Raises:
            ParameterError: a value is not possible.
        """
        sim, known = self._sim, self.parameters()
        settings: dict[str, Any] = {}
        field_numbers: dict[str, Any] = {}
        things: dict[str, dict[str, Any]] = {}
        agents: list[tuple[BasicAgent, str, Any]] = []
        blocks: dict[tuple[Any, ...], list[tuple[DataPath, str, Any]]] = {}
        for name, value in values.items():
            parameter = known[name]
            field, (kind, *place) = parameter.declared.name, parameter.owner
            if field in FIXED:
                raise ParameterError(
                    _(
                        "options: {name}: {fixed} is the same in all episodes; make another "
                        "environment for it",
                        name=name,
                        fixed=FIXED[field],
                    )
                )
            if kind == "world":
                settings[field] = value
            elif kind == "field":
                field_numbers[field] = value
            elif kind == "thing":
                part = things.setdefault(str(place[0]), {})
                for inner in place[1:]:
                    part = part.setdefault(str(inner), {})
                part[field] = value
            elif kind == "agent":
                agent = sim.agents[int(place[0])]
                with _explained(agent.id):
                    changed = BasicAgent(body=agent.body_name, **{field: value})
                agents.append((agent, field, getattr(changed, field)))
            else:
                blocks.setdefault(tuple(place[:3]), []).append((tuple(place[3:]), field, value))
        described = {thing.name: thing for thing in sim.world.described}
        with _explained("world"):
            changed_settings = _changed_model(sim.world.settings, settings)
        with _explained("generate"):
            changed_field = _changed_model(sim.world.field, field_numbers)
        changed_things = []
        for thing_name, parts in things.items():
            thing = described[thing_name]
            with _explained(thing_name):
                # easy starts are for a learner, which takes them from the scene; they may lie
                # outside the ranges of this episode
                if "random" in parts and thing.curriculum is not None:
                    thing = thing.model_copy(update={"curriculum": None})
                changed_things.append(_changed_model(thing, parts))
        changed_blocks = []
        for (index, kind, place), changes in blocks.items():
            agent = sim.agents[index]
            with _explained(f"agent {agent.id!r}"):
                present = getattr(agent, kind)
                changed_blocks.append((present, place, _changed_block(present[place], changes)))
        return _Plan(changed_settings, changed_field, changed_things, agents, changed_blocks)

    def _apply(self, plan: _Plan) -> None:
        """Change what a plan names.

        Raises:
            SetupError: blocks do not fit any more, or a space would change.
        """
        sim, steps = self._sim, self._restore_steps
        world = sim.world
        needs_binding = bool(plan.things or plan.blocks or plan.field != world.field)
        if needs_binding and self._base_spaces is None:
            self._base_spaces = [_spaces_of(agent) for agent in sim.agents]
        described = {thing.name: thing for thing in sim.world.described}
        before = [described[thing.name] for thing in plan.things]
        steps.append(partial(redescribe, world, before, world.settings, world.field))
        redescribe(world, plan.things, plan.settings, plan.field)
        for agent, field, value in plan.agents:
            steps.append(partial(setattr, agent, field, getattr(agent, field)))
            setattr(agent, field, value)
        for blocks, index, block in plan.blocks:
            steps.append(partial(blocks.__setitem__, index, blocks[index]))
            blocks[index] = block
        if needs_binding:
            steps.append(self._bind)
            self._bind()
            self._check_spaces()

    def _restore(self) -> None:
        """Restore all numbers of the scene."""
        self.values = {}
        binds = self._bind in self._restore_steps
        steps, self._restore_steps = self._restore_steps, []
        for step in reversed(steps):
            if step != self._bind:
                step()
        if binds:
            self._bind()

    def _bind(self) -> None:
        """Set up the blocks of all agents again: they may keep what the world's things were."""
        for agent in self._sim.agents:
            before = agent.bound_blocks
            is_kept = any(each is before.brain for each in agent.brains)
            bound = agent.bind_blocks(
                self._sim.world, ready_brain=before.brain if is_kept else None
            )
            for name, actuator in before.actuators.items():  # the setup clears it
                bound.actuators[name].on_clip = actuator.on_clip

    def _check_spaces(self) -> None:
        for agent, base in zip(self._sim.agents, self._base_spaces or (), strict=True):
            for key, space in _spaces_of(agent).items():
                if space != base[key]:
                    raise SetupError(
                        _(
                            "options: agent {id!r}, {key}: expected numbers that keep its space "
                            "{base}, got {space}; make another environment for it",
                            id=agent.id,
                            key=key,
                            base=str(base[key]),
                            space=str(space),
                        )
                    )

    def _check_place(self, name: str) -> None:
        world = self._sim.world
        other = None if world[name].fallen else world.find_overlap(world[name])
        if other is not None:
            raise SetupError(
                _(
                    "options: body {name!r} would overlap body {name2!r}; choose another place or "
                    "size",
                    name=name,
                    name2=other.name,
                )
            )


def named_blocks(agent: BasicAgent) -> Iterator[tuple[str, int, str]]:
    """Yield kind, index and name of an agent's blocks; a name that is taken follows its kind."""
    names = [
        ("sensors", [each.perception_key for each in agent.sensors]),
        ("actuators", [each.action_name for each in agent.actuators]),
        ("rewards", [each.name for each in agent.rewards]),
        ("brains", ["brain" if each.enabled else "" for each in agent.brains]),
    ]
    taken: set[str] = set()
    for kind, blocks in names:
        for index, name in enumerate(blocks):
            if name:
                yield kind, index, f"{kind}.{name}" if name in taken else name
                taken.add(name)


def _of_model(name: str, owner: DataPath, model: BaseModel) -> list[OptionParameter]:
    cls: type = type(model)  # mypy believes that a class that defines __hash__ has no hash
    return [
        OptionParameter(f"{name}.{each.name}", owner, each, getattr(model, each.name))
        for each in declared_numbers(cls)
    ]


def _of_block(name: str, owner: DataPath, block: Block) -> list[OptionParameter]:
    """Return the numbers of a block, and of those inside it."""
    cls: type = type(block)
    values = block.values()
    found = [
        OptionParameter(f"{name}.{each.name}", owner, each, values[each.name])
        for each in declared_numbers(cls)
    ]
    for key, value in values.items():
        if isinstance(value, Block):
            found += _of_block(f"{name}.{key}", (*owner, key, -1), value)
        elif isinstance(value, list | tuple):
            for index, each in enumerate(value):
                if isinstance(each, Block):
                    given = each.given().get("name", index)
                    has_own = given != default_name(type(each), "RewardFunc", "Reward", "Func")
                    inside = str(given if has_own else index)
                    found += _of_block(f"{name}.{inside}", (*owner, key, index), each)
    return found


def _resolved(name: object, known: Mapping[str, Any]) -> str:
    """Return the whole name of a number of which an end is given.

    Raises:
        NameNotFoundError: there is none, or there are several.
    """
    if name in known:
        return str(name)
    fitting = [full for full in known if full.endswith(f".{name}")]
    if len(fitting) == 1:
        return fitting[0]
    if fitting:
        several = ", ".join(fitting[:20])
        raise NameNotFoundError(
            _(
                "options: expected the whole name of one number, got {name}: {several}",
                name=repr(name),
                several=several,
            )
        )
    ends = {full.rpartition(".")[2]: full for full in known}
    hint = suggest(str(name), known)
    if "did you mean" not in hint and "did you mean" in suggest(str(name), ends):
        hint = suggest(str(name), ends)
    raise NameNotFoundError(
        _("options: no number is called {name}; {hint}", name=repr(name), hint=hint)
    )


def _as_numbers(name: str, value: Any, *, is_pair: bool) -> Any:
    """Return a number, or a list of two, out of Python or NumPy.

    Raises:
        ParameterError: the value is none.
    """
    plain = value.tolist() if isinstance(value, np.ndarray | np.generic) else value
    parts = list(plain) if is_pair and isinstance(plain, list | tuple) else [plain]
    is_number = all(isinstance(each, Real) and not isinstance(each, bool) for each in parts)
    if len(parts) != 1 + is_pair or not is_number:
        expected = _("two numbers, as in [0, 1]") if is_pair else _("a number")
        raise ParameterError(
            _(
                "options: {name}: expected {expected}, got {got}",
                name=name,
                expected=expected,
                got=shown(value),
            )
        )
    return parts if is_pair else parts[0]


@contextmanager
def _explained(name: str) -> Iterator[None]:
    """Begin the message about a wrong value with the name of what has it."""
    try:
        yield
    except ParameterError as error:
        raise ParameterError(
            _("options: {name}: {error}", name=name, error=text_of(error))
        ) from None


def _changed_model(model: Any, values: Mapping[str, Any]) -> Any:
    """Return a description with other values, of its shape and its ranges too."""
    if not values:
        return model
    plain = model.model_dump()
    for name, value in values.items():
        plain[name] = {**plain[name], **value} if isinstance(value, Mapping) else value
    try:
        return type(model).model_validate(plain)
    except ValidationError as error:
        problems = format_problems(explain(error.errors(), type(model)))
        raise ParameterError(problems) from None


def _changed_block(block: Block, changes: Sequence[tuple[DataPath, str, Any]]) -> Block:
    """Return a new block with other values, also of the blocks inside it."""
    values = {field: value for inner, field, value in changes if not inner}
    inside: dict[DataPath, list[tuple[DataPath, str, Any]]] = {}
    for inner, field, value in changes:
        if inner:
            inside.setdefault(inner[:2], []).append((inner[2:], field, value))
    for (key, index), each in inside.items():
        here = values.get(str(key), getattr(block, str(key)))
        if index == -1:
            values[str(key)] = _changed_block(here, each)
        else:
            blocks = list(here)
            blocks[int(index)] = _changed_block(blocks[int(index)], each)
            values[str(key)] = blocks
    changed = block.changed(**values)
    if vars(block).get("handler") is not None:  # which a script has set
        setattr(changed, "handler", vars(block)["handler"])  # noqa: B010 - two classes have it
    return changed


def _spaces_of(agent: BasicAgent) -> dict[str, Space[Any]]:
    """Return the spaces of an agent's sensors and actuators by name."""
    bound = agent.bound_blocks
    spaces: dict[str, Space[Any]] = {
        f"sensor {each.perception_key!r}": each.observation_space() for each in bound.sensors
    }
    for name, actuator in bound.actuators.items():
        spaces[f"actuator {name!r}"] = actuator.space()
    return spaces


def _other_values(parameter: OptionParameter) -> Iterator[Any]:
    """Yield values to try in place of the present one."""
    declared, now = parameter.declared, parameter.value
    if declared.is_pair:
        first, second = now or (0.0, 1.0)
        yield [first + 0.25 * (second - first), second]
        yield [first, second + 0.5]
        return
    low, high = declared.low, declared.high
    step = 1 if declared.is_whole else 0.125
    near = low if math.isfinite(low) and not is_open(low) else 0.0
    start = near if now is None else now
    for value in (start + step, start - step, start * 1.5, start * 0.5):
        if low <= value <= high and value != now:
            yield value
