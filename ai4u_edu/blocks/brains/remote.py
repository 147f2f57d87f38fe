"""A brain whose script runs in another process, or on another machine."""

import time
from collections.abc import Callable, Mapping
from typing import Annotated, Any, Literal, Self, assert_never

from pydantic import Field

from ai4u_edu.base.errors import ActionError, SetupError, shown, suggest, text_of
from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Accepted, Action, Answer, Brain, Command
from ai4u_edu.blocks.brains.links.link import (
    Link,
    LinkState,
    Observation,
    Reply,
    ResetRequest,
    describe_agent,
)
from ai4u_edu.blocks.brains.remote_status import RemoteStatus, StatusTracker
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.world import WorldView

WAIT_SLICE_S = 0.015
"""Time for which the world waits at once; then the runner checks its commands, and asks again."""
YIELD_AFTER_S = 0.05
"""Time for which a script that asks for time makes a world with other agents wait. One script may
drive several of them in turn: if the world waited for all of them, it would wait for ever."""
YIELDING_WAIT_S = 0.001
"""Time for which the world waits for such a script after that, at each tick."""
OnMissing = Literal["hold", "coast", "stop"]


class RemoteBrain(Brain):
    """Lets a Python script drive, in another process or on another machine.

    The script gets the agent's observation, its reward, and whether the episode is over. It answers
    with an action, or asks for a reset. As in AI4U the script is the server: the brain sends
    requests to ``host`` and ``port`` until a script answers. An AI4U script works as it is::

        env = gym.make("AI4UEnv-v0", controller_class=BasicGymController)

    In ``lockstep`` the world waits for each action: right for training, since the script misses
    nothing. A script may ask for more time and gets it (in a world with other agents 0.05 s; then
    they go on). If a script is silent for longer than ``receive_timeout``, the world goes on at
    full speed, and waits for the script again once it answers. In ``realtime`` the world never
    waits: an action that comes too late counts for the next decision.

    Until a script has connected, the agent takes no decisions. If a script is connected, or was,
    and its action is missing, ``on_missing`` decides: ``hold`` repeats the last action, ``coast``
    does nothing, ``stop`` gives zeros to all actuators. Numbers out of range are clipped. An action
    that no actuator can carry out (another shape, NaN, an unknown name) is refused, and counts as
    missing.

    A person may take over from the script, and hand control back. Meanwhile the script still gets
    observations, its actions are ignored and counted, and its resets are carried out.

    A reset by the script resets the world; if there are other agents, it begins a new episode for
    this one alone.

    Source: AI4U's RemoteBrain; ``mode`` and ``on_missing`` are ours.

    >>> RemoteBrain(port=8090).title()
    'RemoteBrain(127.0.0.1:8090)'
    """

    host: Annotated[str, Field(min_length=1, max_length=255)] = "127.0.0.1"
    """Host on which the script listens."""
    port: Annotated[int, Field(ge=1, le=65535)] = 8080
    """Port at which the script listens."""
    receive_timeout: Annotated[int, quantity("ms", ge=200, le=600_000)] = 2000
    """Time for which a world in lockstep waits for a script that is silent."""
    mode: Literal["lockstep", "realtime"] = "lockstep"
    """``lockstep``: the world waits for each action. ``realtime``: it never waits."""
    on_missing: OnMissing = "hold"
    """Substitute for a missing action: ``hold`` repeats the last one, ``coast`` takes none,
    ``stop`` gives zeros."""

    def __post_init__(self) -> None:
        self.override: Brain | None = None
        """The brain that decides in the script's place for now, such as a person's keyboard."""
        self._own_link: Link | None = None
        self._link: Link | None = None
        self._current: Observation | None = None
        """The observation that waits for an answer."""
        self._last_asked: Observation | None = None
        """The last observation that the script was asked about; None without a script."""
        self._number = 0
        self._patience = Patience()
        self._status = StatusTracker()
        self._seed: int | None = None
        self._is_stopped = False
        """The script asked for no more decisions in this episode."""
        self._is_resetting = False
        """The reset that is under way was asked for by the script."""
        self._reset_fields: Mapping[str, tuple[str, ...]] = {}
        self._must_truncate = False
        """The script has yet to answer that its episode was cut off."""

    @classmethod
    def with_link(
        cls, link: Link, *, clock: Callable[[], float] = time.monotonic, **parameters: Any
    ) -> Self:
        """Make a remote brain that uses a link of its own instead of ``host`` and ``port``.

        Args:
            link: to the script.
            clock: seconds, for ``receive_timeout``; the one of the link's ``time_asked_at``.
            parameters: of the brain.
        """
        brain = cls(**parameters)
        brain._own_link, brain._patience = link, Patience(clock)
        return brain

    @property
    def has_own_link(self) -> bool:
        """True if the script connected by itself, and got a description of the agent then."""
        return self._own_link is not None

    def begin_override(self, brain: Brain) -> None:
        """Let another brain decide in the script's place; the script stays connected."""
        brain.on_setup(self._agent, self._view)
        brain.on_reset(self._agent, self._view)
        self.override = brain

    def end_override(self) -> None:
        """Let the script decide again, from the next decision on."""
        self.override = None

    def fixed_at_setup(self) -> dict[str, object]:
        """Return the script's address, at which the link was opened."""
        return {} if self.has_own_link else {"host": self.host, "port": self.port}

    # -- interface of a brain --------------------------------------------------------------------

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Begin to wait for a script."""
        self.close(_("the agent is set up again"))
        self.override = None
        self._agent, self._view = agent, view
        self._actions = _RemoteActions(agent)
        link = self._own_link or self._make_link()
        link.open(
            describe_agent(
                agent,
                skip_frame=self.skip_frame,
                repeat_action=self.repeat_action,
                tick=view.dt,
            )
        )
        self._link = link
        agent.percept_ready.connect(self._tell)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Begin an episode; a script that did not ask for it learns that its own was truncated.

        An episode that continues in the middle of a recording is not a new one: if the script were
        told, it would ask for a reset, and the recorded position would be lost.
        """
        asked = self._last_asked
        is_unexpected = not self._is_resetting and not agent.steps
        is_in_episode = asked is not None and (self._must_truncate or not asked.done)
        self._must_truncate = is_unexpected and is_in_episode
        if self._is_resetting:
            self._take_fields(self._reset_fields)
        self._is_resetting = self._is_stopped = False
        self._current = None
        if self.override is not None:
            self.override.on_reset(agent, view)

    def decide(self, percept: Percept) -> Answer:
        """Return the script's answer, or what the agent does without it."""
        link = self._link
        if link is None:
            raise SetupError(
                _(
                    "{title} was closed; expected agent.use_brain(...) to open it again",
                    title=self.title(),
                )
            )
        observation = self._current or self._observe(percept)
        self._patience.timeout_s = self.receive_timeout / 1000
        if self.override is not None:
            return self._decide_overridden(self.override, link, observation)
        timeout = self._timeout(link)
        reply = self._ask(link, observation, timeout)
        if reply is None:
            return self._decide_without_reply(link, has_waited=timeout == WAIT_SLICE_S)
        self._current = None
        self._status.is_late = False
        return self._carry_out(link, reply, observation)

    @property
    def keeps_waiting(self) -> bool:
        """True while a world in lockstep waits for an answer of which the runner is notified."""
        link = self._link
        return (
            link is not None
            and link.will_notify
            and not self._patience.is_given_up
            and self.mode == "lockstep"
            and self.override is None
            and self._last_asked is self._current is not None
        )

    def restart_seed(self) -> int | None:
        """Return the seed that the script asked for with its reset, if it did."""
        return self._seed

    def idle(self) -> None:
        """Keep the connection alive while the world stands still; meanwhile nobody is late."""
        self._patience.restart()
        if self._link is not None:
            self._link.idle()

    def close(self, reason: str = _("the world has ended")) -> None:
        """Say goodbye to the script."""
        if self._link is not None:
            self._link.close(reason)
            self._agent.percept_ready.disconnect(self._tell)
            self._link = self._current = self._last_asked = None

    def title(self) -> str:
        """Return the name for people, with the script's address."""
        if self._own_link:
            return _("{type}(a script)", type=type(self).__name__)
        return f"{type(self).__name__}({self.host}:{self.port})"

    def status(self) -> RemoteStatus:
        """Return the status for the page."""
        return self._status.report(self._link, is_overridden=self.override is not None)

    # -- observations ----------------------------------------------------------------------------

    def _observe(self, percept: Percept) -> Observation:
        """Return a new observation, which stays the current one until it is answered."""
        self._number += 1
        if self._must_truncate and self._last_asked is not None:
            # until it is answered: while the script owes an earlier answer, none is sent
            observation = self._last_asked._replace(
                number=self._number, reward=0.0, terms={}, done=True, truncated=True
            )
        else:
            agent = self._agent
            observation = Observation(
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
                stopped=self._is_stopped,
                episode_reward=agent.episode_reward,
            )
        self._current = observation
        self._patience.restart()
        return observation

    def _tell(self, agent: AgentView) -> None:
        """Send the observation at once: the script may answer before the next tick."""
        link = self._link
        if link is not None and link.state is LinkState.CONNECTED:
            link.tell(self._observe(agent.percept))
            if link.expects_reply:
                self._last_asked = self._current

    # -- replies -----------------------------------------------------------------------------------

    def _ask(self, link: Link, observation: Observation, timeout: float) -> Reply | None:
        """Return the script's reply, unless it belongs to something that is over."""
        reply = link.ask(observation, timeout)
        self._status.follow(link.state)
        if link.state is not LinkState.CONNECTED:
            self._last_asked = None
            # an AI4U script that connects next may be another one
            self._must_truncate = self._must_truncate and self.has_own_link
            self._patience.resume()
        elif link.expects_reply or reply is not None:
            self._last_asked = observation
        patience = self._patience
        if patience.is_given_up and (reply is not None or patience.asks_for_time(link)):
            patience.resume()
            patience.restart()
            self._status.is_late, self._status.reason = False, ""
        if reply is not None and reply.observation is not None and reply.observation.truncated:
            self._must_truncate = False
        if reply is not None and self._is_outdated(reply, observation):
            self._status.dropped += 1
            return None
        return reply

    def _is_outdated(self, reply: Reply, observation: Observation) -> bool:
        """Return True for a late reply; it must not take effect in another episode."""
        asked = reply.observation
        if asked is None or isinstance(reply.answer, ResetRequest):
            return False
        if self.mode == "lockstep":
            return asked.number != observation.number
        return asked.episode != self._agent.episode

    def _carry_out(self, link: Link, reply: Reply, observation: Observation) -> Answer:
        """Return a reply as the decision cycle takes it."""
        answer, agent = reply.answer, self._agent
        if not isinstance(answer, ResetRequest):
            self._take_fields(reply.fields)
        if isinstance(answer, ResetRequest):
            self._warn(reply.warning)
            self._reset_fields = reply.fields
            self._is_resetting, self._must_truncate = True, False
            self._seed = answer.seed
            is_for_world = not agent.other_agents or answer.seed is not None
            return Command.RESTART if is_for_world else Command.RESPAWN
        if isinstance(answer, Command):
            self._warn(reply.warning)
            self._is_stopped = self._is_stopped or answer is Command.STOP
            # after STOP the cycle would not ask again, and would miss a reset
            return Command.WAIT if answer is Command.STOP else answer
        if not self._can_act() or observation.done:
            is_late = reply.observation is not observation  # no mistake of the script
            problem = "" if is_late else self._reason_without_effect(answer, observation)
            self._warn(problem, reply.warning)
            return Command.WAIT
        try:
            action, clipped = self._actions.accept(answer)
        except ActionError as error:
            self._status.refused += 1
            self._status.reason = text_of(error)
            self._warn(str(error), reply.warning)
            if link.refuse(reply, str(error)) and self._may_wait(link):
                self._current = observation
                return Command.HOLD
            return self._substitute()
        self._warn(reply.warning)
        self._status.accept(clipped, self._patience.now())
        return action

    def _take_fields(self, fields: Mapping[str, tuple[str, ...]]) -> None:
        """Give the agent what a script sent besides the action, and report what does not fit."""
        if fields or self._agent.fields:
            self._warn(self._agent.take_fields(fields))

    def _reason_without_effect(self, action: Action, observation: Observation) -> str:
        """Say why an action has no effect, whatever it is."""
        if not action:
            return ""
        names = ", ".join(map(shown, action))
        if observation.done:
            return _(
                "action {names} had no effect: the episode is over; expected a reset", names=names
            )
        if observation.paused:
            return _(
                "action {names} had no effect: the agent is paused; expected a command to resume",
                names=names,
            )
        return _(
            "action {names} had no effect: the agent was stopped; expected a reset", names=names
        )

    def _warn(self, *sentences: str) -> None:
        """Report what had no effect in one reply; empty sentences report nothing."""
        if any(sentences):
            warning = join(list(filter(None, sentences)), "; ")
            self._status.warn(warning, self._patience.now())
            if self._link is not None:
                self._link.note(warning)

    def _decide_overridden(self, brain: Brain, link: Link, observation: Observation) -> Answer:
        """Let another brain decide; the script gets the observation, and only its resets count."""
        reply = self._ask(link, observation, 0.0)
        self._current, self._seed, self._status.is_late = None, None, False
        if reply is not None:
            if isinstance(reply.answer, ResetRequest):
                return self._carry_out(link, reply, observation)
            self._status.dropped += 1
        return brain.decide(observation.percept)

    # -- what happens without a reply ------------------------------------------------------------

    def _decide_without_reply(self, link: Link, *, has_waited: bool) -> Answer:
        """Let the world wait, or let it go on without the script.

        Args:
            link: to the script.
            has_waited: whether the world has waited just now for as long as it may at once.
        """
        if link.state is LinkState.WAITING:
            return Command.WAIT
        if link.state is LinkState.CONNECTED:
            if not link.expects_reply:
                return Command.WAIT
            if has_waited:
                return Command.HOLD
            if self._may_wait(link):
                yields = self._agent.other_agents > 0 and self._patience.yields(link)
                return Command.WAIT if yields else Command.HOLD
            if self.mode == "lockstep":
                self._patience.give_up()
        if not self._can_act():
            return Command.WAIT
        self._status.is_late = True
        silence_s = self._patience.silence_s
        if self._patience.is_given_up:
            self._status.reason = _(
                "no action for {seconds:.1f} s: given up, the world goes on until it answers",
                seconds=silence_s,
            )
        else:
            self._status.reason = _("no action for {seconds:.1f} s", seconds=silence_s)
        return self._substitute()

    def _substitute(self) -> Action:
        """Return what the agent does in place of the script's action."""
        self._status.missing += 1
        self._current = None
        return self._actions.substitute(self.on_missing)

    def _can_act(self) -> bool:
        agent = self._agent
        return not (agent.done or agent.paused or self._is_stopped)

    def _may_wait(self, link: Link) -> bool:
        """Return True if the world may wait for the script."""
        return self.mode == "lockstep" and self._patience.has_time(link, can_act=self._can_act())

    def _timeout(self, link: Link) -> float:
        """Return the time to wait for an answer now, in seconds."""
        if self.mode == "realtime":
            return 0.0
        has_company = self._agent.other_agents > 0
        return self._patience.wait_s(link, can_act=self._can_act(), has_company=has_company)

    def _make_link(self) -> Link:
        from ai4u_edu.blocks.brains.links.ai4u import AI4ULink

        return AI4ULink(
            self.host,
            self.port,
            receive_timeout=self.receive_timeout / 1000,
            threaded=self.mode == "realtime",
        )


class _RemoteActions:
    """The actions that a remote script can give to an agent.

    Args:
        agent: the agent, set up.
    """

    def __init__(self, agent: AgentView) -> None:
        self._agent = agent
        self._actuators = {each.action_name: each for each in agent.actuators if each.is_active}

    def accept(self, action: Action) -> tuple[Accepted, int]:
        """Return an action as the actuators take it, and how many of its numbers were clipped.

        Raises:
            ActionError: no actuator has the name, or it can't carry out the numbers.
        """
        accepted, clipped = Accepted(), 0
        for name, numbers in action.items():
            actuator = self._actuators.get(name)
            if actuator is None:
                raise ActionError(
                    _(
                        "agent {id!r} has no actuator {got}; {hint}",
                        id=self._agent.id,
                        got=shown(name),
                        hint=suggest(str(name), self._actuators),
                    )
                )
            before = actuator.clipped
            accepted[name] = actuator.accept(numbers)
            clipped += actuator.clipped - before
        return accepted, clipped

    def substitute(self, on_missing: OnMissing) -> Action:
        """Return what the agent does in place of an action that is missing."""
        match on_missing:
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
                assert_never(on_missing)


class Patience:
    """The time limit of a script's answer, and whether the world has stopped waiting for it.

    Only the runner's thread calls it.

    Args:
        clock: seconds, the one of the link's ``time_asked_at``.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self.timeout_s = 0.0
        """Time for which a script may be silent; may change at any time."""
        self._clock = clock
        self._asked = 0.0
        self._given_up: float | None = None
        self._silent_since = 0.0

    @property
    def is_given_up(self) -> bool:
        """True while the world does not wait, since the script was silent for too long."""
        return self._given_up is not None

    @property
    def silence_s(self) -> float:
        """Time since the script was asked for the action that it owes."""
        return self._clock() - (self._silent_since if self.is_given_up else self._asked)

    def now(self) -> float:
        """Return the seconds of the clock."""
        return self._clock()

    def restart(self) -> None:
        """Give the script its time again, as for another answer."""
        self._asked = self._clock()

    def give_up(self) -> None:
        """Stop waiting until the script speaks."""
        if not self.is_given_up:
            self._given_up, self._silent_since = self._clock(), self._asked

    def resume(self) -> None:
        """Wait for the script again."""
        self._given_up = None

    def asks_for_time(self, link: Link) -> bool:
        """Return True if a script that was given up has asked for time since then."""
        return self._given_up is not None and link.time_asked_at > self._given_up

    def has_time(self, link: Link, *, can_act: bool) -> bool:
        """Return True if the world may wait for the script.

        Args:
            link: to the script.
            can_act: whether there is something to decide; a script that has nothing to decide, and
                asks for time all the same, keeps nobody waiting.
        """
        if self.is_given_up:
            return False
        since = max(self._asked, link.time_asked_at) if can_act else self._asked
        return self._clock() - since <= self.timeout_s

    def yields(self, link: Link) -> bool:
        """Return True if the script has asked for time for so long that others may go on."""
        return link.time_asked_at > self._asked and self._clock() - self._asked > YIELD_AFTER_S

    def wait_s(self, link: Link, *, can_act: bool, has_company: bool) -> float:
        """Return the time to wait for an answer now.

        Args:
            link: to the script.
            can_act: see :meth:`has_time`.
            has_company: whether there are other agents in the world.
        """
        if self.is_given_up:
            return 0.0
        if self._clock() - self._asked <= YIELD_AFTER_S:
            return WAIT_SLICE_S  # whatever the script said meanwhile
        if not self.has_time(link, can_act=can_act):
            return 0.0
        return YIELDING_WAIT_S if has_company and self.yields(link) else WAIT_SLICE_S
