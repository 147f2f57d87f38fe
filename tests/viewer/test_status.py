import math
import re
from dataclasses import replace

from ai4u_edu import CircleShape
from ai4u_edu.agent.block_frames import Place
from ai4u_edu.blocks import RemoteStatus
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.runtime.tick_monitor import Stall
from ai4u_edu.viewer.panel.status import goal, legend, speed_name, status
from tests.viewer.worlds import busy_world, static_scene_of


def test_an_error_is_shown_escaped(runner: Runner) -> None:
    html = status(replace(runner.latest, error="ValueError: <script>"))
    assert "Stopped: ValueError: &lt;script&gt;" in html


def test_what_can_not_keep_up_says_so(runner: Runner) -> None:
    assert "keep up" in status(replace(runner.latest, real_time_factor=0.5))
    assert "keep up" not in status(replace(runner.latest, real_time_factor=0.97))
    assert "keep up" not in status(replace(runner.latest, time_scale=math.inf))
    assert "Paused" in status(replace(runner.latest, paused=True, real_time_factor=0.0))


def test_how_it_stands_with_a_script_is_shown_escaped(runner: Runner) -> None:
    agent = runner.latest.agents[0]._replace(
        remote=RemoteStatus(
            state="lost",
            reason="no answer from <b>",
            decisions=7,
            missing=2,
            ignored=0,
            refused=0,
            clipped=1,
        ),
    )
    html = status(replace(runner.latest, agents=(agent,)))
    assert "<strong>lost</strong>" in html
    assert "no answer from &lt;b&gt;" in html
    assert "7 decisions, 2 missing, 1 clipped" in html
    assert "Script of agent" not in status(runner.latest)


def test_the_goal_is_told_escaped(runner: Runner) -> None:
    assert goal(runner.latest.static_scene) == ""
    assert "Reach &lt;it&gt;" in goal(replace(runner.latest.static_scene, goal="Reach <it>"))


def test_steps_are_those_of_the_only_agent(runner: Runner) -> None:
    (agent,) = runner.latest.agents
    snapshot = replace(runner.latest, agents=(agent._replace(steps=41),))
    assert "<small>step</small> 41" in status(snapshot)
    assert "step" not in status(replace(snapshot, agents=(agent, agent)))


def test_the_legend_names_all_groups_and_what_rays_can_meet(runner: Runner) -> None:
    html = legend(runner.latest.static_scene)
    assert all(f"{name}</span>" in html for name in ("target", "wall", "floor", "other", "nothing"))


def test_speeds_have_names() -> None:
    assert speed_name(0.1) == "0.1x"


def test_the_past_is_called_so(runner: Runner) -> None:
    past = replace(runner.latest, paused=True, past="episode 1, step 3 of 9")
    assert "<strong>Past</strong>" in status(past)


def test_a_block_that_does_not_return_is_named_escaped(runner: Runner) -> None:
    place = Place("Sensor Wall '<wall>'", "0", "mine.py, line 12")
    html = status(runner.latest, Stall(since=1.0, seconds=5.2, place=place))
    told = "Sensor Wall '&lt;wall&gt;' of agent '0' has not answered for 5 s (mine.py, line 12)"
    assert told in html.replace("&#x27;", "'")


def test_the_legend_names_each_colour_once() -> None:
    world = busy_world()
    world.add_body("cone", CircleShape(radius=0.2), position=(3, -2), tags=("target", "cone"))
    world.add_body("post", CircleShape(radius=0.2), position=(3, -1), tags=("post",), colour="blue")
    html = legend(static_scene_of(world))
    colours = re.findall(r"background: (rgb\(.*?\))", html)
    assert len(colours) == len(set(colours))
    assert "agent, post</span>" in html
    assert "target, cone</span>" in html
