"""Results that the class has not acknowledged yet."""

import time
from pathlib import Path
from threading import Lock

from ai4u_edu.base.atomic_write import reason, write_atomically
from ai4u_edu.locale import gettext as _
from ai4u_edu.wire.class_link import (
    MAX_FRAME_BYTES,
    Delivery,
    HandedInNetwork,
    decode_from_room,
    encode_from_room,
)
from ai4u_edu.wire.validation import WireError

MAX_RESULTS = 500
MAX_BYTES = 32 * 2**20
ENDING = ".result"


class ResultOutbox:
    """Results in the order in which they were added, until they are acknowledged. Thread-safe.

    With a folder, each result is a file there, so that a process that was killed delivers it at its
    next start. Processes may share a folder: a result that two of them deliver has one key, which
    the class stores once.

    If there are more than :data:`MAX_RESULTS`, or more than :data:`MAX_BYTES`, the oldest ones are
    dropped. A network takes the place of one before for the same scene and part.

    Args:
        folder: for the files, made if needed; default: results are kept in memory only.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self.problem = ""
        """Sentence on why results can't be kept on disk; empty if they can."""
        self._folder = folder
        self._frames: dict[str, bytes] = {}
        self._files: dict[str, Path] = {}
        self._networks: dict[tuple[str, str], str] = {}
        """Key of the network for each scene and part."""
        self._lock = Lock()
        if folder is not None:
            self._load(folder)

    def __len__(self) -> int:
        return len(self._frames)

    def keys(self) -> list[str]:
        """Return the keys of all results, oldest first."""
        with self._lock:
            return list(self._frames)

    def frame(self, key: str) -> bytes | None:
        """Return a result's frame; None if it was acknowledged or dropped."""
        return self._frames.get(key)

    def add(self, result: Delivery) -> None:
        """Keep a result; with a folder it is on disk afterwards, which takes some milliseconds.

        A result whose key is known is ignored.
        """
        frame = encode_from_room(result)
        with self._lock:
            if result.key in self._frames:
                return
            self._keep(result, frame)
            if self._folder is not None:
                self._write(self._folder, result.key, frame)
            self._drop_oldest()

    def acknowledge(self, key: str) -> None:
        """Forget a result; an unknown key is ignored."""
        with self._lock:
            self._forget(key)

    def _keep(self, result: Delivery, frame: bytes) -> None:
        if isinstance(result, HandedInNetwork):
            place = (result.scene, result.part)
            self._forget(self._networks.get(place, ""))
            self._networks[place] = result.key
        self._frames[result.key] = frame

    def _write(self, folder: Path, key: str, frame: bytes) -> None:
        path = folder / f"{time.time_ns():020}-{key}{ENDING}"
        try:
            folder.mkdir(parents=True, exist_ok=True)
            write_atomically(path, frame, mode=0o600)
        except OSError as error:
            self.problem = _(
                "results can't be kept in {folder}: {reason}",
                folder=str(folder),
                reason=reason(error),
            )
            return
        self._files[key] = path
        self.problem = ""

    def _drop_oldest(self) -> None:
        total = sum(map(len, self._frames.values()))
        while self._frames and (len(self._frames) > MAX_RESULTS or total > MAX_BYTES):
            oldest = next(iter(self._frames))
            total -= len(self._frames[oldest])
            self._forget(oldest)

    def _forget(self, key: str) -> None:
        self._frames.pop(key, None)
        path = self._files.pop(key, None)
        if path is not None:
            try:
                path.unlink(missing_ok=True)
            except OSError as error:  # it is delivered again later, with the same key
                self.problem = f"{path}: {reason(error)}"

    def _load(self, folder: Path) -> None:
        """Read the results that processes before this one left; ignore files that are damaged."""
        try:
            paths = sorted(folder.glob(f"*{ENDING}"))
        except OSError as error:
            self.problem = _(
                "results can't be read from {folder}: {reason}",
                folder=str(folder),
                reason=reason(error),
            )
            return
        for path in paths:
            try:
                if path.stat().st_size > MAX_FRAME_BYTES:
                    continue
                frame = path.read_bytes()
                result = decode_from_room(frame)
            except (OSError, WireError):
                continue
            if isinstance(result, Delivery):
                self._keep(result, frame)
                self._files[result.key] = path
        self._drop_oldest()
