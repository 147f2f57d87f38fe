"""A running world and its page inside the notebook."""

import os
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from itertools import count
from secrets import token_urlsafe
from typing import TYPE_CHECKING, Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.block_errors import sentence_of
from ai4u_edu.agent.block_frames import frames_of_thread
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.html_template import render_html
from ai4u_edu.lessons.notebook_output import card, image, in_notebook, replace
from ai4u_edu.lessons.pictures import PICTURE_SIZE_PX, animation, picture
from ai4u_edu.lessons.student_errors import is_students, line_of, mistake_in
from ai4u_edu.lessons.time_limit import CALL_LIMIT_S, TimeLimitError, endless_call, raise_in
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate
from ai4u_edu.recording import Episode, Recorder
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import Scene

if TYPE_CHECKING:
    from ai4u_edu.member import ClassMember
    from ai4u_edu.member.notebook import ClassConnection
    from ai4u_edu.page.server.class_feed import ClassFeed

TOKEN = token_urlsafe(24)
"""Token of all pages of this process. Many may share one notebook server under any host name, so
a page asks for the token whatever the host."""
MAX_REPLAY_S = 120
"""Longest episode (s) that is replayed for an animation; more would take too long."""
_GONE_S = 60.0
"""Time without a page after which a world ends; a reload or a short sleep takes less."""
_GONE_AT_HUB_S = 300.0
"""The same at a JupyterHub: pages are gone, too, while the hub and its proxy are restarted."""

_numbers = count(1)


class Live:
    """Running world and its page.

    Args:
        sim: the world and its agents.
        recorder: records the world.
        title: the page's title.
        seed: seed of the first episode.
        scene: the scene that the world was built from; with it the page can change the world.
    """

    def __init__(
        self,
        sim: ControlRequestor,
        recorder: Recorder,
        title: str,
        seed: int | None = None,
        scene: Scene | None = None,
    ) -> None:
        # loaded when a world is shown: exercises can be checked without a page
        from ai4u_edu.page.editing import SceneEditor
        from ai4u_edu.page.server import Rules, with_token
        from ai4u_edu.room import serve_world

        self.title = title
        self.recorder = recorder
        self.runner = Runner(sim, seed=seed, recorder=recorder, wait_for_key=True)
        self._stall_watch = StallWatch(self.runner)
        self._class_member: ClassMember | None = None
        self._class_feed = _NotebookFeed()
        self._editor = None if scene is None else SceneEditor(self.runner, scene)
        self.runner.start()
        self._stall_watch.start()
        self._served = serve_world(
            self.runner,
            title=title,
            editor=self._editor,
            rules=Rules(token=TOKEN, lockstep=True),  # the world is whose notebook it is
            allowed_hosts=("*",),  # the token is asked for; a proxy passes any name on
            class_feed=self._class_feed,
        )
        self.url = with_token(self._served.url, TOKEN)
        """The page's address on this machine, with the token."""
        self.running = True
        self._kept: Episode | None = None
        self._page_watch: PageWatch | None = None
        self.handle = f"ai4u-live-{os.getpid()}-{next(_numbers)}"

    @property
    def sim(self) -> ControlRequestor:
        """The world and its agents; others after another scene was opened in the page."""
        return self.runner.sim

    @property
    def port(self) -> int:
        """Port of the page."""
        return int(self._served.url.rstrip("/").rpartition(":")[2])

    @property
    def episodes(self) -> list[Episode]:
        """Return the episodes so far, the current one last."""
        now = self.recorder.current_episode()
        under_way = [now] if now is not None and any(map(len, now.agents)) else []
        return [*self.recorder.episodes, *under_way]

    def end_without_page(self, end: Callable[["Live"], object]) -> None:
        """Call a function when the page was open, and has been gone for some minutes.

        Worlds of closed tabs would run on for as long as the notebook's kernel does.
        """
        is_at_hub = "JUPYTERHUB_SERVICE_PREFIX" in os.environ
        self._page_watch = PageWatch(
            lambda: len(self._served.viewer.viewer_clients),
            lambda: end(self),
            _GONE_AT_HUB_S if is_at_hub else _GONE_S,
        )
        self._page_watch.start()

    def join_class(self, connection: "ClassConnection") -> None:
        """Show the world on the teacher's page, and let the teacher stop it and open scenes."""
        from ai4u_edu.member import ClassMember, page_at_hub

        self._class_member = member = ClassMember(
            self.runner,
            self._editor,
            connection.link_for_world,
            connection.folder,
            title=self.title,
            show_ghosts=self._served.context.ghosts.race_all,
            page=page_at_hub(f"proxy/{self.port}/?token={TOKEN}"),
        )
        self._class_feed.follow(member.view)
        member.start()

    def leave_class(self) -> None:
        """End what :meth:`join_class` began."""
        member, self._class_member = self._class_member, None
        if member is not None:
            member.stop()
            self._class_feed.follow(None)

    def close(self) -> None:
        """End the world silently."""
        if self.running:
            self.running = False
            self.leave_class()
            if self._page_watch is not None:
                self._page_watch.stop()
            self._served.stop()
            self.runner.stop()
            self._stall_watch.stop()

    def stop(self) -> None:
        """End the world, and leave an animation of the last episode in its place."""
        if not self.running:
            return
        last = self.episodes[-1:] if in_notebook() else []
        self.close()
        moments = _animated(last[0]) if last else b""
        ended = translate(_("this world has ended; run its cell again for a new one."))
        replace("", "", self.film)
        page = card("grey", self.title, [ended])
        still = image(moments or self._still(), _("the last episode"))
        replace(page + still, f"{self.title}: {ended}", self.handle)

    def keep(self) -> None:
        """Put the last finished episode beneath, for readers of the notebook without a server.

        The live page hides it.
        """
        finished = self.recorder.episodes
        if not self.running or not finished or finished[-1] is self._kept:
            return
        self._kept = finished[-1]
        moments = _animated(finished[-1])
        if moments:
            text = f'<div id="{self.film}">{image(moments, _("the last episode"))}</div>'
            replace(text, translate(_("the last episode")), self.film)

    @property
    def film(self) -> str:
        """Display id of the last episode's animation."""
        return f"{self.handle}-film"

    def page(self, height: int) -> str:
        """Return the HTML under the cell."""
        spec = {
            "id": self.handle,
            "port": self.port,
            "token": TOKEN,
            "hub": os.environ.get("JUPYTERHUB_SERVICE_PREFIX", ""),
            "height": height,
        }
        return render_html(
            "lessons/embed.html",
            id=self.handle,
            url=self.url,
            title=self.title,
            still=image(self._still(), _("the world as it begins")),
            spec=spec,
        )

    def _still(self) -> bytes:
        return picture(self.runner.latest, longest=PICTURE_SIZE_PX)

    def _ipython_display_(self) -> None:
        """Show nothing more: the cell shows the world already."""


class PageWatch:
    """Thread that calls a function once a page was open, and then none is for a while.

    Args:
        count: returns the number of open pages; called from the thread.
        gone: called once, from the thread.
        gone_s: time without a page, seconds.
        poll_s: interval of the counts, seconds.
    """

    def __init__(
        self,
        count: Callable[[], int],
        gone: Callable[[], object],
        gone_s: float = _GONE_S,
        poll_s: float = 1.0,
    ) -> None:
        self._count, self._gone = count, gone
        self._gone_s, self._poll_s = gone_s, poll_s
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="page-watch", daemon=True)

    def start(self) -> None:
        """Begin to count."""
        self._thread.start()

    def stop(self) -> None:
        """Stop counting; the function is not called any more."""
        self._stopped.set()

    def _watch(self) -> None:
        was_open, empty = False, 0
        while not self._stopped.wait(self._poll_s):
            # counts and not a clock: a computer that slept has not waited
            empty = 0 if self._count() else empty + 1
            was_open = was_open or not empty
            if was_open and empty * self._poll_s > self._gone_s:
                self._gone()
                return


class _NotebookFeed:
    """The feed of the class that the notebook is in; without one, pages show nothing of a class."""

    def __init__(self) -> None:
        self._feed: ClassFeed | None = None
        self._base = 0

    def follow(self, feed: "ClassFeed | None") -> None:
        """Show another feed from now on."""
        base = self.version + 1
        self._feed, self._base = feed, base

    @property
    def version(self) -> int:
        """A number that grows with every change."""
        return self._base + (self._feed.version if self._feed is not None else 0)

    def event(self, role: str, seat: int) -> dict[str, Any] | None:
        """Return the event for a page; None without a class."""
        return None if self._feed is None else self._feed.event(role, seat)


def _animated(episode: Episode) -> bytes:
    if episode.seconds > MAX_REPLAY_S:
        return b""
    with suppress(AI4UError, RuntimeError):  # blocks of a student's own may not play again
        return animation(episode)
    return b""


class StallWatch:
    """Thread that raises an error in a world's thread when a student's code does not return.

    The page then shows a sentence with the line, as it does for other errors of that code.

    Args:
        runner: runs the world; its errors are described by this object from now on.
        limit_s: longest time of one call, seconds.
        poll_s: interval of the looks, seconds.
    """

    def __init__(self, runner: Runner, limit_s: float = CALL_LIMIT_S, poll_s: float = 0.5) -> None:
        self._runner, self._limit_s, self._poll_s = runner, limit_s, poll_s
        self._text = ""
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="stall-watch", daemon=True)
        runner.describe_error = self.describe

    def start(self) -> None:
        """Begin to look."""
        self._thread.start()

    def stop(self) -> None:
        """End the thread, and a loop that outlives the world; call it after ``Runner.stop``."""
        self._stopped.set()
        if self._runner.is_left_behind:
            self._interrupt()

    def describe(self, error: BaseException, agents: Sequence[BasicAgent]) -> str:
        """Return the sentence on an error: with the student's line if there is one."""
        mistake = mistake_in(error) if line_of(error) else None
        if isinstance(error, TimeLimitError):
            text = self._text
        elif mistake is not None:
            text = mistake.text
        else:
            text = sentence_of(error, agents)
        return translate(text).replace("`", '"')  # the page shows no code in a sentence

    def _watch(self) -> None:
        seen = None
        while not self._stopped.wait(self._poll_s):
            stall = self._runner.stall
            since = None if stall is None or stall.seconds < self._limit_s else stall.since
            # looked at twice: a computer that slept goes on in the middle of a call
            if since is not None and since == seen:
                self._interrupt()
            seen = since

    def _interrupt(self) -> None:
        """Raise an error in the world's thread if it is in a student's code."""
        thread = self._runner.thread_id
        calls = [
            frame
            for frame in reversed(frames_of_thread(thread))
            if is_students(frame.f_code.co_filename)
        ]
        if calls:
            self._text = endless_call(calls, self._limit_s)
            raise_in(thread, TimeLimitError)
