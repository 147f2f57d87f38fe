"""``ai4u-edu play``: serve a scene in the browser."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from ai4u_edu.base.errors import text_of
from ai4u_edu.base.limits import DEFAULT_KEPT_EPISODES
from ai4u_edu.base.options import DRIVERS, MISSIONS, MissingOptionError, load_option
from ai4u_edu.cli import play_options as o
from ai4u_edu.cli.options import OwnBlocks, expect_scene, load_own_blocks
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, translate

if TYPE_CHECKING:
    from ai4u_edu.page.server.start_page import MissionsView
    from ai4u_edu.room import Room, RoomSettings


def play(
    context: typer.Context,
    scene: o.SceneOrWork = "box_chase",
    host: o.Host = "127.0.0.1",
    port: o.Port = 8080,
    open_page: o.OpenPage = True,
    seed: o.Seed = None,
    time_scale: o.TimeScale = None,
    wait_for_key: o.WaitForKey = True,
    allow_host: o.AllowHost = None,
    token: o.Token = "",
    connections: o.Connections = 120,
    seeded_resets: o.SeededResets = None,
    lockstep: o.Lockstep = None,
    on_missing: o.PlayOnMissing = None,
    grace: o.Grace = 3.0,
    receive_timeout: o.ReceiveTimeout = 2000,
    own_blocks: OwnBlocks = None,
    brain: o.Drivers = None,
    record: o.Record = None,
    keep: o.Keep = DEFAULT_KEPT_EPISODES,
    ghost: o.GhostFile = None,
    offer: o.Offers = None,
    kept_scenes: o.SavedScenes = None,
    missions: o.MissionsFolder = None,
    restore: o.Restore = False,
    autosave: o.AutosaveFlag = True,
    class_url: o.ClassUrl = "",
    code: o.ClassCode = "",
    name_choice: o.NameChoice = 1,
) -> None:
    """Serve a scene in the browser; drive with W, A, S, D."""
    expect_scene("play", [scene, *context.args])
    from ai4u_edu.page.editing.autosave import unsaved_folder
    from ai4u_edu.page.server import Rules, hosts_for, is_loopback, token_for
    from ai4u_edu.room import RoomSettings

    load_own_blocks(own_blocks)
    token = token_for(host, token)
    if is_loopback(host) and not allow_host:  # nobody else has to wait, or begins again
        lockstep = True if lockstep is None else lockstep
        seeded_resets = True if seeded_resets is None else seeded_resets
    settings = RoomSettings(
        scene=scene,
        is_scene_named=_is_scene_named(context),
        seed=seed,
        time_scale=time_scale,
        wait_for_key=wait_for_key,
        allowed_hosts=hosts_for(host),
        proxy_hosts=tuple(allow_host or ()),
        rules=Rules(grace, receive_timeout, token, bool(seeded_resets), lockstep, on_missing or ""),
        missions=_mission_map(missions),
        missions_folder=missions,
        record=record,
        keep=keep,
        ghost=ghost,
        offers=(*(offer or ()), *([str(record)] if record else ())),
        saved_scenes=kept_scenes,
        restore=restore,
        unsaved=unsaved_folder() if autosave or restore else None,
        autosave=autosave,
        work=unsaved_folder().parent if autosave else None,
    )
    if brain:
        build = load_option(DRIVERS, "--brain").with_drivers
        build = partial(build, specs=brain, is_served=True, receive_timeout=receive_timeout)
        settings = replace(settings, build=build)
    settings = _with_class(_with_work(settings), class_url, code, name_choice, port)
    if autosave and settings.saved_scenes is None and settings.class_folder is None:
        settings = replace(settings, saved_scenes=_own_scenes())
    _serve(settings, host, port, open_page, connections)


def _mission_map(folder: Path | None) -> "Callable[[], MissionsView]":
    """Return the function that lists missions, and warn of those that can't be read.

    Args:
        folder: of a teacher; None for none.
    """
    from ai4u_edu.page.server import MissionsView

    try:
        missions = load_option(MISSIONS, "--missions" if folder else "the start page")
    except MissingOptionError:
        if folder is not None:
            raise
        return MissionsView
    show: Callable[[], MissionsView] = missions.mission_map(folder)
    for problem in show().problems:
        _warn(problem)
    return show


def _own_scenes() -> Path | None:
    """Return the user's folder for saved scenes; None if it can't be used."""
    from ai4u_edu.base.atomic_write import make_folder
    from ai4u_edu.base.errors import SetupError, text_of
    from ai4u_edu.page.editing.autosave import unsaved_folder

    folder = unsaved_folder().with_name("scenes")
    try:
        make_folder(folder, _("saved scenes"))
    except SetupError as error:
        _warn(_("{problem}; pages can only download scenes", problem=text_of(error)))
        return None
    return folder


def _serve(
    settings: "RoomSettings", host: str, port: int, open_page: bool, connections: int
) -> None:
    from ai4u_edu.page.server import open_on_desktop, serve, with_token
    from ai4u_edu.page.server.process_exit import HAS_SERVED
    from ai4u_edu.room import Room
    from ai4u_edu.runtime.process_tuning import tuned_process

    token = settings.rules.token
    room = Room(settings, _warn, typer.echo)

    def announce(url: str) -> None:
        _announce(room, host, url, token)
        if open_page:
            open_on_desktop(with_token(url, token))

    with tuned_process(), room:
        serve(room.page.app, host, port, on_ready=announce, per_address=connections)
    HAS_SERVED.set()


def _with_work(settings: "RoomSettings") -> "RoomSettings":
    """Open a ZIP file with a student's work, if that is the scene."""
    if not settings.scene.lower().endswith(".zip"):
        return settings
    from ai4u_edu.member.my_work import open_my_work

    work = open_my_work(Path(settings.scene))
    told = _(
        "Your work is in {folder}, and scenes that you save go there.", folder=str(work.folder)
    )
    typer.echo(translate(told))
    return replace(
        settings,
        scene=str(work.scene),
        saved_scenes=settings.saved_scenes or work.scenes,
        offers=(*settings.offers, str(work.episodes)),
    )


def _with_class(
    settings: "RoomSettings", url: str, code: str, name_choice: int, port: int
) -> "RoomSettings":
    """Join a class, if there is an address.

    Args:
        settings: of the world.
        url: address of the class; ``hub`` for that of the JupyterHub that started this server.
        code: join code.
        name_choice: number of the name to take.
        port: of the world's page.
    """
    if url == "hub":
        return _with_class_at_hub(settings, port)
    if not url:
        if code:
            raise typer.BadParameter(_("expected --class with the address of the class, too"))
        return settings
    from ai4u_edu.base.atomic_write import make_folder
    from ai4u_edu.member import ClassLinkSettings, SeatFile
    from ai4u_edu.page.editing.autosave import unsaved_folder

    seats = SeatFile(unsaved_folder().with_name("classes") / "seats.json")
    seat = seats.take(url, code, name_choice)
    folder = seats.folder(seat)
    make_folder(folder, _("the seat in the class"))
    typer.echo(translate(_("Joined the class as {name}.", name=seat.name)))
    return replace(
        settings, class_link=ClassLinkSettings(seat.url, seat.token), class_folder=folder
    )


def _with_class_at_hub(settings: "RoomSettings", port: int) -> "RoomSettings":
    """Join the class of the JupyterHub that has started this server, if there is one."""
    from ai4u_edu.base.atomic_write import make_folder
    from ai4u_edu.member import ClassLinkSettings, NotJoinedError, join_at_hub, page_at_hub
    from ai4u_edu.page.editing.autosave import unsaved_folder
    from ai4u_edu.page.server import with_token

    try:
        seat = join_at_hub()
    except NotJoinedError as error:
        _warn(join([text_of(error), _("The world runs without a class.")]))
        return settings
    folder = unsaved_folder().with_name("classes") / "at-hub"
    make_folder(folder, _("the seat in the class"))
    typer.echo(translate(_("Joined the class as {name}.", name=seat.name)))
    token = settings.rules.token
    page = with_token(f"proxy/{port}/", token) if port else ""
    return replace(
        settings,
        class_link=ClassLinkSettings(seat.url, seat.token, page=page_at_hub(page) if page else ""),
        class_folder=folder,
    )


def _is_scene_named(context: typer.Context) -> bool:
    source = context.get_parameter_source("scene")
    return source is not None and source.name != "DEFAULT"


def _announce(room: "Room", host: str, url: str, token: str) -> None:
    from ai4u_edu.page.editing.unsaved import format_unsaved
    from ai4u_edu.page.server import startup_banner

    typer.echo(startup_banner(room.title, host, url, token))
    unsaved = room.editor.recovery.unsaved
    if unsaved is not None:
        told = _(
            "You have an unsaved scene from {time}. To reopen it: ai4u-edu play --restore",
            time=unsaved.when,
        )
        typer.echo(translate(told))
    if len(room.unsaved) > 1:
        known = format_unsaved(room.unsaved)
        told = _(
            "All unsaved scenes: {known}. To reopen one: ai4u-edu play SCENE --restore",
            known=known,
        )
        typer.echo(translate(told))


def _warn(problem: str) -> None:
    words = translate(_("warning: {text}", text=problem))
    typer.secho(words, err=True, fg=typer.colors.YELLOW)
