"""``ai4u-edu play``: serve a scene in the browser."""

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from ai4u_edu.base.limits import DEFAULT_KEPT_EPISODES
from ai4u_edu.cli import play_options as o
from ai4u_edu.cli.options import OwnBlocks, load_own_blocks

if TYPE_CHECKING:
    from ai4u_edu.agent import ControlRequestor
    from ai4u_edu.editing import SceneEditor
    from ai4u_edu.editing.autosave import Autosave
    from ai4u_edu.editing.sharing import SharedScene
    from ai4u_edu.editing.unsaved import Unsaved
    from ai4u_edu.recording import Episode
    from ai4u_edu.runtime.runner import Runner
    from ai4u_edu.scenes import Scene
    from ai4u_edu.server import LessonView, Rules


@dataclass(frozen=True, kw_only=True)
class PlaySettings:
    """Settings of one run of ``ai4u-edu play``; each field is the option of the same name."""

    scene: str
    is_scene_named: bool
    """False if the scene is only the default."""
    host: str
    port: int
    open_page: bool
    seed: int | None
    time_scale: float | None
    wait_for_key: bool
    allowed_hosts: list[str]
    connections: int
    rules: "Rules"
    drivers: list[str]
    record: Path | None
    keep: int
    ghost: Path | None
    offers: list[str]
    saved_scenes: Path | None
    restore: bool
    autosave: bool


def play(
    context: typer.Context,
    scene: o.SceneName = "box_chase",
    host: o.Host = "127.0.0.1",
    port: o.Port = 8080,
    open_page: o.OpenPage = True,
    seed: o.Seed = None,
    time_scale: o.TimeScale = None,
    wait_for_key: o.WaitForKey = True,
    allow_host: o.AllowHost = None,
    token: o.Token = "",
    connections: o.Connections = 120,
    seeded_resets: o.SeededResets = False,
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
    restore: o.Restore = False,
    autosave: o.AutosaveFlag = True,
) -> None:
    """Serve a scene in the browser; drive with W, A, S, D."""
    from ai4u_edu.server import Rules, token_for

    rules = Rules(
        token=token_for(host, token),
        seeded_resets=seeded_resets,
        lockstep=lockstep,
        on_missing=on_missing or "",
        grace=grace,
        receive_timeout=receive_timeout,
    )
    load_own_blocks(own_blocks)
    settings = PlaySettings(
        scene=scene,
        is_scene_named=_is_scene_named(context),
        host=host,
        port=port,
        open_page=open_page,
        seed=seed,
        time_scale=time_scale,
        wait_for_key=wait_for_key,
        allowed_hosts=allow_host or [],
        connections=connections,
        rules=rules,
        drivers=brain or [],
        record=record,
        keep=keep,
        ghost=ghost,
        offers=[*(offer or ()), *([str(record)] if record else ())],
        saved_scenes=kept_scenes,
        restore=restore,
        autosave=autosave,
    )
    serve_scene(settings)


def serve_scene(settings: PlaySettings) -> None:
    """Build the world and its page, and serve them until somebody ends it.

    Raises:
        AI4UError: the scene, a file or the address can't be used; the message says why.
    """
    from ai4u_edu.editing.autosave import Autosave, unsaved_folder, unsaved_scenes
    from ai4u_edu.panel import PanelSockets
    from ai4u_edu.recording import Episode, recorder_into
    from ai4u_edu.runtime.process_tuning import tuned_process
    from ai4u_edu.runtime.runner import Runner
    from ai4u_edu.server import hosts_for, lock_viser_port, room_app, serve
    from ai4u_edu.server.process_exit import HAS_SERVED
    from ai4u_edu.viewer import Viewer

    is_unsaved_wanted = settings.autosave or settings.restore
    unsaved = unsaved_scenes(unsaved_folder()) if is_unsaved_wanted else []
    restored = _restored(settings, unsaved)
    scene, linked_seed = _scene_of(settings, restored)
    title = scene.description.title or scene.description.name
    sim, scene = _build(scene, settings.drivers)
    recorder = recorder_into(settings.record, sim, scene, settings.keep)
    ghost = Episode.load(settings.ghost) if settings.ghost else None
    runner = Runner(
        sim,
        seed=_first_seed(settings, ghost, linked_seed),
        time_scale=settings.time_scale,
        recorder=recorder,
        wait_for_key=settings.wait_for_key,
    )
    name = scene.description.name
    autosave = Autosave(unsaved_folder(), name, _warn) if settings.autosave else None
    editor = _make_editor(settings, runner, scene, autosave)
    if restored is not None:
        editor.recovery.mark_restored(restored)
    elif unsaved:
        editor.recovery.unsaved = unsaved[0]
    viewer = Viewer(runner, title=title, editor=editor)
    if ghost is not None and settings.ghost is not None:
        viewer.ghosts.race(ghost, settings.ghost.name)
    lock_viser_port(viewer.server)
    room = room_app(
        runner,
        viser_port=viewer.port,
        title=lambda: editor.title,
        allowed_hosts=hosts_for(settings.host),
        proxy_hosts=settings.allowed_hosts,
        rules=settings.rules,
        editor=editor,
        lessons=_lessons,
        panel=PanelSockets(runner, viewer, editor),
    )
    runner.start()
    viewer.start()
    with ExitStack() as ending:  # the last one first: the runner may yet change what is saved
        ending.enter_context(tuned_process())
        ending.callback(viewer.stop)
        if autosave is not None:
            ending.callback(autosave.stop)
        ending.callback(runner.stop)
        on_ready = _announcer(settings, title, editor, unsaved)
        serve(
            room, settings.host, settings.port, on_ready=on_ready, per_address=settings.connections
        )
    HAS_SERVED.set()


def _is_scene_named(context: typer.Context) -> bool:
    source = context.get_parameter_source("scene")
    return source is not None and source.name != "DEFAULT"


def _build(scene: "Scene", drivers: list[str]) -> "tuple[ControlRequestor, Scene]":
    if not drivers:
        return scene.build(), scene
    from ai4u_edu.training.assigned import with_drivers  # loads packages that most don't need

    return with_drivers(scene, drivers, is_served=True)


def _restored(settings: PlaySettings, unsaved: "list[Unsaved]") -> "Unsaved | None":
    from ai4u_edu.editing.unsaved import choose_unsaved

    if not settings.restore:
        return None
    return choose_unsaved(unsaved, settings.scene if settings.is_scene_named else "")


def _scene_of(settings: PlaySettings, restored: "Unsaved | None") -> "SharedScene":
    """Return the scene to serve, and the seed that comes with it in a link."""
    from ai4u_edu.editing.sharing import SharedScene, read_shared
    from ai4u_edu.scenes import Scene
    from ai4u_edu.scenes.scene_link import is_link

    if restored is not None:
        return SharedScene(restored.scene(), None)
    if is_link(settings.scene):
        return read_shared(settings.scene)
    return SharedScene(Scene.load(settings.scene), None)


def _first_seed(settings: PlaySettings, ghost: "Episode | None", linked: int | None) -> int | None:
    if settings.seed is not None:
        return settings.seed
    return linked if ghost is None else ghost.seed


def _make_editor(
    settings: PlaySettings,
    runner: "Runner",
    scene: "Scene",
    autosave: "Autosave | None",
) -> "SceneEditor":
    from ai4u_edu.editing import SceneEditor
    from ai4u_edu.editing.scene_store import SceneStore

    editor = SceneEditor(runner, scene, offers=settings.offers)
    editor.recovery.autosave = autosave
    if settings.saved_scenes is not None:
        editor.scene_store = SceneStore(settings.saved_scenes)
    return editor


def _lessons() -> "list[LessonView]":
    from ai4u_edu.lessons.course import lessons
    from ai4u_edu.server import LessonView

    return [
        LessonView(
            number=each.number,
            title=each.title.removeprefix(each.number).strip(),
            duration=each.duration,
        )
        for each in lessons()
    ]


def _announcer(
    settings: PlaySettings, title: str, editor: "SceneEditor", unsaved: "list[Unsaved]"
) -> Callable[[str], None]:
    from ai4u_edu.editing.unsaved import format_unsaved
    from ai4u_edu.server import open_on_desktop, startup_banner, with_token

    def announce(url: str) -> None:
        typer.echo(startup_banner(title, settings.host, url, settings.rules.token))
        if editor.recovery.unsaved is not None:
            when = editor.recovery.unsaved.when
            typer.echo(
                f"You have an unsaved scene from {when}. To reopen it: ai4u-edu play --restore"
            )
        if len(unsaved) > 1:
            known = format_unsaved(unsaved)
            typer.echo(f"All unsaved scenes: {known}. To reopen one: ai4u-edu play SCENE --restore")
        if settings.open_page:
            open_on_desktop(with_token(url, settings.rules.token))

    return announce


def _warn(problem: str) -> None:
    typer.secho(f"warning: {problem}", err=True, fg=typer.colors.YELLOW)
