"""One number of a scene with many values: the same driver from the same starts with each."""

import io
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
from msgspec import Struct
from pydantic import ValidationError
from rich.console import Console
from rich.table import Table

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.episode_options import AGENT_NUMBERS, named_blocks
from ai4u_edu.base.csv_table import csv_table
from ai4u_edu.base.errors import AI4UError, SetupError, suggest, text_of
from ai4u_edu.base.parameters import DataPath, explain
from ai4u_edu.blocks import Block, Controller, LocalBrain
from ai4u_edu.blocks.brains.controllers.key_defaults import listens_to_keys
from ai4u_edu.blocks.brains.network import ZOO_PREFIX
from ai4u_edu.blocks.declared_numbers import DeclaredNumber, declared_numbers
from ai4u_edu.games.jobs import Engine
from ai4u_edu.learn.training.evaluate_jobs import evaluate_on
from ai4u_edu.learn.training.evaluating import Evaluation, between
from ai4u_edu.learn.training.policies import entrant, expect_here
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, translate
from ai4u_edu.scenes import Scene, SceneDescription
from ai4u_edu.scenes.scene_data import SceneData
from ai4u_edu.scenes.serialization import PlainDataError, is_serializable, to_plain
from ai4u_edu.world import WorldSettings

MAX_VALUES = 50
"""Values of one parameter that are tried at a time."""
MAX_LINE_CHARS = 120
"""Length of a line of a table as text."""
FROM_SCENE = "scene"
"""Name of the driver that the scene itself has."""
NO_FIT = "does not fit agent"
TO_FIT = _("vary another number, or choose a controller: those fit any sensors")
"""Hint for a network that was trained with other sensors."""


@dataclass(frozen=True)
class NumberParameter:
    """A number in a scene: of a block, an agent, a thing, or the world."""

    name: str
    """Such as ``0.vision.columns``, ``bodies.box.mass`` and ``world.gravity``."""
    path: DataPath
    """Path in the scene's plain data."""
    value: float | None
    """Its present value; None if it has none."""
    unit: str = ""
    """Empty if it has none."""
    limits: str = ""
    """Its range in words; empty if it has none."""

    @property
    def owner(self) -> str:
        """Name of the block, the agent or the thing that has it."""
        return self.name.rpartition(".")[0]

    @property
    def shown_unit(self) -> str:
        """The unit, but for plain numbers."""
        return "" if self.unit == "1" else self.unit


class TriedValue(Struct, frozen=True):
    """Result of the episodes with one value of a parameter."""

    value: float
    episodes: int
    successes: int | None
    """Episodes that reached the goal; None in a scene without a goal."""
    low: float | None
    """Lower end of the 95% confidence interval of the share of successes."""
    high: float | None
    reward: float
    """Mean reward of an episode."""
    seconds: float
    """Mean duration (s) of an episode in world time."""
    decisions: float
    """Mean number of decisions of an episode."""

    @property
    def success(self) -> float | None:
        """Share of the episodes that reached the goal; None in a scene without a goal."""
        return None if self.successes is None else self.successes / self.episodes

    @classmethod
    def of(cls, value: float, evaluation: Evaluation) -> "TriedValue":
        """Return the result of an evaluation with a value."""
        low, high = evaluation.interval or (None, None)
        return cls(
            value=value,
            episodes=len(evaluation.episodes),
            successes=evaluation.successes if evaluation.has_goal else None,
            low=low,
            high=high,
            reward=float(np.mean(evaluation.rewards)),
            seconds=float(np.mean(evaluation.seconds)),
            decisions=float(np.mean(evaluation.lengths)),
        )


@dataclass(frozen=True, repr=False)
class Tried:
    """Results of all values of a parameter; as text or in a notebook, a table for the reader."""

    parameter: NumberParameter
    rows: Sequence[TriedValue]

    def table(self) -> Table:
        """Return a table with a row for each value."""
        table = Table(box=None, pad_edge=False)
        for heading in self._headings:
            table.add_column(heading, justify="right", overflow="fold")
        for row in self.rows:
            table.add_row(*_cells(row))
        return table

    def csv(self) -> str:
        """Return the results as CSV; what a scene without a goal lacks is empty."""
        ends = ("success", "success_low", "success_high")
        header = (self.parameter.name, "episodes", "successes", *ends)
        cells = (
            (
                int(row.value) if row.value == int(row.value) else row.value,
                *(row.episodes, row.successes, row.success, row.low, row.high),
                *(row.reward, row.seconds, row.decisions),
            )
            for row in self.rows
        )
        return csv_table((*header, "reward", "seconds", "decisions"), cells)

    def __repr__(self) -> str:
        """Return the table as text."""
        console = Console(file=io.StringIO(), width=MAX_LINE_CHARS, color_system=None)
        with console.capture() as text:
            console.print(self.table(), highlight=False)
        return "\n".join(line.rstrip() for line in text.get().splitlines())

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{escape(each)}</th>" for each in self._headings)
        body = "".join(
            f"<tr>{''.join(f'<td>{cell}</td>' for cell in _cells(row))}</tr>" for row in self.rows
        )
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"

    @property
    def _headings(self) -> tuple[str, ...]:
        name, unit = self.parameter.name, self.parameter.shown_unit
        first = f"{name} ({unit})" if unit else name
        others = _("success"), _("95% between"), _("reward"), _("time")
        return first, *map(translate, others)


def _cells(row: TriedValue) -> tuple[str, ...]:
    success, limits = "-", "-"
    if row.success is not None and row.low is not None and row.high is not None:
        success, limits = f"{row.success:.0%}", translate(between(row.low, row.high))
    return f"{row.value:.10g}", success, limits, f"{row.reward:.2f}", f"{row.seconds:.1f} s"


def number_parameters(scene: Scene) -> list[NumberParameter]:
    """Return all numbers of a scene, with the enabled brain of each agent as ``brain``."""
    plain = scene.plain()
    agents = {agent.id: agent for agent in scene.build().agents}
    found: list[NumberParameter] = []
    for index, given in enumerate(plain["agents"]):
        path: DataPath = ("agents", index)
        agent = agents[str(given.get("id", "0"))]
        own = [each for each in declared_numbers(BasicAgent) if each.name in AGENT_NUMBERS]
        found += _numbers(agent.id, path, given, own)
        for kind, place, name in named_blocks(agent):
            found += _of_block(f"{agent.id}.{name}", (*path, kind, place), given[kind][place])
    found += _numbers("world", ("world",), plain.get("world", {}), _declared(WorldSettings))
    field = scene.description.generate
    if field is not None:
        found += _numbers("generate", ("generate",), plain["generate"], _declared(type(field)))
    for kind in ("floors", "areas", "bodies"):
        for index, thing in enumerate(getattr(scene.description, kind)):
            given, name = plain[kind][index], f"{kind}.{thing.name}"
            found += _numbers(name, (kind, index), given, _declared(type(thing)))
            shape = _declared(type(thing.shape))
            found += _numbers(name, (kind, index, "shape"), given["shape"], shape)
    return found


def parameter_named(scene: Scene, name: str) -> NumberParameter:
    """Return a scene's number by its name, of which a part at the end suffices.

    Raises:
        SetupError: there is none of that name, or there are several.

    >>> parameter_named(Scene.load("box_chase"), "vision.columns").name
    '0.vision.columns'
    """
    known = {each.name: each for each in number_parameters(scene)}
    fitting = [known[name]] if name in known else []
    fitting = fitting or [each for full, each in known.items() if full.endswith(f".{name}")]
    if len(fitting) == 1:
        return fitting[0]
    if fitting:
        several = ", ".join(each.name for each in fitting)
        raise SetupError(
            _(
                "expected the whole name of one parameter, got {name!r}: {several}",
                name=name,
                several=several,
            )
        )
    if owned := [full for full in known if full.startswith((f"{name}.", f"0.{name}."))]:
        raise SetupError(
            _(
                "expected a parameter, got {name!r}, which has {owned}",
                name=name,
                owned=", ".join(owned),
            )
        )
    raise SetupError(
        _(
            "no number of this scene is called {name!r}; {hint}",
            name=name,
            hint=suggest(name, known),
        )
    )


def parse_values(text: str) -> list[float]:
    """Return the numbers that a text names, without repetitions.

    Raises:
        SetupError: it names something else, or too many.

    >>> parse_values("1, 2,0.5")
    [1, 2, 0.5]
    """
    values: list[float] = []
    for part in text.split(","):
        match = re.fullmatch(r"\s*([+-]?(\d+|\d*\.\d+|\d+\.)([eE][+-]?\d{1,3})?)\s*", part)
        if match is None or len(match[1]) > 30:
            raise SetupError(
                _("expected numbers with commas between, as in 1,2,4, got {text!r}", text=text)
            )
        values.append(int(match[1]) if re.fullmatch(r"[+-]?\d+", match[1]) else float(match[1]))
    values = [*dict.fromkeys(values)]
    if len(values) > MAX_VALUES:
        raise SetupError(
            _("expected at most {most} values, got {n}; try fewer", most=MAX_VALUES, n=len(values))
        )
    return values


def with_value(scene: Scene, parameter: NumberParameter, value: float) -> Scene:
    """Return a copy of a scene with another value of a parameter.

    Raises:
        SetupError: the scene can't have that value.
    """
    plain = deepcopy(scene.plain())
    here: Any = plain
    for part in parameter.path[:-1]:
        here = here.setdefault(part, {}) if isinstance(here, dict) else here[part]
    here[parameter.path[-1]] = value
    try:
        changed = Scene(SceneDescription.model_validate(plain), scene.folder)
        changed.build().reset(0)
    except ValidationError as error:
        text = join([each.text for each in explain(error.errors(), SceneDescription)], "; ")
    except PlainDataError as error:
        text = join([each.text for each in error.problems], "; ")
    except AI4UError as error:
        text = join([text_of(error), *([TO_FIT] if NO_FIT in text_of(error) else [])], "; ")
    else:
        return changed
    raise SetupError(join([f"{parameter.name} = {value:g}", text], ": "))


def with_driver(scene: Scene, spec: str, agent: str = "") -> tuple[Scene, str]:
    """Return a scene with a driver in it, so that numbers of the driver can be varied too.

    Args:
        scene: stays as it is.
        spec: names the driver, as for :func:`~ai4u_edu.learn.training.policies.entrant`.
        agent: id of the agent that it drives; default: the first one.

    Returns:
        The scene, and who drives in it: ``scene``, or the same driver if no scene can have it.

    Raises:
        AI4UError: there is no such driver, or it can't drive here.
    """
    who = expect_here(entrant(spec, scene.description.name))
    scene = who.fitted(scene)
    sim = scene.build()
    driven = sim.agent(agent or who.agent or sim.agents[0].id)
    if spec == "random" or ".py:" in spec:
        return scene, spec
    brain = who.brain(driven)
    if not isinstance(brain, LocalBrain):
        got = type(brain).__name__
        raise SetupError(
            _(
                "agent {id!r}: expected a network or a controller, got a {got}",
                id=driven.id,
                got=got,
            )
        )
    controller = brain.controller
    if not isinstance(controller, Controller) or not is_serializable(type(controller)):
        raise SetupError(
            _(
                "{spec}: expected a driver that a scene file can have; export the network "
                "first: ai4u-edu export {spec} --out policy.onnx",
                spec=spec,
            )
        )
    if listens_to_keys(type(controller)):
        raise SetupError(
            _(
                "agent {id!r} follows keys ({kind}), which nobody presses here; expected "
                "another driver, as in --brain zoo for the scene's own network",
                id=driven.id,
                kind=type(controller).__name__,
            )
        )
    if spec == FROM_SCENE:
        return scene, spec
    return _with_brain(scene, driven.id, to_plain(brain)), FROM_SCENE


def try_values(
    scene: Scene,
    parameter: NumberParameter,
    values: Sequence[float],
    seeds: Sequence[int],
    engine: Engine,
    *,
    who: str = FROM_SCENE,
    agent: str = "",
    own_blocks: Sequence[Path] = (),
    tell: Callable[[int], object] = lambda _episodes: None,
) -> list[TriedValue]:
    """Drive from the same starts with each value of a parameter.

    Args:
        scene: stays as it is.
        parameter: is changed.
        values: of the parameter; one at least.
        seeds: of the episodes with each value; one at least.
        engine: runs the episodes.
        who: who drives; see :func:`with_driver`.
        agent: id of the agent that is driven and measured; default: the driver's.
        own_blocks: Python files with blocks that the scene has; they are loaded already.
        tell: called after some episodes with their number.

    Raises:
        AI4UError: the scene can't have one of the values, or the episodes could not be run.
    """
    files = [str(file.absolute()) for file in own_blocks]
    drives = []
    for value in values:
        changed = with_value(scene, parameter, value)
        data: SceneData = {"name": scene.description.name, "text": changed.dumps()}
        data["folder"] = str(scene.folder or ".")
        drives.append((who, data | ({"blocks": files} if files else {})))
    done = evaluate_on(engine, drives, seeds, agent=agent, tell=tell)
    return [TriedValue.of(value, each) for value, each in zip(values, done, strict=True)]


def parameter_table(parameters: Sequence[NumberParameter]) -> Table:
    """Return a table with a row for each parameter that could be varied."""
    table = Table(box=None, pad_edge=False)
    table.add_column(
        translate(_("parameter")),
        overflow="fold",
        min_width=max(len(each.name) for each in parameters),
    )
    table.add_column(translate(_("value")), justify="right")
    for heading in (_("unit"), _("range")):
        table.add_column(translate(heading))
    for each in parameters:
        value = "-" if each.value is None else f"{each.value:.10g}"
        table.add_row(each.name, value, each.shown_unit, each.limits)
    return table


def _with_brain(scene: Scene, agent: str, brain: dict[str, Any]) -> Scene:
    controller = brain.get("controller", {})
    path = str(controller.get("model_path", ""))
    if path and not path.startswith(ZOO_PREFIX):  # the scene's file may lie elsewhere
        controller["model_path"] = str(Path(path).absolute())
    agents = [
        {**each, "brains": [brain]} if str(each.get("id", "0")) == agent else each
        for each in scene.description.agents
    ]
    described = scene.description.model_copy(update={"agents": tuple(agents)})
    return Scene(described, scene.folder)


def _of_block(name: str, path: DataPath, plain: Mapping[str, Any]) -> list[NumberParameter]:
    """Return the numbers of a block, and of those inside it."""
    found = _numbers(name, path, plain, _declared(Block.types[str(plain["type"])]))
    for key, value in plain.items():
        inner = value if isinstance(value, list | tuple) else [value]
        for index, each in enumerate(inner):
            if isinstance(each, Mapping) and each.get("type") in Block.types:
                place = (key, index) if value is inner else (key,)
                inside = str(each.get("name", index)) if value is inner else key
                found += _of_block(f"{name}.{inside}", (*path, *place), each)
    return found


def _numbers(
    owner: str, path: DataPath, plain: Mapping[str, Any], numbers: Iterable[DeclaredNumber]
) -> list[NumberParameter]:
    return [
        NumberParameter(
            f"{owner}.{each.name}",
            (*path, each.name),
            plain.get(each.name, each.value),
            each.unit,
            each.limits,
        )
        for each in numbers
        if not each.is_pair
    ]


def _declared(cls: type) -> tuple[DeclaredNumber, ...]:
    return declared_numbers(cls)  # mypy believes that a class that defines __hash__ has no hash
