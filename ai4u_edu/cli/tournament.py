"""The command ``tournament``; heavy imports happen when it runs."""

import shlex
from contextlib import closing
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer
from rich.console import Console
from rich.table import Table

from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.optional_deps import need
from ai4u_edu.cli import training_options as o
from ai4u_edu.cli.options import OwnBlocks, check_blocks, load_own_blocks, say, seed_option
from ai4u_edu.cli.sweep import INTERRUPTED
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate, unpacked

if TYPE_CHECKING:
    from ai4u_edu.games.jobs import JobOutcome
    from ai4u_edu.games.tournament.plan import TournamentPlan
    from ai4u_edu.games.tournament.tournament import Tournament

MAX_SEEDS = 1000
VERIFY = "verify"
Words = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="SCENE ENTRY...",
        help="The scene, then the entries: NAME=SPEC or SPEC, where SPEC is a network (FILE.onnx), "
        "a controller's name, scene (the scene's scripted controllers), random, a recorded "
        "episode, or FILE.py. NAME=PART:SPEC,PART:SPEC for agents that need different ones. Or: "
        "verify FOLDER.",
    ),
]
Seeds = Annotated[
    int, typer.Option(help="Number of seeds for each pair, or of races.", min=1, max=MAX_SEEDS)
]
System = Annotated[
    Literal["round-robin", "swiss"],
    typer.Option(help="round-robin: all pairs; swiss: neighbours in the standings, in rounds."),
]
Rounds = Annotated[
    int,
    typer.Option(
        help="Rounds of swiss. Default: enough to find the best.",
        min=0,
        max=1000,
        show_default=False,
    ),
]
TrustPython = Annotated[
    bool,
    typer.Option(
        "--trust-python",
        help="Run Python files, each in a process with limits. They can do what you can: read and "
        "delete your files, end your programs.",
    ),
]


def tournament(
    words: Words = None,
    seeds: Seeds = 2,
    seed: Annotated[int, seed_option("The first seed; the next ones count up.")] = 0,
    system: System = "round-robin",
    rounds: Rounds = 0,
    trust_python: TrustPython = False,
    out: Annotated[
        Path | None, typer.Option(help="Folder for the results. Default: runs/SCENE-tournament.")
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Continue the tournament in --out as it was begun.")
    ] = False,
    engine: o.JobsEngine = "processes",
    address: o.ClusterAddress = "",
    own_blocks: OwnBlocks = None,
) -> None:
    r"""Let networks and programs play each other, and rate them.

    Every game is kept as a recording; "tournament verify FOLDER" plays all again and compares bit
    for bit. Ctrl-C keeps what is finished; the same command, or --resume --out DIR, goes on.
    Needs: pip install "ai4u-edu\[tournament]"
    """
    need("tournament", "openskill")
    load_own_blocks(own_blocks)
    given = words or []
    if given[:1] == [VERIFY]:
        if len(given) != 2:
            raise SetupError(_("expected one folder: ai4u-edu tournament verify FOLDER"))
        _verify(Path(given[1]), engine, address, own_blocks)
        return
    if resume:
        if out is None or given:
            raise SetupError(
                _(
                    "--resume goes on as it was begun: expected --out, the tournament's folder, "
                    "and no scene"
                )
            )
        from ai4u_edu.games.tournament.plan import TournamentPlan

        plan, folder = TournamentPlan.load(out), out
        check_blocks(plan.scene, own_blocks)
        if not trust_python and not all(each.can_repeat for each in plan.entries):
            raise SetupError(
                _(
                    "{out}: it has Python programs, which may do on this machine what you may; "
                    "read them, then say --trust-python to let them play",
                    out=str(out),
                )
            )
    else:
        first = range(seed, seed + seeds)
        plan = _plan(given, first, system, rounds, trust_python, own_blocks)
        folder = out or Path("runs") / f"{plan.title}-tournament"
        _check_folder(plan, folder)
    plan.save(folder)
    _report(_run(plan, folder, engine, address), engine)


def _plan(
    words: list[str],
    seeds: range,
    system: Literal["round-robin", "swiss"],
    rounds: int,
    trust_python: bool,
    own_blocks: list[Path] | None,
) -> "TournamentPlan":
    from ai4u_edu.base.seeding import seeds_from
    from ai4u_edu.games.tournament.entry import parse_entry, with_names
    from ai4u_edu.games.tournament.plan import TournamentPlan
    from ai4u_edu.games.tournament.sides import sides_of
    from ai4u_edu.scenes.scene_data import scene_data, scene_from

    if len(words) < 3:
        raise SetupError(
            _(
                "expected a scene and two entries at least, as in: ai4u-edu tournament sumo "
                "a.onnx b.onnx scene"
            )
        )
    scene, *specs = words
    data = scene_data(scene, own_blocks or ())
    loaded = scene_from(data)
    sides, name = sides_of(loaded), loaded.description.name
    entries = with_names(
        parse_entry(each, sides, scene=name, trust_python=trust_python) for each in specs
    )
    return TournamentPlan(
        scene=data,
        entries=entries,
        seeds=tuple(seeds_from(seeds.start, len(seeds))),
        system=system,
        rounds=rounds,
    )


def _check_folder(plan: "TournamentPlan", folder: Path) -> None:
    from ai4u_edu.games.tournament.plan import FILE, TournamentPlan

    if (folder / FILE).exists():
        different = plan.difference(TournamentPlan.load(folder))
        if different:
            raise SetupError(
                _(
                    "{folder} holds a tournament with other {different}; go on with that one "
                    "(--resume --out {folder}), or choose another folder (--out)",
                    folder=str(folder),
                    different=different,
                )
            )


def _run(plan: "TournamentPlan", folder: Path, engine_name: str, address: str) -> "Tournament":
    from ai4u_edu.games.jobs import engine
    from ai4u_edu.games.jobs.journal import count_done
    from ai4u_edu.games.tournament.run import run_tournament, write_results
    from ai4u_edu.learn.training.progress_bar import ProgressBar

    total = len(plan.entries) + plan.games_for(len(plan.entries))
    kept, ended = min(count_done(folder), total), count(1)
    bar = ProgressBar(total, _("games"), done=kept)

    def tell(outcome: "JobOutcome") -> None:
        bar.show(max(kept, next(ended)))
        result = outcome.result or {"reason": outcome.error, "forfeit": -1}
        if result["reason"]:
            entries = outcome.job.arguments["entries"]
            names = " - ".join(dict.fromkeys(str(each["name"]) for each in entries))
            bar.note(f"{names}: {translate(unpacked(result['reason']))}")

    with closing(bar), engine(engine_name, address=address) as running:
        done = run_tournament(plan, folder, running, tell=tell)
    write_results(done)
    return done


def _report(done: "Tournament", engine: str) -> None:
    from ai4u_edu.games.tournament.run import PAGE

    shown = Table(box=None, pad_edge=False)
    headings = {
        "place": _("place"),
        "entry": _("entry"),
        "rating": _("rating"),
        "won": _("won"),
        "drawn": _("drawn"),
        "lost": _("lost"),
        "failed": _("failed"),
    }
    for name, heading in headings.items():
        justify: Literal["left", "right"] = "left" if name in ("entry", "rating") else "right"
        shown.add_column(translate(heading), justify=justify)
    for place, each in enumerate(done.standings, 1):
        counts = (each.won, each.drawn, each.lost, each.forfeits)
        shown.add_row(str(place), each.name, translate(each.rating), *map(str, counts))
    Console().print(shown, markup=False)
    for name, reason in done.refused.items():
        say(_("refused: {name}: {reason}", name=name, reason=reason))
    folder = shlex.quote(str(done.folder))
    say(
        _(
            "report: {folder}\nverify: ai4u-edu tournament verify {quoted}",
            folder=str(done.folder / PAGE),
            quoted=folder,
        )
    )
    if done.is_interrupted:
        again = f"ai4u-edu tournament --resume --out {folder}"
        if not all(each.can_repeat for each in done.plan.entries):
            again += " --trust-python"
        blocks = done.plan.scene.get("blocks", ())
        again += "".join(f" --blocks {shlex.quote(each)}" for each in blocks)
        again += f" --engine {engine}" if engine != "processes" else ""
        say(_("interrupted after {n} games; go on with: {again}", n=len(done.games), again=again))
        raise typer.Exit(INTERRUPTED)


def _verify(folder: Path, engine_name: str, address: str, own_blocks: list[Path] | None) -> None:
    from ai4u_edu.games.jobs import engine
    from ai4u_edu.games.tournament.plan import TournamentPlan
    from ai4u_edu.games.tournament.verify import verify
    from ai4u_edu.learn.training.progress_bar import ProgressBar

    plan = TournamentPlan.load(folder)
    check_blocks(plan.scene, own_blocks)
    bar = ProgressBar(len(plan.entries) + plan.games_for(len(plan.entries)), _("games"))
    with closing(bar), engine(engine_name, address=address) as running:
        count, problems = verify(folder, running, lambda: bar.add(1))
    for each in problems:
        say(each)
    if problems:
        wrong = sum(each.startswith("game ") for each in problems)
        others = len(problems) - wrong
        differ = _(
            "{folder}: {wrong} of {n} games differ", folder=str(folder), wrong=wrong, n=count
        )
        if others:
            differ = _("{differ}, and {others} other things", differ=differ, others=others)
        raise SetupError(differ)
    say(_("{count} games, played again: all are the same, bit for bit", count=count))
