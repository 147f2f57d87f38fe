"""The part "run": time, score and state of the episode."""

import math
from typing import Literal

from msgspec import Struct

from ai4u_edu.blocks.rewards.reward_func import Stages
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import sentence
from ai4u_edu.page.panel.context import PanelContext
from ai4u_edu.page.panel.parts.part import PanelPart
from ai4u_edu.snapshot import AgentState, Snapshot
from ai4u_edu.snapshot.agent_words import ending

MAX_STAGES = 12
"""Most stages that are listed one by one."""
MIN_SPEED_SHARE = 0.9
"""Share of the wanted speed below which a page shows that the world can't keep up."""
MAX_USUAL_CONTACTS = 6
"""Contacts for each body above which bodies must overlap; side by side they have fewer."""


class Stage(Struct, frozen=True):
    """A stage on the way to the goal, or several of them in one line."""

    title: str
    """Its number, or how many of how many are done."""
    is_done: bool
    is_now: bool
    """True for the stage that comes next."""


class RunPart(PanelPart, frozen=True, kw_only=True):
    """The state of the episode, for a page that shows an agent."""

    name: Literal["run"] = "run"
    episode: int
    """Number of the episode, from 1; the agent's own once it has begun more than one alone."""
    decision: int
    """Decisions of the agent in the episode so far."""
    time_s: float
    """Time of the episode (s); it stops at the episode's end."""
    speed: float | Literal["max"]
    """Wanted time scale; 1 is real time."""
    real_speed: float
    """Measured time scale."""
    is_paused: bool
    waiting: str
    """``key`` while the world waits for a person to press a key, ``teacher`` while a teacher holds
    it; empty otherwise."""
    past: str
    """Label of the moment of the past that is shown; empty for the present."""
    seed: str
    """Seed of the episode, a whole number as text: JavaScript rounds those above 2**53."""
    is_seed_locked: bool
    """True if each reset repeats the seed."""
    score: float
    """Reward of the agent in the episode so far."""
    stages: list[Stage]
    """Stages on the way to the goal, in order."""
    seconds_left: float | None
    """World time (s) to the end by the step limit; null without a limit."""
    result: str
    """End of the agent's episode: ``goal``, ``won``, ``lost``, ``fell``, ``time`` or ``over``.
    It is empty before."""
    result_text: str
    """The end of the agent's episode as a short sentence; empty while it runs."""
    status: str
    """The state of the world as a short sentence."""
    slow: str
    """Warning about a slow tick; empty if there was none lately."""
    error: str
    """Sentence about the error that stopped the world; empty if none did."""
    stall: str
    """Sentence about a block that does not return; empty if all do."""


def run_part(context: PanelContext, snapshot: Snapshot, agent_id: str) -> RunPart:
    """Return the state of the episode, for a page that shows an agent."""
    agent = next((each for each in snapshot.agents if each.id == agent_id), snapshot.agents[0])
    stall = context.runner.stall
    return RunPart(
        episode=snapshot.episode if agent.episode <= 1 else agent.episode,
        decision=agent.steps,
        time_s=round(snapshot.episode_time, 2),
        speed="max" if math.isinf(snapshot.time_scale) else snapshot.time_scale,
        real_speed=round(snapshot.real_time_factor, 1),
        is_paused=snapshot.paused,
        waiting=snapshot.waiting,
        past=snapshot.past,
        seed=str(snapshot.seed),
        is_seed_locked=snapshot.is_seed_locked,
        score=agent.episode_reward,
        stages=[stage for stages in agent.stages for stage in _stages(stages)],
        seconds_left=agent.seconds_left,
        result=agent.outcome(snapshot.agents, snapshot.static_scene.success),
        result_text=_result_text(agent),
        status=_status(snapshot),
        slow=slow_warning(snapshot),
        error=snapshot.error,
        stall="" if stall is None else str(stall),
    )


def _stages(stages: Stages) -> list[Stage]:
    """Return a set of stages one by one, or in one line if there are too many.

    >>> [stage.title for stage in _stages(Stages(1, 3, ()))]
    ['1', '2', '3']
    >>> _stages(Stages(4, 40, ()))[0].title
    '4 of 40'
    """
    passed, total = stages.passed, stages.total
    if total > MAX_STAGES:
        return [
            Stage(
                _("{n} of {total}", n=passed, total=total),
                is_done=passed >= total,
                is_now=passed < total,
            )
        ]
    return [
        Stage(str(number + 1), is_done=number < passed, is_now=number == passed)
        for number in range(total)
    ]


def _status(snapshot: Snapshot) -> str:
    if snapshot.error:
        return _("Stopped")
    if snapshot.past:
        return _("Showing {moment}", moment=snapshot.past)
    if snapshot.waiting == "teacher":
        return _("Stopped by your teacher")
    if snapshot.paused:
        return _("Paused")
    if snapshot.waiting:
        return _("Waiting for a key")
    wanted, factor = snapshot.time_scale, snapshot.real_time_factor
    if not math.isinf(wanted) and factor < MIN_SPEED_SHARE * wanted:
        return _(
            "Running at {factor}x: this computer can't keep up with {wanted}x",
            factor=f"{factor:.1f}",
            wanted=f"{wanted:g}",
        )
    return _("Running")


def _result_text(agent: AgentState) -> str:
    """Return the end of the agent's episode as a short sentence; empty while it runs."""
    return sentence(ending(agent)) if agent.terminated or agent.truncated else ""


def slow_warning(snapshot: Snapshot) -> str:
    """Return a warning about a slow tick; empty if there was none."""
    slow = snapshot.slow_tick
    if slow is None:
        return ""
    overlap = slow.contacts > len(snapshot.bodies) * MAX_USUAL_CONTACTS
    took = f"{1000 * slow.seconds:.0f}"
    if overlap:
        return _(
            "Slow computer: a step took {ms} ms with {contacts} contacts. "
            "Move bodies out of each other.",
            ms=took,
            contacts=slow.contacts,
        )
    return _("Slow computer: a step took {ms} ms.", ms=took)
