"""Warnings of environments, given once each through Gymnasium's logger."""

from collections.abc import Sequence
from functools import partial

from gymnasium import logger

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import Actuator
from ai4u_edu.learn.envs.element_names import labels_of_action
from ai4u_edu.learn.envs.spaces_of import outputs_of
from ai4u_edu.locale import gettext as _


def warn_of_default_agent(scene: str, ids: Sequence[str]) -> None:
    """Warn that nobody chose which of several agents learns.

    Args:
        scene: the scene's name.
        ids: the agents' ids; the first one learns.
    """
    logger.warn(
        "%s",
        _(
            "scene {scene!r} has several agents ({ids}), and this environment controls "
            "{ids2!r}, the one that acts first; choose with agent={ids3!r}, or control "
            "all of them with ai4u_edu.learn.envs.parallel_env({scene!r})",
            scene=scene,
            ids=", ".join(ids),
            ids2=ids[0],
            ids3=ids[-1],
        ),
    )


class RangeWarning:
    """Warning that an action was out of range and clipped; an environment gives it once."""

    def __init__(self) -> None:
        self.is_given = False

    def watch(self, agent: BasicAgent) -> None:
        """Warn when an action of this agent is clipped."""
        for actuator in outputs_of(agent).values():
            actuator.on_clip = partial(self._warn, actuator)

    def _warn(self, actuator: Actuator, given: Sequence[float], clipped: Sequence[float]) -> None:
        if self.is_given:
            return
        self.is_given = True
        names = [name for name, _ in labels_of_action(actuator)]
        for name, value, cut, low, high in zip(
            names, given, clipped, *actuator.limits(), strict=True
        ):
            if value != cut:
                logger.warn(
                    "%s",
                    _(
                        "action {action_name!r}: expected {name} from {low:g} to {high:g}, got "
                        "{value:g}, which was clipped to {cut:g}; further actions out of range are "
                        "clipped without a warning",
                        action_name=actuator.action_name,
                        name=name,
                        low=low,
                        high=high,
                        value=value,
                        cut=cut,
                    ),
                )
                return
