"""Registration of the scenes with Gymnasium; loads neither physics nor page.

Gymnasium looks for no plug-ins since its version 1.0, so a name is known once this package is
imported: ``import ai4u_edu``, or ``gymnasium.make("ai4u_edu:ai4u_edu/BoxChase-v0")``.
"""

from pathlib import Path

from gymnasium.envs.registration import register, registry

REMOTE = "ai4u_edu/Remote-v0"
"""Environment of an agent in a world on another machine."""
LIBRARY = Path(__file__).parent / "scenes" / "library"


def env_id(scene: str) -> str:
    """Return the Gymnasium id of a scene of the library.

    >>> env_id("box_chase")
    'ai4u_edu/BoxChase-v0'
    """
    return f"ai4u_edu/{''.join(part.capitalize() for part in scene.split('_'))}-v0"


def register_envs() -> None:
    """Register every scene of the library and the remote environment, unless they are."""
    if REMOTE not in registry:
        register(id=REMOTE, entry_point="ai4u_edu.remote.env:RemoteEnv")
    for path in sorted(LIBRARY.glob("*.yaml")):
        name = env_id(path.stem)
        if name not in registry:
            register(
                id=name,
                entry_point="ai4u_edu.learn.envs:SceneEnv",
                vector_entry_point="ai4u_edu.learn.envs:SceneVectorEnv",
                kwargs={"scene": path.stem},
            )
