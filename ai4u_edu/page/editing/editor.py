"""The editor of a running world's scene."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Future
from pathlib import Path
from typing import Any, Protocol

from ai4u_edu.base.errors import AI4UError, SetupError, shown
from ai4u_edu.blocks import Brain
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing import blocks, proposals, things
from ai4u_edu.page.editing.autosave import Autosave
from ai4u_edu.page.editing.change_result import ChangeResult, failed
from ai4u_edu.page.editing.driver_options import driver_of, driver_options, with_driver
from ai4u_edu.page.editing.drivers import Driver, DriverRegistry
from ai4u_edu.page.editing.plain import BlockPath, Plain
from ai4u_edu.page.editing.proposals import Proposal
from ai4u_edu.page.editing.reasons import reason_against_driver
from ai4u_edu.page.editing.scene_store import SceneStore
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.page.editing.transactions import Transactions
from ai4u_edu.page.editing.unsaved import Unsaved
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.runtime.tick_monitor import Stall
from ai4u_edu.scenes import Scene, SceneDescription
from ai4u_edu.scenes.yaml.file import YamlFile
from ai4u_edu.wire.class_link import Practised, TaskKind, TaskState, Training
from ai4u_edu.world import BodyDescription


class ClassTrainings(Protocol):
    """Lets networks learn in the class's process; a room there may start none. Thread-safe."""

    listeners: list[Callable[[], object]]
    """Functions called after each change, in any thread."""

    @property
    def latest(self) -> Training | None:
        """The room's latest training; None before the first one."""

    @property
    def is_connected(self) -> bool:
        """True while the class can be reached; what is asked for meanwhile is sent later."""

    def learn(self, scene: str, agent: str, drives: Sequence[str]) -> None:
        """Have a network learn from drives, as soon as it is the room's turn.

        Args:
            scene: name of the scene.
            agent: id of the agent.
            drives: names of files in the room's folder of drives.

        Raises:
            SetupError: a name is too long to be sent.
        """

    def stop(self, problem: str) -> None:
        """End the latest training without a result.

        Args:
            problem: shown as the training's until the class has answered.
        """

    def practice(self, key: str) -> Practised | None:
        """Return a practice of the room; None if it was never asked for, or long ago."""

    def practise(self, key: str, practice: str) -> None:
        """Have a network practise, as soon as it is its turn; one that the class knows goes on.

        Args:
            key: names the practice.
            practice: name of its folder in the room's folder of practices.
        """

    def stop_practice(self, key: str) -> None:
        """End a practice; it is over as soon as the class says so."""

    def task(self, key: str) -> TaskState | None:
        """Return a task of the room; None if this process of the room never asked for it."""

    def begin_task(self, key: str, kind: TaskKind) -> None:
        """Have a task done, as soon as it is its turn; one that the class knows goes on.

        Args:
            key: names the task, and its folder in the room's folder of tasks.
            kind: of the task.
        """

    def stop_task(self, key: str, problem: str) -> None:
        """End a task.

        Args:
            key: of the task.
            problem: is the task's from now on.
        """


class SceneEditor:
    """Changes a running world: its agents' blocks and brains, its bodies, or the whole scene.

    Every method that changes something may be called from any thread and returns a future at once.
    The change is made in the runner's thread between two decisions. The future's result is a
    :class:`ChangeResult` (when it takes effect), its exception a :class:`ChangeError` (what is
    wrong, field by field; nothing was changed then). Don't wait for it in the runner's thread.

    Args:
        runner: runs the world.
        scene: the scene that the world was built from.
        offers: Python files with drivers, recorded episodes and networks, folders of them, and
            addresses of AI4U scripts, from which a page may choose a driver.

    >>> scene = Scene.load("box_chase")
    >>> runner = Runner(scene.build(), seed=1)
    >>> editor = SceneEditor(runner, scene)
    >>> future = editor.add_block("0", "sensors", {"type": "BearingSensor", "target": "box"})
    >>> runner.advance()
    >>> str(future.result())
    'works from the next decision on'
    >>> "bearing" in runner.sim.agents[0].percept
    True
    """

    def __init__(self, runner: Runner, scene: Scene, *, offers: Iterable[Path | str] = ()) -> None:
        self._runner = runner
        self._drivers = DriverRegistry(offers)
        state = EditState(scene.description, scene.folder, source=scene.source)
        self._transactions = Transactions(runner, state, self._drivers)
        self._submit = self._transactions.submit
        self.recovery = Recovery(self)
        self.scene_store: SceneStore | None = None
        """Keeps scenes by name for pages; without it a page can only download them."""
        self.work_folder: Path | None = None
        """Folder for what a person makes here beside scenes; without it, that is not kept."""
        self.missions_folder: Path | None = None
        """Folder with a teacher's missions; None for none."""
        self.class_trainings: ClassTrainings | None = None
        """Lets networks learn in a class's process; without it, this process starts its own."""
        self.listeners = self._transactions.listeners
        """Functions called with the state after each change, in the runner's thread."""
        self.listeners.append(self._on_change)

    @property
    def state(self) -> EditState:
        """The wanted state; immutable, replaced with every change."""
        return self._transactions.state

    @property
    def opened(self) -> EditState:
        """The state that was opened last, before any change."""
        return self._transactions.opened

    @property
    def version(self) -> int:
        """A number that grows with every change."""
        return self._transactions.version

    @property
    def is_as_opened(self) -> bool:
        """True if the scene does not differ from the one that was opened."""
        return self.state.description == self.opened.description

    @property
    def scene(self) -> Scene:
        """The wanted state as a scene."""
        return self.state.scene

    @property
    def title(self) -> str:
        """The scene's title, or its name."""
        return self.state.title

    @property
    def stall(self) -> Stall | None:
        """The block that does not return, and so keeps changes from being made; or None."""
        return self._runner.stall

    @property
    def waits_for_reset(self) -> bool:
        """True if some change takes effect at the next reset only."""
        return self._transactions.waits_for_reset

    @property
    def is_dragging(self) -> bool:
        """True while some body is dragged."""
        return self._transactions.is_dragging

    @property
    def undo_label(self) -> str:
        """A few words about the change that undo takes back; empty if there is none."""
        return self._transactions.undo_label

    @property
    def redo_label(self) -> str:
        """A few words about the change that redo makes again; empty if there is none."""
        return self._transactions.redo_label

    def text(self) -> str:
        """Return the scene as YAML text."""
        return self.scene.dumps()

    def drivers(self, agent_id: str) -> list[Driver]:
        """Return all drivers that an agent can have."""
        offered = self._drivers.offered()
        names = {driver.name for driver in offered}
        own = [each for each in driver_options(self.state, agent_id) if each.name not in names]
        return [*own, *offered]

    def driver_of(self, agent_id: str) -> str:
        """Return the name of an agent's driver, as in :meth:`drivers`; "" for any other one."""
        return driver_of(self.state, self._runner.sim.agent(agent_id))

    def reason_against_driver(self, agent_id: str, name: str) -> str:
        """Return why a driver can't drive an agent, as a sentence; empty if it can.

        It takes a decision in a copy of the world, which takes a few milliseconds.
        """
        return reason_against_driver(self.state, agent_id, name, self._drivers)

    def offer(self, networks: Callable[[], Mapping[Path, str]]) -> None:
        """Let pages choose from networks that are made here.

        Args:
            networks: returns titles of the present scene's networks, by their files; in any thread.
        """
        self._drivers.own_networks = networks

    def driver_brain(self, agent_id: str, name: str) -> Brain:
        """Return the brain of a driver for an agent, without letting it drive.

        Args:
            agent_id: the agent.
            name: of one of :meth:`drivers`.

        Raises:
            AI4UError: there is no such driver, or its file can't be read or run.
        """
        if self._drivers.has(name):
            like = self._runner.sim.agent(agent_id).brain
            return self._drivers.brain(name, agent_id, like)
        scene = with_driver(self.state, agent_id, name, self._drivers).scene
        return scene.build().agent(agent_id).brain

    def change_block(self, agent_id: str, path: BlockPath, values: Plain) -> "Future[ChangeResult]":
        """Change parameters of a block.

        Args:
            agent_id: the agent that has the block.
            path: of the block in its agent: ``("sensors", 2)``, ``("brains", 0, "controller")``.
            values: parameters as plain data; None resets one to its default.
        """
        return self._change_block(
            agent_id,
            path,
            lambda block: _("change {block}", block=block),
            lambda a: blocks.changed(a, path, values),
        )

    def add_block(
        self, agent_id: str, kind: str | BlockPath, block: Plain, index: int | None = None
    ) -> "Future[ChangeResult]":
        """Add a block.

        Args:
            agent_id: the agent that gets it.
            kind: ``sensors``, ``actuators``, ``rewards`` or ``brains``; or a path into another
                block, such as ``("rewards", 0, "children")``.
            block: its ``type`` and parameters.
            index: its position among the blocks of its kind; by default the last one.
        """
        return self._submit(lambda: proposals.add_block(self.state, agent_id, kind, block, index))

    def remove_block(self, agent_id: str, path: BlockPath) -> "Future[ChangeResult]":
        """Remove a block."""
        return self._change_block(
            agent_id,
            path,
            lambda block: _("remove {block}", block=block),
            lambda a: blocks.removed(a, path),
        )

    def move_block(self, agent_id: str, path: BlockPath, by: int) -> "Future[ChangeResult]":
        """Move a block up (-1) or down (1) among the blocks of its kind."""
        return self._change_block(
            agent_id,
            path,
            lambda block: _("move {block}", block=block),
            lambda a: blocks.moved(a, path, by),
        )

    def switch_block(self, agent_id: str, path: BlockPath, on: bool) -> "Future[ChangeResult]":
        """Enable or disable a block; enabling a brain disables the others."""
        return self._change_block(
            agent_id,
            path,
            lambda block: (
                _("switch on {block}", block=block) if on else _("switch off {block}", block=block)
            ),
            lambda a: blocks.with_enabled(a, path, on),
        )

    def change_agent(self, agent_id: str, values: Plain) -> "Future[ChangeResult]":
        """Change parameters of an agent itself, such as ``max_steps_per_episode``.

        ``skip_frame`` and ``repeat_action`` are set on the enabled brain.
        """
        return self._submit(lambda: proposals.change_agent(self.state, agent_id, values))

    def scale_rewards(self, agent_id: str, factors: Mapping[str, float]) -> "Future[ChangeResult]":
        """Multiply what reward functions pay, as one change; those without a factor stay.

        Args:
            agent_id: the agent that gets the rewards.
            factors: by the reward function's name.
        """
        return self._submit(lambda: proposals.scale_rewards(self.state, agent_id, factors))

    def set_driver(self, agent_id: str, name: str) -> "Future[ChangeResult]":
        """Choose an agent's driver: one of :meth:`drivers`, or an ``ai4u://`` address."""
        return self._submit(
            lambda: proposals.set_driver(self.state, agent_id, name, self._drivers),
            driver_of=agent_id,
        )

    def restore_driver(self, agent_id: str) -> "Future[ChangeResult]":
        """Hand an agent back from a person, a script or another brain to the scene's driver."""
        return self._submit(lambda: Proposal(self.state, _("drive again")), driver_of=agent_id)

    def drag(
        self, name: str, x: float, y: float, heading_deg: float | None = None
    ) -> "Future[None]":
        """Move a body during a drag, which :meth:`move_body` or :meth:`cancel_drag` ends.

        Metres, degrees. Collisions are ignored, the scene does not change, and undo does not know
        of it.
        """
        return self._runner.submit(lambda: self._transactions.drag(name, x, y, heading_deg))

    def cancel_drag(self, name: str) -> "Future[None]":
        """Put a dragged body back where the drag began."""
        return self._runner.submit(lambda: self._transactions.cancel_drag(name))

    def move_body(
        self,
        name: str,
        x: float,
        y: float,
        heading_deg: float | None = None,
        *,
        is_nudge: bool = False,
    ) -> "Future[ChangeResult]":
        """Put a body, a floor or an area somewhere, now and at each reset from now on.

        A body is at rest then.

        Args:
            name: of the body, the floor or the area.
            x: metres.
            y: metres.
            heading_deg: degrees; by default the present heading.
            is_nudge: True if undo takes back the nudges of the same thing that came just before,
                too.
        """
        pose_of = self._transactions.pose

        def propose() -> Proposal:
            moved = proposals.move_body(self.state, name, x, y, heading_deg, pose_of)
            return moved._replace(merge_key=f"nudge {name}") if is_nudge else moved

        return self._submit(propose)

    def move_things(
        self, goals: Mapping[str, proposals.Goal], *, is_nudge: bool = False
    ) -> "Future[ChangeResult]":
        """Put several things somewhere, as one change.

        Args:
            goals: x, y (m) and heading (degrees; None for the present one) by name.
            is_nudge: as of :meth:`move_body`.
        """
        pose_of = self._transactions.pose

        def propose() -> Proposal:
            moved = proposals.move_things(self.state, goals, pose_of)
            return moved._replace(merge_key=f"nudge {' '.join(goals)}") if is_nudge else moved

        return self._submit(propose)

    def add_things(self, new_things: Sequence[proposals.NewThing]) -> "Future[ChangeResult]":
        """Add several things as one change; another episode begins if agents are among them."""
        return self._submit(lambda: proposals.add_things(self.state, new_things))

    def remove_things(self, names: Sequence[str]) -> "Future[ChangeResult]":
        """Remove several things as one change; the body of an agent goes with its agent."""
        return self._submit(lambda: proposals.remove_things(self.state, names))

    def add_body(self, body: BodyDescription | Mapping[str, Any]) -> "Future[ChangeResult]":
        """Add a body, from its description; :meth:`free_names` returns unused names."""
        return self._submit(lambda: proposals.add_thing(self.state, body, "bodies"))

    def add_region(
        self, region: things.Thing | Mapping[str, Any], kind: things.ThingKind
    ) -> "Future[ChangeResult]":
        """Add a floor (``floors``) or an area (``areas``) from its description."""
        return self._submit(lambda: proposals.add_thing(self.state, region, kind))

    def add_agent(self, body: Mapping[str, Any], like: str) -> "Future[ChangeResult]":
        """Add an agent with copies of another one's blocks; another episode begins.

        Args:
            body: description of its body.
            like: id of the agent whose blocks are copied.
        """
        return self._submit(lambda: proposals.add_agent(self.state, body, like))

    def remove_agent(self, agent_id: str) -> "Future[ChangeResult]":
        """Remove an agent and its body; another episode begins. The last one stays."""
        return self._submit(lambda: proposals.remove_agent(self.state, agent_id))

    def remove_body(self, name: str) -> "Future[ChangeResult]":
        """Remove a body, a floor or an area; refused if an agent or a block needs it."""
        return self._submit(lambda: proposals.remove_thing(self.state, name))

    def change_body(self, name: str, values: Mapping[str, Any]) -> "Future[ChangeResult]":
        """Change parameters of a body, a floor or an area, those of its description."""
        return self._submit(lambda: proposals.change_thing(self.state, name, values))

    def resize(
        self, name: str, shape: Mapping[str, Any], place: tuple[float, float] | None
    ) -> "Future[ChangeResult]":
        """Give a body, a floor or an area another shape, and its centre another place (m).

        Args:
            name: of the thing.
            shape: its shape, as in a scene file.
            place: x and y (m), now and at each reset from now on; None for its present one.
        """
        pose_of = self._transactions.pose
        return self._submit(lambda: proposals.resize_thing(self.state, name, shape, place, pose_of))

    def free_names(self, likes: Iterable[str]) -> list[str]:
        """Return a name that nothing has for each of several new things."""
        return things.free_names(self.state, likes)

    def change_scene(self, values: Mapping[str, Any]) -> "Future[ChangeResult]":
        """Change entries of the scene file: ``title``, ``goal``, ``world``, ``floors``..."""
        return self._submit(lambda: proposals.change_scene(self.state, values))

    def change_settings(self, values: Plain) -> "Future[ChangeResult]":
        """Change the scene's ``title`` or ``goal``, or settings of its world such as ``gravity``.

        Texts apply at once, settings of the world at the next reset.
        """
        return self._submit(lambda: proposals.change_settings(self.state, values))

    def change_field(self, values: Plain) -> "Future[ChangeResult]":
        """Change the field that is generated at each start; ``type`` is its kind, None for none."""
        return self._submit(lambda: proposals.change_field(self.state, values))

    def open(self, scene: Scene) -> "Future[ChangeResult]":
        """Run another scene in place of this one; undo brings this one back."""
        state = EditState(scene.description, scene.folder, source=scene.source)
        proposal = Proposal(state, _("open {scene}", scene=scene.description.name))
        return self._submit(lambda: proposal, whole=True)

    def load(self, text: object, name: str = "scene.yaml") -> "Future[ChangeResult]":
        """Run a scene that somebody wrote: YAML text, which is read and checked, never executed.

        It is read in the caller's thread. The file's errors come with their lines.
        """
        try:
            return self.open(self.read(text, name))
        except AI4UError as error:
            return failed(error)

    def read(self, text: object, name: str = "scene.yaml") -> Scene:
        """Read a scene that somebody wrote, as :meth:`load` does, without running it.

        Raises:
            AI4UError: it can't be used here.
        """
        if not isinstance(text, str):
            raise SetupError(_("expected a scene as text (YAML), got {value}", value=shown(text)))
        agents = YamlFile(text, name).data.get("agents", ())
        self._transactions.permissions.check(agents)
        return Scene.loads(text, name=name, folder=self.state.folder)

    def undo(self) -> "Future[ChangeResult]":
        """Take back the last change; the world's time goes on."""
        return self._runner.submit(self._transactions.undo)

    def redo(self) -> "Future[ChangeResult]":
        """Make the change again that was undone last."""
        return self._runner.submit(self._transactions.redo)

    def _change_block(
        self,
        agent_id: str,
        path: BlockPath,
        label: Callable[[str], str],
        change: Callable[[Plain], Plain],
    ) -> "Future[ChangeResult]":
        return self._submit(
            lambda: proposals.change_block(self.state, agent_id, path, label, change)
        )

    def _on_change(self, state: EditState) -> None:
        self.recovery.on_change(state)


class Recovery:
    """Autosaves an editor's scene, and offers a scene that an earlier server left unsaved.

    Any thread may call its methods.

    Args:
        editor: opens the scene that is restored.
    """

    def __init__(self, editor: SceneEditor) -> None:
        self._editor = editor
        self.unsaved: Unsaved | None = None
        """An unsaved scene to offer; it was left by a server that was killed."""
        self.autosave: Autosave | None = None
        """Writes changes to a file; None in notebooks and tests."""
        self._restored: Unsaved | None = None
        self._saved: SceneDescription | None = None
        """The scene as it was saved last."""

    @property
    def has_unsaved_changes(self) -> bool:
        """True if the scene differs from the one that was opened and from the one last saved."""
        return not self._editor.is_as_opened and not self._is_as_saved

    @property
    def _is_as_saved(self) -> bool:
        return self._editor.state.description == self._saved

    def restore(self) -> "Future[ChangeResult]":
        """Open the unsaved scene that is offered."""
        unsaved, self.unsaved = self.unsaved, None
        if unsaved is None:
            return failed(SetupError(_("there is no unsaved scene")))
        try:
            scene = unsaved.scene()
        except AI4UError as error:
            return failed(error)
        future = self._editor.open(scene)

        def finish(done: "Future[ChangeResult]") -> None:
            if done.cancelled() or done.exception() is not None:
                self.unsaved = self.unsaved or unsaved
            else:
                self.mark_restored(unsaved)

        future.add_done_callback(finish)
        return future

    def mark_restored(self, unsaved: Unsaved) -> None:
        """Treat the scene that was opened last as this unsaved one, so that its file is kept."""
        if self.autosave is None:
            self._restored = unsaved
        else:
            self.autosave.claim(unsaved, self._editor.opened)

    def mark_saved(self, scene: Scene) -> None:
        """Drop the autosaved file, since somebody saved the scene; offer no other one any more."""
        self.unsaved, self._saved = None, scene.description
        if self._restored is not None:
            self._restored.discard()
            self._restored = None
        if self.autosave is not None:
            self.autosave.forget(self._editor.opened)

    def discard(self) -> None:
        """Delete the unsaved scene that is offered; the running scene's autosave stays."""
        unsaved, self.unsaved = self.unsaved, None
        if unsaved is not None:
            unsaved.discard()

    def on_change(self, state: EditState) -> None:
        """Schedule an autosave; a scene that was not changed since it was opened needs none."""
        if self.autosave is None:
            return
        if self.has_unsaved_changes:
            self.autosave.schedule(state, self._editor.opened)
        elif self._editor.redo_label or self._is_as_saved:  # every change was undone
            self.autosave.schedule(None, self._editor.opened)
