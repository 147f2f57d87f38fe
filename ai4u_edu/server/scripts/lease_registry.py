"""Which script has which agent."""

from collections.abc import Callable

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import suggest
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server.loop_queue import LoopQueue, queue_here
from ai4u_edu.server.scripts.agent_lease import Seat
from ai4u_edu.server.scripts.outbox import Line
from ai4u_edu.server.scripts.refusal import RefusalError, wrong_version
from ai4u_edu.server.scripts.settings import Rules
from ai4u_edu.server.token_auth import is_same_secret
from ai4u_edu.wire import native

SHORTEST_SECRET = 16
"""Characters."""


class Seats:
    """The agents of a room, and the scripts that have them. Belongs to the server's loop.

    Args:
        runner: the room's.
        title: tells the room's, which may change.
        rules: of the room.
    """

    def __init__(self, runner: Runner, title: Callable[[], str], rules: Rules) -> None:
        self._runner = runner
        self._title = title
        self._rules = rules
        self._seats: dict[str, Seat] = {}
        self._post: LoopQueue | None = None

    async def enter(self, hello: native.Hello, line: Line) -> Seat:
        """Gives a script the agent that it wants, or the session back that it had.

        Raises:
            RefusalError: it can't be.
        """
        self._check(hello)
        agent = self._agent(hello.agent)
        seat = self._seats.get(agent.id)
        if seat is not None and is_same_secret(seat.secret, hello.secret):
            await seat.is_claimed.wait()
            if seat.is_left:
                raise RefusalError("ended", f"agent {agent.id!r} could not be taken; connect anew")
            if seat.line is not None and seat.line is not line:
                seat.line.end_by("taken_over", "the session goes on over another connection")
        elif hello.session:
            raise RefusalError(
                "session_over",
                f"session {hello.session!r} of agent {agent.id!r} is over; connect anew",
            )
        elif seat is not None:
            raise RefusalError("agent_taken", self._taken(agent))
        else:
            self._post = queue_here(self._post)
            seat = Seat(self._runner, agent, hello, self._rules, self._post, self._left)
            self._seats[agent.id] = seat
            await seat.claim(self._title())
        seat.sit(line)
        return seat

    def _check(self, hello: native.Hello) -> None:
        if hello.version != native.VERSION:
            raise RefusalError("version", wrong_version(f"version {native.VERSION}", hello.version))
        if self._rules.token and not is_same_secret(self._rules.token, hello.token):
            got = "another one" if hello.token else "none"
            raise RefusalError(
                "bad_token",
                f"expected this world's token, got {got}; take the whole address that its terminal "
                "shows, as in connect('http://teacher:8080/?token=...')",
            )
        if len(hello.secret) < SHORTEST_SECRET:
            raise RefusalError(
                "malformed",
                f"secret: expected at least {SHORTEST_SECRET} characters, got {len(hello.secret)}",
            )

    def _left(self, seat: Seat) -> None:
        if self._seats.get(seat.agent.id) is seat:
            del self._seats[seat.agent.id]

    def _agent(self, agent_id: str) -> BasicAgent:
        agents = self._runner.sim.agents
        if not agent_id and len(agents) == 1:
            return agents[0]
        for agent in agents:
            if agent.id == agent_id:
                return agent
        known = [agent.id for agent in agents]
        asked = f"no agent has the id {agent_id!r}" if agent_id else "which agent? none was named"
        raise RefusalError("unknown_agent", f"{asked}; {suggest(agent_id, known)}")

    def _taken(self, agent: BasicAgent) -> str:
        free = [each.id for each in self._runner.sim.agents if each.id not in self._seats]
        others = f"free are {', '.join(map(repr, free))}" if free else "no other is free"
        return (
            f"agent {agent.id!r} is driven by another script; {others}; a seat is free "
            f"{self._rules.grace:g} s after its script has ended"
        )
