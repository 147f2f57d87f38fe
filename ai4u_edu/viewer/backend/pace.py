"""How soon the next picture comes: ticks and scripts go before pictures."""

QUICK = 75.0
"""Pictures a second where there are few pages and the machine has time: more than the world has
ticks, since a bit early is better than a tick late."""
CALM = 30.0
"""Pictures a second that do as well, where there is much else to do."""
LEAST = 25.0
"""Pictures a second below which it is better that they take more of the time."""
FEW, MANY = 8, 24
"""Pages up to which there are quick pictures, and from which on there are calm ones."""
LATE = 0.004
"""Ticks that are so late (s) tell of too much to do..."""
HEAVY = 0.002
"""... and pictures that take so long (s) have a part in it; lighter ones would only be missed."""
RISE, FALL = 0.1, 0.01
"""What a picture with late ticks, and one without, changes in how calm it gets: slower back."""
SHARE = 0.3
"""Of the processor's time that goes into drawing at most, as long as there are enough pictures."""


class Pace:
    """Quick pictures when it is quiet, calm ones when there are many pages or ticks are late.

    >>> pace = Pace()
    >>> round(1 / pace.period(pages=1, late=0.0, spent=0.001))
    75
    >>> round(1 / pace.period(pages=60, late=0.0, spent=0.001))
    30
    >>> round(1 / pace.period(pages=60, late=0.0, spent=0.03))
    25
    """

    def __init__(self) -> None:
        self._strain = 0.0

    def period(self, *, pages: int, late: float, spent: float) -> float:
        """Seconds from this picture to the next one, at least.

        Args:
            pages: so many look on.
            late: how late (s) ticks lately began.
            spent: seconds of the processor's time that this picture took.
        """
        is_too_much = late > LATE and spent > HEAVY
        strained = self._strain + (RISE if is_too_much else -FALL)
        self._strain = min(max(strained, 0.0), 1.0)
        crowd = min(max((pages - FEW) / (MANY - FEW), 0.0), 1.0)
        calm = max(crowd, self._strain)
        period = (1 - calm) / QUICK + calm / CALM
        return max(period, min(spent / SHARE, 1 / LEAST))
