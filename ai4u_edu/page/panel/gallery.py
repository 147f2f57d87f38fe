"""Blocks in words for people who build an agent: a title, a question, a picture for each.

The page groups the blocks that can be added by the question that they answer, such as
"Where is it?" or "What do I touch?".
"""

import re
from collections.abc import Sequence
from typing import NamedTuple

from ai4u_edu.blocks import Block
from ai4u_edu.blocks.docs import short_summary
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.blocks import types_of
from ai4u_edu.page.editing.drivers import Driver
from ai4u_edu.page.editing.forms import ParameterField
from ai4u_edu.page.editing.reasons import reason_against_block
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.page.panel.block_words import BLOCK_WORDS, OWN_BLOCKS, BlockWords

TRAINED_NETWORK = _("Trained network")
"""Title of the network of the package for a scene."""
MAX_FIRST_FIELDS = 3
"""Most fields of a form that are shown before "More"."""


class GalleryItem(NamedTuple):
    """A block that can be added, as a card of the page's gallery."""

    type_name: str
    title: str
    question: str
    summary: str
    picture: str
    """Name of its picture and its icon, as in ``web/shared/icons.js``."""
    reason: str
    """The reason why it can't work in this scene; empty if it can."""


def words_of(type_name: str) -> BlockWords:
    """Return a block's title, question and picture; a student's own block gets its class's name.

    >>> words_of("TouchSensor").title
    'Bumper'
    >>> words_of("DistanceToSensor").title
    'Distance to sensor'
    """
    known = BLOCK_WORDS.get(type_name)
    if known is not None:
        return known
    words = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])|_", " ", type_name).lower()
    return BlockWords(words.strip().capitalize() or type_name, OWN_BLOCKS, "own")


def gallery_items(state: EditState, agent_id: str, kind: str) -> list[GalleryItem]:
    """Return the blocks of a kind that could be added to an agent, grouped by question.

    Each is tried in a copy of the world with suggested parameters, so this takes a few
    milliseconds for each block: call it outside the runner's thread.

    Args:
        state: has the scene.
        agent_id: the agent that would get the block.
        kind: ``sensors``, ``actuators``, ``rewards`` or ``brains``.
    """
    items = []
    for cls in types_of(kind):
        if cls.__name__ not in BLOCK_WORDS and cls.__module__.startswith("ai4u_edu."):
            continue  # a part of a lesson that was loaded, and nobody's own block
        name, words = cls.__name__, words_of(cls.__name__)
        reason = reason_against_block(state, agent_id, kind, name)
        items.append(GalleryItem(name, *words[:2], hint_of(name), words.picture, reason))
    order = list(BLOCK_WORDS)
    items.sort(key=lambda item: order.index(item.type_name if item.type_name in order else ""))
    questions = list(dict.fromkeys(item.question for item in items))
    return sorted(items, key=lambda item: questions.index(item.question))


def driver_title(driver: Driver) -> str:
    """Return a driver's title for people.

    >>> driver_title(Driver("keys:WASDRBMoveController", "Keyboard: WASDRBMoveController"))
    'Keys W, A, S, D'
    >>> driver_title(Driver("network:zoo:box_chase", "Network zoo:box_chase"))
    'Trained network'
    """
    beginning, _, rest = driver.title.partition(" ")
    if beginning in {"Keyboard:", "Program:"}:
        return words_of(rest).title
    if beginning == "Network":
        return TRAINED_NETWORK if rest.startswith("zoo:") else driver.title
    return driver.title


def first_fields(type_name: str, fields: Sequence[ParameterField]) -> list[str]:
    """Return the names of the three fields of a block's form that matter most."""
    chosen = words_of(type_name).first_fields
    own = [field.name for field in fields if not field.is_common]
    return [name for name in chosen if name in own] or own[:MAX_FIRST_FIELDS]


def hint_of(type_name: str) -> str:
    """Return a short sentence about a block; empty if there is no such block.

    >>> hint_of("TouchRewardFunc")
    'A reward for touching the target.'
    """
    cls = Block.types.get(type_name)
    return words_of(type_name).hint or ("" if cls is None else first_sentence(cls))


def first_sentence(cls: type[Block]) -> str:
    """Return a block's summary without its source."""
    return short_summary(cls)
