"""Options of ``ai4u-edu play``, one type for each."""

from pathlib import Path
from typing import Annotated

import typer

from ai4u_edu.cli.options import MAX_TIME_SCALE, MIN_TIME_SCALE, OnMissing, finite, seed_option

SceneName = Annotated[
    str,
    typer.Argument(
        help="A scene of the library, a YAML file, or a link to a shared scene, in quotes."
    ),
]
SceneOrWork = Annotated[
    str,
    typer.Argument(
        help="A scene of the library, a YAML file, a link to a shared scene, in quotes, or the ZIP "
        "file with your work from a class."
    ),
]
Host = Annotated[str, typer.Option(help="Address to listen on.")]
Port = Annotated[int, typer.Option(help="Port; 0 for any free port.", min=0, max=65535)]
OpenPage = Annotated[bool, typer.Option("--open/--no-open", help="Open the page in the browser.")]
Seed = Annotated[int | None, seed_option("Seed of the first episode.")]
TimeScale = Annotated[
    float | None,
    typer.Option(
        help="Speed of time; 1 is real time.",
        min=MIN_TIME_SCALE,
        max=MAX_TIME_SCALE,
        callback=finite,
    ),
]
WaitForKey = Annotated[
    bool,
    typer.Option(
        "--wait-for-key/--no-wait-for-key",
        help="After each reset, wait until a person who drives presses a key; a scene's own "
        "wait_for_key: false keeps it from waiting.",
    ),
]
AllowHost = Annotated[
    list[str] | None,
    typer.Option(help="Host name of a reverse proxy in front. Repeat the option for several."),
]
TOKEN_VARIABLE = "AI4U_EDU_TOKEN"  # noqa: S105 - its name
Token = Annotated[
    str,
    typer.Option(
        envvar=TOKEN_VARIABLE,  # others may read a command line
        help="Token that pages and scripts have to send. Default: a random one if other machines "
        "can reach the server, else none.",
        show_default=False,
    ),
]
Connections = Annotated[
    int,
    typer.Option(
        help="Maximum number of connections from one address; each page needs two. Connections "
        "from this machine are not counted.",
        min=1,
        max=100_000,
    ),
]
SeededResets = Annotated[
    bool | None,
    typer.Option(
        "--seeded-resets/--no-seeded-resets",
        help="Let the script of one of several agents reset the whole world. Default: only if no "
        "other machine can reach the server.",
        show_default=False,
    ),
]
Lockstep = Annotated[
    bool | None,
    typer.Option(
        "--lockstep/--no-lockstep",
        help="Let scripts make the world wait for their actions. Default: only in scenes with "
        "one agent, or if no other machine can reach the server.",
        show_default=False,
    ),
]
PlayOnMissing = Annotated[
    OnMissing | None,
    typer.Option(
        help="What an agent does when its script's action is missing, unless the script "
        "chooses: repeat the last action (hold), no action (coast), or zeros for all actuators "
        "(stop). Default: hold, and stop while the connection is lost.",
        show_default=False,
    ),
]
Grace = Annotated[
    float,
    typer.Option(
        help="Seconds for which an agent is kept for a script that lost its connection.",
        min=0,
        max=600,
    ),
]
ReceiveTimeout = Annotated[
    int,
    typer.Option(
        help="Milliseconds that the world waits for a script in lockstep; then it runs on until "
        "the script answers.",
        min=200,
        max=600_000,
    ),
]
Drivers = Annotated[
    list[str] | None,
    typer.Option(
        help="The driver: an AI4U script (ai4u://127.0.0.1:8080), a network (policy.onnx, or "
        "zoo for the one that comes with the scene), FILE.py:NAME (a function or a "
        "Controller), a training's folder or a model (.zip) in it, a controller, or random. "
        "ID=DRIVER for the agent with that id. Default: the scene's own."
    ),
]
Record = Annotated[
    Path | None, typer.Option(help="Folder in which every episode is saved as a file.")
]
Keep = Annotated[int, typer.Option(help="How many episodes to keep for replay.", min=1, max=1000)]
GhostFile = Annotated[
    Path | None,
    typer.Option(
        help="Recorded episode (.episode) to race against; the first episode gets its seed."
    ),
]
Offers = Annotated[
    list[str] | None,
    typer.Option(
        help="Drivers that can be chosen in the page: a Python file, a network (.onnx), a recorded "
        "episode (.episode), a folder of these, or the address of an AI4U script "
        "(ai4u://HOST:PORT). A Python file is run when it is chosen. Repeat the option for several."
    ),
]
SavedScenes = Annotated[
    Path | None,
    typer.Option(
        "--scenes",
        help="Folder in which pages can save scenes. Default: one of yours; with --no-autosave, "
        "pages can only download them.",
    ),
]
MissionsFolder = Annotated[
    Path | None,
    typer.Option(
        "--missions",
        help="Folder with missions of your own (YAML files), which are read again when you save "
        "them. Default: only those that come with AI4U Edu.",
    ),
]
Restore = Annotated[
    bool,
    typer.Option(
        "--restore",
        help="Reopen the last unsaved scene; if SCENE is given, the last one of that name or the "
        "one with that number.",
    ),
]
ClassUrl = Annotated[
    str,
    typer.Option(
        "--class",
        help="Address of a class to join: the teacher sees this world. On a JupyterHub: hub, "
        "without a code. Default: none.",
        show_default=False,
    ),
]
ClassCode = Annotated[
    str, typer.Option("--code", help="Code of the class, as on the board.", show_default=False)
]
NameChoice = Annotated[
    int,
    typer.Option(
        help="Number of the name to get among those that the class offers.", min=1, max=100
    ),
]
AutosaveFlag = Annotated[
    bool,
    typer.Option(
        "--autosave/--no-autosave", help="Keep unsaved changes, to reopen them with --restore."
    ),
]
