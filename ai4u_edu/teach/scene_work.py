"""Drives and networks of the present scene, and which of its agents can be taught."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from gymnasium import spaces

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.options import SMALL_TRAINER, load_option
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.state import reward_names
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.teach import messages as m
from ai4u_edu.teach.drives import Drive, DriveFolder, persons_decisions
from ai4u_edu.teach.networks import KeptNetwork, NetworkFolder

NO_SENSOR = _("It senses nothing that a network could learn from. Add a sensor in Build.")
NO_ACTUATOR = _("It has no actuator that a network could use. Add one in Build.")


@dataclass(frozen=True)
class SceneWork:
    """Drives and networks of one scene; replaced with every change."""

    version: int = 0
    problems: Mapping[str, str] = field(default_factory=dict)
    """Sentence about why an agent can't be taught, by its id; empty if it can."""
    drives: Mapping[str, tuple[m.TaughtDrive, ...]] = field(default_factory=dict)
    """Drives by the agent, the latest first."""
    rewards: Mapping[str, Sequence[str]] = field(default_factory=dict)
    """Names of an agent's reward terms, by its id."""
    opponents: Mapping[str, Sequence[m.Opponent]] = field(default_factory=dict)
    """Possible opponents of an agent in a practice, by its id."""
    networks: tuple[KeptNetwork, ...] = ()
    """The latest first."""
    scene_name: str = ""
    scene_text: str = ""
    warning: str = ""

    def looked_at(
        self, editor: SceneEditor, drives: DriveFolder, networks: NetworkFolder
    ) -> "SceneWork":
        """Return the same for the editor's present scene, with a new version.

        Args:
            editor: has the scene.
            drives: of all scenes.
            networks: of all scenes.
        """
        scene = editor.scene
        sim = scene.build()
        sim.reset(0)
        described = export_scene(sim, scene.description)
        name = scene.description.name
        kept = list(reversed(drives.drives(name)))
        kinds_of_opponents = load_option(SMALL_TRAINER, "teaching").kinds_of_opponents
        return SceneWork(
            version=self.version + 1,
            problems={agent.id: reason_against_teaching(agent) for agent in sim.agents},
            drives={agent.id: tuple(_shown(kept, agent, described)) for agent in sim.agents},
            rewards={agent.id: reward_names(editor.state.agent(agent.id)) for agent in sim.agents},
            opponents=kinds_of_opponents(scene, sim),
            networks=tuple(reversed(networks.networks(name))),
            scene_name=name,
            scene_text=scene.dumps(),
            warning=self.warning,
        )


def reason_against_teaching(agent: BasicAgent) -> str:
    """Return why no network can learn to drive an agent, as sentences; empty if one can.

    Args:
        agent: in a world.
    """
    blocks = agent.bound_blocks
    sensors = [sensor for sensor in blocks.sensors if sensor.is_input]
    outputs = {name: each.space() for name, each in blocks.actuators.items() if each.is_output}
    if not sensors:
        return NO_SENSOR
    for sensor in sensors:
        if not isinstance(sensor.observation_space(), spaces.Box | spaces.Discrete):
            return _(
                "Its sensor {name} reads text, and a network learns from numbers here. Switch it "
                "off in Build.",
                name=sensor.perception_key,
            )
    if not outputs:
        return NO_ACTUATOR
    if len(outputs) > 1:
        *first, last = sorted(outputs)
        return _(
            "It acts by {names} and {last}, and a network learns one actuator here. Switch the "
            "others off in Build.",
            names=", ".join(first),
            last=last,
        )
    ((name, space),) = outputs.items()
    if isinstance(space, spaces.Discrete) or (isinstance(space, spaces.Box) and space.is_bounded()):
        return ""
    return _(
        "The numbers of its actuator {name} have no range, so there is nothing to aim at.",
        name=name,
    )


def _shown(
    drives: list[Drive], agent: BasicAgent, scene: SceneDescription
) -> Iterator[m.TaughtDrive]:
    for drive in drives:
        record = drive.record(agent.id)
        if record is not None:
            yield m.TaughtDrive(
                number=drive.number,
                result=None if (goal := scene.success) is None else record.reached(goal),
                seconds=round(drive.episode.seconds, 1),
                decisions=persons_decisions(record),
                share=round(persons_decisions(record) / len(record), 3),
                reason=drive.reason_against(agent, scene),
            )
