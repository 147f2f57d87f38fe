"""Report of a sweep as one HTML page."""

from collections.abc import Iterator, Sequence
from html import escape
from pathlib import Path

from ai4u_edu.base.html_report import html_page, html_picture, html_table
from ai4u_edu.learn.training.evaluating import Evaluation
from ai4u_edu.learn.training.sweep.plan import Plan
from ai4u_edu.learn.training.sweep.result import TrialResult, groups, ranked

TITLES = ("Learning curves", "Settings and results", "Without one reward term")


def page_of(
    plan: Plan,
    results: Sequence[TrialResult],
    evaluation: Evaluation | None,
    total: int,
    pictures: Sequence[Path],
) -> str:
    """Return the page.

    Args:
        plan: the sweep's plan.
        results: results of the trials that ended, at least one.
        evaluation: of the best network; None if there is none yet.
        total: number of trials of the whole sweep.
        pictures: learning curves, parallel coordinates, and learning without each reward term if
            that was tried; empty if no trial was checked.
    """
    name = str(plan.scene["name"]).removesuffix(".yaml").removesuffix(".yml")
    return html_page(f"Sweep: {name}", _parts(plan, results, evaluation, total, pictures))


def _parts(
    plan: Plan,
    results: Sequence[TrialResult],
    evaluation: Evaluation | None,
    total: int,
    pictures: Sequence[Path],
) -> Iterator[str]:
    names = [each.name for each in plan.parameters]
    order = ranked(results)
    yield _summary(plan, results, total)
    if evaluation is not None:
        cells = evaluation.cells
        yield "<h2>The best network, on seeds that no training used</h2>"
        yield html_table([*cells], [[*cells.values()]])
        yield (
            f'<p class="soft">{len(evaluation.episodes)} episodes. Quote this row: the best '
            "trial below was chosen by its checks, so its checks look better than it is.</p>"
        )
    if len({each.label for each in results}) < len(results):
        rows = groups(results)
        yield "<h2>Settings over all seeds</h2>"
        if rows:
            yield html_table([*rows[0]], [[*row.values()] for row in rows], marked=(0,))
    for title, picture in zip(TITLES, pictures, strict=False):
        yield f"<h2>{title}</h2>{html_picture(picture, title)}"
    yield "<h2>All trials, the best first</h2>"
    cells_of = [each.cells(names) for each in order]
    headings = [*cells_of[0]]
    texts = (headings.index("algorithm"), headings.index("state"))
    yield html_table(
        headings,
        [[*cells.values()] for cells in cells_of],
        text_columns=texts,
        marked=[0] if order[0].network else [],
    )
    yield (
        '<p class="soft">Success, reward and check length (decisions of an episode) are means of '
        "the best check, whose episodes have the limit of the training; the length above is that "
        "of episodes with the limit of the scene.</p>"
    )
    failed = [each for each in results if each.error]
    if failed:
        yield "<h2>Trials that failed</h2>"
        yield html_table(
            ["trial", "settings", "error"],
            [[each.number, each.label, each.error] for each in failed],
            text_columns=(1, 2),
        )


def _summary(plan: Plan, results: Sequence[TrialResult], total: int) -> str:
    counts = {
        state: sum(each.state == state for each in results)
        for state in ("finished", "pruned", "failed")
    }
    told = ", ".join(f"{count} {state}" for state, count in counts.items() if count)
    steps = "as many decisions as the settings say" if plan.steps is None else f"{plan.steps} steps"
    varied = ", ".join(map(str, plan.parameters)) or "no setting"
    how = "proposed by Optuna" if plan.is_search else "all combinations"
    missing = total - len(results)
    rest = f" {missing} have not run yet." if missing else ""
    unlike = plan.unlike_budgets()
    note = f"<p><strong>{escape(unlike)}.</strong></p>" if unlike else ""
    return (
        f"<p>{total} trials ({how}) of {steps}: {told}.{rest}</p>{note}"
        f"<p class='soft'>Algorithms: {escape(', '.join(plan.algorithms))}. Seeds: "
        f"{escape(_seeds(plan.seeds))}. Varied: <code>{escape(varied)}</code></p>"
    )


def _seeds(seeds: Sequence[int]) -> str:
    if len(seeds) > 1 and list(seeds) == [*range(seeds[0], seeds[-1] + 1)]:
        return f"{seeds[0]}-{seeds[-1]}"
    return ", ".join(map(str, seeds))
