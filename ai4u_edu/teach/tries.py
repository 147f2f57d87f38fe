"""Episodes with many values of one number, which the present driver drives in another process."""

import asyncio
import secrets
import shutil
import threading
from collections.abc import Awaitable, Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from queue import SimpleQueue
from typing import Annotated, Literal

import msgspec
from msgspec import Meta, Struct

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import AI4UError, SetupError, text_of
from ai4u_edu.blocks import Block, NeuralNetController
from ai4u_edu.blocks.brains.controllers.key_defaults import listens_to_keys
from ai4u_edu.blocks.loading import own_files
from ai4u_edu.learn.training.episode import wilson
from ai4u_edu.learn.training.varying import (
    FROM_SCENE,
    NumberParameter,
    Tried,
    TriedValue,
    number_parameters,
    parameter_named,
    parse_values,
    with_driver,
    with_value,
)
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, packed, unpacked
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.driver_options import OWN_BRAIN
from ai4u_edu.page.editing.drivers import NETWORK
from ai4u_edu.page.messages import MAX_NAME_CHARS, Name, PageCommand
from ai4u_edu.page.panel import PanelContext
from ai4u_edu.page.panel.answers import Answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.page import Page
from ai4u_edu.page.panel.parts.part import PanelPart
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.teach.learning import STOPPED
from ai4u_edu.teach.tasks import FOLDER, REQUEST, ClassTask, LocalTask, TaskWork

PREFIX = "try-"
"""Beginning of the names of folders of tries."""
MAX_PROGRAM_EPISODES = 200
"""Episodes of a program in a page, with all values."""
MAX_STARTS = 200
"""Episodes with each value."""
DIED = _("the program that drives has ended; try again")
BY_KEYS = _("You drive this robot by keys. Choose another driver in Drive, such as a network.")
NO_PROGRAM = _(
    "A recording or a script drives this robot, which can't be tried here. "
    "Choose a network or a controller in Drive, or your program below."
)
NOTHING_TRIED = _("no values are tried with a program now; try again")


class TryMany(PageCommand, tag="teach_try"):
    """Let the driver of the page's agent drive from the same starts with each value of a number."""

    parameter: Name
    """Name of the number."""
    values: Annotated[str, Meta(max_length=4 * MAX_NAME_CHARS)]
    """Numbers with commas between."""
    starts: Annotated[int, Meta(ge=1, le=MAX_STARTS)]
    """Episodes with each value."""


class TryProgram(PageCommand, tag="teach_try_program"):
    """Begin to try values with the program in this page, which drives one after another."""

    parameter: Name
    values: Annotated[str, Meta(max_length=4 * MAX_NAME_CHARS)]
    starts: Annotated[int, Meta(ge=1, le=MAX_STARTS)]


class HoldTries(PageCommand, tag="teach_hold_tries"):
    """Wait until the tries of the page's program are over; the page is gone if this ends before."""


class SetTriedValue(PageCommand, tag="teach_set_value"):
    """Give the number a value for all episodes until the next one, and begin an episode."""

    value: float


class NoteTriedValue(PageCommand, tag="teach_note_value"):
    """Note how the page's program did with a value."""

    value: float
    successes: Annotated[int, Meta(ge=0, le=MAX_STARTS)]
    reward: float
    seconds: float
    decisions: float


class StopTrying(PageCommand, tag="teach_stop_trying"):
    """End the episodes; what was driven is kept."""


class DownloadTried(PageCommand, tag="teach_download_tried"):
    """Return the results as CSV: the file's `name`, and its text as `data`."""


class VariableNumber(Struct, frozen=True):
    """A number that can be varied."""

    name: str
    owner: str
    """Block, agent or thing that has it, in words."""
    label: str
    """Name of the number in words, with its unit."""
    value: float | None
    """Its present value; null if it has none."""
    limits: str
    """Its range in words; empty if it has none."""


class TriesState(Struct, frozen=True):
    """State of the latest tries of the agent."""

    is_over: bool
    problem: str
    """Sentence about why they ended early; empty if they did not."""
    waiting: str
    """Sentence about what they wait for; empty if the driver drives or they are over."""
    label: str
    """The number in words."""
    done: int
    """Episodes that were driven."""
    total: int
    """Episodes with all values."""
    rows: list[TriedValue]
    """Results of the values that are done."""


class TriesPart(PanelPart, frozen=True, kw_only=True):
    """Numbers that can be varied, and what came of it."""

    name: Literal["tries"] = "tries"
    agent: str
    """Id of the agent that the page shows."""
    problem: str
    """Sentence about why its driver can't be tried; empty if it can."""
    numbers: list[VariableNumber]
    tries: TriesState | None
    """The latest tries of the agent in this scene; null if there were none since the start."""
    max_starts: int
    max_program_episodes: int
    """Most episodes, with all values, of a program in the page."""


class TryRequest(Struct, frozen=True):
    """Values to try, for the process that drives."""

    scene: str
    """Text of the scene, with the driver in it."""
    place: str
    """Folder for relative paths in the scene; empty for none."""
    agent: str
    """Id of the agent."""
    parameter: str
    """Name of the number."""
    values: list[float | int]
    starts: int
    """Episodes with each value."""
    scene_name: str
    label: str
    """The number in words."""
    blocks: list[str] = []
    """Python files with blocks that the scene has."""


class TryNote(Struct, frozen=True, omit_defaults=True):
    """Progress of the tries, from the process that drives."""

    done: int = 0
    """Episodes that were driven since the last note."""
    row: TriedValue | None = None
    """Result of a value that is done."""
    problem: str = ""
    """Sentence about why it can't go on."""


class Tries:
    """The values of a request, tried elsewhere.

    Args:
        request: the values.
        work: tries them; it begins now.
    """

    def __init__(self, request: TryRequest, work: TaskWork) -> None:
        self.request, self._work = request, work
        total = request.starts * len(request.values)
        self._state = TriesState(False, "", "", unpacked(request.label), 0, total, [])
        self._thread = threading.Thread(target=self._run, name="teach tries", daemon=True)
        self._thread.start()

    @property
    def state(self) -> TriesState:
        """The present state."""
        return msgspec.structs.replace(self._state, waiting=self._work.waiting)

    def stop(self) -> None:
        """End them; what was driven is kept."""
        self._work.stop()

    def leave(self) -> None:
        """Leave them to a later process of this world, if they can go on."""
        self._work.leave()
        self._thread.join()

    def _run(self) -> None:
        state, values = self._state, self.request.values
        for lines in self._work.notes():
            rows, since, problem = list[TriedValue](), 0, ""
            for note in (msgspec.json.decode(line, type=TryNote) for line in lines):
                rows += [] if note.row is None else [note.row]
                since = 0 if note.row is not None else since + note.done
                problem = unpacked(note.problem)
            done = self.request.starts * len(rows) + since
            self._state = state = msgspec.structs.replace(
                state, done=done, rows=rows, problem=problem
            )
        problem = ""
        if len(state.rows) < len(values):
            problem = state.problem or self._work.problem or DIED
        self._state = msgspec.structs.replace(state, is_over=True, problem=problem)


class PageWork:
    """Tries whose episodes the program of a page drives, in this very world.

    The server's event loop calls its methods; a thread iterates over the notes.
    """

    waiting = ""

    def __init__(self) -> None:
        self.problem = ""
        self.ended = asyncio.Event()
        self._lines = SimpleQueue[bytes | None]()

    def add(self, row: TriedValue) -> None:
        """Note a value that is done."""
        self._lines.put(msgspec.json.encode(TryNote(row=row), enc_hook=packed))

    def notes(self) -> Iterator[Sequence[bytes]]:
        """Yield all lines so far whenever there are more, until it has ended."""
        lines = list[bytes]()
        while (line := self._lines.get()) is not None:
            lines.append(line)
            yield lines

    def stop(self, problem: str = STOPPED) -> None:
        """End it, with a sentence about why."""
        self.problem = self.problem or problem
        self._lines.put(None)

    leave = stop


class TryingPages:
    """The section "Try many" of the tab Teach: its part and its commands.

    Args:
        runner: runs the world.
        editor: has the scene.
        folder: of the world's work.
        in_thread: has the option's thread do something, and returns its result.
    """

    def __init__(
        self,
        runner: Runner,
        editor: SceneEditor,
        folder: Path,
        in_thread: Callable[[Callable[[], object]], Awaitable[object]],
    ) -> None:
        self._runner, self._editor, self._in_thread = runner, editor, in_thread
        self._folder = folder / FOLDER
        self._numbers: tuple[NumberParameter, ...] = ()
        self._tries: Tries | None = None
        self._by_program: PageWork | None = None
        """Work of the tries that the program of a page drives; None if none does."""
        self.commands: Mapping[type[PageCommand], Handler] = {
            TryMany: self._try,
            TryProgram: self._try_program,
            HoldTries: self._hold_tries,
            SetTriedValue: self._set_value,
            NoteTriedValue: self._note_value,
            StopTrying: self._stop_trying,
            DownloadTried: self._download,
        }

    def look(self) -> None:
        """Look at the numbers of the present scene; the option's thread calls it."""
        self._numbers = tuple(number_parameters(self._editor.scene))

    def find(self) -> None:
        """Show the tries of an earlier process of a class's room; the option's thread calls it.

        Those that are not over go on, or have gone on in the class's process meanwhile.
        """
        trainings = self._editor.class_trainings
        if trainings is None:
            return
        for folder in self._folder.glob(f"{PREFIX}*"):
            with suppress(OSError, msgspec.MsgspecError):
                text = (folder / REQUEST).read_bytes()
                request = msgspec.json.decode(text, type=TryRequest)
                self._tries = Tries(request, ClassTask("try", trainings, folder))

    def parts(self, context: PanelContext, agent: str) -> Iterator[tuple[str, bytes]]:
        """Yield the part about an agent of the page."""
        driver, numbers, tries = self._editor.driver_of(agent), self._numbers, self._tries
        if tries is not None:
            request = tries.request
            if (request.scene_name, request.agent) != (self._scene, agent):
                tries = None
        state = None if tries is None else tries.state
        progress = None
        if state is not None:
            progress = state.done, len(state.rows), state.is_over, state.waiting
        key = "tries", agent, driver, numbers, tries, progress

        def part() -> TriesPart:
            problem = self._reason_against(agent, driver)
            is_own = driver.startswith(OWN_BRAIN)
            shown = [_shown(each, agent) for each in numbers if _is_for(each, agent, is_own=is_own)]
            return TriesPart(
                agent=agent,
                problem=problem,
                numbers=shown,
                tries=state,
                max_starts=MAX_STARTS,
                max_program_episodes=MAX_PROGRAM_EPISODES,
            )

        yield "tries", context.cache.by_key(key, part)

    def leave(self) -> None:
        """Leave the tries to a later process of a class's room; elsewhere, end them."""
        if self._tries is not None:
            self._tries.leave()

    # -- in the server's event loop ----------------------------------------------------------------

    async def _try(self, page: Page, command: TryMany) -> Answer:
        await self._in_thread(lambda: self._begin(page.view.agent, command))
        return Answer(_("It drives."))

    async def _stop_trying(self, _page: Page, _command: StopTrying) -> Answer:
        tries = self._tries
        if tries is None or tries.state.is_over:
            return Answer(_("Nothing is tried now."))
        tries.stop()
        if self._by_program is not None:
            self._by_program.ended.set()
        return Answer(_("The tries are stopped."))

    async def _try_program(self, page: Page, command: TryProgram) -> Answer:
        """Begin the tries of a page's program; all is done before another command of the page."""
        agent, editor = page.view.agent, self._editor
        self._check_free()
        values = parse_values(command.values)
        if len(values) * command.starts > MAX_PROGRAM_EPISODES:
            raise SetupError(
                _(
                    "expected at most {most} episodes of a program, got {n} "
                    "values with {starts} starts; take fewer",
                    most=MAX_PROGRAM_EPISODES,
                    n=len(values),
                    starts=command.starts,
                )
            )
        parameter = parameter_named(editor.scene, command.parameter)
        number = _shown(parameter, agent)
        request = TryRequest(
            scene="",
            place="",
            agent=agent,
            parameter=parameter.name,
            values=values,
            starts=command.starts,
            scene_name=self._scene,
            label=join([number.owner, number.label], ": "),
        )
        self._by_program = work = PageWork()
        self._tries = Tries(request, work)
        return Answer(more={"values": values})

    async def _hold_tries(self, _page: Page, _command: HoldTries) -> Answer:
        work = self._by_program
        if work is None:
            raise SetupError(NOTHING_TRIED)
        try:
            await work.ended.wait()
        finally:  # also if the page has left
            work.stop()
            if self._by_program is work:
                self._by_program = None
            self._runner.submit(self._restore)
        return Answer()

    async def _set_value(self, page: Page, command: SetTriedValue) -> Answer:
        tries = self._required_by_program()
        name, value = tries.request.parameter, command.value
        if value not in tries.request.values:
            raise SetupError(_("expected a value that is to be tried, got {value:g}", value=value))

        def apply() -> None:
            sim = self._runner.sim
            options = {name: next(each for each in tries.request.values if each == value)}
            sim.reset(0, options)
            sim.usual_options = options

        try:
            await page.result(self._runner.submit(apply))
        except AI4UError as error:
            raise SetupError(
                _(
                    "{number} can't be {value:g} while a program drives: {problem}",
                    number=unpacked(tries.request.label),
                    value=value,
                    problem=text_of(error),
                )
            ) from None
        return Answer()

    async def _note_value(self, _page: Page, command: NoteTriedValue) -> Answer:
        tries, work = self._required_by_program(), self._by_program
        assert work is not None  # noqa: S101 - they are there together
        starts = tries.request.starts
        successes = min(command.successes, starts)
        low, high = wilson(successes, starts)
        has_goal = self._editor.state.description.success is not None
        row = TriedValue(
            value=command.value,
            episodes=starts,
            successes=successes if has_goal else None,
            low=low if has_goal else None,
            high=high if has_goal else None,
            reward=command.reward,
            seconds=command.seconds,
            decisions=command.decisions,
        )
        work.add(row)
        if command.value == tries.request.values[-1]:
            work.ended.set()
        return Answer()

    def _required_by_program(self) -> Tries:
        if self._tries is None or self._by_program is None:
            raise SetupError(NOTHING_TRIED)
        return self._tries

    def _restore(self) -> None:
        """Give the world the scene's own numbers again; the runner calls it."""
        sim = self._runner.sim
        sim.usual_options = None
        if sim.options.values:
            sim.reset()

    async def _download(self, _page: Page, _command: DownloadTried) -> Answer:
        tries = self._tries
        if tries is None or not tries.state.rows:
            raise SetupError(_("there are no results yet; try some values first"))
        request = tries.request
        data = Tried(NumberParameter(request.parameter, (), None), tries.state.rows).csv()
        name = f"{request.scene_name}-{request.parameter}.csv"
        return Answer(more={"name": name, "data": data})

    # -- in the option's thread --------------------------------------------------------------------

    def _begin(self, agent: str, command: TryMany) -> None:
        self._check_free()
        driver = self._editor.driver_of(agent)
        if problem := self._reason_against(agent, driver):
            raise SetupError(problem)
        values = parse_values(command.values)
        scene, _found = with_driver(self._editor.scene, self._spec(agent, driver), agent)
        parameter = parameter_named(scene, command.parameter)
        for value in values:  # what is wrong is said at once
            with_value(scene, parameter, value)
        number = _shown(parameter, agent)
        request = TryRequest(
            scene=scene.dumps(),
            place=str(scene.folder or ""),
            agent=agent,
            parameter=parameter.name,
            values=values,
            starts=command.starts,
            scene_name=self._scene,
            label=join([number.owner, number.label], ": "),
            blocks=[str(file) for file in own_files()],
        )
        try:
            self._tries = Tries(request, self._start(request))
        except OSError as error:
            raise SetupError(
                _("they could not be begun: {reason}", reason=error.strerror or "")
            ) from None

    def _check_free(self) -> None:
        if self._tries is not None and not self._tries.state.is_over:
            raise SetupError(_("values are tried already; wait until they are done, or stop them"))

    def _start(self, request: TryRequest) -> TaskWork:
        """Begin the work on tries.

        Raises:
            OSError: its folder can't be made.
        """
        trainings = self._editor.class_trainings
        if trainings is None:
            return LocalTask("try", request)
        for before in self._folder.glob(f"{PREFIX}*"):
            shutil.rmtree(before, ignore_errors=True)
        folder = self._folder / f"{PREFIX}{secrets.token_urlsafe(12)}"
        folder.mkdir(mode=0o700, parents=True)
        write_atomically(
            folder / REQUEST, msgspec.json.encode(request, enc_hook=packed), mode=0o600
        )
        return ClassTask("try", trainings, folder)

    def _reason_against(self, agent: str, driver: str) -> str:
        """Return why a driver can't be tried, as sentences; empty if it can."""
        if driver.startswith(NETWORK):
            return ""
        if not driver.startswith(OWN_BRAIN):
            return NO_PROGRAM
        brain = self._editor.state.agent(agent)["brains"][int(driver.removeprefix(OWN_BRAIN))]
        controller = brain.get("controller")
        if not isinstance(controller, Mapping):
            return NO_PROGRAM
        return BY_KEYS if listens_to_keys(Block.types[str(controller["type"])]) else ""

    def _spec(self, agent: str, driver: str) -> str:
        """Return a driver's name for the command line."""
        controller = getattr(self._runner.sim.agent(agent).brain, "controller", None)
        if driver.startswith(NETWORK) and isinstance(controller, NeuralNetController):
            return str(controller.model_path)
        return FROM_SCENE

    @property
    def _scene(self) -> str:
        return self._editor.state.description.name


def _is_for(number: NumberParameter, agent: str, *, is_own: bool) -> bool:
    """Return True for a number of the agent or the world, and of its controller if that drives."""
    if number.path[0] != "agents":
        return True
    return number.name.startswith(f"{agent}.") and (is_own or ".controller." not in number.name)


def _shown(number: NumberParameter, agent: str) -> VariableNumber:
    kind, _dot, thing = number.owner.partition(".")
    owner: str = number.owner.removeprefix(f"{agent}.").replace("_", " ")
    if number.owner == agent:
        owner = _("the robot")
    elif number.owner.endswith(".controller"):
        owner = _("the brain")
    if number.path[0] != "agents":
        owner = _("the world") if kind == "world" else thing.replace("_", " ")
    label = number.name.rpartition(".")[2].replace("_", " ")
    unit = f" ({number.shown_unit})" if number.shown_unit else ""
    return VariableNumber(number.name, owner, f"{label}{unit}", number.value, number.limits)
