"""What a person changes in a running world, and takes back."""

import math
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any

from ai4u_edu.base.errors import AI4UError, SetupError, shown
from ai4u_edu.editing import blocks, bodies, settings
from ai4u_edu.editing import driver_options as choice
from ai4u_edu.editing.autosave import Autosave, Unsaved
from ai4u_edu.editing.blocks import BlockPath, Plain
from ai4u_edu.editing.change_result import ChangeResult, failed
from ai4u_edu.editing.drivers import Driver, DriverRegistry
from ai4u_edu.editing.scene_store import SceneStore
from ai4u_edu.editing.state import EditState
from ai4u_edu.editing.transactions import Bench, Made
from ai4u_edu.editing.typed import check_name, check_plain
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.runtime.stall_monitor import Stall
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.yaml.file import YamlFile, write_yaml
from ai4u_edu.world import BodyDescription, Pose


class SceneEditor:
    """What a person changes in a running world: its agents' blocks, brains, bodies, the scene.

    Every method that changes something may be called from any thread and returns a future at once.
    The change is made in the runner's thread between two decisions. The future's result is a
    :class:`ChangeResult` (when it takes effect), its exception a :class:`ChangeError` (what is
    wrong, field by field; nothing was changed then). Don't wait for it in the runner's thread.

    Args:
        runner: whose world is changed.
        scene: what that world was built from.
        offers: Python files with drivers, recorded episodes and networks, folders of them, and
            addresses of AI4U scripts, from which a page may choose who drives.

    >>> scene = Scene.load("box_chase")
    >>> runner = Runner(scene.build(), seed=1)
    >>> editor = SceneEditor(runner, scene)
    >>> future = editor.add_block("0", "sensors", {"type": "BearingSensor", "target": "box"})
    >>> runner.advance()
    >>> str(future.result())
    'it applies at the next decision'
    >>> "bearing" in runner.sim.agents[0].percept
    True
    """

    def __init__(
        self,
        runner: Runner,
        scene: Scene,
        *,
        offers: Iterable[FilePath | str] = (),
    ) -> None:
        self._runner = runner
        self._drivers = DriverRegistry(offers)
        state = EditState(scene.description, scene.folder, source=scene.source)
        self._bench = Bench(runner, state, self._drivers)
        self._do = self._bench.do
        self.unsaved: Unsaved | None = None
        """A scene that was left by a server that was killed, to be offered."""
        self.autosave: Autosave | None = None
        """Keeps what is changed; left out in notebooks and tests."""
        self.scene_store: SceneStore | None = None
        """Where pages keep scenes by name; none, and they can only take them home."""
        self._brought: Unsaved | None = None
        self.listeners = self._bench.listeners
        """Called with the state after each change, in the runner's thread: to be quick."""
        self.listeners.append(self._keep)

    # -- what can be asked, from any thread ------------------------------------------------------

    @property
    def state(self) -> EditState:
        """What is wanted; replaced with every change, never changed itself."""
        return self._bench.state

    @property
    def version(self) -> int:
        """Grows with every change."""
        return self._bench.version

    @property
    def is_as_opened(self) -> bool:
        """Whether the scene is what it was when it was opened."""
        return self._bench.state.description == self._bench.opened.description

    @property
    def scene(self) -> Scene:
        """What is wanted, as a scene."""
        return self.state.scene

    @property
    def title(self) -> str:
        """What the scene is called."""
        return self.state.title

    @property
    def stall(self) -> Stall | None:
        """The block that does not return, and so keeps changes from being made; or None."""
        return self._runner.stall

    @property
    def waits_for_reset(self) -> bool:
        """Whether something of it comes with the next reset only."""
        return self._bench.waits_for_reset

    @property
    def undo_label(self) -> str:
        """What would be taken back, in a few words; empty if there is nothing."""
        last = self._bench.history.last
        return last.label if last else ""

    @property
    def redo_label(self) -> str:
        """What would be done again, in a few words; empty if there is nothing."""
        step = self._bench.history.next
        return step.label if step else ""

    def text(self) -> str:
        """The scene as a file: YAML."""
        return self.scene.dumps()

    def drivers(self, agent_id: str) -> list[Driver]:
        """All who may drive an agent."""
        offered = self._drivers.offered()
        named = {driver.name for driver in offered}
        own = [each for each in choice.offered(self.state, agent_id) if each.name not in named]
        return [*own, *offered]

    def driver_of(self, agent_id: str) -> str:
        """The name of who drives an agent, as :meth:`drivers` has it; "" for somebody else."""
        state, agent = self.state, self._runner.sim.agent(agent_id)
        known = [f"{choice.OWN}{index}" for index in range(len(state.agent(agent_id)["brains"]))]
        known += [state.drivers[agent_id]] if agent_id in state.drivers else []
        driving = [name for name, brain in zip(known, agent.brains, strict=False) if brain.enabled]
        return driving[0] if driving else ""

    # -- blocks ----------------------------------------------------------------------------------

    def change_block(self, agent_id: str, path: BlockPath, values: Plain) -> "Future[ChangeResult]":
        """Gives a block other parameters.

        Args:
            agent_id: whose block.
            path: of the block in its agent: ``("sensors", 2)``, ``("brains", 0, "controller")``.
            values: parameters as plain data; None for one that is to be as by default.
        """
        return self._of_agent(agent_id, path, "change", lambda a: blocks.changed(a, path, values))

    def add_block(
        self, agent_id: str, kind: str | BlockPath, block: Plain, index: int | None = None
    ) -> "Future[ChangeResult]":
        """Adds a block.

        Args:
            agent_id: to whom.
            kind: ``sensors``, ``actuators``, ``rewards`` or ``brains``; or where in another block,
                as in ``("rewards", 0, "children")``.
            block: its ``type`` and parameters.
            index: before which of its like; left out, it is the last one.
        """

        def make() -> Made:
            where = (kind,) if isinstance(kind, str) else kind
            agent, path = blocks.added(self.state.agent(agent_id), where, block, index)
            if where == ("brains",) and len(agent["brains"]) > 1 and block.get("enabled", True):
                agent = blocks.switched(agent, path, True)
            state = self.state.with_agent(agent_id, agent)
            return state, f"add {block['type']}", self._where(agent_id, path)

        return self._do(make)

    def remove_block(self, agent_id: str, path: BlockPath) -> "Future[ChangeResult]":
        """Takes a block away."""
        return self._of_agent(agent_id, path, "remove", lambda a: blocks.removed(a, path))

    def move_block(self, agent_id: str, path: BlockPath, by: int) -> "Future[ChangeResult]":
        """Moves a block up (-1) or down (1) among its like."""
        return self._of_agent(agent_id, path, "move", lambda a: blocks.moved(a, path, by))

    def switch_block(self, agent_id: str, path: BlockPath, on: bool) -> "Future[ChangeResult]":
        """Switches a block on or off; to switch a brain on switches the others off."""
        word = "switch on" if on else "switch off"
        return self._of_agent(agent_id, path, word, lambda a: blocks.switched(a, path, on))

    def change_agent(self, agent_id: str, values: Plain) -> "Future[ChangeResult]":
        """Gives an agent other parameters of its own, such as ``max_steps_per_episode``.

        ``skip_frame`` and ``repeat_action`` are those of the brain that is on.
        """

        def make() -> Made:
            agent = settings.with_agent_settings(self.state.agent(agent_id), values)
            where = self._where(agent_id, ())
            return self.state.with_agent(agent_id, agent), f"change agent {agent_id}", where

        return self._do(make)

    # -- who drives ------------------------------------------------------------------------------

    def set_driver(self, agent_id: str, name: str) -> "Future[ChangeResult]":
        """Lets somebody else drive an agent: one of :meth:`drivers`, or an ``ai4u://`` address."""

        def make() -> Made:
            check_name(name, "the name of a driver")
            state = choice.driven_by(self.state, agent_id, name, self._drivers)
            return state, f"{agent_id}: driven by {name}", self._where(agent_id, ("brains",))

        return self._do(make, drives=agent_id)

    # -- bodies ----------------------------------------------------------------------------------

    def drag(
        self, name: str, x: float, y: float, heading_deg: float | None = None
    ) -> "Future[None]":
        """Puts a body somewhere for as long as a hand holds it; :meth:`move_body` lets go of it.

        Metres, degrees. Nothing is in its way, the scene does not know of it, and it can't be
        taken back.
        """
        return self._runner.submit(lambda: self._bench.drag(name, x, y, heading_deg))

    def cancel_drag(self, name: str) -> "Future[None]":
        """A body that was carried goes back to where it was taken up."""
        return self._runner.submit(lambda: self._bench.cancel_drag(name))

    def move_body(
        self, name: str, x: float, y: float, heading_deg: float | None = None
    ) -> "Future[ChangeResult]":
        """Puts a body somewhere, at rest, now and at each reset from now on.

        Args:
            name: of the body.
            x: metres.
            y: metres.
            heading_deg: degrees; left out: as it looks now.
        """

        def make() -> Made:
            bodies.check_place(x, y, heading_deg)
            bodies.body_named(self.state, name)
            pose = self._bench.pose(name)
            degrees = math.degrees(pose[2]) if heading_deg is None else heading_deg
            state = bodies.placed(self.state, name, x, y, degrees)
            places[name] = (x, y, math.radians(degrees))
            return state, f"move {name}", self.state.description.where_is(name)

        places: dict[str, Pose] = {}
        return self._do(make, places=places)

    def add_body(self, body: BodyDescription | Mapping[str, Any]) -> "Future[ChangeResult]":
        """Adds a body, from its description; :meth:`free_name` knows a name for it."""

        def make() -> Made:
            description = bodies.described(body)
            index = len(self.state.description.bodies)
            state = bodies.with_body(self.state, description)
            return state, f"add {description.name}", ("bodies", index)

        return self._do(make)

    def remove_body(self, name: str) -> "Future[ChangeResult]":
        """Takes a body out of the world; one that an agent has, or that a block needs, stays."""
        return self._do(lambda: (bodies.without_body(self.state, name), f"remove {name}", ()))

    def change_body(self, name: str, values: Mapping[str, Any]) -> "Future[ChangeResult]":
        """Gives a body other parameters, those of :class:`BodyDescription`."""

        def make() -> Made:
            where = self.state.description.where_is(name)
            return bodies.with_other_body(self.state, name, values), f"change {name}", where

        return self._do(make)

    def free_name(self, like: str) -> str:
        """A name that nothing in the scene has."""
        return bodies.free_name(self.state, like)

    # -- whole scenes ----------------------------------------------------------------------------

    def change_scene(self, values: Mapping[str, Any]) -> "Future[ChangeResult]":
        """Gives the scene other words or settings: ``title``, ``goal``, ``world``, ``floors``..."""

        def make() -> Made:
            check_plain(values)
            plain = {**self.scene.plain(), **values}
            scene = Scene.loads(write_yaml(plain), folder=self.state.folder)
            return replace(self.state, description=scene.description), "change the scene", ()

        return self._do(make)

    def change_settings(self, values: Plain) -> "Future[ChangeResult]":
        """Gives the scene another ``title`` or ``goal``, its world other settings: ``gravity``...

        Words apply at once; what holds for the whole world at the next reset.
        """

        def make() -> Made:
            description = settings.with_scene_settings(self.state.description, values)
            return replace(self.state, description=description), "change the scene", ()

        return self._do(make)

    def open(self, scene: Scene) -> "Future[ChangeResult]":
        """Has another scene run in place of this one; undo brings this one back."""

        def make() -> Made:
            state = EditState(scene.description, scene.folder, source=scene.source)
            return state, f"open {scene.description.name}", ()

        return self._do(make, whole=True)

    def load(self, text: object, name: str = "scene.yaml") -> "Future[ChangeResult]":
        """Run a scene that somebody wrote: YAML text, which is read and checked, never executed.

        It is read in the caller's thread. The file's errors come with their lines.
        """
        if not isinstance(text, str):
            return failed(SetupError(f"expected a scene as text (YAML), got {shown(text)}"))
        try:
            agents = YamlFile(text, name).data.get("agents", ())
            self._bench.trust.check(agents)
            scene = Scene.loads(text, name=name, folder=self.state.folder)
        except AI4UError as error:
            return failed(error)
        return self.open(scene)

    def restore_unsaved(self) -> "Future[ChangeResult]":
        """Has the scene run that was left unsaved."""
        unsaved, self.unsaved = self.unsaved, None
        if unsaved is None:
            return failed(SetupError("there is no unsaved scene"))
        try:
            scene = unsaved.scene()
        except AI4UError as error:
            return failed(error)
        future = self.open(scene)

        def tell(done: "Future[ChangeResult]") -> None:
            if done.cancelled() or done.exception() is not None:
                self.unsaved = self.unsaved or unsaved
            else:
                self.mark_restored(unsaved)

        future.add_done_callback(tell)
        return future

    def mark_restored(self, unsaved: Unsaved) -> None:
        """The scene that was opened last is one that was left unsaved; it is kept as such."""
        if self.autosave is None:
            self._brought = unsaved
        else:
            self.autosave.claim(unsaved, self._bench.opened)

    def mark_saved(self) -> None:
        """Somebody has saved the scene as it is; what was left by others is not offered again."""
        self.unsaved = None
        if self._brought is not None:
            self._brought.discard()
            self._brought = None
        if self.autosave is not None:
            self.autosave.forget(self._bench.opened)

    def discard_unsaved(self) -> None:
        """Delete the scene that was left unsaved; what is kept of the one that runs stays."""
        unsaved, self.unsaved = self.unsaved, None
        if unsaved is not None:
            unsaved.discard()

    # -- back and forth --------------------------------------------------------------------------

    def undo(self) -> "Future[ChangeResult]":
        """Takes the last change back; the time goes on."""
        return self._runner.submit(self._bench.undo)

    def redo(self) -> "Future[ChangeResult]":
        """Makes the change again that was taken back last."""
        return self._runner.submit(self._bench.redo)

    def _keep(self, state: EditState) -> None:
        """Has what was changed written down; of a scene that was only opened there is nothing."""
        if self.autosave is None:
            return
        opened = self._bench.opened
        if not self.is_as_opened:
            self.autosave.note(state, opened)
        elif self._bench.history.next is not None:  # all was taken back
            self.autosave.note(None, opened)

    # -- how -------------------------------------------------------------------------------------

    def _of_agent(
        self, agent_id: str, path: BlockPath, word: str, change: Callable[[Plain], Plain]
    ) -> "Future[ChangeResult]":
        def make() -> Made:
            agent = self.state.agent(agent_id)
            label = f"{word} {blocks.block_at(agent, path)['type']}"
            state = self.state.with_agent(agent_id, change(agent))
            return state, label, self._where(agent_id, path)

        return self._do(make)

    def _where(self, agent_id: str, path: BlockPath) -> BlockPath:
        return ("agents", self.state.agent_index(agent_id), *path)
