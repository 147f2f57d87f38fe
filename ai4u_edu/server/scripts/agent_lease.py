"""One agent's seat while a script has it."""

import asyncio
from collections.abc import Callable
from secrets import token_hex

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import AI4UError, NameNotFoundError, shorten
from ai4u_edu.blocks import Brain
from ai4u_edu.blocks.brains.links.link import LinkState
from ai4u_edu.blocks.brains.remote import RemoteBrain
from ai4u_edu.runtime.runner import ANOTHER_WORLD, Runner
from ai4u_edu.server.loop_queue import LoopQueue
from ai4u_edu.server.scripts.outbox import Line
from ai4u_edu.server.scripts.refusal import RefusalError
from ai4u_edu.server.scripts.session import Session
from ai4u_edu.server.scripts.settings import Rules
from ai4u_edu.server.scripts.welcome import Excerpt, output_of
from ai4u_edu.wire import native
from ai4u_edu.wire.validation import LONGEST_TEXT

BLINK = 0.3
"""Seconds for which a lost connection counts as a script that is late; then as one that is lost."""


class Seat:
    """One agent's seat while a script has it.

    Args:
        runner: the room's.
        agent: whose seat it is.
        hello: what the script wants.
        rules: of the room.
        post: of the room.
        on_left: called when the seat is free.
    """

    def __init__(
        self,
        runner: Runner,
        agent: BasicAgent,
        hello: native.Hello,
        rules: Rules,
        post: LoopQueue,
        on_left: Callable[["Seat"], None],
    ) -> None:
        self.agent = agent
        self.secret = hello.secret
        self._runner = runner
        self._hello = hello
        self._rules = rules
        self._on_left = on_left
        self._name = token_hex(4)
        self._on_missing = hello.on_missing or rules.on_missing
        self._timers: list[asyncio.TimerHandle] = []
        self.is_left = False
        """Whether the seat is free again."""
        self._brain: RemoteBrain | None = None
        self._before: Brain | None = None
        self.is_claimed = asyncio.Event()
        """Whether it is settled that the agent is the script's, or can't be."""
        alone = len(runner.sim.agents) == 1
        if hello.mode == "lockstep":
            _check_lockstep(rules, len(runner.sim.agents))
        self.session = Session(
            runner,
            self._taken_away,
            may_seed=alone or rules.seeded_resets,
            post=post,
        )
        self.welcome = b""

    @property
    def line(self) -> Line | None:
        """The connection; None while it is lost."""
        return self.session.line

    async def claim(self, title: str) -> None:
        """Takes the agent's brain's place.

        All that is said of the agent is looked up in the runner's thread, since somebody may change
        its blocks just now.

        Raises:
            RefusalError: it can't be taken.
        """

        def take() -> bytes:
            if not any(agent is self.agent for agent in self._runner.sim.agents):
                raise RefusalError("ended", ANOTHER_WORLD)  # since the script said hello
            try:
                self.session.excerpt = Excerpt(self.agent, self._hello.keys)
            except NameNotFoundError as error:
                raise RefusalError("unknown_key", str(error)) from None
            self._before = before = self.agent.brain
            self._brain = RemoteBrain.over(
                self.session,
                mode=self._hello.mode,
                receive_timeout=self._rules.receive_timeout,
                on_missing=self._on_missing or "hold",
                skip_frame=before.skip_frame,
                repeat_action=before.repeat_action,
            )
            self.agent.use_brain(self._brain)
            return self._welcome(title)

        try:
            self.welcome = await asyncio.wrap_future(self._runner.submit(take))
        except RefusalError as refusal:
            self.leave(str(refusal))
            raise
        except (AI4UError, asyncio.CancelledError) as error:
            self.leave("it could not be taken")
            raise RefusalError("ended", f"the agent can't be taken now ({error})") from None
        finally:
            self.is_claimed.set()

    def sit(self, line: Line) -> None:
        """The script is here, over this connection."""
        self._stop_timers()
        if self._brain is not None:
            self._brain.on_missing = self._on_missing or "hold"
        line.say(self.welcome)
        self.session.attach(line)

    def lose(self, line: Line) -> None:
        """A connection is lost; if it was the script's, the seat is kept for a while."""
        if self.session.line is not line or self.is_left:
            return
        self.session.detach()
        call_later = asyncio.get_running_loop().call_later
        self._timers = [
            call_later(BLINK, self._be_lost),
            call_later(self._rules.grace, self.leave, "the script did not come back"),
        ]

    def leave(self, reason: str) -> None:
        """The seat is free, and the agent goes back to the brain that it had before."""
        if self.is_left:
            return
        self.is_left = True
        self._stop_timers()
        if self.session.line is not None:
            self.session.line.end(native.PROBLEMS["ended"], reason)
        self._runner.submit(self._give_back)
        self._on_left(self)

    def _welcome(self, title: str) -> bytes:
        agent, settings = self.agent, self._runner.sim.world.settings
        return native.encode(
            native.Welcome(
                version=native.VERSION,
                session=self._name,
                grace=self._rules.grace,
                agent=agent.id,
                mode=self._hello.mode,
                title=shorten(title, LONGEST_TEXT),
                ticks_per_second=settings.ticks_per_second,
                skip_frame=agent.brain.skip_frame,
                repeat_action=agent.brain.repeat_action,
                max_steps=agent.max_steps_per_episode,
                rewards=tuple(reward.name for reward in agent.bound_blocks.rewards),
                success=self._runner.sim.success,
                readings=self.session.excerpt.readings,
                outputs=tuple(
                    output_of(name, each) for name, each in agent.bound_blocks.actuators.items()
                ),
            )
        )

    def _give_back(self) -> None:
        agent, brain, before = self.agent, self._brain, self._before
        if brain is None or before is None or agent not in self._runner.sim.agents:
            return  # it never had the agent, or another world runs by now
        if agent.brain is brain:
            agent.use_brain(before)
        agent.brains[:] = [each for each in agent.brains if each is not brain]

    def _taken_away(self, reason: str) -> None:
        """The brain was closed by somebody else: another took its place, or the world has ended."""
        if not self.is_left and self.session.line is not None:
            self.session.line.say(native.encode(native.Bye(reason)))
        self.leave(reason)

    def _be_lost(self) -> None:
        self.session.reason = "the script's connection is lost"
        if self._hello.mode == "realtime":  # in lockstep the world waits for it to come back
            self.session.state = LinkState.LOST
        if self._brain is not None:
            # nobody knows what it would do now
            self._brain.on_missing = self._on_missing or "stop"

    def _stop_timers(self) -> None:
        for timer in self._timers:
            timer.cancel()
        self._timers.clear()


def _check_lockstep(rules: Rules, agents: int) -> None:
    """Raise a RefusalError if the world may not wait for a script."""
    if rules.lockstep or (rules.lockstep is None and agents == 1):
        return
    wait = "the world wait" if agents == 1 else f"all {agents} agents of this world wait"
    raise RefusalError(
        "lockstep_refused",
        f"expected mode='realtime' (ai4u-edu bridge --realtime), got 'lockstep', in which a script "
        f"has {wait} for it; whoever runs the world has to allow that (ai4u-edu play --lockstep)",
    )
