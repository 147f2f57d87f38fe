"""A running world's membership in a class."""

import math
import secrets
import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from pathlib import Path

from msgspec.structs import replace

from ai4u_edu.base.errors import SetupError, shorten
from ai4u_edu.base.log_limit import ErrorLog
from ai4u_edu.locale import gettext as _
from ai4u_edu.member.assigned_scenes import (
    OPEN_TIMEOUT_S,
    AssignedScenes,
    scene_name_of,
)
from ai4u_edu.member.class_view import ClassView
from ai4u_edu.member.client import LinkClient
from ai4u_edu.member.episode_watch import EndedEpisode, EpisodeWatch
from ai4u_edu.member.holds import Holds
from ai4u_edu.member.link import ClassLink, ClassLinkSettings, Receive
from ai4u_edu.member.outbox import ResultOutbox
from ai4u_edu.member.race_run import RaceRun, ShowGhosts
from ai4u_edu.member.room_state import RoomState
from ai4u_edu.member.thumbnail import Thumbnail
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.recording import Recorder
from ai4u_edu.recording.episode import encode
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire.class_link import (
    HEARTBEAT_S,
    MAX_EPISODE_BYTES,
    MAX_SENT_SCENE_CHARS,
    POSES_PER_S,
    Assignment,
    Attention,
    ClassSettings,
    CurrentRace,
    EpisodeResult,
    FromClass,
    Learn,
    LinkProblem,
    LinkWelcome,
    People,
    Practise,
    Practised,
    RoomTrainings,
    State,
    StopTraining,
    Task,
    TaskKind,
    TaskState,
    Training,
    Work,
)
from ai4u_edu.wire.validation import MAX_TEXT_CHARS

POLL_S = 1 / POSES_PER_S
WORK_INTERVAL_S = 1.0
"""Shortest time between two messages with the scene: writing it as text takes milliseconds."""
MIN_RESULT_INTERVAL_S = 0.5
"""Shortest time between two results outside of races: a network may end many episodes a second."""
MAX_UNLINKED_HOLD_S = 600.0
"""Time without a link after which the teacher's hold ends: the class is over."""
REST_AFTER_S = 10.0
"""Time without a page and without a script after which a world stands still."""
NO_ATTENTION = Attention("", "", 0.0)
OUTBOX = "outbox"
"""Folder of undelivered results, in the room's folder."""


class ClassMember:
    """Connects a world with its class: shows it on the wall, and does what the teacher asks for.

    One thread of its own polls the runner's latest snapshot, and opens scenes. Threads of the link
    deliver the class's messages. Pages read :attr:`view`. Start it before or after the runner, and
    stop it before.

    Args:
        runner: runs the world. It gets a recorder if it has none.
        editor: of the world; None if the scene can't be changed.
        link: settings of the link, or a function that makes one for a receiver of messages.
        folder: of the world's files, which exists; without it what has to outlast the process (the
            last assignment, undelivered results, counts) does not.
        title: of the scene, where there is no editor.
        show_ghosts: shows the ghosts of episodes in the page, each with a name.
        page: as :attr:`ClassLinkSettings.page`, where ``link`` is a function.
        clock: seconds; to be replaced in tests.
        open_timeout: time (s) that the world has to open a scene that the class gives.
    """

    def __init__(
        self,
        runner: Runner,
        editor: SceneEditor | None,
        link: ClassLinkSettings | Callable[[Receive], ClassLink],
        folder: Path | None = None,
        *,
        title: str = "",
        show_ghosts: ShowGhosts = lambda _drives: None,
        page: str = "",
        clock: Callable[[], float] = time.monotonic,
        open_timeout: float = OPEN_TIMEOUT_S,
    ) -> None:
        self.view = ClassView(clock)
        """State of the class for pages."""
        self._runner, self._editor, self._title, self._clock = runner, editor, title, clock
        self._page = link.page if isinstance(link, ClassLinkSettings) else page
        self._wake, self._stopping = threading.Event(), False
        self._inbox: deque[tuple[Assignment | CurrentRace, float]] = deque()
        self._watch = EpisodeWatch(runner, self._scene)
        self._holds = Holds(runner, clock)
        self._scenes = AssignedScenes(runner, editor, folder, clock, open_timeout)
        self._race = RaceRun(
            runner,
            self._scenes,
            self._watch,
            self._holds,
            self.view,
            show_ghosts,
            clock,
            open_timeout,
        )
        self._room_state = RoomState(clock, folder, self._scene(), self._scene_title)
        self._thumbnail = Thumbnail()
        self._attention_lock = threading.Lock()
        self._attention_until: float | None = None
        self._state: State | None = None
        self._state_sent_at = self._work_sent_at = self._result_sent_at = -math.inf
        self._linked_at = clock()
        self._work_version: int | None = None
        self._error_log = ErrorLog()
        self._thread = threading.Thread(target=self._run, name="class member", daemon=True)
        self.link = (
            _client(link, self._receive, folder)
            if isinstance(link, ClassLinkSettings)
            else link(self._receive)
        )
        """The link with the class."""
        self.trainings = MemberTrainings(self.link)
        """Trainings of a world on the class's machine."""

    def start(self) -> None:
        """Join the class, in the background."""
        if self._runner.recorder is None:
            self._runner.submit(self._add_recorder)
        self.link.start()
        self._thread.start()

    def stop(self) -> None:
        """Leave the class; the world goes on as if there were none."""
        self._stopping = True
        self._wake.set()
        if self._thread.is_alive() and self._thread is not threading.current_thread():
            self._thread.join()
        self._watch.stop()
        self._race.stop()
        self._holds.end()
        self._scenes.stop()
        if self._state is not None:
            self._room_state.save(self._state, at_once=True)
        self.link.stop()

    def _add_recorder(self) -> None:
        if self._runner.recorder is None:
            scene = self._editor.state.description if self._editor else None
            self._runner.recorder = Recorder(self._runner.sim, scene=scene, keep=1)

    # -- in the link's thread ----------------------------------------------------------------------

    def _receive(self, message: FromClass) -> None:
        match message:
            case LinkWelcome():
                self.view.welcome(message)
            case People():
                self.view.set_people(message)
                rests_at = math.inf if message.is_visited else self._clock() + REST_AFTER_S
                self._holds.for_absence(rests_at)
            case RoomTrainings():
                self.trainings.receive(message)
            case Attention():
                with self._attention_lock:
                    self._pay_attention(message)
            case ClassSettings():
                self.view.set_switches(message.switches)
            case CurrentRace(phase="countdown", id=str(name)) if name:
                starts_at = self._clock() + message.starts_in_s
                self._holds.for_race(starts_at)  # at once, whatever the other thread does
                self._inbox.append((message, starts_at))
            case CurrentRace() | Assignment():
                if isinstance(message, Assignment):
                    self.view.set_lesson(message.lesson)
                self._inbox.append((message, self._clock()))
            case LinkProblem(code="over"):
                with self._attention_lock:
                    # the class is over: nobody could end a pause any more
                    self._pay_attention(NO_ATTENTION)
        self._wake.set()

    def _pay_attention(self, message: Attention) -> None:
        is_any = bool(message.kind or message.message)
        until = self._clock() + message.ends_in_s if message.ends_in_s > 0 else None
        self._attention_until = until if is_any else None
        self._holds.for_attention((until or math.inf) if message.kind else -math.inf)
        self.view.set_attention(message if is_any else None, until)

    # -- in its own thread -------------------------------------------------------------------------

    def _run(self) -> None:
        while not self._stopping:
            self._wake.clear()
            with self._error_log.caught():
                self._poll()
            # a hold may end between two polls, and a race must begin on time
            until_change = self._holds.next_change - self._clock()
            self._wake.wait(max(0.0, min(POLL_S, until_change)))

    def _poll(self) -> None:
        self._handle_messages()
        self._end_attention()
        self._holds.refresh()
        self._watch.follow()
        self._race.poll()
        self._scenes.poll()
        if self._watch.scene is not None:  # else it was not counted yet
            self._room_state.note_scene(self._watch.scene)
        self._report_episodes()
        self._report_state()
        if not self.link.is_connected:
            self._holds.for_absence(math.inf)  # nobody would say who comes back
            return
        for message in self._thumbnail.changes(self._runner.latest):
            self.link.send(message)
        self._report_work()

    def _scene(self) -> object:
        return self._runner.sim if self._editor is None else self._editor.opened

    def _handle_messages(self) -> None:
        while self._inbox and not self._stopping:
            message, at = self._inbox.popleft()
            if isinstance(message, CurrentRace):
                answer = self._race.update(message, at)
            else:
                answer = self._scenes.apply(message) if message.id else None
                is_for = scene_name_of(message) if message.program else ""
                self.view.set_program(message.program, is_for)
                self.view.set_mission(message.mission, message.id)
            if answer is not None:
                self.link.send(answer)

    def _end_attention(self) -> None:
        now = self._clock()
        if self.link.is_connected:
            self._linked_at = now
        is_abandoned = now - self._linked_at > MAX_UNLINKED_HOLD_S
        with self._attention_lock:
            until = self._attention_until
            if is_abandoned or (until is not None and now >= until):
                self._pay_attention(NO_ATTENTION)

    def _report_episodes(self) -> None:
        latest = self._runner.latest
        for ended in self._watch.take():
            word = ended.outcome(latest.agents, latest.episode)
            self._room_state.note_end(word)
            race = self._race.id_of(ended, word)
            if race or self._clock() - self._result_sent_at >= MIN_RESULT_INTERVAL_S:
                self._result_sent_at = self._clock()
                self.link.send_result(self._result_of(ended, word, race))

    def _result_of(self, ended: EndedEpisode, word: str, race: str) -> EpisodeResult:
        data = encode(ended.recorded) if race and ended.recorded is not None else b""
        return EpisodeResult(
            key=secrets.token_urlsafe(12),
            scene=shorten(self._scene_title, MAX_TEXT_CHARS),
            seed=ended.seed,
            outcome=word,  # type: ignore[arg-type]  # it is one of them
            seconds=ended.seconds,
            reward=ended.agents[0].episode_reward,
            driver=shorten(ended.driver, MAX_TEXT_CHARS),
            race=race,
            episode=data if len(data) <= MAX_EPISODE_BYTES else b"",
        )

    @property
    def _scene_title(self) -> str:
        return self._title if self._editor is None else self._editor.title

    def _report_state(self) -> None:
        state = self._room_state.read(
            self._runner.latest,
            self._runner.sim,
            title=self._scene_title,
            version=0 if self._editor is None else self._editor.version,
            begun=self._watch.begun,
        )
        state = replace(state, page=self._page)
        now, before = self._clock(), self._state
        is_due = now - self._state_sent_at >= HEARTBEAT_S
        # seconds change with each poll, and are no news by themselves
        if is_due or before is None or state != replace(before, seconds=state.seconds):
            self._state, self._state_sent_at = state, now
            self.link.send(state)
        if self._watch.scene is not None:
            self._room_state.save(state)

    def _report_work(self) -> None:
        editor, now = self._editor, self._clock()
        if editor is None or editor.version == self._work_version:
            return
        if now - self._work_sent_at < WORK_INTERVAL_S:
            return
        version, text = editor.version, editor.text()
        # noted also if the text is too large to send: it would be made again at each poll
        self._work_version, self._work_sent_at = version, now
        if len(text) <= MAX_SENT_SCENE_CHARS:
            self.link.send(Work(shorten(editor.title, MAX_TEXT_CHARS), text))


class MemberTrainings:
    """Trainings in the class's process; see :class:`ai4u_edu.page.editing.editor.ClassTrainings`.

    Args:
        link: with the class.
    """

    def __init__(self, link: ClassLink) -> None:
        self._link = link
        self._lock = threading.Lock()
        self._asked: Training | None = None
        """Training that the class does not know yet."""
        self._known: Training | None = None
        self._practices: dict[str, Practised] = {}
        """Practices by their keys, also those that the class does not know yet."""
        self._unknown: set[str] = set()
        """Keys of practices that the class does not know yet."""
        self._tasks: dict[str, TaskState] = {}
        """Tasks that this process has asked for, by their keys."""
        self.listeners: list[Callable[[], object]] = []

    @property
    def latest(self) -> Training | None:
        """The room's latest training; None before the first one."""
        return self._asked or self._known

    @property
    def is_connected(self) -> bool:
        """True while the class can be reached."""
        return self._link.is_connected

    def learn(self, scene: str, agent: str, drives: Sequence[str]) -> None:
        """Have a network learn from drives.

        Raises:
            SetupError: a name is too long to be sent.
        """
        for what, name in (("scene", scene), ("agent", agent)):
            if len(name) > MAX_TEXT_CHARS:  # the class would refuse it again and again
                raise SetupError(
                    _(
                        "expected a name of the {what} of at most {most} characters, got {n}; give "
                        "it a shorter one",
                        what=what,
                        most=MAX_TEXT_CHARS,
                        n=len(name),
                    )
                )
        request = Learn(secrets.token_urlsafe(12), scene, agent, tuple(drives))
        with self._lock:
            self._asked = Training(request.key, scene, agent, len(drives))
        self._link.send_result(request)
        self._tell()

    def stop(self, problem: str) -> None:
        """End the latest training without a result; until the class answers, show a problem."""
        with self._lock:
            latest = self.latest
            if latest is None or latest.is_over:
                return
            self._asked = replace(latest, place=0, problem=problem)
        self._link.send_result(StopTraining(secrets.token_urlsafe(12), latest.key))
        self._tell()

    def practice(self, key: str) -> Practised | None:
        """Return a practice of the room; None if it was never asked for, or long ago."""
        with self._lock:
            return self._practices.get(key)

    def practise(self, key: str, practice: str) -> None:
        """Have a network practise; one that the class knows goes on."""
        with self._lock:
            if key not in self._practices:
                self._practices[key] = Practised(key, practice)
                self._unknown.add(key)
        self._link.send_result(Practise(key, practice))
        self._tell()

    def stop_practice(self, key: str) -> None:
        """End a practice; it is over as soon as the class says so."""
        self._link.send_result(StopTraining(secrets.token_urlsafe(12), key))

    def task(self, key: str) -> TaskState | None:
        """Return a task of the room; None if this process never asked for it."""
        with self._lock:
            return self._tasks.get(key)

    def begin_task(self, key: str, kind: TaskKind) -> None:
        """Have a task done; one that the class knows goes on."""
        with self._lock:
            over = [other for other, task in self._tasks.items() if task.is_over]
            for other in over:
                del self._tasks[other]
            self._tasks[key] = TaskState(key, kind)
        self._link.send_result(Task(key, kind))
        self._tell()

    def stop_task(self, key: str, problem: str) -> None:
        """End a task, which has a problem from now on."""
        with self._lock:
            task = self._tasks.get(key)
            if task is None or task.is_over:
                return
            self._tasks[key] = replace(task, place=0, is_over=True, problem=problem)
        self._link.send_result(StopTraining(secrets.token_urlsafe(12), key))
        self._tell()

    def receive(self, message: RoomTrainings) -> None:
        """Take what the class says of the room's trainings."""
        with self._lock:
            tasks = {task.key: task for task in message.tasks}
            under_way = [task for task in self._tasks.values() if not task.is_over]
            self._tasks |= {task.key: tasks.get(task.key, task) for task in under_way}
            self._known = message.trainings[-1] if message.trainings else None
            asked, known = self._asked, self._known
            if asked is not None and known is not None and asked.key == known.key:
                # one that was stopped here goes on there until the class has heard of it
                self._asked = asked if asked.is_over and not known.is_over else None
            practices = {practised.key: practised for practised in message.practices}
            self._unknown -= practices.keys()
            self._practices = {key: self._practices[key] for key in self._unknown} | practices
        for task in under_way:
            if task.key not in tasks:  # the class's process is another one, which knows no tasks
                self._link.send_result(Task(task.key, task.kind))
        self._tell()

    def _tell(self) -> None:
        for listener in self.listeners:
            listener()


def _client(settings: ClassLinkSettings, receive: Receive, folder: Path | None) -> ClassLink:
    outbox = ResultOutbox(None if folder is None else folder / OUTBOX)
    return LinkClient(settings.url, settings.secret, settings.kind, receive, outbox)
