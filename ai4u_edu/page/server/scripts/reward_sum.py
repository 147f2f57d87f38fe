"""The reward that a script has not been told yet."""

from ai4u_edu.blocks.brains.links.link import Observation


class RewardSum:
    """The reward of all decisions since the last percept that was sent, in total and by term."""

    def __init__(self) -> None:
        self.total = 0.0
        self.terms: dict[str, float] = {}
        self._counted = (0, 0)

    def add(self, observation: Observation) -> None:
        """Add the reward of a decision, once; a new episode begins at 0."""
        decision = (observation.episode, observation.steps)
        if decision == self._counted:
            return
        if observation.episode != self._counted[0]:
            self.clear()
        self._counted = decision
        self.total += observation.reward
        for name, amount in observation.terms.items():
            self.terms[name] = self.terms.get(name, 0.0) + amount

    def clear(self) -> None:
        """Begin at 0 again, after a percept was sent."""
        self.total, self.terms = 0.0, {}
