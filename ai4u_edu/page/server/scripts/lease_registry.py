"""The leases of a room's agents to scripts."""

from collections.abc import Callable

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import suggest
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.loop_queue import LoopQueue, queue_here
from ai4u_edu.page.server.scripts.agent_lease import AgentLease, RefusalError
from ai4u_edu.page.server.scripts.outbox import Outbox
from ai4u_edu.page.server.scripts.report import ScriptLog
from ai4u_edu.page.server.scripts.settings import Rules
from ai4u_edu.page.server.token_auth import is_same_secret
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire import native

MIN_SECRET_CHARS = 16


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
