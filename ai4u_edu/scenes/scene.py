"""A scene: a file in, a world with agents out."""

from pathlib import Path
from typing import Any, Self

from pydantic import ValidationError
from yaml import YAMLError

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import AI4UError, SceneError, WorldError, suggest
from ai4u_edu.base.parameters import Problem, explain
from ai4u_edu.blocks.brains.network import files_in
from ai4u_edu.scenes.description import SceneDescription, check_success, make_agents
from ai4u_edu.scenes.serialization import PlainDataError
from ai4u_edu.scenes.setup_errors import path_of
from ai4u_edu.scenes.yaml.edit import edited
from ai4u_edu.scenes.yaml.file import YamlFile, write_yaml
from ai4u_edu.scenes.yaml.tree import NotYamlError, read_tree
from ai4u_edu.world import World

LIBRARY = Path(__file__).parent / "library"

EPISODES = 20
"""So many are set up when a file is read, where some of it is random: in each must be room."""
MOST_TOLD = 20
"""Mistakes of a file that are told at once."""


class Scene:
    """A world and its agents as data; :meth:`build` makes them.

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
        """Where its file is: paths in it begin there."""
        self.source = source
        """The text that it was read from: its comments are kept when the scene is written."""

    @classmethod
    def load(cls, source: str | Path) -> Self:
        """Reads a scene.

        Args:
            source: a name out of the library, or the path of a YAML file.

        Raises:
            SceneError: there is none, or something in it is wrong; names file, path and line.
        """
        path = Path(source)
        if path.suffix not in {".yaml", ".yml"}:
            path = LIBRARY / f"{source}.yaml"
            if not path.is_file() or path.parent != LIBRARY:
                raise SceneError(
                    f"no scene is called {str(source)!r}; {suggest(str(source), cls.names())}; "
                    "a file's name ends in .yaml"
                )
        try:
            text = path.read_text(encoding="utf-8-sig")  # some editors begin with a mark
        except OSError as error:
            raise SceneError(f"{path}: can't be read: {error.strerror}") from None
        except UnicodeDecodeError as error:
            raise SceneError(f"{path}: {_no_utf8(path, error)}") from None
        return cls.loads(text, name=path.name, folder=path.absolute().parent)

    @classmethod
    def loads(cls, text: str, *, name: str = "scene", folder: Path | None = None) -> Self:
        """Reads a scene from YAML text; ``name`` stands in messages, paths begin in ``folder``."""
        file = YamlFile(text, name)
        try:
            description = SceneDescription.model_validate(file.data)
            scene = cls(description, folder, text)
            world = scene.build().world
            if any(thing.random for thing in description.things):
                for seed in range(1, EPISODES):
                    world.reset(seed)
        except ValidationError as error:
            problems = explain(error.errors(), SceneDescription)
            raise _told(file, problems) from None
        except PlainDataError as error:
            raise _told(file, error.problems) from None
        except WorldError as error:
            raise _told(file, [Problem(description.where_is(error.thing), str(error))]) from None
        except AI4UError as error:
            path = path_of(error, description.agents)
            if not path:
                raise SceneError(f"{name}: {error}") from None
            raise _told(file, [Problem(path, str(error))]) from None
        return scene

    @staticmethod
    def names() -> list[str]:
        """The names of all scenes in the library."""
        return sorted(path.stem for path in LIBRARY.glob("*.yaml"))

    def build(self, seed: int = 0) -> ControlRequestor:
        """Makes the world and the agents, each time new ones.

        Raises:
            AI4UError: something in the description is wrong; of its data, a PlainDataError.
        """
        description = self.description
        world = World(seed=seed, **dict(description.world))
        world.add_all(description.things)
        with files_in(self.folder):
            agents = make_agents(description)
        check_success(description.success, agents)
        return ControlRequestor(
            world,
            agents,
            default_time_scale=description.time_scale,
            goal=description.goal,
            success=description.success or "",
            spread_decisions=description.spread_decisions,
        )

    def plain(self) -> dict[str, Any]:
        """The scene as plain data; what is as by default is left out."""
        plain = {"name": self.description.name} | self.description.model_dump(
            mode="json", exclude_defaults=True
        )
        return _with_types(plain, self.description)

    def dumps(self) -> str:
        """The scene as YAML text.

        Of a scene that was read from a text, what did not change stays as it stands there, with
        its comments.
        """
        plain = self.plain()
        return _with_comments(self.source, plain) or write_yaml(plain)

    def save(self, path: str | Path) -> None:
        """Writes the scene to a file; a file that was there is replaced whole, or not at all."""
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
        return "expected UTF-8 text, got UTF-16; save it as UTF-8 in your editor"
    if b"\0" in error.object:
        return "expected a scene file, which is UTF-8 text, got a file that is no text"
    line = error.object[: error.start].count(b"\n") + 1
    return (
        f"line {line}: expected UTF-8 text, got the byte 0x{error.object[error.start]:02x}; save "
        f"{path.name} as UTF-8 in your editor"
    )


def _with_comments(source: str, plain: dict[str, Any]) -> str:
    """Return a scene's text with other data in it; empty if that is not possible."""
    if not source:
        return ""
    try:
        before = _plain_of(source)
        text = source if before == plain else edited(source, before, plain)
        return text if _plain_of(text) == plain else ""
    except (ValueError, LookupError, NotYamlError, YAMLError):  # written in a way that is too odd
        return ""


def _plain_of(text: str) -> dict[str, Any]:
    return Scene(SceneDescription.model_validate(read_tree(text).data)).plain()


def _with_types(plain: dict[str, Any], description: SceneDescription) -> dict[str, Any]:
    """Puts back the shapes' types: they are defaults, but whoever reads needs them."""
    for key in ("floors", "areas", "bodies"):
        for entry, described in zip(plain.get(key, []), getattr(description, key), strict=False):
            shape = {"type": described.shape.type} | entry.get("shape", {})
            entry["shape"] = shape
    return plain


def _told(file: YamlFile, problems: "list[Problem] | tuple[Problem, ...]") -> SceneError:
    told = problems[:MOST_TOLD]
    lines = [f"{file.name}, line {file.line(each.path)}: {each}" for each in told]
    if len(problems) > len(told):
        lines.append(f"{file.name}: and {len(problems) - len(told)} more like these")
    return SceneError("\n".join(lines))
