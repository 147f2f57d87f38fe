"""Scenes as Gymnasium, PettingZoo and Stable-Baselines3 environments."""

from typing import TYPE_CHECKING, Any

from ai4u_edu.learn.envs.external_brain import HeldBrain
from ai4u_edu.learn.envs.scene_env import SceneEnv, SceneLike
from ai4u_edu.learn.envs.scene_vector_env import SceneVectorEnv

if TYPE_CHECKING:
    from ai4u_edu.learn.envs.scene_parallel_env import SceneParallelEnv

__all__ = ["HeldBrain", "SceneEnv", "SceneVectorEnv", "parallel_env"]


def parallel_env(scene: SceneLike, **options: Any) -> "SceneParallelEnv":
    """Return a scene as a PettingZoo ParallelEnv; needs ``pip install ai4u-edu[multi]``.

    Args:
        scene: a name out of the library, a YAML file, or a Scene.
        options: those of :class:`~ai4u_edu.learn.envs.scene_parallel_env.SceneParallelEnv`.
    """
    from ai4u_edu.learn.envs.scene_parallel_env import SceneParallelEnv

    return SceneParallelEnv(scene, **options)
