"""Scenes that are kept by name in a folder, and never outside of it."""

import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ai4u_edu import Scene
from ai4u_edu.base.errors import SceneError, SetupError
from ai4u_edu.page.editing import scene_store as shelves
from ai4u_edu.page.editing.scene_store import SceneExistsError, SceneStore, normalized_name
from tests.page.editing.harness import TEXT


@pytest.fixture
def store(tmp_path: Path) -> SceneStore:
    return SceneStore(tmp_path / "kept")


PLAIN = Scene.loads(TEXT)


def scene(goal: str = "") -> Scene:
    return Scene(PLAIN.description.model_copy(update={"goal": goal}))


def test_a_scene_is_kept_and_found_again(store: SceneStore) -> None:
    assert store.names() == []
    assert store.save(" My maze ", scene("Touch it.")) == "My maze"
    assert store.names() == ["My maze"]
    assert store.load("my MAZE") == scene("Touch it.")
    assert [path.name for path in store.folder.iterdir()] == ["My maze.yaml"]


def test_two_servers_that_save_one_name_don_t_replace_each_other_s(tmp_path: Path) -> None:
    shelves_of_servers = [SceneStore(tmp_path) for _ in range(4)]  # each with a lock of its own
    started = threading.Barrier(len(shelves_of_servers))

    def save(number: int) -> str:
        started.wait()
        try:
            return shelves_of_servers[number].save("Maze", scene(str(number)))
        except SceneExistsError as error:
            return str(error)

    with ThreadPoolExecutor(len(shelves_of_servers)) as pool:
        told = sorted(pool.map(save, range(len(shelves_of_servers))))
    assert told == ["'Maze' is there already"] * 3 + ["Maze"]
    assert [path.name for path in tmp_path.iterdir()] == ["Maze.yaml"]


def test_saving_over_a_scene_needs_confirmation(store: SceneStore) -> None:
    store.save("Maze", scene("one"))
    with pytest.raises(SceneExistsError, match="'Maze' is there already"):
        store.save("maze", scene("two"))
    assert store.load("Maze").description.goal == "one"
    assert store.save("maze", scene("two"), over=True) == "Maze"
    assert store.load("Maze").description.goal == "two"
    assert store.names() == ["Maze"]


NO_NAMES = (
    *(
        "",
        "  ",
        ".",
        "..",
        "../x",
        "a/b",
        "a\\b",
        "/etc/x",
        "C:x",
        ".hidden",
        "-rf",
        "a\0b",
        "a\nb",
    ),
    *("x.yaml", "x" * 61, "_a", "~", "$HOME", "con", "LPT1", "a%2fb", "a\u202eb", "\u2025"),
)


@pytest.mark.parametrize("name", NO_NAMES)
def test_names_are_no_paths(store: SceneStore, name: str) -> None:
    with pytest.raises(SetupError):
        store.save(name, scene())
    with pytest.raises(SetupError):
        store.load(name)
    assert list(store.folder.iterdir()) == []
    assert [path.name for path in store.folder.parent.iterdir()] == ["kept"]


@given(st.text(max_size=70))
def test_any_scene_name_maps_to_one_file_in_the_folder(name: str) -> None:
    try:
        kept = normalized_name(name)
    except SetupError:
        return
    path = Path("/shelf") / f"{kept}.yaml"
    assert path.resolve().parent == Path("/shelf")
    assert path.stem == kept
    assert len(path.name.encode()) < 255
    assert normalized_name(kept) == kept


def test_links_lead_nowhere(store: SceneStore, tmp_path: Path) -> None:
    outside = tmp_path / "outside.yaml"
    scene("secret").save(outside)
    (store.folder / "link.yaml").symlink_to(outside)
    (store.folder / "dangling.yaml").symlink_to(tmp_path / "new.yaml")
    (store.folder / "folder.yaml").mkdir()
    assert store.names() == []
    with pytest.raises(SceneError, match="no scene is kept as 'link'"):
        store.load("link")
    for name in ("link", "dangling", "folder"):
        with pytest.raises(SetupError):
            store.save(name, scene(), over=True)
    assert Scene.load(outside).description.goal == "secret"
    assert not (tmp_path / "new.yaml").exists()


def test_a_page_can_not_fill_the_disk(store: SceneStore, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shelves, "MAX_SCENES", 2)
    for name in ("a", "b"):
        store.save(name, scene())
    with pytest.raises(SetupError, match="at most 2 scenes"):
        store.save("c", scene())
    store.save("a", scene("again"), over=True)
    (store.folder / "b.yaml").write_text("x" * 2_000_000)
    with pytest.raises(SceneError, match="expected at most"):
        store.load("b")


def test_simultaneous_saves_of_one_name_let_one_win(store: SceneStore) -> None:
    def save(number: int) -> bool:
        try:
            store.save("mine", scene(str(number)))
        except SceneExistsError:
            return False
        return True

    with ThreadPoolExecutor(4) as pool:
        assert sum(pool.map(save, range(8))) == 1


def test_saving_needs_relative_network_files_in_the_store(store: SceneStore) -> None:
    network = {"type": "NeuralNetController", "model_path": "mine.onnx"}
    agent = {
        **PLAIN.description.agents[0],
        "brains": [{"type": "LocalBrain", "controller": network}],
    }
    driven = Scene(PLAIN.description.model_copy(update={"agents": (agent,)}))
    with pytest.raises(SetupError, match="lies beside the scene"):
        store.save("mine", driven)
    (store.folder / "mine.onnx").write_bytes(b"")
    store.save("mine", driven)


def test_a_file_is_no_folder(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(SetupError, match="expected a folder for scenes"):
        SceneStore(tmp_path / "file")
