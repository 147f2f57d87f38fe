"""A folder in which scenes are kept under names that people give them."""

import re
import threading
import unicodedata
from pathlib import Path

from ai4u_edu.base.atomic_write import make_folder, reason, write_atomically
from ai4u_edu.base.errors import SceneError, SetupError, suggest
from ai4u_edu.blocks.brains.network import IN_THE_ZOO
from ai4u_edu.editing.permissions import outward
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.yaml.file import MAX_SCENE_CHARS

ENDING = ".yaml"
NAME = re.compile(r"[^\W_](?:[\w -]{0,58}[\w-])?")
"""Letters of any script, digits, spaces, - and _; so no name is a path, hidden, or an option."""
DEVICES = re.compile(r"(?i)con|prn|aux|nul|(com|lpt)[0-9]")
"""What Windows takes for something else than a file."""
MAX_SCENES = 300
"""So many scenes lie in one store: a page must not fill a disk."""


class SceneExistsError(SetupError):
    """Another scene has that name already, and nobody said that it may go."""


class SceneStore:
    """Keeps scenes as files in one folder; whatever a page calls them, they lie in it.

    Args:
        folder: is made if it isn't there.

    Raises:
        SetupError: it can't be.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder.absolute()
        self._lock = threading.Lock()
        make_folder(self.folder, "scenes")

    def names(self) -> list[str]:
        """The names of all scenes that lie there."""
        return sorted(map(_name_of, self._files()), key=str.casefold)

    def file(self, name: str) -> Path | None:
        """The file of a scene; None if there is none. Capitals make no difference."""
        wanted = proper(name).casefold()
        return next((each for each in self._files() if _name_of(each).casefold() == wanted), None)

    def load(self, name: str) -> Scene:
        """The scene of that name.

        Raises:
            SceneError: there is none, or something in it is wrong.
        """
        file = self.file(name)
        if file is None:
            raise SceneError(f"no scene is kept as {name!r}; {suggest(name, self.names())}")
        if file.stat().st_size > 4 * MAX_SCENE_CHARS:  # no character takes more bytes
            raise SceneError(f"{file.name}: expected at most {MAX_SCENE_CHARS} characters")
        return Scene.load(file)

    def save(self, name: str, scene: Scene, *, over: bool = False) -> str:
        """Keeps a scene, whole or not at all.

        Args:
            name: see :data:`NAME`.
            scene: which.
            over: whether one of that name may go for it.

        Returns:
            The name under which it lies there.

        Raises:
            SetupError: the name won't do, the store is full, or the disk.
            SceneExistsError: one of that name is there already.
        """
        name = proper(name)
        self._check_files(scene)
        with self._lock:
            there = self.file(name)
            if there is not None and not over:
                raise SceneExistsError(f"{_name_of(there)!r} is there already")
            if there is None and len(self._files()) >= MAX_SCENES:
                raise SetupError(
                    f"expected at most {MAX_SCENES} scenes; take some out of the folder"
                )
            file = there or self.folder / f"{name}{ENDING}"
            if file.is_symlink() or (file.exists() and not file.is_file()):
                # a link or a folder, which is nobody's to replace
                raise SetupError(f"{name!r} can't be used; choose another name")
            try:
                # another server may keep its scenes here too, under the same names
                write_atomically(file, scene.dumps(), over=over)
            except FileExistsError:
                raise SceneExistsError(f"{name!r} is there already") from None
            except OSError as error:
                raise SetupError(f"{name!r} can't be kept: {reason(error)}") from None
        return _name_of(file)

    def _check_files(self, scene: Scene) -> None:
        """What a scene needs beside it has to be here too."""
        for _, kind, value in outward(scene.description.agents):
            is_file = kind == "model_path" and not value.startswith(IN_THE_ZOO)
            if is_file and not (self.folder / value).is_file():  # an absolute one stays what it is
                raise SetupError(
                    f"it needs {value!r}, which lies beside the scene that it came from; "
                    "put a copy into the folder for saved scenes"
                )

    def _files(self) -> list[Path]:
        """No links: they lead out of the folder."""
        return [
            path
            for path in self.folder.glob(f"*{ENDING}")
            if path.is_file() and not path.is_symlink() and NAME.fullmatch(_name_of(path))
        ]


def proper(name: str) -> str:
    """A name as its file has it.

    Raises:
        SetupError: it won't do.

    >>> proper(" Mi laberinto-2 ")
    'Mi laberinto-2'
    >>> proper("../maze")
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.SetupError: expected a name of letters, digits, spaces, - and _, \
got '../maze'
    """
    name = unicodedata.normalize("NFC", name).strip()
    if not name:
        raise SetupError("expected a name, got none")
    if not NAME.fullmatch(name):
        told = repr(name if len(name) <= 60 else name[:59] + "…")
        length = "" if len(name) <= 60 else "at most 60 "
        raise SetupError(f"expected a name of {length}letters, digits, spaces, - and _, got {told}")
    if DEVICES.fullmatch(name):
        raise SetupError(f"{name!r} is no name for a file on Windows; choose another name")
    return name


def _name_of(file: Path) -> str:
    return unicodedata.normalize("NFC", file.name.removesuffix(ENDING))
