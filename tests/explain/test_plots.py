"""Plots of explanations: pictures of what the arrays say."""

from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

from ai4u_edu.explain import (
    LIMITS,
    field,
    first_disagreement,
    occlusion,
    reward_terms,
    value_map,
)
from ai4u_edu.explain.plots import (
    plot_disagreement,
    plot_field,
    plot_occlusion,
    plot_reward_terms,
    plot_value_map,
)
from tests.explain.test_disagreement import circles, late, recorded
from tests.explain.worlds import robot_and_box

pytestmark = pytest.mark.needs("train")


def words_in(figure: Figure) -> str:
    from matplotlib.text import Text

    return " ".join(each.get_text() for each in figure.findobj(Text)).replace("\n", " ")


def test_bars_say_the_limits_of_the_method() -> None:
    told = occlusion(late, {"bearing": np.array([0.6, -0.8])}, baseline={"bearing": np.zeros(2)})
    figure = plot_occlusion(told, ["forward", "turn", "jump", "forward jump"])
    said = words_in(figure)
    assert LIMITS in said
    assert "turn = -0.70" in said
    bars: Any = figure.axes[1].patches
    widths = [bar.get_width() for bar in bars]
    assert widths == [0, pytest.approx(-1.0)]


def test_a_map_has_a_legend_and_its_source() -> None:
    sim = robot_and_box(circles)
    values: Any = value_map(circles, sim, columns=3, decisions=1)
    assert "what one episode pays, discounted" in words_in(plot_value_map(values))
    arrows = words_in(plot_field(field(circles, sim, columns=3)))
    assert "turns right" in arrows
    assert "no room" in arrows


def test_lines_of_two_policies_and_of_terms() -> None:
    episode = recorded()
    figure = plot_disagreement(first_disagreement(circles, late, episode), ("old", "new"))
    assert "old" in words_in(figure)
    assert "reward so far" in words_in(plot_reward_terms(reward_terms(episode)))
