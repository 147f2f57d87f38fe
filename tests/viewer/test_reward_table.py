"""Rewards by term and decision in the panel."""

from ai4u_edu.agent import Entry, Ledger
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.viewer.panel.plot import INCREMENTS
from ai4u_edu.viewer.panel.readings import rewards
from ai4u_edu.viewer.panel.reward_table import MAX_LISTED_DECISIONS, curves, reward_table
from tests.builders import small_sim


def test_the_latest_decisions_in_which_something_was_paid(runner: Runner) -> None:
    entries = [Entry(step, {"a<b": float(step % 2), "c": -0.001}, 1.0) for step in range(1, 10)]
    idle = [Entry(10, {"a<b": 0.0}, 1.0)]
    html = reward_table(runner.latest.agents[0]._replace(history=(*entries, *idle)))
    assert html.count("<th>decision ") == MAX_LISTED_DECISIONS
    assert html.index("decision 9") < html.index("decision 8")
    assert "decision 10" not in html
    assert "decision 3" not in html
    assert "a&lt;b +1.00, c \u22120.001" in html


def test_nothing_paid_is_nothing_told(runner: Runner) -> None:
    assert "Paid last" not in reward_table(runner.latest.agents[0]._replace(history=()))


def test_curves_have_a_point_for_each_decision() -> None:
    steps, paid, so_far = curves([Entry(3, {"a": 1.0, "b": 0.5}, 4.0), Entry(4, {}, 4.0)])
    assert (steps.tolist(), paid.tolist(), so_far.tolist()) == ([3, 4], [1.5, 0], [4, 4])
    assert [len(each) for each in curves([])] == [1, 1, 1]


def test_a_ledger_remembers_only_if_it_is_told_to() -> None:
    sim = small_sim()
    (agent,) = sim.agents
    agent.end_of_step.connect(lambda agent: agent.add_reward(2.0, name="bonus"))
    sim.reset(1)
    sim.step()
    assert capture_snapshot(sim).agents[0].history == ()
    agent.ledger.keep_history(2)
    for _ in range(3):
        sim.step()
    assert capture_snapshot(sim).agents[0].history == (
        Entry(3, {"bonus": 2.0}, 6.0),
        Entry(4, {"bonus": 2.0}, 8.0),
    )
    sim.reset(1)
    assert capture_snapshot(sim).agents[0].history == ()


def test_the_reward_that_is_shown_is_that_of_the_last_decision_that_is_over() -> None:
    sim = small_sim(skip_frame=2)
    (agent,) = sim.agents
    agent.end_of_step.connect(lambda agent: agent.add_reward(2.0, name="bonus"))
    agent.end_of_update_state.connect(lambda agent: agent.add_reward(0.5, name="late"))
    sim.reset(1)

    def shown() -> tuple[float, dict[str, float]]:
        state = capture_snapshot(sim).agents[0]
        return state.reward, state.reward_terms

    seen = []
    for _ in range(7):
        seen.append(shown())
        sim.tick()
    paid = (2.5, {"bonus": 2.0, "late": 0.5})
    assert seen == [(0.0, {})] * 3 + [paid] * 4
    assert (agent.reward, agent.reward_terms) == (0.0, {})  # of the decision that is under way
    sim.reset(1)
    assert shown() == (0.0, {})


def test_a_sum_of_nothing_looks_like_any_sum() -> None:
    assert "<th>sum</th><td>0.00</td><td>0.00</td>" in rewards({}, {})


def test_what_is_kept_may_grow() -> None:
    book = Ledger()
    book.keep_history(1)
    for step in (1, 2):
        book.open()
        book.pay("a", 1.0)
        book.close(step)
    book.keep_history(3)
    assert [entry.step for entry in book.history] == [2]
    assert book.history.maxlen == 3


def test_no_two_numbers_of_an_axis_look_alike() -> None:
    digits = 3  # uPlot shows no more after the point
    assert list(INCREMENTS) == sorted(INCREMENTS)
    assert all(round(each, digits) == each > 0 for each in INCREMENTS)
