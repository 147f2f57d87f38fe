"""The leases of a room's agents to scripts, at most one an agent."""

import asyncio
from collections.abc import Callable
from secrets import token_hex

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import AI4UError, NameNotFoundError, shorten, suggest, text_of
from ai4u_edu.blocks import Brain
from ai4u_edu.blocks.brains.remote import RemoteBrain
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext
from ai4u_edu.page.server.loop_queue import LoopQueue, queue_here
from ai4u_edu.page.server.scripts.outbox import Outbox
from ai4u_edu.page.server.scripts.report import ScriptLog
from ai4u_edu.page.server.scripts.session import Session
from ai4u_edu.page.server.scripts.settings import Rules
from ai4u_edu.page.server.scripts.welcome import ObservationSubset, output_of
from ai4u_edu.page.server.token_auth import is_same_secret
from ai4u_edu.runtime.runner import WORLD_REPLACED, Runner
from ai4u_edu.wire import native
from ai4u_edu.wire.validation import MAX_TEXT_CHARS

MIN_SECRET_CHARS = 16
SHORT_DROP_S = 0.3
"""Time for which a script whose connection is lost counts as late; after that it counts as lost."""


class RefusalError(Exception):
    """A script does not get the agent that it asked for.

    Attributes:
        code: one of :data:`ai4u_edu.wire.native.PROBLEMS`.
    """

    def __init__(self, code: str, text: str) -> None:
        super().__init__(text)
        self.code = code


class AgentLease:
    """The lease of one agent to one script: from its hello until it leaves, or stays away too long.

    Only the server's event loop calls its methods; what changes the agent is submitted to the
    runner's thread.

    Args:
        runner: the room's.
        agent: the agent that the script drives.
        hello: the script's request.
        rules: of the room.
        queue: of calls for the event loop, shared by the room.
        report: of what happens with the script.
        on_released: called when the lease has ended.
    """

    def __init__(
        self,
        runner: Runner,
        agent: BasicAgent,
        hello: native.Hello,
        rules: Rules,
        queue: LoopQueue,
        report: ScriptLog,
        on_released: Callable[["AgentLease"], None],
    ) -> None:
        self.agent = agent
        self.secret = hello.secret
        self._runner = runner
        self._hello = hello
        self._rules = rules
        self._report = report
        self._on_released = on_released
        self._name = token_hex(4)
        self._on_missing = hello.on_missing or rules.on_missing
        self._timers: list[asyncio.TimerHandle] = []
        self.is_released = False
        self._is_lost = False
        """The script's connection is lost for more than a moment."""
        self._brain: RemoteBrain | None = None
        self._before: Brain | None = None
        self.claimed = asyncio.Event()
        """Set as soon as the script has the agent, or can't have it."""
        is_only_agent = len(runner.sim.agents) == 1
        if hello.mode == "lockstep":
            _check_lockstep(rules, len(runner.sim.agents))
        self.session = Session(
            runner,
            self._on_brain_closed,
            may_seed=is_only_agent or rules.seeded_resets,
            queue=queue,
            report_mistake=self._report_mistake,
        )
        self.welcome = b""

    @property
    def outbox(self) -> Outbox | None:
        """The connection; None while it is lost."""
        return self.session.outbox

    async def claim(self, title: str) -> None:
        """Put a remote brain in the place of the agent's brain.

        Everything that the script is told about the agent is read in the runner's thread, since
        others may be changing its blocks.

        Raises:
            RefusalError: the agent can't be claimed.
        """
        try:
            self.welcome = await asyncio.wrap_future(
                self._runner.submit(lambda: self._install_brain(title))
            )
        except RefusalError as refusal:
            self.release(text_of(refusal))
            raise
        except (AI4UError, asyncio.CancelledError) as error:
            self.release(_("it could not be taken"))
            raise RefusalError(
                "ended", _("the agent can't be taken now ({error})", error=text_of(error))
            ) from None
        finally:
            self.claimed.set()
        self._report.note_event(
            _("a script drives agent {id!r} ({mode})", id=self.agent.id, mode=self._hello.mode)
        )

    def attach(self, outbox: Outbox) -> None:
        """Use this connection to the script from now on."""
        self._stop_timers()
        if self._is_lost:
            self._is_lost = False
            self._report.note_event(_("the script of agent {id!r} is back", id=self.agent.id))
        if self._brain is not None:
            self._brain.on_missing = self._on_missing or "hold"
        outbox.send(self.welcome)
        self.session.attach(outbox)

    def detach(self, outbox: Outbox) -> None:
        """Note that a connection is lost; if it was the current one, wait for the script."""
        if self.session.outbox is not outbox or self.is_released:
            return
        self.session.detach()
        call_later = asyncio.get_running_loop().call_later
        self._timers = [
            call_later(SHORT_DROP_S, self._mark_lost),
            call_later(self._rules.grace, self.release, _("the script did not come back")),
        ]

    def release(self, reason: str) -> None:
        """End the lease, and give the agent back to the brain that it had before."""
        if self.is_released:
            return
        self.is_released = True
        self._stop_timers()
        if self.session.outbox is not None:
            self.session.outbox.close(native.PROBLEMS["ended"], reason)
        self._runner.submit(self._restore_brain)
        self._on_released(self)
        if self._brain is not None:
            self._report.note_event(
                _("the script of agent {id!r} has left: {reason}", id=self.agent.id, reason=reason)
            )

    # -- in the runner's thread ------------------------------------------------------------------

    def _install_brain(self, title: str) -> bytes:
        """Give the agent a remote brain, and return the script's welcome."""
        if not any(agent is self.agent for agent in self._runner.sim.agents):
            raise RefusalError("ended", WORLD_REPLACED)  # since the script said hello
        try:
            self.session.subset = ObservationSubset(self.agent, self._hello.keys)
        except NameNotFoundError as error:
            raise RefusalError("unknown_key", text_of(error)) from None
        self._before = before = self.agent.brain
        self._brain = RemoteBrain.with_link(
            self.session,
            mode=self._hello.mode,
            receive_timeout=self._rules.receive_timeout,
            on_missing=self._on_missing or "hold",
            skip_frame=before.skip_frame,
            repeat_action=before.repeat_action,
        )
        self.agent.use_brain(self._brain)
        return self._encode_welcome(title)

    def _encode_welcome(self, title: str) -> bytes:
        agent, settings = self.agent, self._runner.sim.world.settings
        return native.encode(
            native.Welcome(
                version=native.VERSION,
                session=self._name,
                grace=self._rules.grace,
                agent=agent.id,
                mode=self._hello.mode,
                title=shorten(title, MAX_TEXT_CHARS),
                ticks_per_second=settings.ticks_per_second,
                skip_frame=agent.brain.skip_frame,
                repeat_action=agent.brain.repeat_action,
                max_steps=agent.max_steps_per_episode,
                rewards=tuple(reward.name for reward in agent.bound_blocks.rewards),
                success=self._runner.sim.success,
                readings=self.session.subset.readings,
                outputs=tuple(
                    output_of(name, each) for name, each in agent.bound_blocks.actuators.items()
                ),
                fields=tuple(each.perception_key for each in agent.bound_blocks.array_sensors()),
            )
        )

    def _restore_brain(self) -> None:
        agent, brain, before = self.agent, self._brain, self._before
        if brain is None or before is None or agent not in self._runner.sim.agents:
            return  # the agent was never claimed, or another world runs by now
        if agent.brain is brain:
            agent.use_brain(before)
        agent.brains[:] = [each for each in agent.brains if each is not brain]

    # -- events ----------------------------------------------------------------------------------

    def _on_brain_closed(self, reason: str) -> None:
        """Release the agent after another brain took its place, or the world ended."""
        if not self.is_released and self.session.outbox is not None:
            self.session.outbox.send_bye(reason)
        self.release(reason)

    def _mark_lost(self) -> None:
        # first, since whoever sees that the script is lost may rely on it
        if self._brain is not None:
            self._brain.on_missing = self._on_missing or "stop"  # nobody supervises the last action
        self._is_lost = True
        kept = _("the agent is kept for it for {grace:g} s", grace=self._rules.grace)
        self._report.note_event(
            _("the script of agent {id!r} is lost; {kept}", id=self.agent.id, kept=kept)
        )
        is_waited_for = self._hello.mode == "lockstep"
        reason = _("the script's connection is lost; {kept}", kept=kept)
        self.session.mark_lost(reason, is_waited_for=is_waited_for)

    def _report_mistake(self, reason: str) -> None:
        script = _("the script of agent {id!r}", id=self.agent.id)
        self._report.note_mistake(
            self.agent.id,
            _("{script} sent what has no effect: {reason}", script=script, reason=reason),
        )

    def _stop_timers(self) -> None:
        for timer in self._timers:
            timer.cancel()
        self._timers.clear()


def _check_lockstep(rules: Rules, agents: int) -> None:
    """Raise a RefusalError if the world may not wait for a script."""
    if rules.lockstep or (rules.lockstep is None and agents == 1):
        return
    text = ngettext(
        "expected mode='realtime' (ai4u-edu bridge --realtime), got 'lockstep', in which a script "
        "has the world wait for it; whoever runs the world has to allow that "
        "(ai4u-edu play --lockstep)",
        "expected mode='realtime' (ai4u-edu bridge --realtime), got 'lockstep', in which a script "
        "has all {n} agents of this world wait for it; whoever runs the world has to allow that "
        "(ai4u-edu play --lockstep)",
        agents,
    )
    raise RefusalError("lockstep_refused", text)


class LeaseRegistry:
    """The leases of a room's agents, at most one an agent. Only the server's event loop calls it.

    Args:
        runner: the room's.
        title: returns the room's title, which may change.
        rules: of the room.
        report: of what happens with scripts.
    """

    def __init__(
        self, runner: Runner, title: Callable[[], str], rules: Rules, report: ScriptLog
    ) -> None:
        self._report = report
        self._runner = runner
        self._title = title
        self._rules = rules
        self._leases: dict[str, AgentLease] = {}
        self._queue: LoopQueue | None = None

    async def acquire(
        self, hello: native.Hello, outbox: Outbox, *, is_authenticated: bool = False
    ) -> AgentLease:
        """Lease the agent that a script asks for, or resume the session that it had.

        Args:
            hello: the script's.
            outbox: of its connection.
            is_authenticated: True if the handshake had the room's token.

        Raises:
            RefusalError: the script can't have the agent.
        """
        self._check(hello, is_authenticated)
        agent = self._agent(hello.agent)
        lease = self._leases.get(agent.id)
        if lease is not None and is_same_secret(lease.secret, hello.secret):
            await self._take_over(lease, outbox)
        elif hello.session:
            raise RefusalError(
                "session_over",
                _(
                    "session {session!r} of agent {agent!r} is over; connect again",
                    session=hello.session,
                    agent=agent.id,
                ),
            )
        elif lease is not None:
            raise RefusalError("agent_taken", self._taken(agent))
        else:
            self._queue = queue_here(self._queue)
            lease = AgentLease(
                self._runner, agent, hello, self._rules, self._queue, self._report, self._remove
            )
            self._leases[agent.id] = lease
            await lease.claim(self._title())
        lease.attach(outbox)
        return lease

    async def _take_over(self, lease: AgentLease, outbox: Outbox) -> None:
        """Close the connection that a session had before, for a new one."""
        await lease.claimed.wait()
        if lease.is_released:
            agent = lease.agent.id
            text = _("agent {agent!r} could not be taken; connect again", agent=agent)
            raise RefusalError("ended", text)
        if lease.outbox is not None and lease.outbox is not outbox:
            text = _("the session goes on over another connection")
            lease.outbox.close_with_problem("taken_over", text)

    def _check(self, hello: native.Hello, is_authenticated: bool) -> None:
        if hello.version != native.VERSION:
            expected = _("version {n}", n=native.VERSION)
            raise RefusalError("version", wrong_version(expected, str(hello.version)))
        is_known = is_authenticated or is_same_secret(self._rules.token, hello.token)
        if self._rules.token and not is_known:
            got = _("another one") if hello.token else _("none")
            raise RefusalError(
                "bad_token",
                _(
                    "expected this world's token, got {got}; take the whole address that its "
                    "terminal shows, as in connect('http://teacher:8080/?token=...')",
                    got=got,
                ),
            )
        if len(hello.secret) < MIN_SECRET_CHARS:
            raise RefusalError(
                "malformed",
                _(
                    "secret: expected at least {least} characters, got {got}",
                    least=MIN_SECRET_CHARS,
                    got=len(hello.secret),
                ),
            )

    def _remove(self, lease: AgentLease) -> None:
        if self._leases.get(lease.agent.id) is lease:
            del self._leases[lease.agent.id]

    def _agent(self, agent_id: str) -> BasicAgent:
        agents = self._runner.sim.agents
        if not agent_id and len(agents) == 1:
            return agents[0]
        for agent in agents:
            if agent.id == agent_id:
                return agent
        known = [agent.id for agent in agents]
        hint = suggest(agent_id, known)
        text = _("which agent? none was named; {hint}", hint=hint)
        if agent_id:
            text = _("no agent has the id {id!r}; {hint}", id=agent_id, hint=hint)
        raise RefusalError("unknown_agent", text)

    def _taken(self, agent: BasicAgent) -> str:
        """Return the text for a script whose agent another one has."""
        free = [each.id for each in self._runner.sim.agents if each.id not in self._leases]
        others = _("no other is free")
        if free:
            others = _("free are {names}", names=", ".join(map(repr, free)))
        return _(
            "agent {agent!r} is driven by another script; {others}; an agent is free when its "
            "script ends, or {seconds} s after the connection is lost",
            agent=agent.id,
            others=others,
            seconds=f"{self._rules.grace:g}",
        )


def wrong_version(expected: str, got: str) -> str:
    """Return the text for a script whose version of the protocol is another one."""
    return _(
        "expected {expected}, got {got}; install the ai4u-edu that the world has "
        "(pip install -U ai4u-edu, on both machines)",
        expected=expected,
        got=got,
    )
