"""An episode's file: one line that says what it is, then msgpack, packed by zlib.

Columns stand as bytes, little-endian, all first bytes of the numbers before all second ones: so
they pack better. Reading runs nothing, and believes nothing: what is unpacked is capped, and
everything is checked before it is used.
"""

import json
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

import msgpack
import numpy as np
import numpy.typing as npt
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.parameters import Problem, explain
from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.recording.episode import LONGEST_DRIVER, AgentRecord, Episode, Restart
from ai4u_edu.recording.episode_builder import LATEST
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.table import MOST_FORMS, Table
from ai4u_edu.recording.validation import validate_episode
from ai4u_edu.scenes import Scene, SceneDescription

HEADER = b"ai4u-edu episode 1\n"
MAX_FILE_BYTES = 16 * 2**20
"""Bytes that a file may have."""
LARGEST = 24 * 2**20
"""Bytes that may come out of it when it is unpacked."""
MOST = 100_000
"""Entries of a list or a mapping in it."""

E = TypeVar("E", bound=Episode)

Small = dict[str, Any]


class _Agent(BaseModel):
    """One agent's columns, as they stand in the file."""

    model_config = ConfigDict(extra="forbid", strict=True)

    id: str = Field(max_length=80)
    begin: bytes
    end: bytes
    skip: bytes
    flags: bytes
    action_forms: list[list[tuple[str, int]]] = Field(max_length=MOST_FORMS)
    action_form: bytes
    action_numbers: bytes
    term_forms: list[list[str]] = Field(max_length=MOST_FORMS)
    term_form: bytes
    term_numbers: bytes
    rewards: bytes
    percepts: bytes
    worlds: bytes
    starts: bytes
    firsts: bytes
    driver: str = Field(default="", max_length=LONGEST_DRIVER)


class _File(BaseModel):
    """All that stands in the file."""

    model_config = ConfigDict(extra="forbid", strict=True)

    versions: dict[str, str]
    scene: dict[str, Any]
    seed: int = Field(ge=0, le=MAX_SEED)
    ticks: int = Field(ge=0, le=2 * LATEST)
    changed: int | None = Field(ge=0, le=2 * LATEST)
    cut: bool
    agents: list[_Agent] = Field(min_length=1, max_length=64)
    order: bytes
    restarts: list[tuple[int, list[int]]]


def save(episode: Episode, path: Path) -> Path:
    """Write an episode to a file, whole or not at all."""
    write_atomically(path, encode(episode))
    return path


def load(cls: type[E], path: Path) -> E:
    """Reads a file."""
    try:
        with path.open("rb") as file:
            data = file.read(MAX_FILE_BYTES + 1)
    except OSError as error:
        raise RecordingError(f"{path}: can't be read: {error.strerror}") from None
    return decode(cls, data, path.name)


def encode(episode: Episode) -> bytes:
    """An episode as a file's bytes; the same episode gives the same bytes."""
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
                "begin": _packed(record.begin),
                "end": _packed(record.end),
                "skip": _packed(record.skip),
                "flags": _packed(record.flags),
                "action_forms": record.actions.forms,
                "action_form": _packed(record.actions.form),
                "action_numbers": _packed(record.actions.numbers),
                "term_forms": [[name for name, _ in form] for form in record.terms.forms],
                "term_form": _packed(record.terms.form),
                "term_numbers": _packed(record.terms.numbers),
                "rewards": _packed(record.rewards),
                "percepts": _packed(record.percepts),
                "worlds": _packed(record.worlds),
                "starts": _packed(record.starts),
                "firsts": _packed(record.firsts),
                "driver": record.driver,
            }
            for record in episode.agents
        ],
        "order": _packed(episode.order),
        "restarts": episode.restarts,
    }
    return HEADER + zlib.compress(msgpack.packb(plain), 9)


def decode(cls: type[E], data: bytes, name: str) -> E:
    """An episode out of a file's bytes.

    Args:
        cls: Episode.
        data: all of the file.
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
    file = _checked(_unpacked(data[len(HEADER) :]))
    episode = cls(
        scene=_scene(file.scene),
        seed=file.seed,
        agents=tuple(_record(agent) for agent in file.agents),
        order=_column(file.order, np.int32, "order"),
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
        plain = unpacker.decompress(packed, LARGEST + 1)
    except zlib.error as error:
        raise RecordingError(f"damaged: it can't be unpacked ({error})") from None
    if len(plain) > LARGEST:
        raise RecordingError(f"expected at most {LARGEST // 2**20} MB when it is unpacked")
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
            max_array_len=MOST,
            max_map_len=MOST,
            max_str_len=2**20,
            max_ext_len=0,
        )
    except (ValueError, TypeError, RecursionError, OverflowError) as error:
        raise RecordingError(f"damaged: its contents can't be read ({error})") from None


def _checked(data: Any) -> _File:
    try:
        # lists stand for tuples there, and nothing else is bent
        return _File.model_validate(_tuples(data))
    except ValidationError as error:
        found = explain(error.errors(include_input=True), _File)
        raise RecordingError(_told(found)) from None


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


def _scene(plain: Small) -> SceneDescription:
    try:
        json.dumps(plain)
    except (TypeError, ValueError, RecursionError) as error:
        # msgpack has bytes too, and lists a thousand deep: nothing that a scene's file can hold
        raise RecordingError(f"scene: expected what a scene's file can hold, got {error}") from None
    try:
        return SceneDescription.model_validate(plain)
    except ValidationError as error:
        found = explain(error.errors(), SceneDescription)
        raise RecordingError(
            _told([Problem(("scene", *each.path), each.text) for each in found])
        ) from None


def _told(problems: list[Problem]) -> str:
    more = f" (and {len(problems) - 3} more)" if len(problems) > 3 else ""
    return "; ".join(map(str, problems[:3])) + more


def _record(agent: _Agent) -> AgentRecord:
    return AgentRecord(
        id=agent.id,
        begin=_column(agent.begin, np.uint32, "begin"),
        end=_column(agent.end, np.uint32, "end"),
        skip=_column(agent.skip, np.uint16, "skip"),
        flags=_column(agent.flags, np.uint8, "flags"),
        actions=_table(
            [[(name, width) for name, width in form] for form in agent.action_forms],
            agent.action_form,
            agent.action_numbers,
            "action",
        ),
        terms=_table(
            [[(name, 1) for name in form] for form in agent.term_forms],
            agent.term_form,
            agent.term_numbers,
            "term",
        ),
        rewards=_finite(_column(agent.rewards, np.float64, "rewards"), "rewards"),
        percepts=_column(agent.percepts, np.uint32, "percepts"),
        worlds=_column(agent.worlds, np.uint32, "worlds"),
        starts=_column(agent.starts, np.uint32, "starts"),
        firsts=_column(agent.firsts, np.uint32, "firsts"),
        driver=agent.driver,
    )


def _table(forms: list[list[tuple[str, int]]], form: bytes, numbers: bytes, what: str) -> Table:
    for each in forms:
        names = [name for name, _ in each]
        if len(set(names)) < len(names) or not all(0 <= width <= 1024 for _, width in each):
            raise RecordingError(f"{what}_forms: expected names and how many numbers, got {each}")
    rows = _column(form, np.uint16, f"{what}_form")
    amounts = _finite(_column(numbers, np.float64, f"{what}_numbers"), f"{what}_numbers")
    if len(rows) and int(rows.max()) >= len(forms):
        raise RecordingError(f"{what}_form: expected numbers below {len(forms)}, got {rows.max()}")
    widths = np.array([sum(width for _, width in each) for each in forms], np.int64)
    expected = int(widths[rows].sum()) if len(rows) else 0
    if len(amounts) != expected:
        raise RecordingError(f"{what}_numbers: expected {expected} numbers, got {len(amounts)}")
    return Table(tuple(tuple(each) for each in forms), rows, amounts)


def _packed(column: npt.NDArray[Any]) -> bytes:
    little = np.ascontiguousarray(column, column.dtype.newbyteorder("<"))
    return little.view(np.uint8).reshape(-1, column.dtype.itemsize).T.tobytes()


def _column(data: bytes, dtype: npt.DTypeLike, what: str) -> npt.NDArray[Any]:
    kind = np.dtype(dtype)
    if len(data) % kind.itemsize:
        raise RecordingError(
            f"{what}: expected numbers of {kind.itemsize} bytes, got {len(data)} bytes"
        )
    shuffled = np.frombuffer(data, np.uint8).reshape(kind.itemsize, -1)
    return shuffled.T.copy().view(kind.newbyteorder("<")).reshape(-1).astype(kind)


def _finite(column: npt.NDArray[Any], what: str) -> npt.NDArray[Any]:
    if not np.isfinite(column).all():
        raise RecordingError(f"{what}: expected finite numbers")
    return column
