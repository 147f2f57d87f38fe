"""A folder of scenes that people saved by name."""

import re
import threading
import unicodedata
from pathlib import Path

from ai4u_edu.base.atomic_write import make_folder, reason, write_atomically
from ai4u_edu.base.errors import SceneError, SetupError, suggest
from ai4u_edu.blocks.brains.network import ZOO_PREFIX
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.permissions import external_references
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.yaml.file import MAX_SCENE_BYTES, MAX_SCENE_CHARS

ENDING = ".yaml"
MAX_NAME_CHARS = 60
NAME = re.compile(r"[^\W_](?:[\w -]{0,58}[\w-])?")
"""Letters of any script, digits, spaces, - and _; so no name is a path, hidden, or an option."""
DEVICES = re.compile(r"(?i)con|prn|aux|nul|(com|lpt)[0-9]")
"""Names of devices on Windows."""
MAX_SCENES = 300
"""Scenes in one store; a page must not fill a disk."""


class SceneExistsError(SetupError):
    """Another scene has that name already, and must not be replaced."""


class SceneStore:
    """Saves and loads scenes in one folder; no name leads out of it.

    Args:
        folder: the folder; created if it does not exist.

    Raises:
        SetupError: it can't be created.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder.absolute()
        self._lock = threading.Lock()
        make_folder(self.folder, _("scenes"))

    def names(self) -> list[str]:
        """Return the names of all saved scenes."""
        return sorted(map(_name_of, self._files()), key=str.casefold)

    def file(self, name: str) -> Path | None:
        """Return the file of a scene, ignoring case; None if there is none."""
        wanted = normalized_name(name).casefold()
        return next((each for each in self._files() if _name_of(each).casefold() == wanted), None)

    def load(self, name: str) -> Scene:
        """Load a scene.

        Raises:
            SceneError: there is none, or something in it is wrong.
        """
        file = self.file(name)
        if file is None:
            hint = suggest(name, self.names())
            raise SceneError(_("no scene is kept as {name!r}; {hint}", name=name, hint=hint))
        if file.stat().st_size > MAX_SCENE_BYTES:
            text = _(
                "{file}: expected at most {most} characters", file=file.name, most=MAX_SCENE_CHARS
            )
            raise SceneError(text)
        return Scene.load(file)

    def save(self, name: str, scene: Scene, *, over: bool = False) -> str:
        """Save a scene atomically.

        Args:
            name: see :data:`NAME`.
            scene: the scene.
            over: True to replace a scene of that name.

        Returns:
            The name under which it was saved; of a replaced scene, that one's.

        Raises:
            SetupError: the name is invalid, or the store or the disk is full.
            SceneExistsError: there is a scene of that name, and ``over`` is False.
        """
        name = normalized_name(name)
        self._check_files(scene)
        with self._lock:
            there = self.file(name)
            if there is not None and not over:
                raise SceneExistsError(_("{name!r} is there already", name=_name_of(there)))
            if there is None and len(self._files()) >= MAX_SCENES:
                raise SetupError(
                    _(
                        "expected at most {most} scenes; take some out of the folder",
                        most=MAX_SCENES,
                    )
                )
            file = there or self.folder / f"{name}{ENDING}"
            if file.is_symlink() or (file.exists() and not file.is_file()):
                # never replace a link or a folder
                raise SetupError(_("{name!r} can't be used; choose another name", name=name))
            try:
                # `over=False`: another server may use this folder at the same time
                write_atomically(file, scene.dumps(), over=over)
            except FileExistsError:
                raise SceneExistsError(_("{name!r} is there already", name=name)) from None
            except OSError as error:
                raise SetupError(
                    _("{name!r} can't be kept: {reason}", name=name, reason=reason(error))
                ) from None
        return _name_of(file)

    def _check_files(self, scene: Scene) -> None:
        """Raise a SetupError if the scene needs a network file that is not in this folder."""
        for _path, kind, value in external_references(scene.description.agents):
            is_file = kind == "model_path" and not value.startswith(ZOO_PREFIX)
            if is_file and not (self.folder / value).is_file():  # `/` keeps an absolute path
                raise SetupError(
                    _(
                        "it needs {file!r}, which lies beside the scene that it came from; "
                        "put a copy into the folder for saved scenes",
                        file=value,
                    )
                )

    def _files(self) -> list[Path]:
        """Return all scene files; no links, since they lead out of the folder."""
        return [
            path
            for path in self.folder.glob(f"*{ENDING}")
            if path.is_file() and not path.is_symlink() and NAME.fullmatch(_name_of(path))
        ]


def normalized_name(name: str) -> str:
    """Normalize a name, and check that it can be a file's name.

    Raises:
        SetupError: it can't.

    >>> normalized_name(" Mi laberinto-2 ")
    'Mi laberinto-2'
    >>> normalized_name("../maze")
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.SetupError: expected a name of letters, digits, spaces, - and _, \
got '../maze'
    """
    name = unicodedata.normalize("NFC", name).strip()
    if not name:
        raise SetupError(_("expected a name, got none"))
    if not NAME.fullmatch(name):
        if len(name) <= MAX_NAME_CHARS:
            text = _("expected a name of letters, digits, spaces, - and _, got {name!r}", name=name)
        else:
            text = _(
                "expected a name of at most {most} letters, digits, spaces, - and _, got {name!r}",
                most=MAX_NAME_CHARS,
                name=name[: MAX_NAME_CHARS - 1] + "…",
            )
        raise SetupError(text)
    if DEVICES.fullmatch(name):
        raise SetupError(
            _("{name!r} is no name for a file on Windows; choose another name", name=name)
        )
    return name


def _name_of(file: Path) -> str:
    return unicodedata.normalize("NFC", file.name.removesuffix(ENDING))
