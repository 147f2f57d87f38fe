"""Numbered files of scenes in a folder."""

import re
from collections.abc import Sequence
from pathlib import Path

MAX_NAME_BYTES = 120
"""Length of a scene's name in the name of a file."""


class SceneFolder:
    """A folder in which each scene has numbered files, such as ``box_chase-3.onnx``.

    Args:
        folder: it need not exist yet.
        ending: suffix of the files.
    """

    def __init__(self, folder: Path, ending: str) -> None:
        self._folder, self._ending = folder, ending

    def files(self, scene: str) -> Sequence[Path]:
        """Return a scene's files, the lowest number first."""
        name = re.compile(re.escape(f"{_safe(scene)}-") + "[0-9]{1,9}" + re.escape(self._ending))
        files = self._folder.glob(f"*{self._ending}")
        return sorted((file for file in files if name.fullmatch(file.name)), key=number_of)

    def scenes(self) -> Sequence[str]:
        """Return the names of scenes that have files, as the files' names have them."""
        names = (file.stem.rpartition("-") for file in self._folder.glob(f"*-*{self._ending}"))
        return sorted({name for name, _, number in names if number.isdecimal()})

    def file(self, scene: str, number: int) -> Path:
        """Return the path of a scene's file."""
        return self._folder / f"{_safe(scene)}-{number}{self._ending}"

    def next_file(self, scene: str) -> Path:
        """Return the path of a scene's next file, whose folder is there then.

        Raises:
            OSError: the folder can't be created.
        """
        self._folder.mkdir(parents=True, exist_ok=True)
        files = self.files(scene)
        return self.file(scene, number_of(files[-1]) + 1 if files else 1)


def number_of(path: Path) -> int:
    """Return the number of a scene's file."""
    return int(path.stem.rpartition("-")[2])


def _safe(scene: str) -> str:
    safe = "".join(char if char.isalnum() or char in "-_" else "_" for char in scene)
    return safe.encode()[:MAX_NAME_BYTES].decode(errors="ignore")
