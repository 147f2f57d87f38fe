"""A sample of every kind of block, with parameters that suit the checks' world.

A kind that works there as it is by default needs no sample. Any module of this folder may define
``SAMPLES``: blocks, or a :class:`Sample` where a block needs more.
"""

import pkgutil
from importlib import import_module

from ai4u_edu import Block, HomeostaticVariable
from ai4u_edu.blocks.block import is_built_in
from ai4u_edu.scenes.serialization import KINDS
from tests.check.samples.sample import Sample

INSIDE_OTHERS: tuple[type[Block], ...] = (HomeostaticVariable,)
"""Blocks that only exist inside other blocks, and are checked there."""


def built_in_kinds() -> list[type[Block]]:
    """Return all kinds of blocks of the package that an agent can have."""
    return [
        cls
        for cls in Block.types.values()
        if is_built_in(cls)
        and cls not in (*KINDS, *INSIDE_OTHERS)
        and not cls.__dict__.get("abstract")
    ]


def _given() -> list[Sample]:
    modules = [import_module(f"{__name__}.{each.name}") for each in pkgutil.iter_modules(__path__)]
    samples = [sample for module in modules for sample in getattr(module, "SAMPLES", ())]
    return [each if isinstance(each, Sample) else Sample(each) for each in samples]


GIVEN = {type(sample.block): sample for sample in _given()}


def sample_of(kind: type[Block]) -> Sample:
    """Return the sample of a kind: the one that is given here, else a block with its defaults."""
    return GIVEN.get(kind) or Sample(kind())
