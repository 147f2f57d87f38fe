"""Joining of a class by ``ai4u-edu play --class``."""

from dataclasses import replace
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from ai4u_edu.room import RoomSettings

AT_HUB = "hub"
"""Address that stands for the class of the JupyterHub that has started this server."""


def with_class(
    settings: "RoomSettings", url: str, code: str, name_choice: int, port: int
) -> "RoomSettings":
    """Join a class, if there is an address.

    Args:
        settings: of the world.
        url: address of the class, or :data:`AT_HUB`.
        code: join code.
        name_choice: number of the name to take.
        port: of the world's page.
    """
    if url == AT_HUB:
        return _with_class_at_hub(settings, port)
    if not url:
        if code:
            raise typer.BadParameter("expected --class with the address of the class, too")
        return settings
    from ai4u_edu.base.atomic_write import make_folder
    from ai4u_edu.member import ClassLinkSettings, SeatFile
    from ai4u_edu.page.editing.autosave import unsaved_folder

    seats = SeatFile(unsaved_folder().with_name("classes") / "seats.json")
    seat = seats.take(url, code, name_choice)
    folder = seats.folder(seat)
    make_folder(folder, "the seat in the class")
    typer.echo(f"Joined the class as {seat.name}.")
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
        text = f"warning: {error} The world runs without a class."
        typer.secho(text, err=True, fg=typer.colors.YELLOW)
        return settings
    folder = unsaved_folder().with_name("classes") / "at-hub"
    make_folder(folder, "the seat in the class")
    typer.echo(f"Joined the class as {seat.name}.")
    token = settings.rules.token
    page = with_token(f"proxy/{port}/", token) if port else ""
    return replace(
        settings,
        class_link=ClassLinkSettings(seat.url, seat.token, page=page_at_hub(page) if page else ""),
        class_folder=folder,
    )
