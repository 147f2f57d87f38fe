"""Settings of The Littlest JupyterHub for the course and a class; see jupyterhub.md.

Goes to /opt/tljh/config/jupyterhub_config.d/ai4u_edu.py; then: sudo tljh-config reload
"""

c = get_config()  # noqa: F821 - JupyterHub defines it

USER_PYTHON = "/opt/tljh/user/bin/python3"
TEACHERS = ["jane"]  # names at the hub; its admins are teachers, too

# copies the course before a student's server starts; runs as the student
COPY_COURSE = (
    f'{USER_PYTHON} -m ai4u_edu lessons "$HOME/course" --copy-only && '
    'JUPYTER_CONFIG_PATH="$HOME/course/.ai4u-edu/jupyter" exec jupyterhub-singleuser "$@"'
)
c.Spawner.cmd = ["sh", "-c", COPY_COURSE, "sh"]
c.Spawner.default_url = "/lab/tree/course/00_start_here.ipynb"
c.Spawner.args = ["--MappingKernelManager.cull_idle_timeout=3600"]

# a class logs in within a minute, and each server takes seconds of a core until it answers
c.JupyterHub.concurrent_spawn_limit = 10  # others wait for their turn, and their pages say so
c.Spawner.start_timeout = 300
c.Spawner.http_timeout = 120

# the class, at /services/ai4u-class/; runs as a system account that has its folder, not as root
c.JupyterHub.services.append(
    {
        "name": "ai4u-class",
        "url": "http://127.0.0.1:10101",
        "user": "ai4u-class",
        "cwd": "/srv/ai4u-class",
        "command": [
            *(USER_PYTHON, "-m", "ai4u_edu", "class", "--hub"),
            *("--folder", "/srv/ai4u-class/class"),  # seats and results; back it up
        ],
        "oauth_no_confirm": True,
    }
)
use_class = ["access:services!service=ai4u-class", "read:services!service=ai4u-class"]
# the token of a student's server may be shown to the class, and find it
c.Spawner.server_token_scopes = ["users:activity!user", "access:servers!server", *use_class]
c.JupyterHub.load_groups.update({"ai4u-teachers": {"users": TEACHERS}})
c.JupyterHub.load_roles.extend(
    [
        {"name": "user", "scopes": ["self", *use_class]},
        {
            "name": "ai4u-teachers",
            "groups": ["ai4u-teachers"],
            "scopes": ["access:servers", *use_class],  # "Look in" needs students' servers
        },
    ]
)
