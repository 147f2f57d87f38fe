"""``ai4u-edu class --hub``: a class as a service of a JupyterHub."""

import typer

TEACHERS = ["ai4u-teachers"]
"""Usual groups of the hub whose members are teachers."""


def serve_at_hub(context: typer.Context) -> None:
    """Serve a class until SIGTERM, which the hub sends at its end.

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
    from ai4u_edu.page.server import serve
    from ai4u_edu.page.server.process_exit import HAS_SERVED
    from ai4u_edu.runtime.process_tuning import released_memory, tuned_process

    hub, options = HubEnvironment.read(), context.params
    source = context.get_parameter_source("host")
    is_host_given = source is not None and source.name != "DEFAULT"

    def announce(url: str) -> None:
        typer.echo(f"The class is a service of the hub: {url.rstrip('/')}{hub.prefix}")

    with ClassStore(options["folder"], options["max_folder"]) as store:
        rule = RoomRule.parse("each")
        seats = Seats(store, options["scene"], rule, language=options["language"])
        app = hub_class_app(
            store,
            seats,
            hub,
            teachers=options["teachers"] or TEACHERS,
            blocks=options["own_blocks"] or (),
        )
        host = options["host"] if is_host_given else hub.host
        with tuned_process(), released_memory():
            serve(app, host, hub.port, announce, **SERVER_LIMITS)
    HAS_SERVED.set()
