"""The commands for recorded episodes; what they need is loaded when they run."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.table import Table

from ai4u_edu.atomic_write import make_folder, write_atomically
from ai4u_edu.errors import SetupError

if TYPE_CHECKING:
    from ai4u_edu.cycle import ControlRequestor
    from ai4u_edu.recording import Episode, Recorder
    from ai4u_edu.scenes import Scene

LONGEST = 5000
"""Decisions after which an episode is cut off in a scene that has no limit of its own."""
KEPT = 50
"""So many episodes are kept in memory."""
MAX_SCENE_NAME_BYTES = 150
"""Length of a scene's name in the name of a file."""

OwnBlocks = Annotated[
    list[Path] | None,
    typer.Option("--blocks", help="A Python file with blocks of your own, which is run."),
]
Data = Annotated[
    list[Path], typer.Argument(help="Recorded episodes (.episode), or folders of them.")
]
AgentId = Annotated[
    str | None, typer.Option(help="The agent's id; left out, the one that acts first.")
]


def add_to(app: typer.Typer) -> None:
    """Adds the commands to a command line."""
    for command in (record, replay, dataset, clone):
        app.command()(command)


def record(
    scene: Annotated[str, typer.Argument(help="A scene of the library, or a YAML file.")],
    brain: Annotated[
        list[str] | None,
        typer.Option(
            help="Who drives: FILE.py:NAME (a function or a Controller), a network (.onnx, "
            "zoo:SCENE), a training's folder, random; ID=... for another agent than the first. "
            "Left out, the scene's own."
        ),
    ] = None,
    episodes: Annotated[int, typer.Option(min=1, max=10_000)] = 1,
    seed: Annotated[int, typer.Option(help="Of the first episode; then one by one.", min=0)] = 0,
    out: Annotated[Path, typer.Option(help="A folder for the files.")] = Path("episodes"),
    own_blocks: OwnBlocks = None,
) -> None:
    """Let somebody drive, and keep the episodes as files."""
    from ai4u_edu.scenes import Scene

    _load_blocks(own_blocks)
    loaded = Scene.load(scene)
    sim, loaded = _with_brains(loaded, brain or [])
    recorder = recorder_into(out, sim, loaded)
    first = sim.agents[0]
    for each in range(seed, seed + episodes):
        sim.reset(each)
        episode = sim.episode
        while not first.done and first.steps < LONGEST and sim.episode == episode:
            sim.step(first)
            if first.stopped or first.paused:
                break
        recorder.finish()
    Console().print(_overview(list(recorder.episodes)))
    typer.echo(f"kept in {out}; look at one:  ai4u-edu replay {out}/... --html episode.html")


def replay(
    file: Annotated[Path, typer.Argument(help="A recorded episode (.episode).")],
    html: Annotated[Path | None, typer.Option(help="Write a page that plays it.")] = None,
    gif: Annotated[Path | None, typer.Option(help="Draw it as an animated GIF.")] = None,
    mp4: Annotated[
        Path | None, typer.Option(help='Draw it as a video; needs "ai4u-edu\\[video]".')
    ] = None,
    csv: Annotated[
        Path | None, typer.Option(help="Write a table, a row for each decision.")
    ] = None,
    own_blocks: OwnBlocks = None,
) -> None:
    """Play a recorded episode again, say whether it is exact, and export it."""
    from ai4u_edu.recording import Episode, Replay
    from ai4u_edu.recording.csv_file import write_csv
    from ai4u_edu.recording.movie import write_gif, write_mp4
    from ai4u_edu.recording.page import write_html

    _load_blocks(own_blocks)
    played = Replay(Episode.load(file))
    verdict = played.verdict
    writers: list[tuple[Path | None, Callable[[Replay, Path], Path]]] = [
        (html, write_html),
        (gif, write_gif),
        (mp4, write_mp4),
        (csv, write_csv),
    ]
    Console().print(_details(played.episode))
    for path, write in writers:
        if path is not None:
            typer.echo(f"{write(played, path)}: {path.stat().st_size / 1000:.0f} kB")
    if verdict.exact:
        typer.echo("it plays again exactly, bit for bit")
        return
    seconds = verdict.until / played.episode.scene.world.ticks_per_second
    typer.echo(f"it plays again exactly up to {seconds:.2f} s and not beyond: {verdict.why}")
    raise typer.Exit(1)


def dataset(
    data: Data,
    out: Annotated[Path | None, typer.Option(help="Write NumPy arrays (.npz).")] = None,
    minari: Annotated[
        str, typer.Option(help='Make a Minari dataset of that name; needs "ai4u-edu\\[data]".')
    ] = "",
    observation: Annotated[str, typer.Option(help="flat or dict.")] = "flat",
    agent: AgentId = None,
    own_blocks: OwnBlocks = None,
) -> None:
    """Make data to learn from out of recorded episodes."""
    from ai4u_edu.training.demonstrations import demonstrations, load_episodes

    if out is None and not minari:
        raise SetupError("expected --out FILE.npz, --minari NAME, or both")
    _load_blocks(own_blocks)
    shown = demonstrations(load_episodes(data), agent=agent, observation=observation)
    told = f"{len(shown.episodes)} episodes, {shown.decisions} decisions"
    if out is not None:
        typer.echo(f"{shown.save(out)}: {told}")
    if minari:
        shown.to_minari(minari)
        typer.echo(f"Minari dataset {minari}: {told}")


def clone(
    data: Data,
    out: Annotated[Path, typer.Option(help="The network's file.")] = Path("policy.onnx"),
    seed: Annotated[int, typer.Option(help="The same seed gives the same network.", min=0)] = 0,
    updates: Annotated[int, typer.Option(help="Gradient steps.", min=1)] = 2000,
    agent: AgentId = None,
    evaluate: Annotated[
        int, typer.Option(help="Episodes, on seeds of 1000 and more, in which it is tried out.")
    ] = 100,
    own_blocks: OwnBlocks = None,
) -> None:
    r"""Let a network learn to do what was recorded (behaviour cloning).

    Needs: pip install "ai4u-edu\[train]"
    """
    from ai4u_edu.extras import need

    need("train", "torch", "stable_baselines3", "onnx", "onnxscript")
    from ai4u_edu.scenes import Scene
    from ai4u_edu.training.cloning import clone as cloned
    from ai4u_edu.training.demonstrations import load_episodes
    from ai4u_edu.training.entrants import entrant
    from ai4u_edu.training.evaluating import evaluate as evaluated
    from ai4u_edu.training.report import table

    _load_blocks(own_blocks)
    episodes = load_episodes(data)
    done = cloned(episodes, out, agent=agent, seed=seed, updates=updates)
    typer.echo(f"{done.path}: cloned from {done.decisions} decisions, error {done.loss:.4f}")
    if evaluate:
        where = Scene(episodes[0].scene)
        result = evaluated(entrant(str(out)), where, range(1000, 1000 + evaluate))
        Console().print(table([result]))
    typer.echo(f"let it drive:  ai4u-edu play {episodes[0].scene.name} --brain {out}")


def recorder_into(
    folder: Path | None, sim: "ControlRequestor", scene: "Scene", keep: int = KEPT
) -> "Recorder":
    """A recorder that keeps the last episodes, and writes each into a folder when it is over.

    Args:
        folder: where to; None: nothing is written.
        sim: the world and its agents.
        scene: what it was made from.
        keep: how many episodes are kept in memory.
    """
    from ai4u_edu.recording import Archive, Recorder
    from ai4u_edu.recording.file import encode

    episodes = Archive(keep)
    if folder is None:
        return Recorder(sim, scene=scene.description, episodes=episodes)
    make_folder(folder, "recorded episodes")

    def write(episode: "Episode") -> None:
        scene = episode.scene.name.encode()[:MAX_SCENE_NAME_BYTES].decode(errors="ignore")
        name, data, count = f"{scene}-{episode.seed}", encode(episode), 1
        path = folder / f"{name}.episode"
        while True:
            try:
                write_atomically(path, data, over=False)
            except FileExistsError:  # of an earlier episode, or of another server
                count += 1
                path = folder / f"{name}-{count}.episode"
            else:
                return

    return Recorder(sim, scene=scene.description, episodes=episodes, on_episode=write)


def _with_brains(scene: "Scene", specs: list[str]) -> "tuple[ControlRequestor, Scene]":
    from ai4u_edu.training.entrants import entrant

    ids = [agent.id for agent in scene.build().agents]
    named: dict[str, str] = {}
    for spec in specs:
        agent, equals, who = spec.partition("=")
        named |= {agent: who} if equals and agent in ids else {ids[0]: spec}
    entrants = {agent: entrant(who) for agent, who in named.items()}
    for each in entrants.values():
        scene = each.fitted(scene)
    sim = scene.build()
    for agent_id, each in entrants.items():
        driver = sim.agent(agent_id)
        driver.use_brain(each.brain(driver))
    controller = getattr(sim.agents[0].brain, "controller", None)
    if hasattr(controller, "_keyboard"):
        raise SetupError(
            f"agent {ids[0]!r} is driven by keys ({type(controller).__name__}), and nobody is here "
            "to hold them; name who drives, as in --brain FILE.py:NAME, or drive yourself: "
            f"ai4u-edu play {scene.description.name} --record DIR"
        )
    return sim, scene


def _load_blocks(files: list[Path] | None) -> None:
    from ai4u_edu.blocks.own_file import load_blocks

    for file in files or ():
        load_blocks(file)


def _overview(episodes: "list[Episode]") -> Table:
    told = Table(box=None, pad_edge=False)
    for heading in ("scene", "seed", "seconds", "decisions", "reward", "success"):
        told.add_column(heading, justify="left" if heading == "scene" else "right")
    for each in episodes:
        first = each.agents[0]
        told.add_row(
            each.scene.name,
            str(each.seed),
            f"{each.seconds:.1f}",
            str(len(first)),
            f"{first.total:.2f}",
            _yes(each.success),
        )
    return told


def _details(episode: "Episode") -> Table:
    told = Table(
        box=None,
        pad_edge=False,
        title=f"{episode.scene.name}, seed {episode.seed}, {episode.seconds:.1f} s, "
        f"success: {_yes(episode.success)}",
        title_justify="left",
    )
    for heading in ("agent", "decisions", "reward", "terms"):
        told.add_column(heading, justify="right" if heading in ("decisions", "reward") else "left")
    for record in episode.agents:
        sums: dict[str, float] = {}
        for decision in record:
            for name, amount in decision.reward_terms.items():
                sums[name] = sums.get(name, 0.0) + amount
        terms = ", ".join(f"{name} {amount:.3g}" for name, amount in sums.items())
        told.add_row(record.id, str(len(record)), f"{record.total:.2f}", terms)
    return told


def _yes(success: bool | None) -> str:
    return "-" if success is None else "yes" if success else "no"
