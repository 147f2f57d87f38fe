"""Reasons why a block or a driver can't work in a scene, found by trying it in a copy."""

import re

from ai4u_edu.base.errors import ActionError, AI4UError, text_of
from ai4u_edu.locale import Text, sentence
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.driver_options import KEYS, OWN_BRAIN, with_driver
from ai4u_edu.page.editing.drivers import NETWORK, DriverRegistry
from ai4u_edu.page.editing.dry_run import IdleBrain, dry_run
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.proposals import add_block
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.page.editing.suggestion import suggest_block
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.serialization import PlainDataError

_BY_FIELD = {
    "area": _("It needs an area. Add one in the World tab first."),
    **dict.fromkeys(
        ("target", "thing", "targets", "reference"),
        _("It needs something to refer to. Add one in the World tab first."),
    ),
    "source": _('It needs the reward "Feel better" first.'),
}
"""Sentences about parameters for which a scene has no value, by the parameter's name."""
_NO_AREA, _NO_NEEDS = "no area carries", "no HomeostaticReward is called"
_LOCAL = (KEYS, OWN_BRAIN, NETWORK)
"""Beginnings of the names of drivers that can be tried without running anybody's script."""


def reason_against_block(state: EditState, agent_id: str, kind: str, type_name: str) -> str:
    """Return why a new block can't work in a scene, as a sentence; empty if it can.

    Args:
        state: has the scene.
        agent_id: the agent that would get the block.
        kind: ``sensors``, ``actuators``, ``rewards`` or ``brains``.
        type_name: of the block, which is tried with suggested parameters.
    """
    try:
        block = suggest_block(state, agent_id, type_name)
        proposal = add_block(state, agent_id, kind, block, None)
        dry_run(proposal.state, proposal.path)
    except AI4UError as error:
        return _sentence(error)
    except Exception as error:  # a block of a student's may raise anything
        return _own_fault(error)
    return ""


def reason_against_driver(
    state: EditState, agent_id: str, name: str, drivers: DriverRegistry
) -> str:
    """Return why a driver can't drive an agent, as a sentence; empty if it can or is not tried.

    Scripts and recordings are not tried, because that would run them.

    Args:
        state: has the scene.
        agent_id: the agent.
        name: of the driver, as in :meth:`SceneEditor.drivers`.
        drivers: drivers that are in no scene.
    """
    if not name.startswith(_LOCAL) or drivers.has(name):
        return ""
    try:
        _decide_once(with_driver(state, agent_id, name, drivers), agent_id)
    except AI4UError as error:
        return _sentence(error)
    except Exception as error:  # a controller of a student's may raise anything
        return _own_fault(error)
    return ""


def _decide_once(state: EditState, agent_id: str) -> None:
    """Build a state's world and let one agent's brain take a decision; the others stay idle."""
    tried = agent_id if _is_local(state, agent_id) else None
    scene = Scene(state.description, state.folder)
    sim = scene.build(brains=lambda agent: None if agent.id == tried else IdleBrain())
    sim.reset(0)
    sim.tick()


def _is_local(state: EditState, agent_id: str) -> bool:
    """Return True if an agent's enabled brain opens no socket."""
    brains = state.agent(agent_id)["brains"]
    return all(each["type"] == "LocalBrain" for each in brains if each.get("enabled", True))


def _own_fault(error: Exception) -> str:
    """Return an error of a block's own code as a sentence."""
    fault = f"{type(error).__name__}: {error!s:.200}"
    return _("Its code raised {error}.", error=fault)


def _sentence(error: AI4UError) -> str:
    """Return an error as a short sentence for people who don't know parameters' names."""
    text = text_of(error)
    if isinstance(error, ActionError):
        return _("Its actions don't fit this agent's actuators.")
    if missing := re.search(r"no sensor has the (?:perception_)?key '([^']*)'", text):
        return _("It needs a sensor with the name {name}.", name=missing[1])
    if "does not fit agent" in text:
        return _("It was trained with other sensors or actuators.")
    if isinstance(error, ChangeError | PlainDataError) and error.problems:
        problem = error.problems[0]
        field = str(problem.path[-1]) if problem.path else ""
        if _NO_AREA in text or _NO_NEEDS in text or problem.text.startswith("is missing"):
            known = {_NO_AREA: "area", _NO_NEEDS: "source"}
            field = next((name for part, name in known.items() if part in text), field)
            return _BY_FIELD.get(field, _("It needs a value for {name}.", name=field))
        text = problem.text
    return sentence(_without_place(text))


def _without_place(text: str) -> str:
    """Return a problem without the place before it, such as "agent '0', sensor 'eyes': "."""
    if not isinstance(text, Text):
        return text.removeprefix("agent ").partition(": ")[2] or text
    named = re.fullmatch(r".*\{\w+\}: \{(\w+)\}", text.msgid)
    place = text.values.get(named[1]) if named else None
    return place if isinstance(place, str) else text
