"""Scenes: read from files, built into worlds with agents, written to files."""

from collections.abc import Callable, Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Any, Self

from pydantic import ValidationError
from yaml import YAMLError

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import AI4UError, SceneError, SetupError, WorldError, suggest, text_of
from ai4u_edu.base.parameters import DataPath, ParameterProblem, explain
from ai4u_edu.blocks import Brain
from ai4u_edu.blocks.brains.network import files_in
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.scenes.description import SceneDescription, check_success, make_agents
from ai4u_edu.scenes.serialization import PlainDataError
from ai4u_edu.scenes.yaml.edit import edited
from ai4u_edu.scenes.yaml.file import YamlFile, with_pictures, write_yaml
from ai4u_edu.scenes.yaml.tree import NotYamlError, read_tree
from ai4u_edu.world import World

LIBRARY = Path(__file__).parent / "library"

RANDOM_RESETS = 20
"""Resets that are tried when a randomized scene is read: each must find room for everything."""
MAX_ERRORS = 20
"""Errors of a file in one message."""
BLOCK_KINDS = ("sensors", "actuators", "rewards", "brains")
UNKNOWN_NAME_PHRASES = ("is named", "is called", "carries the tag", "the network")
"""Phrases in messages before a name that does not exist."""


@cache
def _library_names() -> tuple[str, ...]:
    return tuple(sorted(path.stem for path in LIBRARY.glob("*.yaml")))


class Scene:
    """A world and its agents as data; :meth:`build` makes the world.

    >>> scene = Scene.load("box_chase")
    >>> sim = scene.build(seed=1)
    >>> sim.reset(seed=1)
    >>> percept = sim.step()
    >>> percept["done"]
    False
    """

    def __init__(
        self, description: SceneDescription, folder: Path | None = None, source: str = ""
    ) -> None:
        self.description = description
        self.folder = folder
        """Folder of its file, to which paths in it are relative."""
        self.source = source
        """The text that it was read from; its comments are kept when the scene is written."""

    @classmethod
    def load(cls, source: str | Path) -> Self:
        """Read a scene.

        Args:
            source: a name in the library, or the path of a YAML file.

        Raises:
            SceneError: it does not exist, or something in it is wrong; names file, path and line.
        """
        path = Path(source)
        if path.suffix not in {".yaml", ".yml"}:
            path = LIBRARY / f"{source}.yaml"
            if not path.is_file() or path.parent != LIBRARY:
                raise SceneError(
                    _(
                        "no scene is called {source}; {hint}; a file's name ends in .yaml",
                        source=repr(str(source)),
                        hint=suggest(str(source), cls.names()),
                    )
                )
        try:
            text = path.read_text(encoding="utf-8-sig")  # a byte order mark is skipped
        except OSError as error:
            raise SceneError(
                _("{path}: can't be read: {why}", path=str(path), why=str(error.strerror))
            ) from None
        except UnicodeDecodeError as error:
            raise SceneError(join([str(path), _no_utf8(path, error)], ": ")) from None
        # resets take two thirds of the time; those of the library are reset in the tests
        resets = 1 if path.parent == LIBRARY else RANDOM_RESETS
        return cls._read(text, path.name, path.absolute().parent, resets)

    @classmethod
    def loads(cls, text: str, *, name: str = "scene", folder: Path | None = None) -> Self:
        """Read a scene from YAML text.

        Args:
            text: YAML.
            name: of the file, for messages.
            folder: folder to which paths in it are relative.

        Raises:
            SceneError: something in it is wrong; names file, path and line.
        """
        return cls._read(text, name, folder, RANDOM_RESETS)

    @classmethod
    def _read(cls, text: str, name: str, folder: Path | None, resets: int) -> Self:
        """Read a scene; one that samples anything is reset with several seeds."""
        text = with_pictures(text, name, folder)
        file = YamlFile(text, name)
        try:
            description = SceneDescription.model_validate(file.data)
            scene = cls(description, folder, text)
            world = scene.build().world
            if description.generate or any(thing.random for thing in description.things):
                for seed in range(1, resets):
                    world.reset(seed)
            if (easy := description.with_easy_starts()) is not None:
                world = cls(easy, folder).build().world
                for seed in range(1, resets):
                    world.reset(seed)
        except ValidationError as error:
            problems = explain(error.errors(), SceneDescription)
            raise _scene_error(file, problems) from None
        except PlainDataError as error:
            raise _scene_error(file, error.problems) from None
        except WorldError as error:
            raise _scene_error(
                file, [ParameterProblem(description.where_is(error.thing), text_of(error))]
            ) from None
        except AI4UError as error:
            path = _path_of(error, description.agents)
            if not path:
                raise SceneError(join([name, text_of(error)], ": ")) from None
            raise _scene_error(file, [ParameterProblem(path, text_of(error))]) from None
        return scene

    @staticmethod
    def names() -> list[str]:
        """Return the names of all scenes in the library."""
        return list(_library_names())

    def build(
        self, seed: int = 0, *, brains: Callable[[BasicAgent], Brain | None] | None = None
    ) -> ControlRequestor:
        """Make a new world with new agents.

        Args:
            seed: of the world.
            brains: returns the brain of an agent in place of those in the scene, or None to keep
                these; an agent that it gets has its other blocks already.

        Raises:
            AI4UError: something in the description is wrong; for its data a PlainDataError.
        """
        description = self.description
        world = World(seed=seed, **dict(description.world))
        world.add_all(description.things, description.generate)
        with files_in(self.folder):
            agents = make_agents(description)
        check_success(description.success, agents)
        if brains is not None:
            for agent in agents:
                brain = brains(agent)
                if brain is not None:
                    agent.brains = [brain]
        return ControlRequestor(
            world,
            agents,
            default_time_scale=description.time_scale,
            goal=description.goal,
            success=description.success or "",
            spread_decisions=description.spread_decisions,
            wait_for_key=description.wait_for_key,
        )

    def plain(self) -> dict[str, Any]:
        """Return the scene as plain data without default values."""
        plain = {"name": self.description.name} | self.description.model_dump(
            mode="json", exclude_defaults=True
        )
        return _with_types(plain, self.description)

    def dumps(self) -> str:
        """Return the scene as YAML text.

        Unchanged parts of a scene that was read from a text stay as they are there, with comments.
        """
        plain = self.plain()
        return _with_comments(self.source, plain) or write_yaml(plain)

    def save(self, path: str | Path) -> None:
        """Write the scene to a file atomically."""
        write_atomically(Path(path), self.dumps())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scene):
            return NotImplemented
        return self.description == other.description

    __hash__ = None  # type: ignore[assignment]  # compared by content

    def __repr__(self) -> str:
        return f"<Scene {self.description.name!r}>"


def _no_utf8(path: Path, error: UnicodeDecodeError) -> str:
    """Return the error for a file that is no UTF-8 text."""
    head = error.object[:4]
    if head[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return _("expected UTF-8 text, got UTF-16; save it as UTF-8 in your editor")
    if b"\0" in error.object:
        return _("expected a scene file, which is UTF-8 text, got a file that is no text")
    line = error.object[: error.start].count(b"\n") + 1
    return _(
        "line {line}: expected UTF-8 text, got the byte 0x{byte:02x}; save {name} as UTF-8 in your "
        "editor",
        line=line,
        byte=error.object[error.start],
        name=path.name,
    )


def _with_comments(source: str, plain: dict[str, Any]) -> str:
    """Return a scene's text with other data in it; empty if it can't be edited."""
    if not source:
        return ""
    try:
        before = _plain_of(source)
        text = source if before == plain else edited(source, before, plain)
        return text if _plain_of(text) == plain else ""
    except (
        ValueError,
        LookupError,
        NotYamlError,
        YAMLError,
    ):  # unusual YAML, which can't be edited line by line
        return ""


def _plain_of(text: str) -> dict[str, Any]:
    return Scene(SceneDescription.model_validate(read_tree(text).data)).plain()


def _with_types(plain: dict[str, Any], description: SceneDescription) -> dict[str, Any]:
    """Put back the types of shapes: they are defaults, but needed for reading."""
    for key in ("floors", "areas", "bodies"):
        for entry, described in zip(plain.get(key, []), getattr(description, key), strict=False):
            shape = {"type": described.shape.type} | entry.get("shape", {})
            entry["shape"] = shape
    if description.generate is not None:
        plain["generate"] = {"type": description.generate.type} | plain["generate"]
    return plain


def _scene_error(
    file: YamlFile, problems: "list[ParameterProblem] | tuple[ParameterProblem, ...]"
) -> SceneError:
    shown = problems[:MAX_ERRORS]
    lines = [
        _(
            "{name}, line {line}: {problem}",
            name=file.name,
            line=file.line(each.path),
            problem=each.message,
        )
        for each in shown
    ]
    if len(problems) > len(shown):
        more = len(problems) - len(shown)
        lines.append(_("{name}: and {count} more like these", name=file.name, count=more))
    return SceneError(join([*lines], "\n"))


def _path_of(error: AI4UError, agents: Iterable[Mapping[str, Any]]) -> DataPath:
    """Return the path in the scene that an error is about; () if unknown.

    Args:
        error: raised while agents were set up in a world.
        agents: the agents' parameters in the scene.
    """
    where = error.where if isinstance(error, SetupError) else ()
    agent = where[0] if where else None
    if not isinstance(agent, BasicAgent):
        return ()
    plain = list(agents)
    index = [str(each.get("id", "0")) == agent.id for each in plain]
    if not any(index):
        return ()
    # of two agents with the same id the second one is wrong
    base: DataPath = ("agents", len(index) - 1 - index[::-1].index(True))
    return base + _inside(agent, where[-1], plain[int(base[1])], text_of(error))


def _inside(agent: BasicAgent, part: object, plain: Mapping[str, Any], text: str) -> DataPath:
    if isinstance(part, str):
        return (part,) if part in plain else ()
    for kind in BLOCK_KINDS:
        for index, block in enumerate(getattr(agent, kind)):
            given = plain.get(kind, ())
            if block is part and index < len(given):
                return (kind, index, *field_named_in(text, given[index]))
    return ()


def field_named_in(text: str, data: Any, path: DataPath = ()) -> DataPath:
    """Return the path of the value that a message names as unknown; () if there is none.

    >>> field_named_in("no body is called 'bxo'", {"type": "TouchSensor", "target": "bxo"})
    ('target',)
    """
    if isinstance(data, Mapping):
        parts: Iterable[tuple[str | int, Any]] = data.items()
    elif isinstance(data, list | tuple):
        parts = enumerate(data)
    else:
        unknown = isinstance(data, str) and any(
            f"{word} {data!r}" in text for word in UNKNOWN_NAME_PHRASES
        )
        return path if unknown else ()
    found = (field_named_in(text, each, (*path, part)) for part, each in parts)
    return next(filter(None, found), ())
