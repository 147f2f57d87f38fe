"""Easy starts: learn near the goal first, then farther and farther away from it.

Before: :mod:`~ai4u_edu.learn.small.ppo`. New here is where episodes begin. Whoever only tries
things out at random must reach the goal by chance once, to be paid for it. Far from the goal that
may never happen; near it, it happens soon. So a scene may name ranges of easy starts
(``curriculum:``) beside those of all its starts (``random:``). A training begins with the easy
ones. As soon as four of five of the latest 50 episodes have reached the goal, the ranges widen a
bit towards those of all starts, and the count begins again.

Only what learns sees easy starts: in its checks, in play and in tests all of them count.

>>> from ai4u_edu import Scene
>>> starts = EasyStarts.of(Scene.load("push_block"))
>>> starts.options["bodies.block.random.x"]
[-0.4, 0.4]
>>> for _ in range(EPISODES):
...     starts.note(True)
>>> round(starts.share, 1), [round(end, 2) for end in starts.options["bodies.block.random.x"]]
(0.1, [-0.51, 0.51])

Source: Y. Bengio et al., Curriculum Learning, ICML 2009; widening by the share of successes: I.
Akkaya et al., Solving Rubik's Cube with a Robot Hand, arXiv:1910.07113, 2019.
"""

from collections import deque
from collections.abc import Mapping
from typing import Any

from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.description import THINGS

EPISODES = 50
"""Latest episodes that count."""
ENOUGH = 40
"""Episodes among them that must have reached the goal: 80%."""
STEPS = 10
"""Times that the ranges widen until all starts are in them."""


class EasyStarts:
    """Starts of a training in a scene with a curriculum.

    Args:
        scene: has one, and a goal.

    Attributes:
        share: way from the easy starts, 0, to all starts, 1.
        options: of the next episode's reset; empty for all starts.
    """

    def __init__(self, scene: Scene) -> None:
        self._things = [
            (f"{kind}.{thing.name}.random", thing)
            for kind in THINGS
            for thing in getattr(scene.description, kind)
            if thing.curriculum is not None
        ]
        self._latest = deque[bool](maxlen=EPISODES)
        self.share = 0.0
        self.options: dict[str, Any] = {}
        self._widen_to(0)

    @classmethod
    def of(cls, scene: Scene) -> "EasyStarts | None":
        """Return the starts of a scene; None if it has no curriculum."""
        has_one = any(thing.curriculum is not None for thing in scene.description.things)
        return cls(scene) if has_one and scene.description.success is not None else None

    def note(self, has_succeeded: bool) -> None:
        """Note how an episode ended, and widen the ranges if it is time."""
        self._latest.append(has_succeeded)
        if self.share < 1.0 and self._latest.count(True) >= ENOUGH:
            self._latest.clear()
            self._widen_to(round(self.share * STEPS) + 1)

    def state(self) -> dict[str, Any]:
        """Return the share and the latest episodes as plain data."""
        return {"share": self.share, "latest": [*self._latest]}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Restore what :meth:`state` gave."""
        self._latest.extend(map(bool, state["latest"]))
        self._widen_to(round(float(state["share"]) * STEPS))

    def _widen_to(self, steps: int) -> None:
        self.share = steps / STEPS
        self.options = {}
        if steps < STEPS:
            for prefix, thing in self._things:
                for name, ends in thing.curriculum.widened(thing.random, self.share).items():
                    self.options[f"{prefix}.{name}"] = list(ends)
