"""A scene with several agents as a PettingZoo environment: all decide at the same time."""

from typing import Any

from gymnasium import spaces
from pettingzoo import ParallelEnv

from ai4u_edu.agent import BasicAgent
from ai4u_edu.drawing import draw
from ai4u_edu.envs.held_brain import take_over
from ai4u_edu.envs.scene_env import SceneLike, load_scene
from ai4u_edu.envs.spaces_of import Observer, action_space_of, outputs_of
from ai4u_edu.snapshot import picture_of


class SceneParallelEnv(ParallelEnv):  # type: ignore[misc]  # PettingZoo has no types
    """Every agent of a scene learns.

    A step gives every agent its action, and ends when all their decisions are over. An agent whose
    episode ends takes part no more; the others go on.

    Args:
        scene: a name out of the library, a YAML file, or a Scene.
        observation: ``"dict"`` or ``"flat"``.
        render_mode: None or ``"rgb_array"``.
        max_cycles: steps after which all that are left are truncated; 0 for no limit.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "is_parallelizable": True}

    def __init__(
        self,
        scene: SceneLike,
        *,
        observation: str = "dict",
        render_mode: str | None = None,
        max_cycles: int = 0,
    ) -> None:
        self.scene = load_scene(scene)
        self.sim = self.scene.build()
        self.render_mode = render_mode
        self.max_cycles = max_cycles
        self.metadata = {**self.metadata, "name": f"ai4u_edu/{self.scene.description.name}"}
        self._agents: dict[str, BasicAgent] = {agent.id: agent for agent in self.sim.agents}
        self._brains = {agent_id: take_over(agent) for agent_id, agent in self._agents.items()}
        self._observers = {
            agent_id: Observer(agent, observation) for agent_id, agent in self._agents.items()
        }
        self._outputs = {agent_id: list(outputs_of(a)) for agent_id, a in self._agents.items()}
        self._action_spaces = {name: action_space_of(a) for name, a in self._agents.items()}
        self.possible_agents = list(self._agents)
        self.agents: list[str] = []
        self._cycles = 0

    def observation_space(self, agent: str) -> spaces.Space[Any]:
        """An agent's space of observations."""
        return self._observers[agent].space

    def action_space(self, agent: str) -> spaces.Space[Any]:
        """An agent's space of actions."""
        return self._action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Begins an episode for all agents."""
        self.sim.reset(seed)
        self.agents = list(self.possible_agents)
        self._cycles = 0
        observations = {name: self._observe(name) for name in self.agents}
        return observations, {name: self._info(name) for name in self.agents}

    def step(
        self, actions: dict[str, Any]
    ) -> tuple[dict[str, Any], dict[str, float], dict[str, bool], dict[str, bool], dict[str, Any]]:
        """One decision of every agent that still takes part."""
        acting = list(self.agents)
        for name in acting:
            outputs = self._outputs[name]
            action = actions[name]
            self._brains[name].action = {outputs[0]: action} if len(outputs) == 1 else action
        self.sim.tick()
        while not self.sim.between_decisions():
            self.sim.tick()
        self._cycles += 1
        out_of_time = 0 < self.max_cycles <= self._cycles
        agents = {name: self._agents[name] for name in acting}
        terminated = {name: agent.terminated for name, agent in agents.items()}
        truncated = {
            name: agent.truncated or (out_of_time and not agent.terminated)
            for name, agent in agents.items()
        }
        self.agents = [name for name in acting if not (terminated[name] or truncated[name])]
        return (
            {name: self._observe(name) for name in acting},
            {name: agent.reward for name, agent in agents.items()},
            terminated,
            truncated,
            {name: self._info(name) for name in acting},
        )

    def render(self) -> Any:
        """The world from above, (height, width, 3) uint8."""
        return draw(picture_of(self.sim)) if self.render_mode == "rgb_array" else None

    def close(self) -> None:
        """Nothing is held open."""

    def _observe(self, name: str) -> Any:
        return self._observers[name].observe(self._agents[name].percept)

    def _info(self, name: str) -> dict[str, Any]:
        return {"reward_terms": self._agents[name].reward_terms}
