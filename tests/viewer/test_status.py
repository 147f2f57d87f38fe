import math
from dataclasses import replace

from ai4u_edu.runner import Runner
from ai4u_edu.viewer.status import legend, speed_name, status


def test_an_error_is_shown_escaped(runner: Runner) -> None:
    html = status(replace(runner.latest, error="ValueError: <script>"))
    assert "Stopped: ValueError: &lt;script&gt;" in html


def test_what_can_not_keep_up_says_so(runner: Runner) -> None:
    assert "keep up" in status(replace(runner.latest, real_time_factor=0.5))
    assert "keep up" not in status(replace(runner.latest, real_time_factor=0.97))
    assert "keep up" not in status(replace(runner.latest, time_scale=math.inf))
    assert "Paused" in status(replace(runner.latest, paused=True, real_time_factor=0.0))


def test_the_legend_names_all_groups_and_what_rays_can_meet(runner: Runner) -> None:
    html = legend(runner.latest.stage)
    assert all(f"{name}</span>" in html for name in ("target", "wall", "floor", "other", "nothing"))


def test_speeds_have_names() -> None:
    assert speed_name(0.1) == "0.1x"
