"""Recorded episodes as data, from which they can be replayed, and their files.

A file has a header line, then msgpack compressed with zlib. Files are untrusted: reading executes
nothing, limits the decompressed size, and validates everything before it is used.
"""

import json
import math
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple, Self, TypeVar

import msgpack
import numpy as np
import numpy.typing as npt
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import NameNotFoundError, suggest, text_of
from ai4u_edu.base.parameters import ParameterProblem, explain
from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.recording.agent_record import ENDED, AgentRecord
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.table import MAX_FORMS, Table, check_finite, pack_column, unpack_column
from ai4u_edu.scenes import Scene, SceneDescription

HEADER = b"ai4u-edu episode 2\n"
EARLIER_HEADERS = (b"ai4u-edu episode 1\n",)
"""Headers of earlier versions, which are read as well: the first one has no inputs."""
MAX_INPUTS = 20_000
"""Most inputs of an episode; what happens later is not recorded."""
MAX_OPTIONS = 1000
"""Most options of an episode."""
MAX_RECORDING_BYTES = 16 * 2**20
"""Size of a file."""
MAX_UNPACKED_MB = 24
"""Size of its decompressed content."""
MAX_ENTRIES = 100_000
"""Entries of a list or a mapping in a file."""
MAX_TICK = 2_000_000
"""Last tick that is recorded: nine hours at 60 ticks per second."""
_MAX_SKIP_FRAME = 10_000
"""The largest skip_frame that a brain may have."""

MAX_DRIVER_CHARS = 200
"""Length of a driver's title."""


class Restart(NamedTuple):
    """A restart of some agents' episodes while the world went on."""

    tick: int
    agents: tuple[int, ...]
    """Indices of the agents, in the order in which they act."""


class Input(NamedTuple):
    """Numbers that a script gave to an agent's sensor, besides the actions of its brain."""

    tick: int
    agent: int
    """Index of the agent, in the order in which they act."""
    name: str
    """Perception key of the sensor."""
    moment: int
    """Count of the sensor's readings and resets in this episode before."""
    values: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class Episode:
    """A recorded episode of a world, from one reset to the next.

    It contains no percepts: :class:`~ai4u_edu.recording.Replay` computes them again from the scene,
    the seed and the actions, bit for bit, and checks them by their checksums.
    """

    scene: SceneDescription
    seed: int
    agents: tuple[AgentRecord, ...]
    """Agents in the order in which they act."""
    order: npt.NDArray[np.int32]
    """Order of events: the index of an agent for a decision, ``-1 - i`` for restart i."""
    restarts: tuple[Restart, ...]
    ticks: int
    """Tick at which the last decision ended."""
    changed: int | None
    """Tick at which a person edited the world, which ends the exact replay; None if nobody did."""
    cut: bool
    """True if it was too long to be recorded completely."""
    versions: dict[str, str]
    """Versions of the packages that ran, by name."""
    inputs: tuple[Input, ...] = ()
    """Numbers that scripts gave to the agents besides actions, in order."""
    options: Mapping[str, Any] = field(default_factory=dict)
    """Options of the reset that began it, by name; ``scene`` has these numbers already."""

    def agent(self, agent_id: str | None = None) -> AgentRecord:
        """Return the record of an agent; by default of the one that acts first."""
        for record in self.agents:
            if agent_id in (None, record.id):
                return record
        raise NameNotFoundError(
            _(
                "no agent has the id {agent_id}; {hint}",
                agent_id=repr(agent_id),
                hint=suggest(str(agent_id), self.ids),
            )
        )

    @property
    def ids(self) -> tuple[str, ...]:
        """Ids of the agents."""
        return tuple(record.id for record in self.agents)

    @property
    def seconds(self) -> float:
        """Duration in world time (s)."""
        return self.ticks / self.scene.world.ticks_per_second

    @property
    def success(self) -> bool | None:
        """True if an agent reached the scene's goal; None for a scene without a goal."""
        goal = self.scene.success
        return None if goal is None else any(record.reached(goal) for record in self.agents)

    @cached_property
    def places(self) -> tuple[npt.NDArray[np.int64], ...]:
        """Indices in ``order`` of each agent's decisions."""
        return tuple(np.flatnonzero(self.order == index) for index in range(len(self.agents)))

    @cached_property
    def restart_places(self) -> npt.NDArray[np.int64]:
        """Indices in ``order`` of the restarts."""
        return np.flatnonzero(self.order < 0)

    def save(self, path: str | Path) -> Path:
        """Write the episode to a file atomically, and return the path.

        Args:
            path: of the file; ``.episode`` is the usual suffix.
        """
        path = Path(path)
        write_atomically(path, encode(self))
        return path

    @classmethod
    def load(cls, path: str | Path) -> Self:
        """Read an episode from a file; nothing in it is executed.

        Raises:
            RecordingError: it is no episode file, or something in it is wrong.
        """
        path = Path(path)
        try:
            with path.open("rb") as file:
                data = file.read(MAX_RECORDING_BYTES + 1)
        except OSError as error:
            raise RecordingError(
                _("{path}: can't be read: {why}", path=str(path), why=str(error.strerror))
            ) from None
        return decode(cls, data, path.name)

    def __str__(self) -> str:
        told = ", ".join(f"agent {r.id}: {len(r)} decisions, {r.total:g}" for r in self.agents)
        with_options = "".join(f", {name} {value}" for name, value in self.options.items())
        start = f"{self.scene.name}, seed {self.seed}{with_options}"
        return f"{start}, {self.seconds:.1f} s; {told}"


E = TypeVar("E", bound=Episode)


class _AgentColumns(BaseModel):
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
    agents: list[_AgentColumns] = Field(min_length=1, max_length=64)
    order: bytes
    restarts: list[tuple[int, list[int]]]
    inputs: list[tuple[int, int, str, int, list[float]]] = Field(default=[], max_length=MAX_INPUTS)
    options: dict[str, int | float | list[int | float]] = Field(default={}, max_length=MAX_OPTIONS)


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
        "inputs": episode.inputs,
        **({"options": dict(episode.options)} if episode.options else {}),
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
        raise RecordingError(join([name, text_of(error)], ": ")) from None


def _read(cls: type[E], data: bytes) -> E:
    if not data.startswith((HEADER, *EARLIER_HEADERS)):
        if data.startswith(HEADER[:16]):
            raise RecordingError(
                _(
                    "an episode of another version of this package; expected {version}, got {got}",
                    version=repr(HEADER.decode().strip()),
                    got=repr(data[: len(HEADER)].split()[-1]),
                )
            )
        raise RecordingError(
            _("expected a recorded episode, as ai4u-edu record writes it, and this is none")
        )
    if len(data) > MAX_RECORDING_BYTES:
        raise RecordingError(
            _(
                "expected at most {mb} MB",
                mb=MAX_RECORDING_BYTES // 2**20,
            )
        )
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
        inputs=tuple(Input(*parts[:-1], tuple(parts[-1])) for parts in file.inputs),
        options=file.options,
    )
    _validate(episode)
    return episode


def _unpacked(packed: bytes) -> Any:
    unpacker = zlib.decompressobj()
    try:
        plain = unpacker.decompress(packed, MAX_UNPACKED_MB * 2**20 + 1)
    except zlib.error as error:
        raise RecordingError(
            _("damaged: it can't be unpacked ({error})", error=text_of(error))
        ) from None
    if len(plain) > MAX_UNPACKED_MB * 2**20:
        raise RecordingError(
            _(
                "expected at most {mb} MB when it is unpacked",
                mb=MAX_UNPACKED_MB,
            )
        )
    if not unpacker.eof:
        raise RecordingError(_("damaged: its end is missing"))
    if unpacker.unused_data:
        raise RecordingError(_("damaged: something follows after its end"))
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
        raise RecordingError(
            _("damaged: its contents can't be read ({error})", error=text_of(error))
        ) from None


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
        "inputs": _each_tuple(data.get("inputs", [])),
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
        raise RecordingError(
            _("scene: expected what a scene's file can hold, got {error}", error=text_of(error))
        ) from None
    try:
        return SceneDescription.model_validate(plain)
    except ValidationError as error:
        found = explain(error.errors(), SceneDescription)
        raise RecordingError(
            _message([ParameterProblem(("scene", *each.path), each.text) for each in found])
        ) from None


def _message(problems: list[ParameterProblem]) -> str:
    text = join([problem.message for problem in problems[:3]], "; ")
    if len(problems) <= 3:
        return text
    return _("{problems} (and {more} more)", problems=text, more=len(problems) - 3)


def _record(agent: _AgentColumns) -> AgentRecord:
    return AgentRecord(
        id=agent.id,
        begin=unpack_column(agent.begin, np.uint32, "begin"),
        end=unpack_column(agent.end, np.uint32, "end"),
        skip=unpack_column(agent.skip, np.uint16, "skip"),
        flags=unpack_column(agent.flags, np.uint8, "flags"),
        actions=Table.unpack(agent.action_forms, agent.action_form, agent.action_numbers, "action"),
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
    return Table.unpack([[(name, 1) for name in each] for each in forms], form, numbers, what)


def _validate(episode: Episode) -> None:
    """Check that all parts of an episode fit together.

    Raises:
        RecordingError: they do not; the message names the part.
    """
    ids = [str(agent.get("id", "0")) for agent in episode.scene.agents]
    if list(episode.ids) != ids:
        raise RecordingError(
            _(
                "agents: expected those of the scene, {ids}, got {got}",
                ids=str(ids),
                got=str(list(episode.ids)),
            )
        )
    for record in episode.agents:
        _check_agent(record, episode.ticks)
    _check_order(episode)
    _check_time(episode)
    for given in episode.inputs:
        known = 0 <= given.agent < len(episode.agents) and given.moment >= 0
        if not known or not 0 <= given.tick <= 2 * MAX_TICK or not math.isfinite(sum(given.values)):
            raise RecordingError(
                _(
                    "inputs: expected an agent's number, a moment and finite numbers, got {given}",
                    given=str(given),
                )
            )
    numbers = np.array([number for value in episode.options.values() for number in np.ravel(value)])
    if not np.isfinite(numbers.astype(np.float64)).all():
        raise RecordingError(
            _("options: expected finite numbers, got {options}", options=str(episode.options))
        )


def _check_agent(record: AgentRecord, ticks: int) -> None:
    who, count = _("agent {id!r}", id=record.id), len(record)
    for name in ("end", "skip", "flags", "actions", "terms", "rewards", "percepts", "worlds"):
        if len(getattr(record, name)) != count:
            raise RecordingError(
                _(
                    "{who}: expected {count} {name}, one for each decision, got {got}",
                    who=who,
                    count=count,
                    name=name,
                    got=len(getattr(record, name)),
                )
            )
    if len(record.carried) not in (0, count):
        raise RecordingError(
            _(
                "{who}: expected {count} carried, one for each decision, or none, got {got}",
                who=who,
                count=count,
                got=len(record.carried),
            )
        )
    if (record.skip > _MAX_SKIP_FRAME).any():
        raise RecordingError(
            _(
                "{who}: skip: expected at most {most}",
                who=who,
                most=_MAX_SKIP_FRAME,
            )
        )
    if (record.end < record.begin).any() or (record.end > ticks).any():
        raise RecordingError(_("{who}: end: expected decisions that end after they begin", who=who))
    ended = (record.flags & ENDED) > 0
    if (record.end[ended] == record.begin[ended]).any():
        raise RecordingError(
            _("{who}: end: expected each decision to take a tick at least", who=who)
        )
    starts = record.starts
    if not len(starts) or len(record.firsts) != len(starts) or starts[0] != 0:
        raise RecordingError(
            _("{who}: starts: expected one for each of the agent's episodes", who=who)
        )
    if (np.diff(starts.astype(np.int64)) < 0).any() or (starts > count).any():
        raise RecordingError(_("{who}: starts: expected numbers of decisions, in order", who=who))


def _check_order(episode: Episode) -> None:
    order = episode.order
    for index, record in enumerate(episode.agents):
        if int((order == index).sum()) != len(record):
            raise RecordingError(
                _("order: expected all decisions of agent {id!r} once each", id=record.id)
            )
    if order[order < 0].tolist() != [-1 - i for i in range(len(episode.restarts))]:
        raise RecordingError(_("order: expected all restarts once each, in order"))
    if len(order) and int(order.max()) >= len(episode.agents):
        raise RecordingError(_("order: expected numbers of agents"))
    for restart in episode.restarts:
        known = all(0 <= index < len(episode.agents) for index in restart.agents)
        if not restart.agents or len(set(restart.agents)) < len(restart.agents) or not known:
            raise RecordingError(_("restarts: expected numbers of agents"))


def _check_time(episode: Episode) -> None:
    """Check that ticks do not decrease; a replay would wait forever for an earlier one."""
    restarts = [restart.tick for restart in episode.restarts]
    # other values may not fit into the array
    known = all(0 <= tick <= episode.ticks for tick in restarts)
    ticks = np.zeros(len(episode.order), np.int64)
    for places, record in zip(episode.places, episode.agents, strict=True):
        ticks[places] = record.begin
    ticks[episode.restart_places] = restarts if known else -1
    if not known or (np.diff(ticks) < 0).any() or (ticks > episode.ticks).any():
        raise RecordingError(_("order: expected what happened later to come later"))
