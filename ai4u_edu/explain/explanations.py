"""Everything that explains the agents of one running world."""

from dataclasses import dataclass

from ai4u_edu.explain.elsewhere import PoseTrial
from ai4u_edu.explain.live import LiveExplainer
from ai4u_edu.explain.live_maps import LiveMaps


@dataclass(frozen=True)
class Explanations:
    """Everything that explains the agents of one running world, beside its ticks.

    Any thread may call its parts. They work in threads of their own while somebody asks.
    """

    explainer: LiveExplainer
    """Explains the agents' latest actions."""
    maps: LiveMaps
    """Computes their actions and values all over the floor."""
    pose_trial: PoseTrial
    """Tries an agent at another place."""

    def stop(self) -> None:
        """End the threads; they are not waited for, as a student's function may not return."""
        self.explainer.stop()
        self.maps.stop()
