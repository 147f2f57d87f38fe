"""A remote agent as a Gymnasium environment."""

from typing import Any

import gymnasium
import numpy as np

from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.seeding import checked_seed
from ai4u_edu.locale import gettext as _
from ai4u_edu.remote.own_frames import OWN_FRAMES_HIDDEN
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.remote.robot import connect
from ai4u_edu.remote.spaces import action_space, observation_space


class RemoteEnv(gymnasium.Env[Any, Any]):
    """One agent of a world that runs elsewhere; the world waits for each step.

    It waits for at most its ``--receive-timeout``, and then goes on without this agent's action; an
    algorithm that learns for longer between two steps needs a longer one. In a world with several
    agents that other machines can reach, its owner has to allow that it waits (``ai4u-edu play
    --lockstep``).

    ``info`` has ``reward_terms`` (by name), ``success`` (whether the scene's goal was reached in
    this episode), and the percept's ``tick``. The spaces are those of the same scene's environment
    on this machine. In a world with other agents, its owner has to allow resets with a seed; a
    reset without one begins an episode for this agent alone.

    Args:
        url: the page's address, such as ``"http://teacher:8080"``.
        agent: the agent's id; may be left out where there is only one.
        observation: ``"dict"``: by perception key; ``"flat"``: one float32 array.
        token: the world's, if it has one.
        patience: seconds to wait for a world that is not there, and for an agent that another
            script has; see :func:`~ai4u_edu.remote.connect`.
    """

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(
        self,
        url: str = "http://127.0.0.1:8080",
        agent: str = "",
        *,
        observation: str = "dict",
        token: str = "",
        patience: float = 10.0,
        render_mode: str | None = None,
    ) -> None:
        with OWN_FRAMES_HIDDEN:
            if observation not in ("dict", "flat"):
                raise SetupError(
                    _(
                        "observation: expected 'dict' or 'flat', got {observation!r}",
                        observation=observation,
                    )
                )
            if render_mode is not None:
                raise SetupError(
                    _(
                        "render_mode: expected None (the page shows the world), got "
                        "{render_mode!r}",
                        render_mode=render_mode,
                    )
                )
            self.render_mode = None
            self.robot = connect(url, agent, token=token, mode="lockstep", patience=patience)
            """The same agent, for direct use."""
            welcome = self.robot.welcome
            self._flat = observation == "flat"
            self._readings = [reading for reading in welcome.readings if reading.is_input]
            self.observation_space = observation_space(self._readings, observation)
            outputs = {output.name: output for output in welcome.outputs}
            self.action_space = action_space(outputs)
            self._one_output = next(output.name for output in welcome.outputs if output.is_output)
            if isinstance(self.action_space, gymnasium.spaces.Dict):
                self._one_output = ""
            self._paid = 0.0

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode.

        Args:
            seed: fixes all random numbers of the episode, and resets the whole world.
            options: ignored.

        Raises:
            RefusedError: there is a seed, there are other agents, and the world does not allow
                scripts to reset it.
        """
        with OWN_FRAMES_HIDDEN:
            if seed is not None:
                seed = checked_seed(seed)
            super().reset(seed=seed)
            percept = self.robot.reset(seed)
            self._paid = 0.0
            return self._observe(percept), self._info(percept)

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Take one decision."""
        with OWN_FRAMES_HIDDEN:
            self.robot.act({self._one_output: action} if self._one_output else action)
            percept = self.robot.sense()
        return (
            self._observe(percept),
            percept.reward,
            percept.terminated,
            percept.truncated,
            self._info(percept),
        )

    def close(self) -> None:
        """Give the agent back to the brain that it had before."""
        self.robot.close()

    def _observe(self, percept: RemotePercept) -> Any:
        if self._flat:
            parts = [np.asarray(percept[each.key], np.float32).ravel() for each in self._readings]
            return np.concatenate(parts)
        return {each.key: _own(percept[each.key]) for each in self._readings}

    def _info(self, percept: RemotePercept) -> dict[str, Any]:
        goal = self.robot.welcome.success
        self._paid += percept.reward_terms.get(goal, 0.0)
        return {
            "reward_terms": percept.reward_terms,
            "success": self._paid > 0,
            "tick": percept.tick,
        }


def _own(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value.copy()
    if isinstance(value, str | tuple):
        return value
    if isinstance(value, bool | int):
        return np.int64(value)
    return np.asarray(value, np.float32)
