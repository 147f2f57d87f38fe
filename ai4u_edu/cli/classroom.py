"""``ai4u-edu class``: a class of many rooms behind one address."""

import os
from contextlib import closing
from pathlib import Path
from typing import Annotated

import typer

from ai4u_edu.base.errors import SetupError
from ai4u_edu.cli import play_options as o
from ai4u_edu.cli.options import OwnBlocks, finite, load_own_blocks, say
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate

Rooms = Annotated[
    str, typer.Option(help="A room for each student, or shared: each, pairs, teams:N or one.")
]
Folder = Annotated[
    Path, typer.Option(help="Folder of the class; started with it again, the class goes on.")
]
JoinCode = Annotated[str, typer.Option(help="Join code. Default: a random one.")]
SleepAfter = Annotated[
    float,
    typer.Option(
        min=0,
        max=10_000,
        callback=finite,
        help="Minutes until a world that nobody uses is saved and ends.",
    ),
]
RoomMemory = Annotated[
    float,
    typer.Option(min=100, max=100_000, callback=finite, help="Memory (MB) that one world may use."),
]
MaxFolder = Annotated[
    float,
    typer.Option(
        min=0.01,
        max=100_000,
        callback=finite,
        help="Size (GB) of the class's folder from which nothing more of students' work is kept.",
    ),
]

AtHub = Annotated[
    bool,
    typer.Option(
        "--hub",
        help="Run as a service of a JupyterHub, which says where to listen and who is who.",
    ),
]
Teachers = Annotated[
    list[str] | None,
    typer.Option(
        help="With --hub: a group of the hub whose members are teachers, as its admins are. "
        "Repeat the option for several. Default: ai4u-teachers.",
        show_default=False,
    ),
]


def classroom(
    context: typer.Context,
    scene: o.SceneName = "box_chase",
    rooms: Rooms = "each",
    folder: Folder = Path("ai4u-class"),
    host: o.Host = "0.0.0.0",  # noqa: S104 - a class is for other machines
    port: o.Port = 8080,
    code: JoinCode = "",
    sleep_after: SleepAfter = 5.0,
    room_memory: RoomMemory = 600.0,
    receive_timeout: o.ReceiveTimeout = 2000,
    max_folder: MaxFolder = 5.0,
    allow_host: o.AllowHost = None,
    own_blocks: OwnBlocks = None,
    missions: o.MissionsFolder = None,
    open_page: o.OpenPage = True,
    hub: AtHub = False,
    teachers: Teachers = None,  # noqa: ARG001 - _serve_at_hub takes it from the context
) -> None:
    """Serve a class: students join with a code, and each drives in a world of their own."""
    load_own_blocks(own_blocks)
    os.umask(0o077)  # whatever a class and its rooms write is its owner's alone
    if hub:
        if missions is not None:
            raise SetupError(
                _(
                    "--missions: expected a class of its own, got --hub; there, worlds run on the "
                    "students' servers: start them with play --missions"
                )
            )
        _serve_at_hub(context)
        return
    from ai4u_edu.classroom import ClassStore, LocalRooms, RoomRule, Seats, class_app
    from ai4u_edu.classroom.addresses import class_banner, join_address, teacher_address
    from ai4u_edu.classroom.gateway import SERVER_LIMITS
    from ai4u_edu.classroom.names import names_language
    from ai4u_edu.classroom.room_watch import RoomLimits
    from ai4u_edu.classroom.store import teacher_token
    from ai4u_edu.missions import mission_map
    from ai4u_edu.page.server import hosts_for, open_on_desktop, serve
    from ai4u_edu.page.server.process_exit import HAS_SERVED
    from ai4u_edu.runtime.process_tuning import released_memory, tuned_process
    from ai4u_edu.scenes import Scene

    Scene.load(scene)  # a mistake in it is said here, and not in each room
    for problem in mission_map(missions)().problems if missions else ():
        typer.echo(translate(problem), err=True)
    limits = RoomLimits(sleep_after_s=60 * sleep_after, max_memory_mb=room_memory)
    rule, blocks = RoomRule.parse(rooms), own_blocks or ()
    made = LocalRooms(
        folder,
        blocks,
        limits,
        are_shared=rule.kind != "each",
        receive_timeout_ms=receive_timeout,
        missions=missions,
    )
    with ClassStore(folder, max_folder) as store, closing(made) as local:
        local.quota = store.quota
        seats = Seats(store, scene, rule, code, names_language())
        token = teacher_token(store)

        def announce(url: str) -> None:
            local.class_url = url
            app.state.begin()
            banner = class_banner(join_address(host, url), seats.code, url, token)
            say(banner)
            if open_page:
                open_on_desktop(teacher_address(url, token))

        app = class_app(
            store,
            seats,
            local,
            teacher_token=token,
            join_address=lambda url: join_address(host, url),
            allowed_hosts=hosts_for(host),
            proxy_hosts=allow_host or [],
            blocks=blocks,
            missions=missions,
        )
        with tuned_process(), released_memory():
            serve(app, host, port, announce, **SERVER_LIMITS)
    HAS_SERVED.set()


def _serve_at_hub(context: typer.Context) -> None:
    """Serve a class as a service of a JupyterHub until SIGTERM, which the hub sends at its end.

    Args:
        context: of the command, with its options. An address to listen at that is among them counts
            more than the hub's: in a container that may be a name of the network, at which nobody
            can listen.

    Raises:
        SetupError: no hub has started this process.
    """
    from ai4u_edu.classroom import ClassStore, RoomRule, Seats
    from ai4u_edu.classroom.gateway import SERVER_LIMITS
    from ai4u_edu.classroom.hub import HubEnvironment, hub_class_app
    from ai4u_edu.classroom.names import names_language
    from ai4u_edu.page.server import serve
    from ai4u_edu.page.server.process_exit import HAS_SERVED
    from ai4u_edu.runtime.process_tuning import released_memory, tuned_process

    hub, options = HubEnvironment.read(), context.params
    source = context.get_parameter_source("host")
    is_host_given = source is not None and source.name != "DEFAULT"

    def announce(url: str) -> None:
        address = f"{url.rstrip('/')}{hub.prefix}"
        say(_("The class is a service of the hub: {address}", address=address))

    with ClassStore(options["folder"], options["max_folder"]) as store:
        rule = RoomRule.parse("each")
        seats = Seats(store, options["scene"], rule, language=names_language())
        app = hub_class_app(
            store,
            seats,
            hub,
            teachers=options["teachers"] or ["ai4u-teachers"],
            blocks=options["own_blocks"] or (),
        )
        host = options["host"] if is_host_given else hub.host
        with tuned_process(), released_memory():
            serve(app, host, hub.port, announce, **SERVER_LIMITS)
    HAS_SERVED.set()
