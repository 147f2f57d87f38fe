"""``ai4u-edu class --hub``: a class as a service of a JupyterHub."""

from collections.abc import Iterable
from pathlib import Path

import typer


def serve_at_hub(
    folder: Path, scene: str, language: str, teachers: Iterable[str], blocks: Iterable[Path]
) -> None:
    """Serve a class until SIGTERM, which the hub sends at its end.

    Args:
        folder: of the class.
        scene: of seats that have no world yet.
        language: of students' names.
        teachers: groups of the hub whose members are teachers.
        blocks: Python files with the teacher's blocks.

    Raises:
        SetupError: no hub has started this process.
    """
    from ai4u_edu.classroom import ClassStore, RoomRule, Seats
    from ai4u_edu.classroom.gateway import SERVER_LIMITS
    from ai4u_edu.classroom.hub import HubEnvironment, hub_class_app
    from ai4u_edu.runtime.process_tuning import released_memory, tuned_process
    from ai4u_edu.server import serve
    from ai4u_edu.server.process_exit import HAS_SERVED

    hub = HubEnvironment.read()

    def announce(url: str) -> None:
        typer.echo(f"The class is a service of the hub: {url.rstrip('/')}{hub.prefix}")

    with ClassStore(folder) as store:
        seats = Seats(store, scene, RoomRule.parse("each"), language=language)
        app = hub_class_app(store, seats, hub, teachers=teachers, blocks=blocks)
        with tuned_process(), released_memory():
            serve(app, hub.host, hub.port, announce, **SERVER_LIMITS)
    HAS_SERVED.set()
