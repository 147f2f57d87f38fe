"""A brain on the other end of a network."""

from typing import Annotated, Any, Literal, Self, assert_never

from pydantic import Field

from ai4u_edu.base.errors import ActionError, SetupError, shown, suggest
from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Brain
from ai4u_edu.blocks.brains.command import Accepted, Action, Answer, Command
from ai4u_edu.blocks.brains.links.link import (
    Link,
    LinkState,
    Observation,
    Reply,
    Reset,
    describe_agent,
)
from ai4u_edu.blocks.brains.patience import WAIT_SLICE_S, Patience
from ai4u_edu.blocks.brains.remote_status import RemoteStatus
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.world import WorldView

BY_HAND = "a person drives; its actions are ignored"
"""What is said of a script meanwhile."""


class RemoteBrain(Brain):
    """Lets a Python script drive, in another process or on another machine.

    The script gets what the agent senses, its reward and whether the episode is over, and answers
    with an action, or asks for a reset. As in AI4U the script is a server and listens: the brain
    knocks at ``host`` and ``port`` until one opens. An AI4U script works as it is::

        env = gym.make("AI4UEnv-v0", controller_class=BasicGymController)

    In ``lockstep`` the world stands still until the action is there: right for training, since the
    script misses nothing. A script that needs more time and says so gets it (in a world with other
    agents 0.05 s; then they go on). One that says nothing for longer than ``receive_timeout`` is
    given up: the world goes on at its full pace, and waits for the script again once it answers. In
    ``realtime`` the world never waits: an action that comes too late counts for the next decision.

    While there is no script, the agent takes no decisions. When a script was there and its action
    is missing, ``on_missing`` decides: ``hold`` does the last action again, ``coast`` does nothing,
    ``stop`` gives zeros to all actuators. Numbers that are out of range are cut to it; what no
    actuator can carry out (another shape, NaN, an unknown name) is refused, and counts as missing.

    A person may take the agent over, and let it go again: meanwhile the script goes on seeing what
    the agent senses, its actions are ignored and counted, and a reset that it asks for is done.

    A reset that the script asks for is the world's; if other agents are there too, it is a new
    episode for this one alone.

    Source: AI4U's RemoteBrain; ``mode`` and ``on_missing`` are ours.

    >>> RemoteBrain(port=8090).title()
    'RemoteBrain(127.0.0.1:8090)'
    """

    host: Annotated[str, Field(min_length=1, max_length=255)] = "127.0.0.1"
    """Where the script listens."""
    port: Annotated[int, Field(ge=1, le=65535)] = 8080
    """Port at which the script listens."""
    receive_timeout: Annotated[int, quantity("ms", ge=200, le=600_000)] = 2000
    """Time for which a world in lockstep waits for a script that is silent."""
    mode: Literal["lockstep", "realtime"] = "lockstep"
    """``lockstep``: the world waits for each action. ``realtime``: it never waits."""
    on_missing: Literal["hold", "coast", "stop"] = "hold"
    """Action where the script's is missing: ``hold`` repeats the last one, ``coast`` takes none,
    ``stop`` gives zeros."""

    def __post_init__(self) -> None:
        self.override: Brain | None = None
        """Who decides in the script's place for now: a person's keyboard."""
        self._given: Link | None = None
        self._link: Link | None = None
        self._situation: Observation | None = None
        self._told: Observation | None = None
        self._number = 0
        self._patience = Patience(self.receive_timeout / 1000)
        self._seed: int | None = None
        self._late = self._stopped = self._resetting = self._cut_short = False
        self._reason = ""
        self._decisions = self._missing = self._dropped = self._refused = self._clipped = 0

    @classmethod
    def with_link(cls, link: Link, **parameters: Any) -> Self:
        """A remote brain whose script is reached in another way than by ``host`` and ``port``."""
        brain = cls(**parameters)
        brain._given = link
        return brain

    @property
    def has_own_link(self) -> bool:
        """Whether its script came by itself, and was told already what the agent senses."""
        return self._given is not None

    def begin_override(self, hand: Brain) -> None:
        """Has another brain decide in the script's place, which stays connected."""
        hand.on_setup(self._agent, self._view)
        hand.on_reset(self._agent, self._view)
        self.override = hand

    def end_override(self) -> None:
        """The script decides again, from the next decision on."""
        self.override = None

    # -- what a brain does -----------------------------------------------------------------------

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Begins to look out for a script."""
        self.close("the agent is set up anew")
        self.override = None
        self._agent, self._view = agent, view
        self._actuators = {each.action_name: each for each in agent.actuators if each.is_active}
        link = self._given or self._own_link()
        link.open(
            describe_agent(
                agent,
                skip_frame=self.skip_frame,
                repeat_action=self.repeat_action,
                tick=view.dt,
            )
        )
        self._link = link
        agent.end_of_update_state.connect(self._tell)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """A new episode; a script that didn't ask for it is told that its own was cut off.

        One that goes on from the middle of a recording is no new one: were the script told, it
        would ask for a reset, and lose it.
        """
        told = self._told
        is_new = not self._resetting and not agent.steps
        self._cut_short = is_new and told is not None and not told.done
        self._resetting = self._stopped = False
        self._situation = None
        if self.override is not None:
            self.override.on_reset(agent, view)

    def decide(self, percept: Percept) -> Answer:
        """What the script says, or what is done without it."""
        link = self._link
        if link is None:
            raise SetupError(
                f"{self.title()} was closed; expected agent.use_brain(...) to open it again"
            )
        observation = self._situation or self._now(percept)
        if self.override is not None:
            return self._by_hand(self.override, link, observation)
        timeout = self._time_for(link)
        reply = self._ask(link, observation, timeout)
        if reply is None:
            return self._without_answer(link, waits=timeout == WAIT_SLICE_S)
        self._situation = None
        self._late = False
        return self._obeyed(link, reply, observation)

    @property
    def keeps_waiting(self) -> bool:
        """Whether a world in lockstep waits for an answer that will come with a call."""
        link = self._link
        return (
            link is not None
            and link.will_notify
            and not self._patience.is_given_up
            and self.mode == "lockstep"
            and self.override is None
            and self._told is self._situation is not None
        )

    def restart_seed(self) -> int | None:
        """The seed that the script asked for, if it did."""
        return self._seed

    def idle(self) -> None:
        """Stays in touch while the world stands still; nobody is late meanwhile."""
        self._patience.restart()
        if self._link is not None:
            self._link.idle()

    def close(self, reason: str = "the world has ended") -> None:
        """Says goodbye to the script."""
        if self._link is not None:
            self._link.close(reason)
            self._agent.end_of_update_state.disconnect(self._tell)
            self._link = self._situation = self._told = None

    def title(self) -> str:
        """What a person calls it."""
        where = "a script" if self._given else f"{self.host}:{self.port}"
        return f"{type(self).__name__}({where})"

    def status(self) -> RemoteStatus:
        """How it stands, for the page."""
        link = self._link
        state = LinkState.WAITING if link is None else link.state
        here = state is LinkState.CONNECTED
        said = BY_HAND if self.override is not None else self._reason
        return RemoteStatus(
            state="late" if here and self._late else state.value,
            reason=(said if here else "") or (link.reason if link else ""),
            decisions=self._decisions,
            missing=self._missing,
            ignored=self._dropped + (link.ignored if link else 0),
            refused=self._refused,
            clipped=self._clipped,
        )

    # -- the steps of it -------------------------------------------------------------------------

    def _ask(self, link: Link, observation: Observation, timeout: float) -> Reply | None:
        """The script's answer, if there is one that counts."""
        reply = link.ask(observation, timeout)
        if link.state is not LinkState.CONNECTED:
            self._told = None
            self._patience.resume()
        elif link.expects_reply or reply is not None:
            self._told = observation
        patience = self._patience
        if patience.is_given_up and (reply is not None or patience.asks_for_time(link)):
            patience.resume()
            patience.restart()
            self._late, self._reason = False, ""
        if reply is not None and self._outdated(reply, observation):
            self._dropped += 1
            return None
        return reply

    def _by_hand(self, hand: Brain, link: Link, observation: Observation) -> Answer:
        """What a person does; the script sees it, and nobody waits for what it would do."""
        reply = self._ask(link, observation, 0.0)
        self._situation, self._seed, self._late = None, None, False
        if reply is not None:
            if isinstance(reply.answer, Reset):
                return self._obeyed(link, reply, observation)
            self._dropped += 1
        return hand.decide(observation.percept)

    def _own_link(self) -> Link:
        from ai4u_edu.blocks.brains.links.ai4u import AI4ULink

        return AI4ULink(
            self.host,
            self.port,
            receive_timeout=self.receive_timeout / 1000,
            threaded=self.mode == "realtime",
        )

    def _now(self, percept: Percept) -> Observation:
        """What is to be told now; the same until it is reply."""
        self._number += 1
        if self._cut_short and self._told is not None:
            self._cut_short = False
            now = self._told._replace(
                number=self._number, reward=0.0, terms={}, done=True, truncated=True
            )
        else:
            agent = self._agent
            now = Observation(
                number=self._number,
                episode=agent.episode,
                percept=percept,
                reward=agent.reward,
                terms=agent.reward_terms,
                steps=agent.steps,
                tick=self._view.ticks,
                done=agent.done,
                truncated=agent.truncated,
                paused=agent.paused,
                stopped=self._stopped,
            )
        self._situation = now
        self._patience.restart()
        return now

    def _tell(self, agent: AgentView) -> None:
        """Has the script see at once what was sensed: until the next tick it may have reply."""
        link = self._link
        if link is not None and link.state is LinkState.CONNECTED:
            link.tell(self._now(agent.percept))
            if link.expects_reply:
                self._told = self._situation

    def _outdated(self, reply: Reply, observation: Observation) -> bool:
        """Whether an answer belongs to what is over: it must not reach another episode."""
        told = reply.observation
        if told is None or isinstance(reply.answer, Reset):
            return False
        if self.mode == "lockstep":
            return told.number != observation.number
        return told.episode != self._agent.episode

    def _can_act(self) -> bool:
        agent = self._agent
        return not (agent.done or agent.paused or self._stopped)

    def _has_time(self, link: Link) -> bool:
        """Whether the world may wait for the script."""
        return self.mode == "lockstep" and self._patience.has_time(link, can_act=self._can_act())

    def _time_for(self, link: Link) -> float:
        """Seconds to wait for an answer now."""
        if self.mode == "realtime":
            return 0.0
        company = self._agent.other_agents > 0
        return self._patience.wait_s(link, can_act=self._can_act(), has_company=company)

    def _without_answer(self, link: Link, *, waits: bool) -> Answer:
        """The world waits, or goes on without the script.

        Args:
            link: to the script.
            waits: whether the world waited just now.
        """
        if link.state is LinkState.WAITING:
            return Command.WAIT
        if link.state is LinkState.CONNECTED:
            if not link.expects_reply:
                return Command.WAIT
            if waits:
                return Command.HOLD
            if self._has_time(link):
                yields = self._agent.other_agents > 0 and self._patience.yields(link)
                return Command.WAIT if yields else Command.HOLD
            if self.mode == "lockstep":
                self._patience.give_up()
        if not self._can_act():
            return Command.WAIT
        self._late = True
        self._reason = f"no action for {self._patience.silence_s:.1f} s"
        if self._patience.is_given_up:
            self._reason += ": given up, the world goes on until it answers"
        return self._without_action()

    def _without_action(self) -> Action:
        """What is done in place of the script's action."""
        self._missing += 1
        self._situation = None
        match self.on_missing:
            case "hold":
                return dict(self._agent.last_action)
            case "coast":
                return {}
            case "stop":
                return {
                    name: [
                        min(max(0.0, low), high) for low, high in zip(*each.limits(), strict=True)
                    ]
                    for name, each in self._actuators.items()
                    if each.is_output
                }
            case _:
                assert_never(self.on_missing)

    def _obeyed(self, link: Link, reply: Reply, observation: Observation) -> Answer:
        """The answer in the cycle's terms."""
        answer, agent = reply.answer, self._agent
        if isinstance(answer, Reset):
            self._resetting, self._cut_short = True, False
            self._seed = answer.seed
            alone = not agent.other_agents or answer.seed is not None
            return Command.RESTART if alone else Command.RESPAWN
        if isinstance(answer, Command):
            self._stopped = self._stopped or answer is Command.STOP
            # the cycle would not ask again, and so would never hear of a reset
            return Command.WAIT if answer is Command.STOP else answer
        if not self._can_act() or observation.done:
            return Command.WAIT
        try:
            action = self._checked(answer)
        except ActionError as error:
            self._refused += 1
            self._reason = str(error)
            if link.refuse(reply, self._reason) and self._has_time(link):
                self._situation = observation
                return Command.HOLD
            return self._without_action()
        self._decisions += 1
        self._reason = ""
        return action

    def _checked(self, action: Action) -> Accepted:
        """An action as the actuators take it; numbers out of range are cut."""
        checked = Accepted()
        for name, numbers in action.items():
            actuator = self._actuators.get(name)
            if actuator is None:
                raise ActionError(
                    f"agent {self._agent.id!r} has no actuator {shown(name)}; "
                    f"{suggest(str(name), self._actuators)}"
                )
            before = actuator.clipped
            checked[name] = actuator.accept(numbers)
            self._clipped += actuator.clipped - before
        return checked
