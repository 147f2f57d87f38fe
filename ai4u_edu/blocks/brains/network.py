"""A trained network in an ONNX file: its inputs, its outputs, and its metadata."""

import json
import math
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ai4u_edu.base.errors import BlockError, suggest
from ai4u_edu.blocks.brains import zoo
from ai4u_edu.locale import gettext as _

MAX_LOADED_NETWORK_BYTES = 64 * 2**20
"""Largest file of a network."""

MAX_PORT_NUMBERS = 2**24
"""Most numbers of one input or output."""

MAX_REASON_CHARS = 300
"""Longest text of onnxruntime in an error."""

EXTERNAL_DATA_SETTING = "session.model_external_initializers_file_folder_path"
"""Name of onnxruntime's setting for the folder of external data of a network."""

ZOO_PREFIX = "zoo:"
"""Prefix of a path that names a network of the package, by its scene."""

TRAINING_KEY = "ai4u_edu"
"""Key of our entry in the file's metadata, which describes the training."""

VALUE_OUTPUT = "critic_value"
"""Name of the output of a network that also gives the value of a percept; it drives nothing."""

_FOLDER: ContextVar[Path | None] = ContextVar("_FOLDER", default=None)

RHYTHM = ("skip_frame", "repeat_action")
"""Parameters of a brain that are part of a network's metadata."""

DTYPES: dict[str, npt.DTypeLike] = {
    "tensor(float)": np.float32,
    "tensor(int64)": np.int64,
    "tensor(int32)": np.int32,
    "tensor(uint8)": np.uint8,
    "tensor(bool)": np.bool_,
}


class Port(NamedTuple):
    """An input or an output."""

    name: str
    shape: tuple[int, ...]
    """Shape for one decision, without the batch axis."""
    dtype: np.dtype[Any]


@contextmanager
def files_in(folder: Path | None) -> Iterator[None]:
    """Resolve the relative paths of blocks that are made meanwhile in this folder."""
    before = _FOLDER.set(folder)
    try:
        yield
    finally:
        _FOLDER.reset(before)


def folder_of_files() -> Path | None:
    """Return the folder for relative paths of blocks; None for the current folder."""
    return _FOLDER.get()


def find_network(path: str, folder: Path | None = None) -> Path:
    """Return the file that a path names.

    Args:
        path: of an ONNX file, or ``zoo:`` and a scene.
        folder: for relative paths; the current folder is searched too.

    Raises:
        BlockError: there is no such file, or it is not an ONNX file.
    """
    if path.startswith(ZOO_PREFIX):
        scene = path.removeprefix(ZOO_PREFIX)
        if scene not in zoo.names():
            raise BlockError(
                _(
                    "the zoo has no network for {scene}; {hint}",
                    scene=repr(scene),
                    hint=suggest(scene, zoo.names()),
                )
            )
        return zoo.network_of(scene)
    if Path(path).suffix != ".onnx":
        raise BlockError(
            _(
                "expected a network as an .onnx file (or zoo:SCENE), got {path}; make one with: "
                "ai4u-edu export MODEL --out policy.onnx",
                path=repr(path),
            )
        )
    places = [Path(path)] if folder is None else [folder / path, Path(path)]
    for place in places:
        if place.is_file():
            return place
    absolute = [str(place.absolute()) for place in dict.fromkeys(places)]
    if len(absolute) == 1:
        raise BlockError(
            _("the network {path!r} is not there as {place}", path=path, place=absolute[0])
        )
    raise BlockError(
        _(
            "the network {path!r} is not there as {place} nor as {other}",
            path=path,
            place=absolute[0],
            other=absolute[1],
        )
    )


class Network:
    """A network that onnxruntime runs, on one thread.

    Only ONNX is loaded: numbers, and operations from a fixed list; no code from the file is
    executed.

    Args:
        path: the file.

    Raises:
        BlockError: the file can't be read, or onnxruntime can't run the network.
    """

    def __init__(self, path: Path) -> None:
        import onnxruntime  # 20 MB of memory that only networks need

        self.path = path
        options = onnxruntime.SessionOptions()
        # a policy's network is so small that it is done before a second thread wakes up
        options.intra_op_num_threads = options.inter_op_num_threads = 1
        options.log_severity_level = 4
        # a folder that can't exist, so that no file but the network's own is ever read
        options.add_session_config_entry(EXTERNAL_DATA_SETTING, str(path.absolute() / "no parts"))
        data = _bytes_of(path)
        try:
            session = onnxruntime.InferenceSession(
                data, options, providers=["CPUExecutionProvider"], enable_fallback=0
            )
            # reading names raises if they are not valid text
            self.inputs = [_port(each, path) for each in session.get_inputs()]
            self.outputs = [_port(each, path) for each in session.get_outputs()]
            entries = dict(session.get_modelmeta().custom_metadata_map)
        except BlockError:
            raise
        except Exception as error:  # its errors have no common base of their own
            raise BlockError(
                _(
                    "{name}: expected a network that onnxruntime can run, got: {told}",
                    name=path.name,
                    told=_told(error),
                )
            ) from None
        self._session = session
        self._run_options = onnxruntime.RunOptions()
        self._names = [port.name for port in self.outputs]
        self._feeds = [(port.name, (1, *port.shape), port.dtype) for port in self.inputs]
        self._shapes = [(1, *port.shape) for port in self.outputs]
        self.about = _about(entries, path)
        """Description of its training; empty for a network from elsewhere."""

    @property
    def rhythm(self) -> dict[str, Any]:
        """The brain's parameters in its training; empty for a network from elsewhere."""
        return {name: self.about[name] for name in RHYTHM if name in self.about}

    def stop(self) -> None:
        """End a decision that takes too long, from another thread; it and later ones fail."""
        self._run_options.terminate = True

    def decide(self, percept: Mapping[str, Any]) -> dict[str, npt.NDArray[Any]]:
        """Return the network's outputs by name, for one percept.

        Raises:
            BlockError: onnxruntime can't run it, as when it wants more memory than there is, or an
                output has another shape than the file says.
        """
        try:
            feed = {
                name: np.asarray(percept[name], dtype).reshape(shape)
                for name, shape, dtype in self._feeds
            }
            answers = self._session.run(self._names, feed, self._run_options)
        except Exception as error:  # its errors have no common base of their own
            raise BlockError(
                _(
                    "{name}: onnxruntime can't run this network: {told}; expected one that "
                    "decides within the memory of this machine",
                    name=self.path.name,
                    told=_told(error),
                )
            ) from None
        shapes = [answer.shape for answer in answers]
        if shapes != self._shapes:
            raise BlockError(
                _(
                    "{name}: expected outputs of the shapes {shapes}, as the file says, got "
                    "{shapes2}",
                    name=self.path.name,
                    shapes=str(self._shapes),
                    shapes2=str(shapes),
                )
            )
        return {name: answer[0] for name, answer in zip(self._names, answers, strict=True)}


def _bytes_of(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            data = file.read(MAX_LOADED_NETWORK_BYTES + 1)
    except OSError as error:
        raise BlockError(
            _("{path}: can't be read: {why}", path=str(path), why=str(error.strerror))
        ) from None
    if len(data) > MAX_LOADED_NETWORK_BYTES:
        raise BlockError(
            _(
                "{name}: expected at most {mb} MB",
                name=path.name,
                mb=MAX_LOADED_NETWORK_BYTES // 2**20,
            )
        )
    return data


def _told(error: Exception) -> str:
    """Return onnxruntime's reason, without its codes and the places in its own source."""
    text = " ".join(str(error).split())
    text = re.sub(r"^\[ONNXRuntimeError\] : \d+ : \w+ : ", "", text)
    if "external data" in text.lower():  # the rest of it are paths of this machine
        return _("one whose numbers lie in another file; export it as one file")
    text = re.sub(r"/\S*onnxruntime\S* (\S+ onnxruntime::\w+(::\w+)*\([^)]*\) )?", "", text)
    text = text or type(error).__name__
    return text if len(text) <= MAX_REASON_CHARS else text[: MAX_REASON_CHARS - 1] + "…"


def _port(node: Any, path: Path) -> Port:
    if node.type not in DTYPES:
        raise BlockError(
            _(
                "{name}: {name2!r} is a {type}; expected one of {names}",
                name=path.name,
                name2=node.name,
                type=node.type,
                names=", ".join(DTYPES),
            )
        )
    batch, *shape = node.shape or [None]
    if batch not in (1, None) and not isinstance(batch, str):
        raise BlockError(
            _(
                "{name}: {name2!r} takes {batch} decisions at once; expected a first axis of "
                "length 1, or of any",
                name=path.name,
                name2=node.name,
                batch=str(batch),
            )
        )
    if not all(isinstance(length, int) for length in shape):
        raise BlockError(
            _(
                "{name}: {name2!r} has an axis without a length: {shape}",
                name=path.name,
                name2=node.name,
                shape=str(node.shape),
            )
        )
    if math.prod(shape) > MAX_PORT_NUMBERS:
        raise BlockError(
            _(
                "{name}: {name2!r} has the shape {shape}; expected at most {max_port_numbers} "
                "numbers",
                name=path.name,
                name2=node.name,
                shape=str(tuple(shape)),
                max_port_numbers=MAX_PORT_NUMBERS,
            )
        )
    return Port(node.name, tuple(shape), np.dtype(DTYPES[node.type]))


def _about(entries: Mapping[str, str], path: Path) -> dict[str, Any]:
    try:
        about = json.loads(entries.get(TRAINING_KEY, "{}"))
    except (ValueError, RecursionError):
        about = None
    if not isinstance(about, dict):
        raise BlockError(
            _(
                "{name}: its entry {training_key} is no JSON mapping",
                name=path.name,
                training_key=repr(TRAINING_KEY),
            )
        )
    return about
