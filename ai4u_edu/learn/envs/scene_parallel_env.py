"""A scene with several agents as a PettingZoo environment: all decide at the same time."""

from functools import cached_property
from typing import Any

from gymnasium import spaces
from pettingzoo import ParallelEnv

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import ActionError, SetupError, suggest
from ai4u_edu.learn.envs.description import EnvDescription, describe_agent
from ai4u_edu.learn.envs.env_warnings import RangeWarning
from ai4u_edu.learn.envs.external_brain import take_over
from ai4u_edu.learn.envs.scene_env import SceneLike, load_scene
from ai4u_edu.learn.envs.spaces_of import Observer, action_space_of, options_space_of, outputs_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.snapshot.raster import draw_snapshot


class SceneParallelEnv(ParallelEnv):  # type: ignore[misc]  # PettingZoo has no types
    """PettingZoo environment in which every agent of a scene learns.

    A step gives every agent its action, and is over when their decisions are; all decide as seldom
    as the one that decides most seldom. An agent whose episode ends takes part no more, and the
    others go on: ``agents`` has those that are left, and is empty when a reset is due. ``infos``
    has for each ``reward_terms`` (by name) and ``success`` (True once it reached the
    scene's goal in this episode).

    Args:
        scene: a name out of the library, a YAML file, or a Scene.
        observation: ``"dict"``: by perception key; ``"flat"``: one float32 array.
        render_mode: None or ``"rgb_array"``: drawn without a browser.
        max_cycles: steps after which all that are left are truncated; 0 for no limit.

    >>> from ai4u_edu.learn.envs import parallel_env
    >>> env = parallel_env("sumo", observation="flat")
    >>> observations, infos = env.reset(seed=1)
    >>> env.agents, observations["blue"].shape
    (['blue', 'orange'], (11,))
    >>> actions = {agent: env.action_space(agent).sample() * 0 for agent in env.agents}
    >>> observations, rewards, terminations, truncations, infos = env.step(actions)
    >>> rewards, infos["orange"]["success"]
    ({'blue': 0.0, 'orange': 0.0}, False)
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
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise SetupError(
                _(
                    "render_mode: expected one of {render_modes}, got {render_mode}",
                    render_modes=self.metadata["render_modes"],
                    render_mode=repr(render_mode),
                )
            )
        self.scene = load_scene(scene)
        self.sim = self.scene.build()
        self.render_mode = render_mode
        self.max_cycles = max_cycles
        self._goal = self.scene.description.success
        self._agents: dict[str, BasicAgent] = {agent.id: agent for agent in self.sim.agents}
        self._brains = {name: take_over(agent) for name, agent in self._agents.items()}
        # one action a step, and no reward between two steps: so all need the same time for one
        self.sim.spread_decisions = False
        skip_frame = max(brain.skip_frame for brain in self._brains.values())
        for brain in self._brains.values():
            brain.skip_frame = skip_frame
        range_warning = RangeWarning()
        for each in self._agents.values():
            range_warning.watch(each)
        self._observers = {
            name: Observer(agent, observation) for name, agent in self._agents.items()
        }
        self._outputs = {name: list(outputs_of(agent)) for name, agent in self._agents.items()}
        self._action_spaces = {name: action_space_of(agent) for name, agent in self._agents.items()}
        self.possible_agents = list(self._agents)
        self.agents: list[str] = []
        self._cycles = 0
        ticks = self.sim.world.settings.ticks_per_second
        self.metadata = {
            **self.metadata,
            "name": f"ai4u_edu/{self.scene.description.name}",
            "render_fps": max(1, round(ticks / (skip_frame + 1))),
        }

    def observation_space(self, agent: str) -> spaces.Space[Any]:
        """Return an agent's observation space."""
        return self._observers[agent].space

    def action_space(self, agent: str) -> spaces.Space[Any]:
        """Return an agent's action space."""
        return self._action_spaces[agent]

    def describe(self, agent: str) -> EnvDescription:
        """Return what each number of an agent's observations and actions is, as a table."""
        return describe_agent(
            self._agents[agent], self.observation_space(agent), self.action_space(agent)
        )

    @cached_property
    def options_space(self) -> spaces.Dict:
        """The numbers that options of a reset may change, with their ranges, by name."""
        return options_space_of(self.scene, self.sim)

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Begin an episode for all agents.

        Args:
            seed: fixes everything in it; left out, it follows from the last one's.
            options: numbers of the scene for this episode, as for
                :meth:`SceneEnv.reset <ai4u_edu.learn.envs.scene_env.SceneEnv.reset>`.

        Raises:
            AI4UError: no number has that name, or it can't have that value.
        """
        known = {name: each for name, each in (options or {}).items() if name != "options"}
        self.sim.reset(seed, known)  # PettingZoo's own test of an environment gives that name
        self.agents = list(self.possible_agents)
        self._cycles = 0
        observations = {name: self._observe(name) for name in self.agents}
        return observations, {name: self._info(name) for name in self.agents}

    def step(
        self, actions: dict[str, Any]
    ) -> tuple[dict[str, Any], dict[str, float], dict[str, bool], dict[str, bool], dict[str, Any]]:
        """Run one decision of every agent that still takes part.

        Args:
            actions: one for each of ``agents``.
        """
        acting = list(self.agents)
        self._hand_out(actions)
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
        """Return the world from above, (height, width, 3) uint8; None without a render mode."""
        return (
            draw_snapshot(capture_snapshot(self.sim)) if self.render_mode == "rgb_array" else None
        )

    def close(self) -> None:
        """Do nothing; nothing is held open."""

    def _hand_out(self, actions: dict[str, Any]) -> None:
        if not self.agents:
            raise SetupError(_("no agent takes part; expected a reset() first"))
        for name in actions:
            if name not in self._agents:
                raise ActionError(
                    _(
                        "no agent has the id {name!r}; {hint}",
                        name=name,
                        hint=suggest(name, self._agents),
                    )
                )
        for name in self.agents:
            if name not in actions:
                raise ActionError(
                    _(
                        "expected an action for each of {agents}, got none for {name!r}",
                        agents=str(self.agents),
                        name=name,
                    )
                )
            outputs, action = self._outputs[name], actions[name]
            self._brains[name].action = {outputs[0]: action} if len(outputs) == 1 else action

    def _observe(self, name: str) -> Any:
        return self._observers[name].observe(self._agents[name].percept)

    def _info(self, name: str) -> dict[str, Any]:
        agent, goal = self._agents[name], self._goal
        return {
            "reward_terms": agent.reward_terms,
            "success": goal is not None and agent.ledger.episode_terms.get(goal, 0.0) > 0,
        }
