"""The base of actuators whose action is one choice out of a few."""

from typing import Any

from ai4u_edu.base.errors import ActionError, shown
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.locale import gettext as _


class ChoiceActuator(Actuator):
    """The base of actuators with a Discrete space: an invalid choice is refused, never clipped."""

    abstract = True
    is_continuous = False

    def accept(self, values: Any) -> tuple[float, ...]:
        """Check a choice.

        Raises:
            ActionError: it is not in the space.
        """
        last = int(self._limits[0][1])
        try:
            numbers = self._numbers(values)
        except ActionError:
            numbers = ()
        if len(numbers) != 1 or numbers[0] not in range(last + 1):
            raise ActionError(
                _(
                    "action {action_name!r}: expected a whole number from 0 to {last}, got {got}",
                    action_name=self.action_name,
                    last=last,
                    got=shown(values),
                )
            )
        return numbers
