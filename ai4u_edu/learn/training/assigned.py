"""Assignment of the command line's drivers (``--brain``) to a scene's agents."""

import re
from collections.abc import Sequence
from pathlib import Path

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import NameNotFoundError, SetupError, suggest
from ai4u_edu.learn.training.policies import Entrant, entrant, expect_here
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

_ID = re.compile(r"[\w .:\-]+")


def with_drivers(
    scene: Scene, specs: Sequence[str], *, is_served: bool = False, receive_timeout: int = 2000
) -> tuple[ControlRequestor, Scene]:
    """Build a scene in which the drivers that were named drive.

    Args:
        scene: stays as it is.
        specs: who drives, for :func:`~ai4u_edu.learn.training.policies.entrant`; ``ID=...`` for
            another agent than the first.
        is_served: True if pages and scripts reach the world. Then an AI4U script may drive, and
            with several agents each driver has to be given to one by its id.
        receive_timeout: milliseconds for which the world waits for an AI4U script whose address
            names no ``receive_timeout``.

    Returns:
        The world with its agents, and the scene as the drivers are used to observe it.

    Raises:
        AI4UError: there is no such agent, or no such driver.
    """
    ids = [agent.id for agent in scene.build().agents]
    entrants: dict[str, Entrant] = {}
    for spec in specs:
        agent_id, who = agent_and_driver(spec, ids)
        if not agent_id and is_served and len(ids) > 1:
            raise SetupError(
                _(
                    "--brain {spec}: the scene has several agents ({ids}); name one, as in "
                    "--brain {ids2}={spec}",
                    spec=spec,
                    ids=", ".join(ids),
                    ids2=ids[0],
                )
            )
        agent_id = agent_id or ids[0]
        if agent_id in entrants:
            raise SetupError(
                _(
                    "--brain {spec}: agent {agent_id!r} is driven by {name} already; expected "
                    "one driver for each agent",
                    spec=spec,
                    agent_id=agent_id,
                    name=entrants[agent_id].name,
                )
            )
        found = entrant(who, scene.description.name, receive_timeout=receive_timeout)
        entrants[agent_id] = found if is_served else expect_here(found)
    for each in entrants.values():
        scene = each.fitted(scene)
    sim = scene.build()
    for agent_id, each in entrants.items():
        driven = sim.agent(agent_id)
        driven.use_brain(each.brain(driven))
    return sim, scene


def agent_and_driver(spec: str, ids: Sequence[str]) -> tuple[str, str]:
    """Split ``ID=DRIVER``; the id is empty if none is named.

    Raises:
        NameNotFoundError: no agent has that id.

    >>> agent_and_driver("0=zoo:box_chase", ["0"])
    ('0', 'zoo:box_chase')
    >>> agent_and_driver("ai4u://127.0.0.1:8080?mode=realtime", ["0"])
    ('', 'ai4u://127.0.0.1:8080?mode=realtime')
    """
    agent_id, equals, who = spec.partition("=")
    if not equals or (agent_id not in ids and _is_no_id(agent_id, spec)):
        return "", spec
    if agent_id not in ids:
        raise NameNotFoundError(
            _(
                "no agent has the id {agent_id!r}; {hint}",
                agent_id=agent_id,
                hint=suggest(agent_id, ids),
            )
        )
    return agent_id, who


def _is_no_id(text: str, spec: str) -> bool:
    """Return True for what comes before an equals sign in an address or a path."""
    return not _ID.fullmatch(text) or Path(spec).exists()
