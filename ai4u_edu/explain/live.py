"""Explanations of a running world's agents, several times a second, beside its ticks."""

import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.blocks import Brain, ChannelLegend, LocalBrain, Percept
from ai4u_edu.explain.baseline import Baseline, mean_of
from ai4u_edu.explain.errors import NotExplainableError
from ai4u_edu.explain.groups import Group, groups_of
from ai4u_edu.explain.occlusion import Occlusion, occlusion
from ai4u_edu.explain.policy import Policy
from ai4u_edu.explain.sentence import (
    MIN_SHARE,
    Axis,
    axes_of,
    decisive,
    explained,
    sentence,
    shares_of,
)
from ai4u_edu.explain.what_if import Changes, WhatIf, what_if
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.snapshot import AgentState, Snapshot
from ai4u_edu.snapshot.block_info import SensorInfo

EXPLANATIONS_PER_S = 5.0
"""Explanations of each agent that a page asks about."""
MAX_CORE_SHARE = 0.1
"""Share of one processor that explanations may take; they come less often if they take longer."""
INTEREST_S = 2.0
"""Time for which an agent is explained after somebody asked; the thread ends after it."""
MAX_PARTS = 64
"""Most parts of one sensor that are left out one by one; a larger one is left out as a whole."""
MIN_MEAN_PERCEPTS = 50
"""Percepts from which their mean is the baseline; before, it is the middle of the ranges."""
MEAN_EVERY = 25
"""Percepts after which the mean is computed again."""
MAX_MEAN_PERCEPTS = 600
"""Latest percepts that count for the mean: two minutes."""

Floats = npt.NDArray[np.float64]

KEYS_DRIVE = _("You are driving. Let a trained network drive to see why it acts.")
MIDDLE = _("the middle of its range")
GONE = _("There is no such agent any more.")
SCRIPT_DRIVES = _("A script elsewhere drives; only it can say why.")


class NamedBaseline(NamedTuple):
    """A baseline, and where it is from."""

    words: str
    """The baseline in words."""
    readings: Baseline


@dataclass(frozen=True, eq=False)
class Why:
    """The explanation of one decision."""

    agent: str
    """Id of the agent."""
    problem: str = ""
    """Reason why there is no explanation; empty if there is one."""
    sentence: str = ""
    """The most important slot in words."""
    baseline: str = ""
    """The baseline in words."""
    also: str = ""
    """The sentence with the other baseline, if another slot is decisive there."""
    explained: str = ""
    """Share of what all slots do together that the single ones explain, in words."""
    axes: tuple[Axis, ...] = ()
    """The numbers of the action."""
    groups: tuple[Group, ...] = ()
    """The groups of slots that were left out."""
    shares: tuple[tuple[float, ...], ...] = ()
    """Movement of each number of the action by each group, as a share of its range."""
    ray_weights: Mapping[str, Floats] = field(default_factory=dict)
    """Weight of each ray of a sensor, 0..1, by perception key, in the order of its picture."""


class LiveExplainer:
    """Explains agents of a running world in a thread of its own, as long as somebody asks.

    Any thread may call :meth:`why`; the first call starts the thread, which ends when nobody has
    asked for a while. It reads snapshots, which are immutable, and asks the agent's policy, which
    has no state: so neither a tick nor the world waits for it.

    Args:
        latest: returns the latest snapshot.
        brain_of: returns an agent's present brain by its id; None if there is no such agent.
        recorded: returns a baseline for an agent's state in a snapshot of the past; None for that
            of the live world.
    """

    def __init__(
        self,
        latest: Callable[[], Snapshot],
        brain_of: Callable[[str], Brain | None],
        recorded: Callable[[Snapshot, str], NamedBaseline | None] = lambda _snapshot, _id: None,
    ) -> None:
        self._latest, self._brain_of, self._recorded = latest, brain_of, recorded
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._stopping = threading.Event()
        self._asked_at: dict[str, float] = {}
        self._known: dict[str, Why] = {}
        self._drivers: dict[str, BrainExplainer] = {}

    def why(self, agent_id: str) -> Why | None:
        """Return the latest explanation of an agent, and keep explaining it for a while.

        Returns:
            None if there is none yet.
        """
        with self._lock:
            self._asked_at[agent_id] = time.monotonic()
            if self._thread is None and not self._stopping.is_set():
                self._thread = threading.Thread(target=self._run, name="explainer", daemon=True)
                self._thread.start()
            return self._known.get(agent_id)

    def what_if(self, agent_id: str, changes: Changes) -> WhatIf:
        """Return an agent's action on its percept, and on a changed one; it may take a while.

        Raises:
            NotExplainableError: its decision is no function of the percept.
            SetupError: there is no such number.
        """
        return what_if(self.policy(agent_id), self._state(agent_id), changes)

    def policy(self, agent_id: str) -> Policy:
        """Return an agent's policy.

        Raises:
            NotExplainableError: its decision is no function of the percept.
        """
        brain, state = self.brain(agent_id), self._state(agent_id)
        driver = None if brain is None else BrainExplainer(brain, state)
        if driver is None or driver.policy is None:
            raise NotExplainableError(driver.problem if driver else GONE)
        return driver.policy

    def brain(self, agent_id: str) -> Brain | None:
        """Return an agent's present brain; None if there is no such agent."""
        return self._brain_of(agent_id)

    def _state(self, agent_id: str) -> AgentState:
        for agent in self._latest().agents:
            if agent.id == agent_id:
                return agent
        raise NotExplainableError(GONE)

    def stop(self) -> None:
        """End the thread; it is not waited for, as a student's function may not return."""
        self._stopping.set()

    def _run(self) -> None:
        pause = 0.0
        while not self._stopping.wait(pause):
            # under the lock, so that `why` finds this thread or none, and never one that ends
            with self._lock:
                since = time.monotonic() - INTEREST_S
                wanted = [agent for agent, at in self._asked_at.items() if at >= since]
                if not wanted:
                    self._thread = None
                    self._asked_at, self._known, self._drivers = {}, {}, {}
                    return
            # processor time of this thread alone: that other threads run meanwhile is no cost of it
            began = time.thread_time()
            snapshot = self._latest()
            for agent_id in wanted:
                self._known[agent_id] = self._explained(snapshot, agent_id)
            took = time.thread_time() - began
            # two limits: the rate of explanations, and the share of a core that they take
            pause = max(1 / EXPLANATIONS_PER_S - took, took / MAX_CORE_SHARE - took)

    def _explained(self, snapshot: Snapshot, agent_id: str) -> Why:
        agent = next((each for each in snapshot.agents if each.id == agent_id), None)
        brain = self._brain_of(agent_id)
        if agent is None or brain is None:
            return Why(agent_id, problem=GONE)
        driver = self._drivers.get(agent_id)
        if driver is None or not driver.drives(brain, agent):
            driver = self._drivers[agent_id] = BrainExplainer(brain, agent)
        return driver.why(agent, self._recorded(snapshot, agent_id))


class BrainExplainer:
    """A brain that drives an agent, and what the agent sensed meanwhile.

    Args:
        brain: the brain.
        agent: the agent's state.
    """

    def __init__(self, brain: Brain, agent: AgentState) -> None:
        self._brain, self._infos = brain, agent.sensor_infos
        self._seen: list[Percept] = []
        self._middle = middle_of_infos(agent.sensor_infos)
        self._mean: Baseline | None = None
        self.policy: Policy | None = None
        """The brain as a function of the percept; None if it is none."""
        self.problem = ""
        """Reason why it is none."""
        if agent.is_driven_by_keys:
            self.problem = KEYS_DRIVE
        elif not isinstance(brain, LocalBrain):
            self.problem = SCRIPT_DRIVES
        else:
            try:
                self.policy = Policy(brain)
            except AI4UError as error:
                self.problem = text_of(error)

    def drives(self, brain: Brain, agent: AgentState) -> bool:
        """Return True if a brain and an agent's blocks are still these."""
        return brain is self._brain and agent.sensor_infos is self._infos

    def why(self, agent: AgentState, recorded: NamedBaseline | None = None) -> Why:
        """Return why the brain acts as it does on the agent's present percept.

        Args:
            agent: the agent's state.
            recorded: the baseline; default: the mean of what the agent sensed lately.
        """
        if self.policy is None:
            return Why(agent.id, problem=self.problem)
        try:
            return self._why(self.policy, agent, recorded)
        except AI4UError as error:
            return Why(agent.id, problem=text_of(error))
        except Exception as error:  # a student's function may raise anything
            # do not ask again: it would fail at each percept
            self.policy = None
            self.problem = join([type(error).__name__, text_of(error)], ": ")
            return Why(agent.id, problem=self.problem)

    def _why(self, policy: Policy, agent: AgentState, recorded: NamedBaseline | None) -> Why:
        percept = agent.percept
        inputs = set(policy.inputs(percept))
        infos = [info for info in agent.sensor_infos if info.key in inputs]
        groups = parts_of(infos, agent)
        chosen = recorded or self._baseline(percept)
        told = occlusion(policy, percept, baseline=chosen.readings, groups=groups)
        axes = axes_of(agent.actuator_infos, list(policy.answer(percept)))
        also = ""
        if recorded is None and self._mean is not None:
            other = NamedBaseline(MIDDLE, self._middle)
            there = occlusion(policy, percept, baseline=other.readings, groups=groups)
            if not decisive(told, axes) and decisive(there, axes):
                # a robot that stands still makes the mean what it senses now
                (chosen, told), (other, there) = (other, there), (chosen, told)
            if decisive(told, axes) != decisive(there, axes):
                also = _(
                    "Compared with {baseline} instead: {sentence}",
                    baseline=other.words,
                    sentence=sentence(there, axes),
                )
        shares = shares_of(told, axes)
        return Why(
            agent.id,
            sentence=sentence(told, axes),
            baseline=chosen.words,
            also=also,
            explained=explained(told, axes),
            axes=tuple(axes),
            groups=told.groups,
            shares=tuple(tuple(each) for each in shares),
            ray_weights=_ray_weights(told, shares, agent),
        )

    def _baseline(self, percept: Percept) -> NamedBaseline:
        # a paused world shows the same percept again, which counts once
        if not self._seen or self._seen[-1] is not percept:
            self._seen = [*self._seen[1 - MAX_MEAN_PERCEPTS :], percept]
            if len(self._seen) >= MIN_MEAN_PERCEPTS and len(self._seen) % MEAN_EVERY == 0:
                self._mean = mean_of(self._seen)
        if self._mean is None:
            return NamedBaseline(MIDDLE, self._middle)
        words = _("the mean of the last {count} percepts", count=len(self._seen))
        return NamedBaseline(words, self._mean)


def parts_of(infos: Sequence[SensorInfo], agent: AgentState) -> list[Group]:
    """Return the groups of sensors to leave out; a large picture is left out as a whole."""
    found: list[Group] = []
    for info in infos:
        parts = groups_of([info], agent.rays, agent.spots, agent.percept)
        if len(parts) > MAX_PARTS:
            parts = [
                Group(
                    _("all of {sensor}", sensor=info.key),
                    info.key,
                    np.logical_or.reduce([p.mask for p in parts]),
                )
            ]
        found += parts
    return found


def middle_of_infos(infos: Sequence[SensorInfo]) -> dict[str, npt.NDArray[np.float64]]:
    """Return the middle of the ranges of described sensors; 0 for pictures and without an end."""
    found = {}
    for info in infos:
        has_ends = np.isfinite(info.low) & np.isfinite(info.high)
        middle = np.add(info.low, info.high, where=has_ends, out=np.zeros(len(info.low))) / 2
        if isinstance(info.legend, ChannelLegend):
            middle[:] = 0
        found[info.key] = np.tile(middle, info.stack)
    return found


def _ray_weights(
    told: Occlusion, shares: Sequence[Sequence[float]], agent: AgentState
) -> dict[str, Floats]:
    """Return for each ray its largest share, relative to the largest of all slots."""
    sizes = [max(map(abs, each), default=0.0) for each in shares]
    largest = max([MIN_SHARE, *sizes])
    found: dict[str, Floats] = {}
    for key, picture in agent.rays.items():
        rays = [size for group, size in zip(told.groups, sizes, strict=True) if group.key == key]
        if len(rays) == len(picture.groups):
            # of a fan, the groups begin with the leftmost ray, and its picture with the rightmost
            is_fan = next(info.legend for info in agent.sensor_infos if info.key == key) is None
            found[key] = np.array(rays[::-1] if is_fan else rays) / largest
    return found
