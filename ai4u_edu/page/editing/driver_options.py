"""Drivers that a scene itself offers, and the choice of a driver by its name."""

from collections.abc import Mapping
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.parameters import ParameterProblem, default_of
from ai4u_edu.blocks import Block, Brain, LocalBrain, NeuralNetController
from ai4u_edu.blocks.brains.address import brain_at
from ai4u_edu.blocks.brains.controllers.key_defaults import listens_to_keys
from ai4u_edu.blocks.brains.network import ZOO_PREFIX, files_in
from ai4u_edu.blocks.brains.zoo import names as in_the_zoo
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext
from ai4u_edu.page.editing.blocks import types_of, with_enabled
from ai4u_edu.page.editing.drivers import NETWORK, REMOTE, Driver, DriverRegistry
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.plain import Plain
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.scenes.serialization import to_plain

KEYS, OWN_BRAIN = "keys:", "brain:"

KINDS = _(
    "expected brain:NUMBER (one that the agent has), keys:CONTROLLER, network:FILE.onnx or "
    "network:zoo:SCENE, ai4u://127.0.0.1:PORT, script:FILE.py:NAME or recording:NAME"
)


TO_OFFER = _(
    "networks are offered that lie beside the scene's file, or that were named when the world was "
    "started (--offer FILE.onnx or FOLDER)"
)


def with_driver(state: EditState, agent_id: str, name: str, drivers: DriverRegistry) -> EditState:
    """Change the driver of an agent.

    Args:
        state: the present state.
        agent_id: the agent.
        name: of the driver; see :data:`KINDS`.
        drivers: drivers that are in no scene.

    Raises:
        AI4UError: no driver has that name.
    """
    agent = state.agent(agent_id)
    if drivers.has(name):
        return state.driven(agent_id, name)
    brains = list(agent.get("brains", ()))
    if name.startswith(OWN_BRAIN) and name.removeprefix(OWN_BRAIN).isdecimal():
        index = int(name.removeprefix(OWN_BRAIN))
        if index >= len(brains):
            text = ngettext(
                "agent {agent!r} has {n} brain",
                "agent {agent!r} has {n} brains",
                len(brains),
                agent=agent_id,
            )
            raise ChangeError([ParameterProblem((), text)])
        return _with_enabled_brain(state.driven(agent_id, ""), agent_id, brains, index)
    wanted = _plain_brain(state, name, _rhythm(brains))
    same = [{**each, "enabled": None} == {**wanted, "enabled": None} for each in brains]
    if not any(same):
        brains.append(wanted)
        same.append(True)
    return _with_enabled_brain(state.driven(agent_id, ""), agent_id, brains, same.index(True))


def driver_options(state: EditState, agent_id: str) -> list[Driver]:
    """Return an agent's brains, and the package's controllers and networks that could drive it."""
    agent = state.agent(agent_id)
    brains = [
        Driver(f"{OWN_BRAIN}{index}", title_of(brain))
        for index, brain in enumerate(agent["brains"])
    ]
    has = {driver.title for driver in brains}
    keys = [
        Driver(f"{KEYS}{cls.__name__}", _controller_title(cls))
        for cls in sorted(types_of("controller"), key=lambda cls: not listens_to_keys(cls))
        if not _needs_something(cls) and _controller_title(cls) not in has
    ]
    networks = [
        Driver(f"{NETWORK}zoo:{scene}", _("Network {name}", name=f"zoo:{scene}"))
        for scene in in_the_zoo()
        if scene == state.description.name
    ]
    networks += [
        Driver(f"{NETWORK}{name}", _("Network {name}", name=name))
        for name in _networks_in_folder(state)
    ]
    address = "127.0.0.1:8080"
    remote = [Driver(f"{REMOTE}{address}", _("AI4U script at {address}", address=address))]
    return [*brains, *keys, *(n for n in networks if n.title not in has), *remote]


def _networks_in_folder(state: EditState) -> list[str]:
    """Return the names of network files in the scene's folder."""
    return [] if state.folder is None else sorted(path.name for path in state.folder.glob("*.onnx"))


def driver_of(state: EditState, agent: BasicAgent) -> str:
    """Return the name of an agent's enabled driver; "" for one that has no name."""
    brains = range(len(state.agent(agent.id)["brains"]))
    names = [f"{OWN_BRAIN}{index}" for index in brains]
    names += [state.drivers[agent.id]] if agent.id in state.drivers else []
    driving = [name for name, brain in zip(names, agent.brains, strict=False) if brain.enabled]
    return driving[0] if driving else ""


def title_of(brain: Plain) -> str:
    """Return the title of a brain that is given as plain data."""
    controller = brain.get("controller")
    if isinstance(controller, Mapping):
        path = controller.get("model_path")
        return (
            _("Network {name}", name=str(path))
            if path
            else _controller_title(Block.types[str(controller["type"])])
        )
    if brain["type"] == "RemoteBrain":
        port = brain.get("port", 8080)
        address = f"{brain.get('host', '127.0.0.1')}:{port}"
        return _("AI4U script at {address}", address=address)
    return str(brain["type"])


def _plain_brain(state: EditState, name: str, rhythm: dict[str, Any]) -> Plain:
    if name.startswith(REMOTE):
        return _plain(brain_at(name, **rhythm))
    if name.startswith(NETWORK):
        path = name.removeprefix(NETWORK)
        if not path.startswith(ZOO_PREFIX) and path not in _networks_in_folder(state):
            text = _("no network {path!r} is offered here; {hint}", path=path, hint=TO_OFFER)
            raise ChangeError([ParameterProblem((), text)])
        with files_in(state.folder):
            network = NeuralNetController(model_path=path)
        return _plain(LocalBrain(controller=network, **{**rhythm, **network.network.rhythm}))
    known = {cls.__name__: cls for cls in types_of("controller")}
    cls = known.get(name.removeprefix(KEYS))
    if not name.startswith(KEYS) or cls is None:
        text = _("nobody is called {name!r}; {hint}", name=name, hint=KINDS)
        raise ChangeError([ParameterProblem((), text)])
    return {"type": "LocalBrain", "controller": {"type": cls.__name__}} | {
        name: value for name, value in rhythm.items() if value != _default(name)
    }


def _with_enabled_brain(
    state: EditState, agent_id: str, brains: list[Plain], index: int
) -> EditState:
    agent = {**state.agent(agent_id), "brains": brains}
    return state.with_agent(agent_id, with_enabled(agent, ("brains", index), True))


def _rhythm(brains: list[Plain]) -> dict[str, Any]:
    """Return ``skip_frame`` and ``repeat_action`` of the enabled brain."""
    on = next((brain for brain in brains if brain.get("enabled", True)), {})
    return {name: on.get(name, _default(name)) for name in ("skip_frame", "repeat_action")}


def _default(name: str) -> Any:
    return default_of(Brain.parameters()[name])


def _controller_title(cls: type[Block]) -> str:
    if listens_to_keys(cls):
        return _("Keyboard: {controller}", controller=cls.__name__)
    return _("Program: {controller}", controller=cls.__name__)


def _needs_something(cls: type[Block]) -> bool:
    """Return True if a controller needs a parameter without a default, or a script."""
    needed = any(field.is_required() for field in cls.parameters().values())
    return needed or getattr(cls, "needs_script", False)


def _plain(brain: Brain) -> Plain:
    plain: Plain = to_plain(brain)
    return plain
