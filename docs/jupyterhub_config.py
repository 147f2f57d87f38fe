"""Settings of a JupyterHub for the course; see jupyterhub.md."""

import os
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
culler_role = {
    "name": "idle-culler",
    "scopes": ["list:users", "read:users:activity", "read:servers", "delete:servers"],
    "services": ["idle-culler"],
}
culler = {
    "name": "idle-culler",
    "command": [sys.executable, "-m", "jupyterhub_idle_culler", "--timeout=3600"],
}
# end kernels that have been idle for an hour, and whose notebook is closed
c.Spawner.args = ["--MappingKernelManager.cull_idle_timeout=3600"]
if hasattr(os, "geteuid") and os.geteuid() == 0:
    # a server that runs as root, as SimpleLocalProcessSpawner starts it in a container, refuses to
    # start without it; one that runs as its student takes no notice of it
    c.Spawner.args.append("--allow-root")

# a class logs in within a minute, and each server takes seconds of a core until it answers
c.JupyterHub.concurrent_spawn_limit = 10  # others wait for their turn, and their pages say so
c.Spawner.start_timeout = 300
c.Spawner.http_timeout = 120

# a class, at /services/ai4u-class/
ai4u_class = {
    "name": "ai4u-class",
    "url": "http://127.0.0.1:10101",  # students' servers open it, too
    "command": [
        *(sys.executable, "-m", "ai4u_edu", "class", "--hub"),
        *("--folder", str(Path("ai4u-class").absolute())),  # seats and results; back it up
    ],
    "oauth_no_confirm": True,
}
use_class = ["access:services!service=ai4u-class", "read:services!service=ai4u-class"]
# the token of a student's server may be shown to the class, and find it
c.Spawner.server_token_scopes = ["users:activity!user", "access:servers!server", *use_class]
user_role = {"name": "user", "scopes": ["self", *use_class]}
# teachers; the hub's admins are, too. "Look in" needs access to students' servers.
c.JupyterHub.load_groups = {"ai4u-teachers": {"users": []}}
teacher_role = {
    "name": "ai4u-teachers",
    "groups": ["ai4u-teachers"],
    "scopes": ["access:servers", *use_class],
}

c.JupyterHub.services = [culler, ai4u_class]
c.JupyterHub.load_roles = [culler_role, user_role, teacher_role]
