"""Settings of a JupyterHub for the course; see jupyterhub.md."""

import subprocess
import sys
from pathlib import Path

c = get_config()  # noqa: F821 - JupyterHub defines it

c.Spawner.default_url = "/lab/tree/course/00_start_here.ipynb"


def hand_out(spawner):
    """Copy the course into the student's home; notebooks that are there stay as they are."""
    home = Path(spawner.user_env({})["HOME"])
    home.mkdir(parents=True, exist_ok=True)
    command = [sys.executable, "-m", "ai4u_edu", "lessons", str(home / "course"), "--copy-only"]
    subprocess.run(command, check=True)  # noqa: S603
    # settings of JupyterLab that were copied too; they keep its question about news away
    spawner.environment["JUPYTER_CONFIG_PATH"] = str(home / "course" / ".ai4u-edu" / "jupyter")


c.Spawner.pre_spawn_hook = hand_out

# end servers that nobody has used for an hour; needs: pip install jupyterhub-idle-culler
c.JupyterHub.load_roles = [
    {
        "name": "idle-culler",
        "scopes": ["list:users", "read:users:activity", "read:servers", "delete:servers"],
        "services": ["idle-culler"],
    }
]
c.JupyterHub.services = [
    {
        "name": "idle-culler",
        "command": [sys.executable, "-m", "jupyterhub_idle_culler", "--timeout=3600"],
    }
]
# end kernels that have been idle for an hour, and whose notebook is closed
c.Spawner.args = ["--MappingKernelManager.cull_idle_timeout=3600"]
