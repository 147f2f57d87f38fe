"""A remote script imports no package that only a world needs."""

import subprocess
import sys

from tests.waiting import LIMIT_S

HEAVY = (
    *("onnxruntime", "pymunk", "viser", "pydantic", "starlette", "uvicorn"),
    *("ruamel", "typer", "rich"),
)
OURS = ("blocks", "world", "agent", "scenes", "runner", "server", "viewer", "parameters")


def test_the_client_is_light() -> None:
    code = (
        "import sys; from ai4u_edu.remote import connect, AsyncRobot, RemoteEnv; "
        "from ai4u_edu.remote.bridge import Bridge; "
        "import gymnasium; gymnasium.spec('ai4u_edu/Remote-v0'); "
        f"print([name for name in {HEAVY} if name in sys.modules] + "
        f"[name for name in {OURS} if 'ai4u_edu.' + name in sys.modules])"
    )
    found = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=LIMIT_S
    )
    assert found.stdout.strip() == "[]"
