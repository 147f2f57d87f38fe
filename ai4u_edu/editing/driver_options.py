"""Who is to drive, as a page or a command line names it."""

import re
from collections.abc import Mapping
from typing import Any

from ai4u_edu.base.parameters import Problem
from ai4u_edu.blocks import Block, Brain, LocalBrain, NeuralNetController
from ai4u_edu.blocks.brains.address import brain_at
from ai4u_edu.blocks.brains.network import IN_THE_ZOO, files_in
from ai4u_edu.editing.blocks import Plain, types_of
from ai4u_edu.editing.drivers import NETWORK, REMOTE, Driver, DriverRegistry
from ai4u_edu.editing.errors import ChangeError
from ai4u_edu.editing.state import EditState
from ai4u_edu.scenes.serialization import to_plain
from ai4u_edu.zoo import names as in_the_zoo

KEYS, OWN = "keys:", "brain:"

CODE = re.compile("Key[A-Z]$|Arrow|Space|Digit")
"""What a key is called, by where it is on the keyboard."""

KINDS = (
    "expected brain:NUMBER (one that the agent has), keys:CONTROLLER, network:FILE.onnx or "
    "network:zoo:SCENE, ai4u://127.0.0.1:PORT, script:FILE.py:NAME or recording:NAME"
)


TO_OFFER = (
    "networks are offered that lie beside the scene's file, or that were named when the world was "
    "started (--offer FILE.onnx or FOLDER)"
)


def driven_by(state: EditState, agent_id: str, name: str, drivers: DriverRegistry) -> EditState:
    """With somebody else who drives an agent.

    Args:
        state: what is.
        agent_id: whom.
        name: who; see :data:`KINDS`.
        drivers: those who are in no scene, as the world's owner offered them.

    Raises:
        AI4UError: there is nobody of that name.
    """
    agent = state.agent(agent_id)
    if drivers.has(name):
        return state.driven(agent_id, name)
    brains = list(agent.get("brains", ()))
    if name.startswith(OWN) and name.removeprefix(OWN).isdecimal():
        index = int(name.removeprefix(OWN))
        if index >= len(brains):
            raise ChangeError([Problem((), f"agent {agent_id!r} has {len(brains)} brains")])
        return _only(state.driven(agent_id, ""), agent_id, brains, index)
    wanted = _plain_brain(state, name, _rhythm(brains))
    same = [{**each, "enabled": None} == {**wanted, "enabled": None} for each in brains]
    if not any(same):
        brains.append(wanted)
        same.append(True)
    return _only(state.driven(agent_id, ""), agent_id, brains, same.index(True))


def offered(state: EditState, agent_id: str) -> list[Driver]:
    """Who may drive an agent: its brains, keyboards, controllers and networks that come with us."""
    agent = state.agent(agent_id)
    brains = [
        Driver(f"{OWN}{index}", title_of(brain)) for index, brain in enumerate(agent["brains"])
    ]
    has = {driver.title for driver in brains}
    keys = [
        Driver(f"{KEYS}{cls.__name__}", _controller(cls))
        for cls in sorted(types_of("controller"), key=lambda cls: not _has_keys(cls))
        if not _needs_something(cls) and _controller(cls) not in has
    ]
    networks = [
        Driver(f"{NETWORK}zoo:{scene}", f"Network zoo:{scene}")
        for scene in in_the_zoo()
        if scene == state.description.name
    ]
    networks += [Driver(f"{NETWORK}{name}", f"Network {name}") for name in _beside(state)]
    remote = [Driver(f"{REMOTE}127.0.0.1:8080", "AI4U script at 127.0.0.1:8080")]
    return [*brains, *keys, *(n for n in networks if n.title not in has), *remote]


def _beside(state: EditState) -> list[str]:
    """The networks that lie beside the scene's file."""
    return [] if state.folder is None else sorted(path.name for path in state.folder.glob("*.onnx"))


def title_of(brain: Plain) -> str:
    """What a person calls a brain that is given as data."""
    controller = brain.get("controller")
    if isinstance(controller, Mapping):
        path = controller.get("model_path")
        return f"Network {path}" if path else _controller(Block.types[str(controller["type"])])
    if brain["type"] == "RemoteBrain":
        port = brain.get("port", 8080)
        return f"AI4U script at {brain.get('host', '127.0.0.1')}:{port}"
    return str(brain["type"])


def _plain_brain(state: EditState, name: str, rhythm: dict[str, Any]) -> Plain:
    if name.startswith(REMOTE):
        return _plain(brain_at(name).changed(**rhythm))
    if name.startswith(NETWORK):
        path = name.removeprefix(NETWORK)
        if not path.startswith(IN_THE_ZOO) and path not in _beside(state):
            raise ChangeError([Problem((), f"no network {path!r} is offered here; {TO_OFFER}")])
        with files_in(state.folder):
            network = NeuralNetController(model_path=path)
        return _plain(LocalBrain(controller=network, **{**rhythm, **network.network.rhythm}))
    known = {cls.__name__: cls for cls in types_of("controller")}
    cls = known.get(name.removeprefix(KEYS))
    if not name.startswith(KEYS) or cls is None:
        raise ChangeError([Problem((), f"nobody is called {name!r}; {KINDS}")])
    return {"type": "LocalBrain", "controller": {"type": cls.__name__}} | {
        name: value for name, value in rhythm.items() if value != _default(name)
    }


def _only(state: EditState, agent_id: str, brains: list[Plain], index: int) -> EditState:
    switched = [
        {k: v for k, v in brain.items() if k != "enabled"}
        | ({} if number == index else {"enabled": False})
        for number, brain in enumerate(brains)
    ]
    return state.with_agent(agent_id, {**state.agent(agent_id), "brains": switched})


def _rhythm(brains: list[Plain]) -> dict[str, Any]:
    """How often the brain that is on decides."""
    on = next((brain for brain in brains if brain.get("enabled", True)), {})
    return {name: on.get(name, _default(name)) for name in ("skip_frame", "repeat_action")}


def _default(name: str) -> Any:
    return Brain.parameters()[name].get_default()


def _controller(cls: type[Block]) -> str:
    return f"{'Keyboard' if _has_keys(cls) else 'Program'}: {cls.__name__}"


def _has_keys(cls: type[Block]) -> bool:
    """Whether a controller listens to keys: some parameter names codes of keys by default."""
    defaults = [f.get_default(call_default_factory=True) for f in cls.parameters().values()]
    lists = [each for each in defaults if isinstance(each, list) and each]
    return any(isinstance(each[0], str) and CODE.match(each[0]) for each in lists)


def _needs_something(cls: type[Block]) -> bool:
    """Return True if a controller can't drive by itself: a parameter is missing, or a script."""
    needed = any(field.is_required() for field in cls.parameters().values())
    return needed or getattr(cls, "needs_script", False)


def _plain(brain: Brain) -> Plain:
    plain: Plain = to_plain(brain)
    return plain
