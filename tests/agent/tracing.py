"""Agents and a world that write down everything that happens to them, in order."""

from typing import Any

from gymnasium.spaces import Box

from ai4u_edu import (
    Actuator,
    BasicAgent,
    BodyView,
    Brain,
    CircleShape,
    Command,
    Percept,
    RewardFunc,
    Sensor,
    World,
    WorldView,
)
from ai4u_edu.agent import EVENTS
from ai4u_edu.blocks.agent_view import AgentView

Log = list[str]


class TracedWorld(World):
    """A world that tells each tick, each reset and each body that goes back."""

    log: Log | None = None

    def tick(self) -> None:
        if self.log is not None:
            self.log.append("tick")
        super().tick()

    def reset(self, seed: int | None = None) -> None:
        if self.log is not None:
            self.log.append("world reset")
        super().reset(seed)

    def put_back(self, name: str) -> None:
        if self.log is not None:
            self.log.append(f"{name} goes back")
        super().put_back(name)


class TracedSensor(Sensor):
    """Counts its readings."""

    log: list[Any]
    perception_key: str = "eye"

    def space(self) -> Box:
        return Box(0, 1e6, (1,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        self.who = agent.id
        self.log.append(f"{agent.id}: setup sensor {self.perception_key}")

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        self.count = -1
        self.log.append(f"{agent.id}: reset sensor {self.perception_key}")

    def read(self, body: BodyView, view: WorldView) -> float:
        self.count += 1
        self.log.append(f"{self.who}: read {self.perception_key}={self.count}")
        return self.count


class TracedActuator(Actuator):
    """Moves at a speed, forward."""

    log: list[Any]
    action_name: str = "go"

    def space(self) -> Box:
        return Box(-100, 100, (1,))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        self.who = agent.id
        self.log.append(f"{agent.id}: setup actuator {self.action_name}")

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        self.log.append(f"{agent.id}: reset actuator {self.action_name}")

    def act(self, body: Any, action: tuple[float, ...]) -> None:
        self.log.append(f"{self.who}: act {self.action_name}={action[0]:g}")
        body.set_velocity(action[0], 0.0)


class TracedReward(RewardFunc):
    """Pays the same for each decision."""

    log: list[Any]
    name: str = "pay"
    amount: float = 1.0

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        self.who = agent.id
        self.log.append(f"{agent.id}: setup reward {self.name}")

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        self.log.append(f"{agent.id}: reset reward {self.name}")

    def on_update(self, body: BodyView, view: WorldView) -> float:
        self.log.append(f"{self.who}: reward {self.name}")
        return self.amount


class TracedBrain(Brain):
    """Answers with what it was told to, one after another; then with the last."""

    log: list[Any]
    answers: list[Any]

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        self.who = agent.id
        self.turn = 0
        self.log.append(f"{agent.id}: setup brain")

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        self.log.append(f"{agent.id}: reset brain")

    def decide(self, percept: Percept) -> Any:
        answer = self.answers[min(self.turn, len(self.answers) - 1)]
        self.turn += 1
        seen = f"eye={percept['eye'][0]:g}" if "eye" in percept else ""
        is_command = isinstance(answer, Command)
        said = answer.value if is_command else _said(answer)
        self.log.append(f"{self.who}: decide {seen} done={percept['done']} -> {said}")
        return answer


def _said(action: Any) -> str:
    return " ".join(f"{name}={number:g}" for name, number in action.items()) or "nothing"


def traced_agent(log: Log, *answers: Any, **fields: Any) -> BasicAgent:
    """An agent of which every event and every block is written down."""
    agent_id = fields.get("id", "0")
    brain = {name: fields.pop(name) for name in ("skip_frame", "repeat_action") if name in fields}
    agent = BasicAgent(
        body=fields.pop("body", "robot"),
        sensors=fields.pop("sensors", [TracedSensor(log=log)]),
        actuators=fields.pop("actuators", [TracedActuator(log=log)]),
        rewards=fields.pop("rewards", [TracedReward(log=log)]),
        brains=[TracedBrain(log=log, answers=list(answers) or [{"go": 1}], **brain)],
        **fields,
    )
    _share(log, agent)
    for name in EVENTS:

        def told(agent: BasicAgent, name: str = name) -> None:
            suffix = {
                "end_of_step": f" reward={agent.reward:g}",
                "end_of_episode": f" terminated={agent.terminated} truncated={agent.truncated}",
            }.get(name, "")
            log.append(f"{agent_id}: {name}{suffix}")

        getattr(agent, name).connect(told)
    return agent


def _share(log: Log, agent: BasicAgent) -> None:
    # a list given as a parameter is copied by its validation; all are to write into one
    for block in (*agent.sensors, *agent.actuators, *agent.rewards, *agent.brains):
        block.log = log  # type: ignore[attr-defined]


def traced_world(log: Log, *names: str, edge: float | None = None) -> TracedWorld:
    """A world with one body a name, five metres apart; with an edge: void from x = edge on."""
    from ai4u_edu import BoxShape

    world = TracedWorld()
    if edge is not None:
        world.add_floor("plate", BoxShape(size=(20, 40)), position=(edge - 10, 0))
    for index, name in enumerate(names or ("robot",)):
        world.add_body(name, CircleShape(radius=0.5), position=(0, 5.0 * index))
    world.log = log
    return world
