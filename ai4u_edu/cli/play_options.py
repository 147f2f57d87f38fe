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
Host = Annotated[str, typer.Option(help="The address to listen on.")]
Port = Annotated[int, typer.Option(help="The port; 0 for any free one.", min=0, max=65535)]
OpenPage = Annotated[bool, typer.Option("--open/--no-open", help="Open the page in the browser.")]
Seed = Annotated[int | None, seed_option("Seed of the first episode.")]
TimeScale = Annotated[
    float | None,
    typer.Option(
        help="How fast the time runs; 1 is real time.",
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
    typer.Option(help="A name under which the page is asked for, behind a proxy."),
]
Token = Annotated[
    str,
    typer.Option(
        help="What page and scripts have to know; where other machines can reach it, one is "
        "made up if you choose none.",
        show_default=False,
    ),
]
Connections = Annotated[
    int,
    typer.Option(
        help="Connections from one address, at most; each page has two. This machine's own "
        "are not counted.",
        min=1,
        max=100_000,
    ),
]
SeededResets = Annotated[
    bool,
    typer.Option(
        "--seeded-resets", help="Let one of several agents' scripts reset the whole world."
    ),
]
Lockstep = Annotated[
    bool | None,
    typer.Option(
        "--lockstep/--no-lockstep",
        help="Let scripts have the world wait for their actions; left out, only where there is "
        "one agent.",
        show_default=False,
    ),
]
PlayOnMissing = Annotated[
    OnMissing | None,
    typer.Option(
        help="What an agent does when its script's action is missing, unless the script "
        "chooses: the last one again (hold), nothing (coast), or zeros for all actuators "
        "(stop). Left out: hold, and stop while its connection is lost.",
        show_default=False,
    ),
]
Grace = Annotated[
    float,
    typer.Option(
        help="Seconds that an agent is kept for a script whose connection is lost.",
        min=0,
        max=600,
    ),
]
ReceiveTimeout = Annotated[
    int,
    typer.Option(
        help="Milliseconds for which the world waits for a script in lockstep; then it goes "
        "on until the script answers.",
        min=200,
        max=600_000,
    ),
]
Drivers = Annotated[
    list[str] | None,
    typer.Option(
        help="Who drives: an AI4U script (ai4u://127.0.0.1:8080), a network (policy.onnx, or "
        "zoo for the one that comes with the scene), FILE.py:NAME (a function or a "
        "Controller), a training's folder or a model (.zip) in it, a controller, random; "
        "ID=... for the agent of that id."
    ),
]
Record = Annotated[
    Path | None, typer.Option(help="A folder in which every episode is kept as a file.")
]
Keep = Annotated[
    int, typer.Option(help="So many episodes are kept, to go back to.", min=1, max=1000)
]
GhostFile = Annotated[
    Path | None,
    typer.Option(help="A recorded episode (.episode) to play against; its seed is the first."),
]
Offers = Annotated[
    list[str] | None,
    typer.Option(
        help="Python files with drivers, networks (.onnx), recorded episodes (.episode), "
        "folders of them, or an AI4U script's address (ai4u://HOST:PORT), from which the page "
        "may choose who drives; a script is run when it is chosen."
    ),
]
SavedScenes = Annotated[
    Path | None,
    typer.Option(
        "--scenes",
        help="A folder in which pages can save scenes under a name; left out, they can only "
        "download them.",
    ),
]
Restore = Annotated[
    bool,
    typer.Option(
        "--restore",
        help="Go on with the scene that was left unsaved last; of SCENE, or by number, if one "
        "is named.",
    ),
]
AutosaveFlag = Annotated[
    bool, typer.Option("--autosave/--no-autosave", help="Keep what is changed in the page.")
]
