"""Models of the API's answers; the JSON and its OpenAPI description come from them."""

import math
from collections.abc import Mapping
from dataclasses import asdict
from datetime import UTC, datetime, timedelta
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field
from typing_extensions import TypeAliasType

from ai4u_edu.base.version import __version__
from ai4u_edu.blocks import RemoteStatus
from ai4u_edu.runtime.tick_monitor import Stall
from ai4u_edu.runtime.training_progress import TrainingProgress
from ai4u_edu.snapshot import AgentState, BodyState, Snapshot


def finite(value: float) -> float | None:
    """Return a number, or None if JSON can't hold it (NaN, infinity)."""
    return value if math.isfinite(value) else None


Number = Annotated[float | None, BeforeValidator(finite)]
Pose = Annotated[
    tuple[Number, Number, Number, Number],
    Field(description="x, y, z in metres; heading in radians, counter-clockwise from +x"),
]
Velocity = Annotated[tuple[Number, Number, Number], Field(description="x, y, z in m/s")]
Spin = Annotated[Number, Field(description="rad/s, counter-clockwise")]
Reading = TypeAliasType("Reading", "bool | int | float | str | list[Reading] | None")


class _View(BaseModel):
    model_config = ConfigDict(extra="forbid")  # the schema then allows no other fields


class BodyStateView(_View):
    """Pose and motion of a body."""

    name: str
    pose: Pose
    velocity: Velocity
    angular_velocity: Spin
    fallen: bool

    @classmethod
    def of(cls, body: BodyState) -> "BodyStateView":
        """Return the view of a body's state."""
        return cls(name=body.name, fallen=body.fallen, **_motion(body))


class StagesView(_View):
    """Stages on the way to the goal, such as marks to pass or bodies to collect."""

    passed: int
    total: int
    targets: list[str] = Field(description="bodies and areas, in order if the order counts")


class ScriptView(_View):
    """The script that drives an agent, beside the world or on another machine."""

    state: Literal["waiting", "connected", "late", "lost"]
    reason: str = Field(description="the last event in a sentence; empty if there is nothing")
    decisions: int = Field(description="actions that were carried out")
    missing: int = Field(description="decisions for which no action was there in time")
    ignored: int = Field(description="messages that were no answer")
    refused: int = Field(description="actions that no actuator could carry out")
    clipped: int = Field(description="numbers of actions that were out of range, and clipped")
    warnings: int = Field(description="replies that had no effect, or of which a part had none")
    warning: str = Field(
        description="what was wrong in one of them; empty if there was none of late; "
        "it changes every 5 s at most"
    )

    @classmethod
    def of(cls, remote: RemoteStatus) -> "ScriptView":
        """Return the view of a remote brain's status."""
        return cls(**asdict(remote))


class AgentStateView(_View):
    """An agent's last percept, action and reward, and its present pose."""

    id: str
    body: str
    brain: str
    pose: Pose
    velocity: Velocity
    angular_velocity: Spin
    percept: dict[str, Reading]
    action: dict[str, list[Number]]
    reward: Number = Field(description="of the last finished decision")
    reward_terms: Mapping[str, Number]
    episode_reward: Number
    episode_terms: Mapping[str, Number]
    steps: int = Field(description="decisions in this episode")
    terminated: bool
    truncated: bool
    stages: list[StagesView] = Field(description="one for each set of targets")
    seconds_left: float | None = Field(
        description="world time until the step limit ends the episode; null: no limit"
    )
    script: ScriptView | None = Field(description="null where no remote script drives")

    @classmethod
    def of(cls, agent: AgentState, body: BodyState) -> "AgentStateView":
        """Return the view of an agent's state."""
        return cls(
            id=agent.id,
            body=agent.body,
            brain=agent.brain,
            **_motion(body),
            percept={key: _reading(agent.percept[key]) for key in agent.percept},
            action={name: list(numbers) for name, numbers in agent.action.items()},
            reward=agent.reward,
            reward_terms=agent.reward_terms,
            episode_reward=agent.episode_reward,
            episode_terms=agent.episode_terms,
            steps=agent.steps,
            terminated=agent.terminated,
            truncated=agent.truncated,
            stages=[
                StagesView(passed=each.passed, total=each.total, targets=list(each.targets))
                for each in agent.stages
            ],
            seconds_left=agent.seconds_left,
            script=None if agent.remote is None else ScriptView.of(agent.remote),
        )


Waiting = Literal["", "key", "teacher"]
WAITING: Any = Field(
    description="key: the world waits on its first frame until a person presses a key; "
    "teacher: a teacher has stopped it"
)


class SlowTickView(_View):
    """A tick that took too long."""

    seconds: Number
    contacts: int = Field(description="pairs of bodies that touched, approximately")


class SnapshotView(_View):
    """State of the world at one tick."""

    tick: int
    time: Number = Field(description="seconds of the world's time since the reset")
    episode_time: Number = Field(
        description="seconds of the episode; stops at its end, while the world goes on"
    )
    seed: int
    seed_locked: bool = Field(description="true: a reset without a seed repeats the present one")
    episode: int
    paused: bool
    waiting: Waiting = WAITING
    time_scale: Number = Field(description="1 is real time; null: unlimited")
    real_time_factor: Number
    error: str = Field(description="error that stopped the world; empty if there is none")
    slow_tick: SlowTickView | None = Field(
        description="the slowest tick of the last 5 s, if one took more than 0.05 s"
    )
    past: str = Field(description="moment of a replay that is shown; empty for the present")
    agents: list[AgentStateView]
    bodies: list[BodyStateView]

    @classmethod
    def of(cls, picture: Snapshot) -> "SnapshotView":
        """Return the view of a snapshot."""
        bodies = {body.name: body for body in picture.bodies}
        slow = picture.slow_tick
        return cls(
            tick=picture.tick,
            time=picture.time,
            episode_time=picture.episode_time,
            seed=picture.seed,
            seed_locked=picture.is_seed_locked,
            episode=picture.episode,
            paused=picture.paused,
            waiting=_waiting(picture),
            time_scale=picture.time_scale,
            real_time_factor=picture.real_time_factor,
            error=picture.error,
            slow_tick=SlowTickView(seconds=slow.seconds, contacts=slow.contacts) if slow else None,
            past=picture.past,
            agents=[AgentStateView.of(agent, bodies[agent.body]) for agent in picture.agents],
            bodies=[BodyStateView.of(body) for body in picture.bodies],
        )


Status = Literal["ok", "paused", "error", "stalled"]


class TrainingView(_View):
    """Training whose policy drives in the room."""

    training: TrainingProgress | None = Field(description="null where nothing is being trained")


class Health(_View):
    """Health of a room."""

    status: Status = Field(
        description="of the world in the room; stalled: something in it does not return"
    )
    waiting: Waiting = WAITING
    version: str
    scene: str
    uptime: float = Field(description="seconds", ge=0)
    block: str = Field(description="the block that does not return, and where; empty if none")
    since: datetime | None = Field(
        description="time of the call that does not return; null if there is none"
    )

    @classmethod
    def of(
        cls, picture: Snapshot, scene: str, uptime: float, stall: Stall | None = None
    ) -> "Health":
        """Return the health of a room whose world looks like this.

        Args:
            picture: the latest snapshot.
            scene: the title of the scene.
            uptime: seconds for which the room has been there.
            stall: what keeps the world from going on, if anything does.
        """
        status: Status = "error" if picture.error else "paused" if picture.paused else "ok"
        since = None
        if stall is not None:
            status = "stalled"
            since = datetime.now(UTC) - timedelta(seconds=stall.seconds)
            since = since.replace(microsecond=0)
        return cls(
            status=status,
            waiting=_waiting(picture),
            version=__version__,
            scene=scene,
            uptime=round(uptime, 3),
            block="" if stall is None else stall.title,
            since=since,
        )


def _waiting(picture: Snapshot) -> Waiting:
    match picture.waiting:
        case "key" | "teacher" as waiting:
            return waiting
    return ""


def _motion(body: BodyState) -> dict[str, Any]:
    return {
        "pose": (body.x, body.y, body.z, body.heading),
        "velocity": (body.vx, body.vy, body.vz),
        "angular_velocity": body.angular_velocity,
    }


def _reading(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return _reading(value.tolist())
    if isinstance(value, list | tuple):
        return [_reading(each) for each in value]
    return finite(value) if isinstance(value, float) else value
