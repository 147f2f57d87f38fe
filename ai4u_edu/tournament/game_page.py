"""The page of one recorded game; a job's function, since it replays the game."""

from dataclasses import replace
from pathlib import Path

from ai4u_edu.recording import Episode, Replay
from ai4u_edu.recording.episode import decode
from ai4u_edu.recording.exports.html_page import html_of

PROJECTED = """<style>
main { display: block; max-width: none; text-align: center; }
section + section, footer, #goal, #about, .bar { display: none; }
h1 { font-size: clamp(22px, 2.8vw, 60px); }
</style>
<script>
set(true);
setInterval(() => {
  if (playing) return;
  time = 0;
  set(true);
}, 3000);
</script>
"""
"""Addition to the page of :mod:`ai4u_edu.recording.exports.html_page` for the projector."""


def game_page(path: str, *, is_projected: bool = False) -> str:
    """Return the HTML page that plays a recorded game, with its players in the title.

    Args:
        path: of the episode's file.
        is_projected: True for a page that plays by itself, again and again, and shows the world
            alone.

    Raises:
        RecordingError: it is no episode.
        OSError: it can't be read.
    """
    file = Path(path)
    episode = decode(Episode, file.read_bytes(), file.name)
    scene = episode.scene
    title = f"{scene.title or scene.name}: {_players(episode)}"
    page = html_of(Replay(replace(episode, scene=scene.model_copy(update={"title": title}))))
    return page.replace("</body>", f"{PROJECTED}</body>") if is_projected else page


def _players(episode: Episode) -> str:
    """Return the entries of a game, each with its side if there are two."""
    sides: dict[str, str] = {}
    for agent in episode.agents:
        sides.setdefault(agent.id.partition("_")[0], agent.driver)
    if len(sides) == 1:
        return next(iter(sides.values()))
    return " – ".join(f"{driver} ({side})" for side, driver in sides.items())  # noqa: RUF001
