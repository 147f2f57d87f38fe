"""Episode files: a header line, then msgpack compressed with zlib.

Files are untrusted: reading executes nothing, limits the decompressed size, and validates
everything before it is used.
"""

import json
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

import msgpack
import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.parameters import Problem, explain
from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.recording.columns import check_finite, pack_column, unpack_column, unpack_table
from ai4u_edu.recording.episode import MAX_DRIVER_CHARS, AgentRecord, Episode, Restart
from ai4u_edu.recording.episode_builder import MAX_TICK
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.table import MAX_FORMS, Table
from ai4u_edu.recording.validation import validate_episode
from ai4u_edu.scenes import Scene, SceneDescription

HEADER = b"ai4u-edu episode 1\n"
MAX_FILE_BYTES = 16 * 2**20
"""Size of a file."""
MAX_UNPACKED_MB = 24
"""Size of its decompressed content."""
MAX_ENTRIES = 100_000
"""Entries of a list or a mapping in a file."""

E = TypeVar("E", bound=Episode)


class _Agent(BaseModel):
    """One agent's columns in a file."""

    model_config = ConfigDict(extra="forbid", strict=True)

    id: str = Field(max_length=80)
    begin: bytes
    end: bytes
    skip: bytes
    flags: bytes
    action_forms: list[list[tuple[str, int]]] = Field(max_length=MAX_FORMS)
    action_form: bytes
    action_numbers: bytes
    term_forms: list[list[str]] = Field(max_length=MAX_FORMS)
    term_form: bytes
    term_numbers: bytes
    rewards: bytes
    percepts: bytes
    worlds: bytes
    starts: bytes
    firsts: bytes
    driver: str = Field(default="", max_length=MAX_DRIVER_CHARS)
    carried_forms: list[list[str]] = Field(default=[], max_length=MAX_FORMS)
    carried_form: bytes = b""
    carried_numbers: bytes = b""


class _File(BaseModel):
    """Content of a file."""

    model_config = ConfigDict(extra="forbid", strict=True)

    versions: dict[str, str]
    scene: dict[str, Any]
    seed: int = Field(ge=0, le=MAX_SEED)
    ticks: int = Field(ge=0, le=2 * MAX_TICK)
    changed: int | None = Field(ge=0, le=2 * MAX_TICK)
    cut: bool
    agents: list[_Agent] = Field(min_length=1, max_length=64)
    order: bytes
    restarts: list[tuple[int, list[int]]]


def save(episode: Episode, path: Path) -> Path:
    """Write an episode to a file atomically."""
    write_atomically(path, encode(episode))
    return path


def load(cls: type[E], path: Path) -> E:
    """Read an episode from a file."""
    try:
        with path.open("rb") as file:
            data = file.read(MAX_FILE_BYTES + 1)
    except OSError as error:
        raise RecordingError(f"{path}: can't be read: {error.strerror}") from None
    return decode(cls, data, path.name)


def encode(episode: Episode) -> bytes:
    """Return an episode as a file's bytes; equal episodes give equal bytes."""
    plain = {
        "versions": episode.versions,
        "scene": Scene(episode.scene).plain(),
        "seed": episode.seed,
        "ticks": episode.ticks,
        "changed": episode.changed,
        "cut": episode.cut,
        "agents": [
            {
                "id": record.id,
                "begin": pack_column(record.begin),
                "end": pack_column(record.end),
                "skip": pack_column(record.skip),
                "flags": pack_column(record.flags),
                "action_forms": record.actions.forms,
                "action_form": pack_column(record.actions.form),
                "action_numbers": pack_column(record.actions.numbers),
                **_packed_terms("term", record.terms),
                "rewards": pack_column(record.rewards),
                "percepts": pack_column(record.percepts),
                "worlds": pack_column(record.worlds),
                "starts": pack_column(record.starts),
                "firsts": pack_column(record.firsts),
                "driver": record.driver,
                **(_packed_terms("carried", record.carried) if len(record.carried) else {}),
            }
            for record in episode.agents
        ],
        "order": pack_column(episode.order),
        "restarts": episode.restarts,
    }
    return HEADER + zlib.compress(msgpack.packb(plain), 9)


def decode(cls: type[E], data: bytes, name: str) -> E:
    """Return the episode in a file's bytes.

    Args:
        cls: Episode, or a subclass.
        data: the content of the file.
        name: of the file, for messages.

    Raises:
        RecordingError: something is wrong in it.
    """
    try:
        return _read(cls, data)
    except RecordingError as error:
        raise RecordingError(f"{name}: {error}") from None


def _read(cls: type[E], data: bytes) -> E:
    if not data.startswith(HEADER):
        if data.startswith(HEADER[:16]):
            raise RecordingError(
                "an episode of another version of this package; expected "
                f"{HEADER.decode().strip()!r}, got {data[: len(HEADER)].split()[-1]!r}"
            )
        raise RecordingError(
            "expected a recorded episode, as ai4u-edu record writes it, and this is none"
        )
    if len(data) > MAX_FILE_BYTES:
        raise RecordingError(f"expected at most {MAX_FILE_BYTES // 2**20} MB")
    file = _validated(_unpacked(data[len(HEADER) :]))
    episode = cls(
        scene=_scene(file.scene),
        seed=file.seed,
        agents=tuple(_record(agent) for agent in file.agents),
        order=unpack_column(file.order, np.int32, "order"),
        restarts=tuple(Restart(tick, tuple(agents)) for tick, agents in file.restarts),
        ticks=file.ticks,
        changed=file.changed,
        cut=file.cut,
        versions=file.versions,
    )
    validate_episode(episode)
    return episode


def _unpacked(packed: bytes) -> Any:
    unpacker = zlib.decompressobj()
    try:
        plain = unpacker.decompress(packed, MAX_UNPACKED_MB * 2**20 + 1)
    except zlib.error as error:
        raise RecordingError(f"damaged: it can't be unpacked ({error})") from None
    if len(plain) > MAX_UNPACKED_MB * 2**20:
        raise RecordingError(f"expected at most {MAX_UNPACKED_MB} MB when it is unpacked")
    if not unpacker.eof:
        raise RecordingError("damaged: its end is missing")
    if unpacker.unused_data:
        raise RecordingError("damaged: something follows after its end")
    try:
        return msgpack.unpackb(
            plain,
            raw=False,
            strict_map_key=True,
            use_list=True,
            max_array_len=MAX_ENTRIES,
            max_map_len=MAX_ENTRIES,
            max_str_len=2**20,
            max_ext_len=0,
        )
    except (ValueError, TypeError, RecursionError, OverflowError) as error:
        raise RecordingError(f"damaged: its contents can't be read ({error})") from None


def _validated(data: Any) -> _File:
    try:
        # strict models want tuples, and msgpack has lists only
        return _File.model_validate(_tuples(data))
    except ValidationError as error:
        found = explain(error.errors(include_input=True), _File)
        raise RecordingError(_message(found)) from None


def _tuples(data: Any) -> Any:
    if not isinstance(data, Mapping):
        return data
    agents = data.get("agents")
    return {
        **data,
        "restarts": _each_tuple(data.get("restarts")),
        "agents": [_agent_tuples(agent) for agent in agents]
        if isinstance(agents, list)
        else agents,
    }


def _agent_tuples(agent: Any) -> Any:
    if not isinstance(agent, Mapping) or not isinstance(agent.get("action_forms"), list):
        return agent
    return {**agent, "action_forms": [_each_tuple(form) for form in agent["action_forms"]]}


def _each_tuple(entries: Any) -> Any:
    if not isinstance(entries, list):
        return entries
    return [tuple(each) if isinstance(each, list) else each for each in entries]


def _scene(plain: dict[str, Any]) -> SceneDescription:
    try:
        json.dumps(plain)
    except (TypeError, ValueError, RecursionError) as error:
        # msgpack can have bytes, and deeper nesting than a scene file
        raise RecordingError(f"scene: expected what a scene's file can hold, got {error}") from None
    try:
        return SceneDescription.model_validate(plain)
    except ValidationError as error:
        found = explain(error.errors(), SceneDescription)
        raise RecordingError(
            _message([Problem(("scene", *each.path), each.text) for each in found])
        ) from None


def _message(problems: list[Problem]) -> str:
    more = f" (and {len(problems) - 3} more)" if len(problems) > 3 else ""
    return "; ".join(map(str, problems[:3])) + more


def _record(agent: _Agent) -> AgentRecord:
    return AgentRecord(
        id=agent.id,
        begin=unpack_column(agent.begin, np.uint32, "begin"),
        end=unpack_column(agent.end, np.uint32, "end"),
        skip=unpack_column(agent.skip, np.uint16, "skip"),
        flags=unpack_column(agent.flags, np.uint8, "flags"),
        actions=unpack_table(
            [[(name, width) for name, width in form] for form in agent.action_forms],
            agent.action_form,
            agent.action_numbers,
            "action",
        ),
        terms=_terms(agent.term_forms, agent.term_form, agent.term_numbers, "term"),
        rewards=check_finite(unpack_column(agent.rewards, np.float64, "rewards"), "rewards"),
        percepts=unpack_column(agent.percepts, np.uint32, "percepts"),
        worlds=unpack_column(agent.worlds, np.uint32, "worlds"),
        starts=unpack_column(agent.starts, np.uint32, "starts"),
        firsts=unpack_column(agent.firsts, np.uint32, "firsts"),
        driver=agent.driver,
        carried=_terms(agent.carried_forms, agent.carried_form, agent.carried_numbers, "carried"),
    )


def _packed_terms(what: str, terms: Table) -> dict[str, Any]:
    """Return the columns of a table of reward terms by name."""
    return {
        f"{what}_forms": [[name for name, _ in form] for form in terms.forms],
        f"{what}_form": pack_column(terms.form),
        f"{what}_numbers": pack_column(terms.numbers),
    }


def _terms(forms: list[list[str]], form: bytes, numbers: bytes, what: str) -> Table:
    """Return a table of reward terms from its columns."""
    return unpack_table([[(name, 1) for name in each] for each in forms], form, numbers, what)
