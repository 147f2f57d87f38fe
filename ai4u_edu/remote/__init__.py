"""Drive an agent of a running world from anywhere; loads no physics and no page."""

from typing import TYPE_CHECKING, Any

from ai4u_edu.base.errors import ActionError
from ai4u_edu.remote.async_robot import AsyncRobot
from ai4u_edu.remote.errors import LostError, RefusedError, RemoteError
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.remote.robot import Robot, connect
from ai4u_edu.remote.robot_base import Spaces

if TYPE_CHECKING:
    from ai4u_edu.remote.env import RemoteEnv

__all__ = [
    "ActionError",
    "AsyncRobot",
    "LostError",
    "RefusedError",
    "RemoteEnv",
    "RemoteError",
    "RemotePercept",
    "Robot",
    "Spaces",
    "connect",
]


def __getattr__(name: str) -> Any:
    if name == "RemoteEnv":  # only who wants an environment loads Gymnasium
        from ai4u_edu.remote.env import RemoteEnv

        return RemoteEnv
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
