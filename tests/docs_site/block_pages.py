"""The reference of the blocks: a page for each, made of its declaration."""

import itertools
import textwrap
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ai4u_edu import Actuator, BasicAgent, Block, Sensor
from ai4u_edu.base.errors import NameNotFoundError
from ai4u_edu.blocks.docs import KINDS, built_in_blocks, parameter_rows, summary
from ai4u_edu.check import standard_scene
from ai4u_edu.page.panel.gallery import words_of
from ai4u_edu.snapshot.block_info import block_info_of
from tests.check.samples import INSIDE_OTHERS, sample_of
from tests.docs_site import block_pictures, rst
from tests.docs_site.block_pictures import units_of
from tests.docs_site.examples import Example, example_of, has_docstring_example
from tests.docs_site.staging import Staging

FOLDER = "blocks"
MAX_NAMED_NUMBERS = 24
"""Most numbers of a reading that get a row each."""


class MissingExampleError(Exception):
    """A block without an example that can be run."""


@dataclass(frozen=True)
class Page:
    """A block's page."""

    cls: type[Block]
    text: str
    picture: bytes | None


def add_blocks(site: Staging) -> None:
    """Write a page for each built-in block, and the lists of them."""
    index, titles = [], titles_of_kinds(site)
    for kind, members in built_in_blocks().items():
        if not members:
            continue
        index.append(kind)
        site.write(f"{FOLDER}/{kind}.rst", _list_of(site, titles[kind], members))
        for cls in members:
            page = page_of(site, cls)
            site.write(f"{FOLDER}/{cls.__name__}.rst", page.text)
            if page.picture is not None:
                site.write(f"{FOLDER}/{cls.__name__}.png", page.picture)
    listed = "\n".join(f"- [{titles[kind]}]({FOLDER}/{kind}.rst)" for kind in index)
    entries = "\n".join(f"{FOLDER}/{kind}" for kind in index)
    site.append("blocks.md", f"{listed}\n\n```{{toctree}}\n:hidden:\n\n{entries}\n```\n")


def titles_of_kinds(site: Staging) -> dict[str, str]:
    """Return headings of the kinds, as in :func:`built_in_blocks`."""
    return {
        "sensors": site.words("Sensors"),
        "actuators": site.words("Actuators"),
        "rewards": site.words("Reward functions"),
        "brains": site.words("Brains"),
        "controllers": site.words("Controllers"),
        "parts": site.words("Parts of other blocks"),
    }


def _list_of(site: Staging, title: str, members: Iterable[type[Block]]) -> str:
    rows = [(f":doc:`{cls.__name__}`", summary(cls).split(" Source:")[0]) for cls in members]
    return "\n".join(
        [
            rst.title(title),
            rst.table((site.words("block"), site.words("what it is")), rows, (1, 2)),
            rst.hidden_toctree(cls.__name__ for cls in members),
        ]
    )


def page_of(site: Staging, cls: type[Block]) -> Page:
    """Return the page of a block, after running its example.

    Raises:
        MissingExampleError: it has no example.
    """
    example = None if cls in INSIDE_OTHERS else example_of(sample_of(cls))
    if example is None and not has_docstring_example(cls):
        raise MissingExampleError(
            f"{cls.__name__}: expected a sample that can be written down, or an example (>>>) in "
            "its docstring"
        )
    picture = _picture(cls, example)
    methods = own_methods(cls)
    members = f":members: {', '.join(methods)}" if methods else ""
    shown = [
        rst.title(cls.__name__),
        _in_the_page(site, cls),
        f".. autoclass:: ai4u_edu.{cls.__name__}(**parameters)\n   {members}\n",
    ]
    if picture is not None:
        if issubclass(cls, Sensor):
            alt = site.words("The world from above and the reading, for {name} as in the example")
        else:
            alt = site.words("The world from above, for {name} as in the example")
        shown.append(
            f".. image:: {cls.__name__}.png\n   :alt: {alt.format(name=cls.__name__)}\n"
            "   :class: ai4u-picture\n"
        )
    shown.append(_parameters(site, cls))
    if example is not None:
        shown += [_gives(site, cls, example), _example(site, example)]
    return Page(cls, "\n".join(filter(None, shown)), picture)


def _in_the_page(site: Staging, cls: type[Block]) -> str:
    words = words_of(cls.__name__)
    if words.picture == "own":
        return ""
    where = site.words("In the page: **{title}**, under “{question}”")
    title, question = site.translated(words.title), site.translated(words.question)
    return where.format(title=title, question=question) + "\n"


def own_methods(cls: type[Block]) -> list[str]:
    """Return the public methods that a block adds to those of its bases, for scripts to call."""
    inherited = {name for base in cls.__mro__[1:] for name in vars(base)}
    return [
        name
        for name, value in vars(cls).items()
        if callable(value) and not name.startswith("_") and name not in inherited
    ]


def _parameters(site: Staging, cls: type[Block]) -> str:
    common = set(_kind_of(cls).parameters())
    rows = parameter_rows(cls)
    own = [row for row in rows if row.name not in common]
    shared = [row for row in rows if row.name in common]
    parts = [rst.title(site.words("Parameters"), "-")]
    header = (
        site.words("name"),
        site.words("type"),
        site.words("default"),
        site.words("unit"),
        site.words("what it is"),
    )
    parts.append(
        rst.parameters(own, header) if own else site.words("It has none of its own.") + "\n"
    )
    if shared:
        parts.append(".. rubric:: " + site.words("Parameters of all blocks of this kind") + "\n")
        parts.append(rst.parameters(shared, header))
    return "\n".join(parts)


def _kind_of(cls: type[Block]) -> type[Block]:
    return next((kind for kind in KINDS.values() if issubclass(cls, kind)), Block)


def _picture(cls: type[Block], example: Example | None) -> bytes | None:
    """Return what a sensor reads or how an actuator moves, as PNG; None for other blocks."""
    if example is not None and issubclass(cls, Sensor):
        sensor = next(each for each in example.agent.sensors if type(each) is cls)
        return block_pictures.sensor_picture(example.sim, sensor)
    if issubclass(cls, Sensor):  # its values come from a script
        return _picture_without_script(cls)
    sample = None if cls in INSIDE_OTHERS else sample_of(cls).block
    return block_pictures.actuator_picture(sample) if isinstance(sample, Actuator) else None


def _picture_without_script(cls: type[Sensor]) -> bytes | None:
    sim = standard_scene().build()
    agent = sim.agents[0]
    sensor = sample_of(cls).block
    if not isinstance(sensor, Sensor):
        raise NameNotFoundError(f"{cls.__name__} has no sample")
    agent.sensors.append(sensor)
    agent.setup(sim.world)
    sim.reset(1)
    return block_pictures.sensor_picture(sim, sensor)


def _gives(site: Staging, cls: type[Block], example: Example) -> str:
    """Return the table of what a sensor reads or an actuator takes, as in the example."""
    if issubclass(cls, Sensor):
        return _readings(site, cls, example.agent)
    return _action(site, cls, example.agent) if issubclass(cls, Actuator) else ""


def _readings(site: Staging, cls: type[Sensor], agent: BasicAgent) -> str:
    sensor = next(each for each in agent.sensors if type(each) is cls)
    infos = block_info_of(agent).sensor_infos
    info = next(each for each in infos if each.key == sensor.perception_key)
    heading, reading = rst.title(site.words("What it reads"), "-"), agent.percept[info.key]
    if isinstance(reading, str | tuple):
        text = site.words("Text, under the key ``{key}``.").format(key=info.key)
        return f"{heading}\n{text}\n"
    array = np.asarray(reading)
    if array.shape:
        words = site.words(
            "With the parameters of the example: ``{dtype}`` of shape ``{shape}``, under the key "
            "``{key}``."
        )
    else:
        words = site.words(
            "With the parameters of the example: ``{dtype}``, under the key ``{key}``."
        )
    words = words.format(dtype=array.dtype, shape=array.shape, key=info.key) + "\n"
    rows = _number_rows(site, info.slots, info.low.tolist(), info.high.tolist(), units_of(info))
    return "\n".join([heading, words, rows])


def _action(site: Staging, cls: type[Actuator], agent: BasicAgent) -> str:
    actuator = next(each for each in agent.actuators if type(each) is cls)
    infos = block_info_of(agent).actuator_infos
    info = next(each for each in infos if each.name == actuator.action_name)
    heading, count = rst.title(site.words("What it takes"), "-"), len(info.components)
    if not count:
        return f"{heading}\n" + site.words("No action: it works by itself.") + "\n"
    if info.is_choice:
        kind = site.words("One whole number, under the name ``{name}``.")
    elif count == 1:
        kind = site.words("A number, under the name ``{name}``.")
    else:
        kind = site.words("{count} numbers, under the name ``{name}``.")
    kind = kind.format(count=count, name=info.name) + "\n"
    names = tuple(each.name for each in info.components)
    low, high = ([getattr(each, end) for each in info.components] for end in ("low", "high"))
    rows = _number_rows(site, names, low, high, [""] * count)
    return "\n".join([heading, kind, rows])


def _number_rows(
    site: Staging, names: tuple[str, ...], low: list[float], high: list[float], units: list[str]
) -> str:
    """Return a table of numbers; many without names get one row for each range."""
    if not low:
        return ""
    if any(names) and len(low) <= MAX_NAMED_NUMBERS:
        rows = [
            (f"{place}", name, f"{least:g}", f"{most:g}", unit)
            for place, (name, least, most, unit) in enumerate(
                zip(names, low, high, units, strict=True)
            )
        ]
    else:
        ranges = list(dict.fromkeys(zip(low, high, strict=True)))
        rows = [
            (_places(low, high, each), "", f"{each[0]:g}", f"{each[1]:g}", units[0])
            for each in ranges
        ]
    header = (
        site.words("index"),
        site.words("number"),
        site.words("lowest"),
        site.words("highest"),
        site.words("unit"),
    )
    return rst.table(header, rows, (1, 3, 1, 1, 1))


def _places(low: list[float], high: list[float], bounds: tuple[float, float]) -> str:
    """Return the indices with these bounds in words.

    >>> _places([0, 0, 0], [1, 1, 1], (0, 1)), _places([0, 0], [1, 2], (0, 2))
    ('0 to 2', '1')
    """
    places = [at for at, each in enumerate(zip(low, high, strict=True)) if each == bounds]
    steps = {b - a for a, b in itertools.pairwise(places)}
    if len(places) == 1:
        return f"{places[0]}"
    if steps == {1}:
        return f"{places[0]} to {places[-1]}"
    return ", ".join(map(str, places[:3])) + (", ..." if len(places) > 3 else "")


def _example(site: Staging, example: Example) -> str:
    printed = textwrap.indent(example.printed.rstrip(), "   ")
    return "\n".join(
        [
            rst.title(site.words("Example"), "-"),
            rst.code(example.source),
            site.words("It prints") + "::",
            "",
            printed,
            "",
        ]
    )
