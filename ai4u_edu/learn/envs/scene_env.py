"""A scene as a Gymnasium environment: one agent learns, the others follow their brains."""

from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from typing import Any

import gymnasium

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.options import ENV_PAGE, LivePage, load_option
from ai4u_edu.blocks import Percept
from ai4u_edu.learn.envs.description import EnvDescription, describe_agent
from ai4u_edu.learn.envs.env_warnings import RangeWarning, warn_of_default_agent
from ai4u_edu.learn.envs.external_brain import take_over
from ai4u_edu.learn.envs.spaces_of import Observer, action_space_of, options_space_of, outputs_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.snapshot.raster import draw_snapshot

SceneLike = Scene | str | Path


def load_scene(scene: SceneLike) -> Scene:
    """Return a scene given as such, by its name in the library, or by its file."""
    return scene if isinstance(scene, Scene) else Scene.load(scene)


class SceneEnv(gymnasium.Env[Any, Any]):
    """Gymnasium environment for one agent of a scene.

    A step hands its action to the agent's brain and runs the same decision cycle as the page. An
    action out of range is clipped; the first one gives a warning.
    ``info`` has ``reward_terms`` (by name) and ``success`` (True once the scene's goal was reached
    in this episode).

    Args:
        scene: a name out of the library, a YAML file, or a :class:`Scene`.
        observation: ``"dict"``: by perception key; ``"flat"``: one float32 array; ``"image"``: the
            picture of the only sensor, uint8, for policies that look at pictures.
        agent: the id of the agent that learns; left out, the one that acts first, with a warning
            that names it if there are several.
        render_mode: ``"rgb_array"``: drawn without a browser; ``"human"``: serves the page
            (``page_url``), at the pace of the wall clock. The page is an option; see
            :mod:`ai4u_edu.base.options`.

    >>> import gymnasium, ai4u_edu
    >>> env = gymnasium.make("ai4u_edu/BoxChase-v0", observation="flat")
    >>> observation, info = env.reset(seed=1)
    >>> observation.shape
    (126,)
    >>> observation, reward, terminated, truncated, info = env.step(env.action_space.sample() * 0)
    >>> terminated, info["success"], sorted(info["reward_terms"])
    (False, False, ['fall', 'min_dist', 'touch'])
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array", "human"], "render_fps": 12}

    def __init__(
        self,
        scene: SceneLike = "box_chase",
        *,
        observation: str = "dict",
        agent: str | None = None,
        render_mode: str | None = None,
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
        self.sim: ControlRequestor = self.scene.build()
        if agent is None and len(self.sim.agents) > 1:
            ids = [each.id for each in self.sim.agents]
            warn_of_default_agent(self.scene.description.name, ids)
        self.agent = self.sim.agents[0] if agent is None else self.sim.agent(agent)
        self._brain = take_over(self.agent)
        self.observer = Observer(self.agent, observation)
        self.observation_space = self.observer.space
        self.action_space = action_space_of(self.agent)
        self._output = next(iter(outputs_of(self.agent)))
        self._one_output = not isinstance(self.action_space, gymnasium.spaces.Dict)
        self.range_warning = RangeWarning()
        """Warning that an action was clipped; many worlds share one."""
        self.range_warning.watch(self.agent)
        self._goal = self.scene.description.success
        self._ledger = self.agent.ledger
        self.render_mode = render_mode
        ticks = self.sim.world.settings.ticks_per_second
        fps = max(1, round(ticks / (self._brain.skip_frame + 1)))
        self.metadata = {**self.metadata, "render_fps": fps}
        self._page: LivePage | None = None
        if render_mode == "human":
            make: Callable[[ControlRequestor, str], LivePage] = load_option(
                ENV_PAGE, _('render_mode="human" (but not "rgb_array")')
            ).EnvPage
            self._page = make(self.sim, self.scene.description.title)
        self._share_chance()

    @property
    def page_url(self) -> str:
        """URL of the page in mode ``"human"``; empty in other modes."""
        return self._page.url if self._page else ""

    @property
    def success(self) -> bool:
        """True once the scene's goal was reached in this episode."""
        goal = self._goal
        return goal is not None and self._ledger.episode_terms.get(goal, 0.0) > 0

    def describe(self) -> EnvDescription:
        """Return what each number of an observation and of an action is, as a table.

        In a dict observation, the index counts the numbers of each sensor on their own.

        >>> described = SceneEnv("forage", observation="flat").describe()
        >>> described.observations[96]
        Element(index=96, key='velocity', element='forward', unit='m/s', low=-5.0, high=5.0)
        >>> print(described)  # doctest: +ELLIPSIS
        index  sensor    element           unit   low  high
            0  vision    code, ray 0                0     1
            1  vision    distance, ray 0            0     1
        ...
           97  velocity  left              m/s     -5     5
           98  velocity  turning           rad/s  -20    20
        <BLANKLINE>
        index  actuator  element       unit  low  high
            0  move      forward              -1     1
            1  move      turn                 -1     1
            2  move      jump                  0     1
            3  move      forward jump          0     1
        """
        return describe_agent(self.agent, self.observation_space, self.action_space)

    @cached_property
    def options_space(self) -> gymnasium.spaces.Dict:
        """The numbers that options of a reset may change, with their ranges, by name.

        A number is found by the end of its name, too, if no other one ends so: ``gravity``.

        >>> SceneEnv("box_chase").options_space["world.gravity"]
        Box(0.0, 1000.0, (), float64)
        """
        return options_space_of(self.scene, self.sim)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode.

        Args:
            seed: fixes everything in it; left out, it follows from the last one's.
            options: numbers of the scene for this episode, such as ``{"gravity": 1.6}``; names
                and ranges are in :attr:`options_space`. The next reset begins with the scene's own.

        Raises:
            AI4UError: no number has that name, or it can't have that value.

        >>> env = SceneEnv("box_chase")
        >>> _ = env.reset(seed=1, options={"gravity": 1.6, "bodies.box.position": [2, 2]})
        >>> env.sim.world["box"].position
        (2.0, 2.0)
        """
        self.sim.reset(seed, options)
        self._share_chance()
        return self.observer.observe(self.agent.percept), self._info()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Run one decision."""
        percept = self.decide(action)
        agent = self.agent
        return (
            self.observer.observe(percept),
            agent.ledger.total,
            agent.terminated,
            agent.truncated,
            self._info(),
        )

    def decide(self, action: Any) -> Percept:
        """Run one decision and return the observation after it; the agent knows the rest."""
        self._brain.action = {self._output: action} if self._one_output else action
        if self._page is None:
            return self.sim.step(self.agent)
        agent, before = self.agent, self.agent.steps
        while not agent.done and agent.steps == before:
            self._page.advance()
        return agent.percept

    def render(self) -> Any:
        """Return the world from above, (height, width, 3) uint8; None in mode ``"human"``."""
        if self.render_mode == "rgb_array":
            return draw_snapshot(capture_snapshot(self.sim))
        return None

    def close(self) -> None:
        """Stop serving the page, if there is one."""
        if self._page:
            self._page.close()
            self._page = None

    def _share_chance(self) -> None:
        # Gymnasium's np_random is the world's own generator
        seeds = self.sim.world.seeds
        self._np_random, self._np_random_seed = seeds.generator, seeds.seed

    def _info(self) -> dict[str, Any]:
        return {"reward_terms": self._ledger.terms.copy(), "success": self.success}
