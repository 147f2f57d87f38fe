"""A controller that calls its partner, and goes where its partner calls it."""

from typing import Annotated

from ai4u_edu.base.parameters import quantity
from ai4u_edu.blocks.brains.brain import Answer
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.percept import Percept


class CallController(Controller):
    """Calls while its partner faces the partner's goal, and drives ahead while it hears a call.

    It turns on the spot while it hears nothing, and stays once it is at its own goal. It needs
    three sensors, named by their perception keys: ``partner``, an OrientationSensor whose
    ``reference`` is the partner's body; ``hear``, a HearSensor; ``goal``, a TouchSensor.

    Source: ours.
    """

    actuator_name: str = "move"
    """Action name of its RBMoveActuator."""
    voice: str = "speak"
    """Action name of its SpeakActuator with ``size`` 0."""
    partner: str = "partner"
    """Perception key of an OrientationSensor of the partner's goal, as the partner sees it."""
    hear: str = "hear"
    """Perception key of a HearSensor."""
    goal: str = "goal"
    """Perception key of a TouchSensor of its own goal."""
    facing: Annotated[float, quantity("1", ge=-1, le=1)] = 0.97
    """Cosine of the angle between the partner's heading and its goal above which it calls."""

    def get_action(self, percept: Percept) -> Answer:
        """Return the action, and whether it calls."""
        is_there, is_called = percept[self.goal][0] > 0, percept[self.hear][0] > 0
        ahead = 1.0 if is_called and not is_there else 0.0
        turn = 0.0 if is_called or is_there else -0.5
        return {
            self.actuator_name: (ahead, turn, 0.0, 0.0),
            self.voice: (float(percept[self.partner][0] > self.facing),),
        }
