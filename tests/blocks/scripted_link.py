"""A link to a remote script, without a network, for tests of RemoteBrain."""

from typing import Any

from ai4u_edu import (
    BasicAgent,
    BearingSensor,
    CircleShape,
    ControlRequestor,
    LocalBrain,
    RBMoveActuator,
    RemoteBrain,
    World,
)
from ai4u_edu.blocks.brains.links.link import AgentSpec, LinkState, Observation, Reply
from tests.builders import small_sim

FORWARD = {"move": [1, 0, 0, 0]}


class StillClock:
    """A clock that stands still until a test advances it."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now

    def advance(self, seconds: float) -> None:
        self.now += seconds


class ScriptedLink:
    """A link with a list of answers; each one answers the latest observation.

    Attributes:
        clock: of the brain; a script is silent for no time until a test advances it.
    """

    def __init__(self, *answers: Any) -> None:
        self.clock = StillClock()
        self.answers = list(answers)
        self.state = LinkState.CONNECTED
        self.reason = ""
        self.ignored = 0
        self.time_asked_at = 0.0
        self.expects_reply = True
        self.will_notify = False
        self.told: list[Observation] = []
        self.refused: list[str] = []
        self.may_try_again = False
        self.timeouts: list[float] = []
        self.closed = ""
        self.idled = 0

    def open(self, offer: AgentSpec) -> None:
        self.offer = offer

    def tell(self, situation: Observation) -> None:
        self.told.append(situation)

    def ask(self, situation: Observation, timeout: float) -> Reply | None:
        self.timeouts.append(timeout)
        if not self.told or self.told[-1] is not situation:
            self.told.append(situation)
        answer = self.answers.pop(0) if self.answers else None
        if answer is None or isinstance(answer, Reply):
            return answer
        return Reply(answer, situation)

    def ask_for_time(self) -> None:
        """Ask for more time, as a script does that still computes."""
        self.time_asked_at = self.clock()

    def note(self, warning: str) -> None:
        """Nobody is told."""

    def refuse(self, answered: Reply, reason: str) -> bool:
        self.refused.append(reason)
        return self.may_try_again

    def idle(self) -> None:
        self.idled += 1

    def close(self, reason: str) -> None:
        self.closed = reason


def sim_with_link(link: ScriptedLink, **fields: Any) -> Any:
    """Return a small sim and its RemoteBrain, which uses a link."""
    brain_fields = {
        name: fields.pop(name)
        for name in ("mode", "on_missing", "receive_timeout", "skip_frame")
        if name in fields
    }
    brain = RemoteBrain.with_link(link, clock=link.clock, **({"skip_frame": 0} | brain_fields))
    sim = small_sim([BearingSensor(target="box")], brains=[brain], **fields)
    return sim, brain


def two_agents(link: ScriptedLink, controller: Any) -> ControlRequestor:
    """Return a sim: agent 0 is remote and decides every tick, agent 1 is local, every fifth."""
    world = World()
    agents = []
    remote = RemoteBrain.with_link(link, clock=link.clock, skip_frame=0)
    for index, brain in enumerate((remote, LocalBrain(controller=controller, skip_frame=4))):
        world.add_body(f"robot{index}", CircleShape(), position=(0, 3 * index))
        agents.append(
            BasicAgent(
                body=f"robot{index}",
                id=str(index),
                actuators=[RBMoveActuator()],
                brains=[brain],
            )
        )
    sim = ControlRequestor(world, agents)
    sim.reset(0)
    return sim
