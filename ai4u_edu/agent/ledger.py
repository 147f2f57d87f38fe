"""Who paid what: the reward of a decision and of an episode, by named term."""

HANDLERS = "handlers"
"""The term under which ``agent.add_reward`` books what is given no other name."""


class Ledger:
    """The breakdown of rewards.

    Attributes:
        terms: by name, what was paid in the last decision.
        episode_terms: by name, what was paid in this episode.
        total: of the last decision.
        episode_total: of this episode.

    >>> ledger = Ledger()
    >>> ledger.pay("touch", 100.0); ledger.pay("step", -0.5)
    >>> ledger.total, ledger.terms
    (99.5, {'touch': 100.0, 'step': -0.5})
    >>> ledger.open()
    >>> ledger.total, ledger.episode_total
    (0.0, 99.5)
    """

    def __init__(self) -> None:
        self.terms: dict[str, float] = {}
        self.episode_terms: dict[str, float] = {}
        self.total = 0.0
        self.episode_total = 0.0

    def open(self) -> None:
        """A decision begins: nothing is paid for it yet."""
        self.terms = {}
        self.total = 0.0

    def pay(self, name: str, amount: float) -> None:
        """Books an amount under a name."""
        terms, episode_terms = self.terms, self.episode_terms
        terms[name] = terms.get(name, 0.0) + amount
        episode_terms[name] = episode_terms.get(name, 0.0) + amount
        self.total += amount
        self.episode_total += amount

    def clear(self) -> None:
        """An episode begins."""
        self.open()
        self.episode_terms = {}
        self.episode_total = 0.0
