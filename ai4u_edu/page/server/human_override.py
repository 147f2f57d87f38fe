"""Override of an agent's brain by a person at the keyboard."""

from collections.abc import Collection
from concurrent.futures import Future

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.driving_keys import RESTART, active_brain, keys_of
from ai4u_edu.blocks import Brain
from ai4u_edu.blocks.brains.remote import RemoteBrain
from ai4u_edu.page.server.bindings import keyboard_brain
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot.agent_words import driver_title, is_network


class HumanOverride:
    """Replacement of an agent's brain by one that listens to the keyboard, until it is ended.

    There is nothing to replace if the brain listens to keys itself. A script on another machine
    stays connected and keeps receiving percepts; its actions are ignored meanwhile.

    The event loop calls all public methods; brains are replaced in the runner's thread.

    Args:
        runner: replaces brains between two decisions.
        agent: the agent to drive.
    """

    def __init__(self, runner: Runner, agent: BasicAgent) -> None:
        self._runner = runner
        self._agent = agent
        self._replacement: Brain | None = None
        self._original: Brain | None = None
        self._is_new = False
        self._cached: tuple[Brain, Brain | None] | None = None
        self._beginning: Future[None] | None = None
        self._ending: Future[None] | None = None

    @property
    def brain(self) -> Brain:
        """The brain whose keys a page shows: the agent's, or the one that would replace it."""
        agent = self._agent
        return active_brain(agent.brain) if keys_of(agent) else self._candidate() or agent.brain

    @property
    def current_driver(self) -> str:
        """Title of the driver that a person would replace; empty if a person drives directly."""
        agent = self._agent
        return "" if keys_of(agent) else driver_title(agent.brain)

    @property
    def is_network(self) -> bool:
        """True if a network drives the agent."""
        return is_network(self._agent.brain)

    @property
    def next_driver(self) -> str:
        """Title of the driver that continues when the override ends; empty if there is none."""
        original = self._original
        is_over = active_brain(self._agent.brain) is not self._replacement
        return (
            "" if original is None or is_over or self._is_gone(original) else driver_title(original)
        )

    def is_requested_by(self, codes: Collection[str]) -> bool:
        """Return True if one of these keys asks for control; the key to restart does not."""
        if not self.current_driver or self._candidate() is None:
            return bool(codes)
        actions = keys_of(self._agent, self._candidate()).items()
        return any(code in codes for action, keys in actions if action != RESTART for code in keys)

    def begin(self) -> Future[None] | None:
        """Give the agent a brain that listens to the keys; None if it needs none."""
        is_beginning = self._beginning is not None and not self._beginning.done()
        if is_beginning or not self.current_driver or self._candidate() is None:
            return None
        self._beginning = self._runner.submit(self._begin)
        return self._beginning

    def end(self) -> Future[None] | None:
        """Give the agent its own brain back; None if it has it."""
        if self._original is None and (self._beginning is None or self._beginning.done()):
            return None
        if self._ending is None or self._ending.done():
            self._ending = self._runner.submit(self._end)
        return self._ending

    def _candidate(self) -> Brain | None:
        """Return the brain with which a person could take over, made once for each brain."""
        now = self._agent.brain
        if self._cached is None or self._cached[0] is not now:
            self._cached = now, keyboard_brain(self._agent)
        return self._cached[1]

    # in the runner's thread; everything may have changed since the call was submitted

    def _begin(self) -> None:
        agent, replacement = self._agent, self._candidate()
        if keys_of(agent) or replacement is None or not self._is_in_world():
            return
        original = agent.brain
        self._is_new = not any(replacement is brain for brain in agent.brains)
        if isinstance(original, RemoteBrain):
            original.begin_override(replacement)
        else:
            agent.use_brain(replacement)
        self._original, self._replacement = original, replacement

    def _end(self) -> None:
        agent, original, replacement = self._agent, self._original, self._replacement
        self._original = self._replacement = None
        if original is None or active_brain(agent.brain) is not replacement:
            return
        if not self._is_in_world() or self._is_gone(original):
            return
        agent.keyboard.release()
        if isinstance(original, RemoteBrain):
            original.end_override()
        else:
            agent.use_brain(original)
        if self._is_new:
            agent.brains[:] = [brain for brain in agent.brains if brain is not replacement]

    def _is_gone(self, brain: Brain) -> bool:
        """Return True for a brain that was taken from the agent while the person drove."""
        return not any(brain is each for each in self._agent.brains)

    def _is_in_world(self) -> bool:
        return any(agent is self._agent for agent in self._runner.sim.agents)
