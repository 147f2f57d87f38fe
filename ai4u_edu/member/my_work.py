"""A student's work from a class: one ZIP file, which anybody may have made.

::

    scene.yaml              the scene as it was at the end
    scenes/NAME.yaml        saved scenes
    episodes/NAME.episode   recorded episodes
    programs/NAME.py        programs in Python, which are not opened
    networks/NAME.onnx      networks that learned, or were handed in for tournaments
    progress.json           progress in the lessons
    missions.json           progress in missions, which is not read

Everything else in the file is ignored.
"""

import hashlib
import re
import shutil
import tempfile
import zipfile
import zlib
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from ai4u_edu.base.atomic_write import reason
from ai4u_edu.base.errors import SceneError, SetupError, text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.permissions import Permissions
from ai4u_edu.page.editing.scene_store import DEVICES, MAX_SCENES
from ai4u_edu.page.editing.scene_store import NAME as SCENE_NAME
from ai4u_edu.recording.episode import MAX_RECORDING_BYTES
from ai4u_edu.scenes.yaml.file import MAX_SCENE_BYTES, YamlFile
from ai4u_edu.wire.class_link import MAX_NETWORK_BYTES

SCENE, PROGRESS = "scene.yaml", "progress.json"
SCENES, EPISODES, PROGRAMS, NETWORKS = "scenes", "episodes", "programs", "networks"
MAX_ZIP_BYTES = 64 * 2**20
MAX_TOTAL_BYTES = 256 * 2**20
"""Limit of everything in the file, unpacked."""
MAX_EPISODES = 300
MAX_PROGRAMS = 50
MAX_PROGRAM_BYTES = 4 * 100_000
"""A class keeps programs of 100,000 characters, each of at most four bytes."""
MAX_NETWORKS = 100
MAX_PROGRESS_BYTES = 4 * 2**20
MAX_FOLDERS = 100
"""Limit of folders for ZIP files of the same name."""
MARK = ".my-work"
"""File with the digest of the ZIP file that a folder was made from."""
_PROGRAM = re.compile(r"[\w&-][\w &-]{0,180}\.py")
_NETWORK = re.compile(r"[\w-]{1,180}\.onnx")
_EPISODE = re.compile(r"[A-Za-z0-9_][\w. -]{0,180}\.episode")


class UnsafeSceneError(SetupError):
    """A scene of an unknown person names files elsewhere, or another machine."""


@dataclass(frozen=True)
class MyWork:
    """A folder with a student's work."""

    folder: Path

    @property
    def scene(self) -> Path:
        """The scene's file."""
        return self.folder / SCENE

    @property
    def scenes(self) -> Path:
        """The folder of saved scenes."""
        return self.folder / SCENES

    @property
    def episodes(self) -> Path:
        """The folder of recorded episodes."""
        return self.folder / EPISODES


def open_my_work(file: Path) -> MyWork:
    """Unpack a student's work into a folder beside the file, and return it.

    The folder is named like the file. A file that was unpacked before is not unpacked again, so
    that nothing is lost that was changed since; another file of the same name gets a folder of its
    own.

    Raises:
        SetupError: it is no such file, it is too large, or there is no space for the folder.
        UnsafeSceneError: a scene names a file or a machine that it may not.
    """
    try:
        if file.stat().st_size > MAX_ZIP_BYTES:
            raise SetupError(
                _("{file}: expected at most {most} MB", file=str(file), most=MAX_ZIP_BYTES // 2**20)
            )
        digest = hashlib.sha256(file.read_bytes()).hexdigest()
        folder = _folder_for(file, digest)
        if not folder.exists():
            _unpack(file, folder, digest)
        work = MyWork(folder)
        work.scenes.mkdir(exist_ok=True)
        work.episodes.mkdir(exist_ok=True)
    except OSError as error:
        raise SetupError(f"{error.filename or file}: {reason(error)}") from None
    return work


def _folder_for(file: Path, digest: str) -> Path:
    """Return the folder that was made from the file, or the name of a new one."""
    for number in range(1, MAX_FOLDERS + 1):
        folder = file.with_name(file.stem if number == 1 else f"{file.stem}-{number}")
        mark = folder / MARK
        if not folder.exists() or (mark.is_file() and mark.read_text(encoding="utf-8") == digest):
            return folder
    raise SetupError(
        _(
            "{file}: there are {most} folders for it already; delete some",
            file=str(file),
            most=MAX_FOLDERS,
        )
    )


def _unpack(file: Path, folder: Path, digest: str) -> None:
    files = _read(file)
    beside = Path(tempfile.mkdtemp(prefix=".my-work-", dir=folder.parent))
    try:
        for name, data in files.items():
            target = beside / name
            target.parent.mkdir(exist_ok=True)
            target.write_bytes(data)
        (beside / MARK).write_text(digest, encoding="utf-8")
        beside.chmod(0o755)
        beside.rename(folder)
    except BaseException:
        shutil.rmtree(beside, ignore_errors=True)
        raise


def _read(file: Path) -> dict[str, bytes]:
    """Return the known files in a ZIP file by their name in it."""
    files: dict[str, bytes] = {}
    left_bytes = MAX_TOTAL_BYTES
    try:
        with zipfile.ZipFile(file) as archive:
            for info in archive.infolist():
                limit = _limit_of(info.filename, files)
                if limit is None:
                    continue
                with archive.open(info) as entry:
                    # what the file says of its sizes may be wrong
                    data = entry.read(min(limit, left_bytes) + 1)
                left_bytes -= len(data)
                if len(data) > limit or left_bytes < 0:
                    raise SetupError(
                        _(
                            "{file}: {filename} is too large to be a student's work",
                            file=str(file),
                            filename=info.filename,
                        )
                    )
                if info.filename.endswith(".yaml"):
                    _check_references(file, info.filename, data)
                files[info.filename] = data
    except (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, ValueError) as error:
        # RuntimeError: it is encrypted, or compressed in an unknown way
        raise SetupError(
            _(
                "{file}: expected the ZIP file that a class gave as 'my work', got {problem}",
                file=str(file),
                problem=str(error),
            )
        ) from None
    if SCENE not in files:
        raise SetupError(
            _(
                "{file}: expected the ZIP file that a class gave as 'my work'; there is no "
                "{scene} in it",
                file=str(file),
                scene=SCENE,
            )
        )
    return files


def _limit_of(name: str, known: dict[str, bytes]) -> int | None:
    """Return the largest size (bytes) of a file in the ZIP file; None for one to ignore."""
    if name.casefold() in map(str.casefold, known):  # one file on some systems
        return None
    folder, slash, last = name.partition("/")
    if not slash:
        return {SCENE: MAX_SCENE_BYTES, PROGRESS: MAX_PROGRESS_BYTES}.get(name)
    stem, _, ending = last.rpartition(".")
    if DEVICES.fullmatch(last.partition(".")[0].strip()):
        return None
    count = sum(each.startswith(f"{folder}/") for each in known)
    if folder == SCENES and ending == "yaml" and SCENE_NAME.fullmatch(stem):
        return MAX_SCENE_BYTES if count < MAX_SCENES else None
    if folder == EPISODES and _EPISODE.fullmatch(last):
        return MAX_RECORDING_BYTES if count < MAX_EPISODES else None
    if folder == PROGRAMS and _PROGRAM.fullmatch(last):
        return MAX_PROGRAM_BYTES if count < MAX_PROGRAMS else None
    if folder == NETWORKS and _NETWORK.fullmatch(last):
        return MAX_NETWORK_BYTES if count < MAX_NETWORKS else None
    return None


def _check_references(file: Path, name: str, data: bytes) -> None:
    """Raise a SceneError if a scene would read other files or connect to other machines.

    A scene that is wrong in another way is reported when it is opened.
    """
    with suppress(SceneError, UnicodeDecodeError):
        plain = YamlFile(data.decode("utf-8-sig"), name).data
        try:
            Permissions(()).check(plain, ())
        except ChangeError as error:
            raise UnsafeSceneError(
                _(
                    "{file}: {name}: {problem}. If you know who made it, unpack the file "
                    "yourself, and play {scene}.",
                    file=str(file),
                    name=name,
                    problem=text_of(error),
                    scene=SCENE,
                )
            ) from None
