"""With the bearing; it leaps when it sees the low wall right ahead."""

from typing import Any

from ai4u_edu import Percept
from tests.scenes.solvers import Driver
from tests.scenes.solvers.seek import seek


def solver() -> Driver:
    def drive(percept: Percept) -> dict[str, Any]:
        sine, cosine = (float(each) for each in percept["bearing"])
        codes, distances = percept["vision"][:, 1, 4]  # straight ahead, 10 degrees down
        wall = codes == 1.0 and distances * 15 < 1.8
        return seek(cosine, sine, leap=float(wall))

    return drive
