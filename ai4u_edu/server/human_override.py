"""Takes an agent out of its brain's hands, and gives it back."""

from collections.abc import Collection
from concurrent.futures import Future

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import Brain, NeuralNetController, ReplayController, ScriptController
from ai4u_edu.blocks.brains.remote import RemoteBrain
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server.bindings import acting, keyboard_brain, keys_of

RESTART = "restart"
"""What a person may ask for without driving."""

KINDS = {
    NeuralNetController: "A network",
    ReplayController: "A recording",
    ScriptController: "A script",
}


class Hands:
    """An agent whose brain gives way to a person, and comes back when that one lets go.

    Where the brain listens to keys itself there is nothing to do. A script on another machine keeps
    its place and goes on seeing what happens; only its actions are ignored meanwhile.

    Args:
        runner: changes brains, between two decisions.
        agent: which.
    """

    def __init__(self, runner: Runner, agent: BasicAgent) -> None:
        self._runner = runner
        self._agent = agent
        self._ours: Brain | None = None
        self._before: Brain | None = None
        self._is_made = False
        self._spare: tuple[Brain, Brain | None] | None = None
        self._under_way: Future[None] | None = None
        self._giving_back: Future[None] | None = None

    @property
    def brain(self) -> Brain:
        """The brain whose keys a page should know: the agent's, or the one that would take over."""
        agent = self._agent
        return acting(agent.brain) if keys_of(agent) else self._reserve() or agent.brain

    @property
    def others(self) -> str:
        """Who drives in place of a person, in words; empty if a person may just do it."""
        agent = self._agent
        return "" if keys_of(agent) else who(agent.brain)

    @property
    def instead(self) -> str:
        """Who would go on if the person let go, in words; empty if nobody would."""
        before = self._before
        return "" if before is None or acting(self._agent.brain) is not self._ours else who(before)

    def are_called_by(self, codes: Collection[str]) -> bool:
        """Whether keys mean that somebody wants to drive; to restart one doesn't have to."""
        if not self.others or self._reserve() is None:
            return bool(codes)
        means = keys_of(self._agent, self._reserve()).items()
        return any(code in codes for action, keys in means if action != RESTART for code in keys)

    def take(self) -> Future[None] | None:
        """Gives the agent a brain that listens to the keys; None if that isn't needed."""
        waits = self._under_way is not None and not self._under_way.done()
        if waits or not self.others or self._reserve() is None:
            return None
        self._under_way = self._runner.submit(self._take)
        return self._under_way

    def let_go(self) -> Future[None] | None:
        """Gives it back the brain that it had; None if that isn't needed."""
        if self._before is None and (self._under_way is None or self._under_way.done()):
            return None
        if self._giving_back is None or self._giving_back.done():
            self._giving_back = self._runner.submit(self._give_back)
        return self._giving_back

    def _reserve(self) -> Brain | None:
        """The brain with which a person could take over."""
        now = self._agent.brain
        if self._spare is None or self._spare[0] is not now:
            self._spare = now, keyboard_brain(self._agent)
        return self._spare[1]

    # in the runner's thread; meanwhile everything may have changed

    def _take(self) -> None:
        agent, spare = self._agent, self._reserve()
        if keys_of(agent) or spare is None or not self._is_here():
            return
        before = agent.brain
        self._is_made = not any(spare is brain for brain in agent.brains)
        if isinstance(before, RemoteBrain):
            before.begin_override(spare)
        else:
            agent.use_brain(spare)
        self._before, self._ours = before, spare

    def _give_back(self) -> None:
        agent, before, ours = self._agent, self._before, self._ours
        self._before = self._ours = None
        if before is None or acting(agent.brain) is not ours or not self._is_here():
            return
        agent.keyboard.release()
        if isinstance(before, RemoteBrain):
            before.end_override()
        else:
            agent.use_brain(before)
        if self._is_made:
            agent.brains[:] = [brain for brain in agent.brains if brain is not ours]

    def _is_here(self) -> bool:
        return any(agent is self._agent for agent in self._runner.sim.agents)


def who(brain: Brain) -> str:
    """What drives, as one calls it at the beginning of a sentence."""
    if isinstance(brain, RemoteBrain):
        return "A script elsewhere"
    controller = getattr(brain, "controller", brain)
    kinds = (name for kind, name in KINDS.items() if isinstance(controller, kind))
    return next(kinds, type(controller).__name__)
