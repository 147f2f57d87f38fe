"""Commands for recorded episodes; heavy imports happen when a command runs."""

import time
from collections.abc import Callable
from dataclasses import replace as with_changes
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.table import Table

from ai4u_edu.base.errors import NoDecisionError, SetupError
from ai4u_edu.base.seeding import seeds_from
from ai4u_edu.cli.options import (
    MAX_EPISODES,
    MAX_UPDATES,
    SCENE_AND_MORE,
    OwnBlocks,
    expect_scene,
    let_it_drive,
    load_own_blocks,
    say,
    seed_option,
)
from ai4u_edu.cli.training_options import Trainer
from ai4u_edu.locale import Text, join, ngettext, translate
from ai4u_edu.locale import gettext as _

if TYPE_CHECKING:
    from ai4u_edu.agent import BasicAgent
    from ai4u_edu.agent.cycle import ControlRequestor
    from ai4u_edu.learn.training.demonstrations import Cloned
    from ai4u_edu.recording import Episode
    from ai4u_edu.scenes import Scene

DEFAULT_MAX_DECISIONS = 5000
"""Decisions after which an episode is truncated in a scene without a limit of its own."""
SCRIPT_POLL_S = 0.01
"""Poll interval (s) while the agent's script is not connected."""

Data = Annotated[
    list[Path], typer.Argument(help="Recorded episodes (.episode), or folders of them.")
]
AgentId = Annotated[
    str | None, typer.Option(help="The agent's id. Default: the agent that acts first.")
]


def add_to(app: typer.Typer) -> None:
    """Add the commands to a command line."""
    app.command(context_settings=SCENE_AND_MORE)(record)
    for command in (replay, dataset, clone):
        app.command()(command)


def record(
    context: typer.Context,
    scene: Annotated[str, typer.Argument(help="Scene name or YAML file.")],
    brain: Annotated[
        list[str] | None,
        typer.Option(
            help="The driver: FILE.py:NAME (a function or a Controller), a network (.onnx, zoo, "
            "zoo:SCENE), a training's folder or a model (.zip) in it, a controller, or random. "
            "ID=DRIVER for an agent other than the first. Default: the scene's own."
        ),
    ] = None,
    episodes: Annotated[int, typer.Option(help="Number of episodes.", min=1, max=10_000)] = 1,
    seed: Annotated[int, seed_option("Seed of the first episode; the next ones count up.")] = 0,
    out: Annotated[Path, typer.Option(help="Folder for the files.")] = Path("episodes"),
    own_blocks: OwnBlocks = None,
) -> None:
    """Record episodes of any driver into files."""
    expect_scene("record", [scene, *context.args])
    from ai4u_edu.scenes import Scene

    load_own_blocks(own_blocks)
    seeds = seeds_from(seed, episodes)
    loaded = Scene.load(scene)
    sim, loaded = _with_brains(loaded, brain or [])
    from ai4u_edu.recording import Recorder

    recorder = Recorder.into(out, sim, loaded)
    first = sim.agents[0]
    try:
        for each in seeds:
            _drive(sim, first, each)
            recorder.finish()
    finally:
        recorder.finish()  # Ctrl-C ends the episode, and loses nothing of it
    Console().print(_overview(list(recorder.episodes)))
    say(
        _("saved in {out}; watch one:  ai4u-edu replay {out}/... --html episode.html", out=str(out))
    )


def replay(
    file: Annotated[Path, typer.Argument(help="Recorded episode (.episode).")],
    html: Annotated[Path | None, typer.Option(help="Export it as a web page.")] = None,
    gif: Annotated[Path | None, typer.Option(help="Export it as an animated GIF.")] = None,
    mp4: Annotated[
        Path | None, typer.Option(help='Export it as a video; needs "ai4u-edu\\[video]".')
    ] = None,
    csv: Annotated[
        Path | None, typer.Option(help="Export it as a table with one row per decision.")
    ] = None,
    own_blocks: OwnBlocks = None,
) -> None:
    """Replay a recorded episode, check that it is exact, and export it."""
    from ai4u_edu.recording import Episode, Replay
    from ai4u_edu.recording.exports.csv_file import write_csv
    from ai4u_edu.recording.exports.html_page import write_html
    from ai4u_edu.recording.exports.movie import write_gif, write_mp4

    load_own_blocks(own_blocks)
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
        say(_("the replay is exact, bit for bit"))
        return
    seconds = verdict.exact_until / played.episode.scene.world.ticks_per_second
    say(
        _(
            "the replay is exact up to {seconds:.2f} s and not beyond: {why}",
            seconds=seconds,
            why=verdict.why,
        )
    )
    raise typer.Exit(1)


def dataset(
    data: Data,
    out: Annotated[Path | None, typer.Option(help="File for NumPy arrays (.npz).")] = None,
    minari: Annotated[
        str, typer.Option(help='Name of a Minari dataset to make; needs "ai4u-edu\\[data]".')
    ] = "",
    observation: Annotated[
        str, typer.Option(help="Form of the observations: flat or dict.")
    ] = "flat",
    agent: AgentId = None,
    own_blocks: OwnBlocks = None,
) -> None:
    """Turn recorded episodes into a training dataset."""
    from ai4u_edu.learn.training.demonstrations import demonstrations, load_episodes

    if out is None and not minari:
        raise SetupError(_("expected --out FILE.npz, --minari NAME, or both"))
    load_own_blocks(own_blocks)
    shown = demonstrations(load_episodes(data), agent=agent, observation=observation)
    told = {
        "episodes": ngettext("{n} episode", "{n} episodes", len(shown.episodes)),
        "decisions": ngettext("{n} decision", "{n} decisions", shown.decisions),
    }
    if out is not None:
        say(_("{file}: {episodes}, {decisions}", file=str(shown.save(out)), **told))
    if minari:
        shown.to_minari(minari)
        say(_("Minari dataset {name}: {episodes}, {decisions}", name=minari, **told))


def clone(
    data: Data,
    out: Annotated[Path, typer.Option(help="File to write.")] = Path("policy.onnx"),
    seed: Annotated[int, seed_option("Random seed; the same seed gives the same network.")] = 0,
    updates: Annotated[
        int, typer.Option(help="Number of gradient steps.", min=1, max=MAX_UPDATES)
    ] = 2000,
    agent: AgentId = None,
    evaluate: Annotated[
        int,
        typer.Option(
            help="Number of episodes to evaluate it in afterwards, with seeds from 1000 on; 0 "
            "for none.",
            min=0,
            max=MAX_EPISODES,
        ),
    ] = 100,
    trainer: Trainer = "",
    own_blocks: OwnBlocks = None,
) -> None:
    r"""Train a network to imitate recorded episodes (behaviour cloning).

    With pip install "ai4u-edu\[train]", torch learns; without it, the small learner, which also
    says how well it acts in drives that it never saw.
    """
    from ai4u_edu.learn.training import clone as cloned
    from ai4u_edu.learn.training.demonstrations import load_episodes
    from ai4u_edu.learn.training.evaluating import evaluate as evaluated
    from ai4u_edu.learn.training.evaluating import evaluation_table
    from ai4u_edu.learn.training.policies import entrant
    from ai4u_edu.learn.training.progress_bar import counted

    load_own_blocks(own_blocks)
    episodes = load_episodes(data)
    done = cloned(episodes, out, agent=agent, seed=seed, updates=updates, trainer=trainer)
    say(
        _(
            "{path}: cloned from {decisions} decisions, {quality}",
            path=str(done.path),
            decisions=done.decisions,
            quality=_quality(done),
        )
    )
    if evaluate:
        who = with_changes(entrant(str(out)), agent=agent or "")
        where = _driven_by(out, episodes[0], agent)
        seeds = range(1000, 1000 + evaluate)
        result = evaluated(who, where, counted(seeds, who.name))
        Console().print(evaluation_table([result]))
    let_it_drive(episodes[0].scene.name, out)


def _quality(done: "Cloned") -> Text:
    """Return how well a clone does what it was shown, as the rest of a sentence, and more lines."""
    if done.alike is None or done.commonest is None:
        return _("error {loss:.4f}", loss=done.loss)
    measure = _(
        "and on {held_out} held-out ones it acts like the driver in {alike:.0%} (always the same "
        "action: {commonest:.0%})",
        held_out=done.held_out,
        alike=done.alike,
        commonest=done.commonest,
    )
    return join([measure, *done.remarks], "\n")


def _driven_by(network: Path, episode: "Episode", agent_id: str | None) -> "Scene":
    """Return a recorded scene driven by a network; the recorded driver's file may be missing."""
    from ai4u_edu.recording.scene_export import without_unknown_brains
    from ai4u_edu.scenes import Scene

    controller = {"type": "NeuralNetController", "model_path": str(network.absolute())}
    brains = [{"type": "LocalBrain", "controller": controller}]
    driven = episode.agent(agent_id).id
    agents = tuple(
        {**agent, "brains": brains} if agent.get("id", "0") == driven else agent
        for agent in episode.scene.agents
    )
    return Scene(without_unknown_brains(episode.scene.model_copy(update={"agents": agents})))


def _with_brains(scene: "Scene", specs: list[str]) -> "tuple[ControlRequestor, Scene]":
    from ai4u_edu.learn.training.assigned import with_drivers

    sim, scene = with_drivers(scene, specs)
    controller = getattr(sim.agents[0].brain, "controller", None)
    if hasattr(controller, "_keyboard"):
        raise SetupError(
            _(
                "agent {id!r} is driven by keys ({controller}), and nobody "
                "is here to hold them; name who drives, as in --brain "
                "FILE.py:NAME, or drive yourself: ai4u-edu play "
                "{scene} --record DIR",
                id=sim.agents[0].id,
                controller=type(controller).__name__,
                scene=scene.description.name,
            )
        )
    return sim, scene


def _drive(sim: "ControlRequestor", agent: "BasicAgent", seed: int) -> None:
    """Run one episode; while the agent's script is not connected, say so and wait for it."""
    from ai4u_edu.agent.block_errors import reason_for_no_decision
    from ai4u_edu.blocks import RemoteBrain

    sim.reset(seed)
    episode, in_vain = sim.episode, 0
    while not agent.done and agent.steps < DEFAULT_MAX_DECISIONS and sim.episode == episode:
        steps = agent.steps
        sim.step(agent)
        if agent.stopped or agent.paused:
            return
        in_vain = 0 if agent.steps != steps else in_vain + 1
        if not in_vain:
            continue
        if isinstance(agent.brain, RemoteBrain):
            if in_vain == 1:
                reason = reason_for_no_decision(agent)
                waits = _(
                    "agent {id!r} waits: {reason}  (Ctrl-C ends it)", id=agent.id, reason=reason
                )
                say(waits, err=True)
            time.sleep(SCRIPT_POLL_S)
        elif in_vain == DEFAULT_MAX_DECISIONS:
            reason = reason_for_no_decision(agent)
            raise NoDecisionError(
                _(
                    "agent {id!r} took no decision in {most} ticks: {reason}",
                    id=agent.id,
                    most=DEFAULT_MAX_DECISIONS,
                    reason=reason,
                )
            )


def _overview(episodes: "list[Episode]") -> Table:
    told = Table(box=None, pad_edge=False)
    told.add_column(translate(_("scene")))
    for heading in (_("seed"), _("seconds"), _("decisions"), _("reward"), _("success")):
        told.add_column(translate(heading), justify="right")
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
        title=translate(
            _(
                "{scene}, seed {seed}, {seconds:.1f} s, success: {success}",
                scene=episode.scene.name,
                seed=episode.seed,
                seconds=episode.seconds,
                success=_yes(episode.success),
            )
        ),
        title_justify="left",
    )
    told.add_column(translate(_("agent")))
    for heading in (_("decisions"), _("reward")):
        told.add_column(translate(heading), justify="right")
    told.add_column(translate(_("terms")))
    for record in episode.agents:
        sums: dict[str, float] = {}
        for decision in record:
            for name, amount in decision.reward_terms.items():
                sums[name] = sums.get(name, 0.0) + amount
        terms = ", ".join(f"{name} {amount:.3g}" for name, amount in sums.items())
        told.add_row(record.id, str(len(record)), f"{record.total:.2f}", terms)
    return told


def _yes(success: bool | None) -> str:
    return "-" if success is None else translate(_("yes") if success else _("no"))
