"""Missions as data: small tasks in the page, read from YAML files."""

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple, Self, get_args

from pydantic import (
    AfterValidator,
    Field,
    StringConstraints,
    ValidationError,
    field_validator,
    model_validator,
)

from ai4u_edu.base.errors import AI4UError, SceneError, SetupError, shown, suggest, text_of
from ai4u_edu.base.parameters import ParameterProblem, explain
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.missions.checks import AnyCheck, Chooses, Holds, Reads, Solves, Text
from ai4u_edu.missions.events import Driver
from ai4u_edu.page.editing.scene_pictures import template_names
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.yaml.file import YamlFile
from ai4u_edu.world.shapes import Description

LIBRARY = Path(__file__).parent / "library"
MAX_FILES = 100
"""Most files of a folder that are read."""
MAX_MISSION_BYTES = 64 * 1024
REREAD_S = 1.0
"""Time (s) after which a folder is looked at again."""
EMPTY_SCENES = template_names()
"""Scenes to build in, which have no goal yet: the empty plate, and worlds of lessons."""
EXPECTED = _("lines such as title: ..., scene: ..., steps: ...")
Island = Literal["Drive", "Sense", "Think", "Code", "Build", "Teach", "Compete", "My class"]
"""Islands of the map, in their order; the last one is for missions of a teacher."""
ISLANDS: tuple[Island, ...] = get_args(Island)
Title = Annotated[str, StringConstraints(min_length=1, max_length=60)]
CONTROLS = (
    *("Add a reward", "Add a sensor", "Add an actuator", "Arena", "Ball", "Blocks", "Box", "Build"),
    *("Code", "Compare", "Details", "Drive", "First actuator", "First brain", "First reward"),
    *("First sensor", "Follow", "Keys", "Learn", "Let it drive", "More"),
    *("Networks", "New start", "Past", "Pause", "Practise", "Program", "Python", "Rewards", "Run"),
    *("Sensors", "Simple", "Space", "Step", "Stop", "Target", "Teach", "Test", "Through its eyes"),
    *("Trail", "Try again", "Wall", "World"),
)
"""Controls of the page that a mission can light, by the names that they have there; ``Keys`` are
the keys on the screen that drive, ``Space`` is the one for the space bar, ``Program`` is the editor
of a program, ``Networks`` is the card of a network in the tab "Teach", and ``First sensor`` is a
sensor's first card in the tab "Build"."""


def _known_control(name: str) -> str:
    if name not in CONTROLS:
        raise ValueError(
            _("no control is called {name}; {hint}", name=shown(name), hint=suggest(name, CONTROLS))
        )
    return name


Control = Annotated[
    str, AfterValidator(_known_control), Field(json_schema_extra={"enum": [*CONTROLS]})
]


class Hint(Description):
    """A sentence that is shown when something has happened in place of what was asked for."""

    when: AnyCheck
    say: Text


class Star(Description):
    """A second or third star, for doing the whole mission especially well."""

    say: Text
    check: AnyCheck


class Step(Description):
    """One thing to do."""

    say: Text
    """One sentence; what stands in stars is bold."""
    light: Annotated[list[Control], Field(max_length=6)] = Field(default_factory=list)
    """Names of controls on the way to the one that is meant: the last one that can be seen is lit,
    such as ``[Code, Run]``."""
    by: Driver | Literal["new network", "anyone"] = "anyone"
    """The driver that counts; a new network is one that did not drive before the step."""
    check: AnyCheck
    done: Text = "Done."
    """One sentence about what happened."""
    hints: Annotated[list[Hint], Field(max_length=8)] = Field(default_factory=list)


class Mission(Description):
    """A small task in the page, of three to eight minutes."""

    title: Title
    island: Island = "My class"
    place: Annotated[int, Field(ge=1, le=1000)] = 1
    """Its place on the island; the smallest comes first."""
    minutes: Annotated[int, Field(ge=1, le=30)] = 5
    scene: str
    """Name of a scene of the library or of a lesson, or ``my_scene`` for an empty plate with a
    robot."""
    idea: Annotated[str, StringConstraints(max_length=40)] = ""
    """The word that it is about, such as ``percept``."""
    steps: Annotated[list[Step], Field(min_length=1, max_length=12)]
    stars: Annotated[list[Star], Field(max_length=2)] = Field(default_factory=list)
    """The second and the third star; the first one is for doing the mission."""
    next: str = ""
    """Name of the mission that follows; default: the one that follows on the map."""
    exercise: Annotated[str, StringConstraints(pattern=r"^(\d\d\.\d)?$")] = ""
    """Exercise of the course that the mission is, such as ``01.4``; empty if it is none."""

    def texts(self) -> Iterator[str]:
        """Yield all texts that a person reads."""
        yield self.title
        if self.idea:
            yield self.idea
        for step in self.steps:
            yield from (step.say, step.done, *(hint.say for hint in step.hints))
            for check in (step.check, *(hint.when for hint in step.hints)):
                if isinstance(check, Holds) and check.word:
                    yield check.word
            if isinstance(step.check, Chooses | Reads):
                yield step.check.question
            if isinstance(step.check, Chooses):
                yield from step.check.options
        yield from (star.say for star in self.stars)

    @model_validator(mode="after")
    def _has_an_exercise(self) -> Self:
        if not self.exercise and any(isinstance(step.check, Solves) for step in self.steps):
            raise ValueError(_("a step of type solves needs exercise: NUMBER in the mission"))
        return self

    @field_validator("scene")
    @classmethod
    def _is_known(cls, scene: str) -> str:
        known = [*Scene.names(), *EMPTY_SCENES]
        if scene not in known:
            raise ValueError(
                _("no scene is called {scene!r}; {hint}", scene=scene, hint=suggest(scene, known))
            )
        return scene


def read_mission(text: str, name: str) -> Mission:
    r"""Read a mission, and check that its scene has what its checks look at.

    Args:
        text: YAML.
        name: of the file, for messages.

    Raises:
        SceneError: something in it is wrong; names file and line.

    >>> read_mission("title: Go\nscene: box_chase\nsteps: []\nstep: 1", "go.yaml")
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.SceneError: go.yaml, line 3: steps: expected at least 1 entries, got []
    go.yaml, line 4: step: unknown parameter; did you mean 'steps'?
    """
    file = YamlFile(text, name, EXPECTED)
    try:
        mission = Mission.model_validate(file.data)
    except ValidationError as error:
        raise _error(file, explain(error.errors(), Mission)) from None
    problems = list(_unfit(mission))
    if problems:
        raise _error(file, problems)
    return mission


def mission_schema() -> dict[str, Any]:
    """Return the schema of a mission's file (JSON Schema 2020-12), with all kinds of checks."""
    schema = "https://json-schema.org/draft/2020-12/schema"
    return {"$schema": schema, **Mission.model_json_schema()}


class Missions(NamedTuple):
    """Missions by name, in the order of the map, and what is wrong with files."""

    by_name: dict[str, Mission]
    problems: tuple[str, ...] = ()

    def get(self, name: str) -> Mission:
        """Return a mission.

        Raises:
            SetupError: there is none of that name; the text suggests one.
        """
        if name not in self.by_name:
            raise SetupError(
                _(
                    "no mission is called {name!r}; {hint}",
                    name=name[:80],
                    hint=suggest(name[:80], self.by_name),
                )
            )
        return self.by_name[name]

    def after(self, name: str) -> str:
        """Return the name of the mission that follows another one; empty after the last one."""
        chosen = self.by_name[name].next
        if chosen in self.by_name:
            return chosen
        names = [*self.by_name, ""]
        return names[names.index(name) + 1]


class MissionFolder:
    """The missions of the package, and those of a folder, which is read again when it changes.

    Any thread may call it.

    Args:
        folder: of a teacher; None for none. Its missions come after those of the package.
        clock: returns the time (s).
    """

    def __init__(
        self, folder: Path | None = None, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self.folder, self._clock = folder, clock
        self._seen = _Look(-math.inf, None, library_missions())

    def missions(self) -> Missions:
        """Return all missions; a file that was saved is read again within a second."""
        seen, folder = self._seen, self.folder
        now = self._clock()
        if folder is None or now - seen.at < REREAD_S:
            return seen.missions
        files = _files(folder)
        state = tuple((path, *_stat(path)) for path in files)
        missions = seen.missions if state == seen.state else _with_folder(folder, files)
        self._seen = _Look(now, state, missions)
        return missions


@cache
def library_missions() -> Missions:
    """Return the missions of the package.

    They are read without being tried in their scenes, which a test does.
    """
    found = {
        path.stem: Mission.model_validate(YamlFile(text, path.name, EXPECTED).data)
        for path in sorted(LIBRARY.glob("*.yaml"))
        for text in [path.read_text(encoding="utf-8")]
    }
    return Missions(_in_order(found))


@dataclass(frozen=True)
class _Look:
    at: float
    state: tuple[tuple[Path, float, int], ...] | None
    """Each file with its time and size; None before the first look."""
    missions: Missions


def _in_order(missions: dict[str, Mission]) -> dict[str, Mission]:
    def rank(name: str) -> tuple[int, int, str]:
        mission = missions[name]
        return ISLANDS.index(mission.island), mission.place, name

    return {name: missions[name] for name in sorted(missions, key=rank)}


def _files(folder: Path) -> list[Path]:
    return sorted(path for path in folder.glob("*.y*ml") if path.suffix in (".yaml", ".yml"))


def _stat(path: Path) -> tuple[float, int]:
    try:
        stat = path.stat()
    except OSError:  # it has just been removed
        return 0.0, -1
    return stat.st_mtime, stat.st_size


def _with_folder(folder: Path, files: Sequence[Path]) -> Missions:
    """Return the missions of the package and of a folder's files."""
    library = library_missions().by_name
    found: dict[str, Mission] = {}
    problems: list[str] = []
    if not folder.is_dir():
        problems.append(
            _("{folder}: expected a folder with missions, found none", folder=str(folder))
        )
    if len(files) > MAX_FILES:
        problems.append(
            _(
                "{folder}: expected at most {most} files, got {count}; the first {most} are read",
                folder=str(folder),
                most=MAX_FILES,
                count=len(files),
            )
        )
    for path in files[:MAX_FILES]:
        try:
            if path.stem in library:
                raise SceneError(
                    _("{name}: a mission of this name exists; rename the file", name=path.name)
                )
            found[path.stem] = read_mission(_text_of(path), path.name)
        except AI4UError as error:
            problems.append(text_of(error))
    names = {*library, *found}
    problems += [
        _(
            "{name}.yaml: next: no mission is called {next!r}; {hint}",
            name=name,
            next=each.next,
            hint=suggest(each.next, names),
        )
        for name, each in found.items()
        if each.next and each.next not in names
    ]
    return Missions(_in_order(library | found), tuple(problems))


def _text_of(path: Path) -> str:
    try:
        with path.open("rb") as file:
            data = file.read(MAX_MISSION_BYTES + 1)
    except OSError as error:
        raise SceneError(
            _("{name}: can't be read: {strerror}", name=path.name, strerror=str(error.strerror))
        ) from None
    if len(data) > MAX_MISSION_BYTES:
        raise SceneError(
            _(
                "{name}: expected at most {most} bytes, got more",
                name=path.name,
                most=MAX_MISSION_BYTES,
            )
        )
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise SceneError(
            _("{name}: expected UTF-8 text; save it as UTF-8", name=path.name)
        ) from None


def _unfit(mission: Mission) -> Sequence[ParameterProblem]:
    """Return what the checks of a mission look at and its scene does not have."""
    if mission.scene in EMPTY_SCENES:
        return ()  # its person builds what they look at
    sim = Scene.load(mission.scene).build()
    sim.reset(0)
    agent = sim.agents[0]
    problems: list[ParameterProblem] = []
    for path, check in _checks(mission):
        try:
            check.fit(agent)
        except SetupError as error:
            problems.append(ParameterProblem(path, text_of(error)))
    return problems


def _checks(mission: Mission) -> Sequence[tuple[tuple[str | int, ...], AnyCheck]]:
    found: list[tuple[tuple[str | int, ...], AnyCheck]] = []
    for index, step in enumerate(mission.steps):
        found.append((("steps", index, "check"), step.check))
        found += [
            (("steps", index, "hints", place, "when"), hint.when)
            for place, hint in enumerate(step.hints)
        ]
    return found + [
        (("stars", index, "check"), star.check) for index, star in enumerate(mission.stars)
    ]


def _error(file: YamlFile, problems: Sequence[ParameterProblem]) -> SceneError:
    lines = [
        _(
            "{name}, line {line}: {problem}",
            name=file.name,
            line=file.line(each.path),
            problem=each.message,
        )
        for each in problems[:20]
    ]
    return SceneError(join(lines, "\n"))
