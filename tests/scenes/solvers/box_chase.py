"""With a cosine alone: turns until it is large, then drives."""

from typing import Any

from ai4u_edu import Percept
from tests.scenes.solvers import Driver


def solver() -> Driver:
    def drive(percept: Percept) -> dict[str, Any]:
        cosine = percept["orientation"][0]
        return {"move": [1.0, 0, 0, 0] if cosine > 0.99 else [0, 0.2, 0, 0]}

    return drive
