"""Programs in the docs run, links and named files are there, and tables are the code's own."""

import re
import shlex
from pathlib import Path
from typing import Any

import pytest
import typer
from PIL import GifImagePlugin, Image

import ai4u_edu
from ai4u_edu import Scene
from ai4u_edu.cli.main import app
from tests import architecture
from tests.builders import small_sim
from tests.components import AI4U, AI4U_SETTINGS
from tests.names import AI4U_PAGE, table_in
from tests.playing import played
from tests.waiting import until

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[1]
PAGES = [
    ROOT / "README.md",
    *sorted(ROOT.glob("README.*.md")),
    *sorted((ROOT / "docs").rglob("*.md")),
]
FROM_AI4U = AI4U_PAGE.read_text(encoding="utf-8")
MAX_FILM_BYTES = 1_500_000
PROGRAMS = {
    "build-an-agent.md": ["touched the lamp: True"],
    "python.md": ["'touch': 1.0", "watch it at http://127.0.0.1:"],
    "traces.md": ["under me: [0."],
    "explain.md": ["(19, 4)", "It turns left because ray "],
    "training.md": ["(126,) {'touch': 0.0", "['blue_striker', 'blue_keeper', 'orange_striker'"],
}
"""The pages with Python programs, and what each page's programs print."""
START_PAGE = ROOT / "docs/README.md"
RUN_ELSEWHERE = {
    "remote.md": "tests/remote/test_guide.py",
    "README.md": "test_the_start_page_drives_a_robot",
    "from-ai4u.md": "tests/remote/test_ai4u_ports.py",
}
"""Pages whose programs need worlds of their own, and the tests that run them."""


def programs(page: Path, kind: str = "python") -> list[str]:
    return re.findall(rf"```{kind}\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


@pytest.mark.parametrize("name", PROGRAMS)
def test_programs_run(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    names: dict[str, Any] = {"input": lambda _: "\n"}
    for block in programs(ROOT / "docs" / name):
        exec(block, names)  # noqa: S102 - our own
    told = capsys.readouterr().out
    for text in PROGRAMS[name]:
        assert text in told
    if "DistanceTo" in names:
        assert names["DistanceTo"](target="box").reach == 20.0


def test_no_other_page_has_a_program_that_is_not_run() -> None:
    assert {page.name for page in PAGES if programs(page)} == {*PROGRAMS, *RUN_ELSEWHERE}


def test_the_start_page_drives_a_robot() -> None:
    (program,) = programs(START_PAGE)
    program_name, command, *arguments = shlex.split(programs(START_PAGE, "sh")[0])
    assert (program_name, command) == ("ai4u-edu", "play")
    with played(*arguments) as server:
        exec(program.replace("http://127.0.0.1:8080", server.url.rstrip("/")), {})  # noqa: S102
        until(lambda: "a script drives agent '0'" in "".join(server.told))


def test_the_start_page_has_commands_with_options_that_they_know() -> None:
    commands = typer.main.get_command(app).commands  # type: ignore[attr-defined]  # a group
    lines = "".join(programs(START_PAGE, "sh")).splitlines()
    assert len(lines) == 4
    for line in lines:
        _, command, *arguments = shlex.split(line)
        commands[command].make_context(command, arguments)  # raises an error of usage


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_to_files_that_are_there(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    links = re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", text)
    links += re.findall(r'<img src="([^"]+)"', text)
    missing = [
        link for link in links if "://" not in link and not (page.parent / link).resolve().exists()
    ]
    assert missing == []


@pytest.mark.parametrize("folder", ["", "adr", "how-to"])
def test_every_page_is_in_the_list_of_its_folder(folder: str) -> None:
    """The lists are the docs site's table of contents."""
    here = ROOT / "docs" / folder
    listed = re.findall(
        r"^- \[.*?\]\(([\w./-]+)\)", (here / "README.md").read_text("utf-8"), re.MULTILINE
    )
    assert len(set(listed)) == len(listed)
    assert {page.name for page in here.glob("*.md")} - {"README.md", *listed} == set()


def test_every_scene_is_said_to_be_for_something() -> None:
    listed = re.findall(
        r"^\| `(\w+)` \| .+ \|$", (ROOT / "docs/scenes.md").read_text("utf-8"), re.MULTILINE
    )
    assert listed == Scene.names()


def test_the_film_moves_and_is_small() -> None:
    (name,) = re.findall(r'src="(tests/pictures/\w+\.gif)"', PAGES[0].read_text(encoding="utf-8"))
    assert (ROOT / name).stat().st_size < MAX_FILM_BYTES
    with Image.open(ROOT / name) as film:
        assert isinstance(film, GifImagePlugin.GifImageFile)
        assert film.info["loop"] == 0, "endless"
        assert film.n_frames > 100


PLACES = re.compile(r"`((?:ai4u_edu|tests|lessons|web)/[\w./]*)(?:::(\w+))?`")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_files_and_names_in_them_are_there(page: Path) -> None:
    """``path`` or ``path::NAME`` in backticks; NAME stands for a file of the reader's own."""
    missing = []
    for path, name in PLACES.findall(page.read_text(encoding="utf-8")):
        if "NAME" in path or "NN" in path:
            continue
        file = ROOT / path
        if not file.exists() or (name and not defines(file, name)):
            missing.append(f"{path}::{name}")
    assert missing == []


def defines(file: Path, name: str) -> bool:
    pattern = rf"^(class|def|async def) {name}\b|^{name}\b.*="
    return re.search(pattern, file.read_text(encoding="utf-8"), re.MULTILINE) is not None


def test_every_class_of_ai4u_has_a_row_that_says_something() -> None:
    rows = [line.split(" | ") for line in table_in(FROM_AI4U).splitlines()[2:]]
    assert [row[0].strip("|` ") for row in rows] == sorted(AI4U.split(), key=str.lower)
    assert all(len(row[2].split()) > 2 for row in rows)


def test_every_setting_of_ai4u_has_a_row() -> None:
    named = {name for theirs, _ in settings() for name in re.findall(r"`([^`]+)`", theirs)}
    assert {each.replace("_FPS", " FPS") for each in AI4U_SETTINGS.split()} - named == set()


def test_what_the_rows_name_is_here() -> None:
    named = [name for _, here in settings() for name in re.findall(r"`([\w.]+)`", here)]
    assert len(named) > 70
    strange = [name for name in named if not is_known(name)]
    assert strange == []


def settings() -> list[tuple[str, str]]:
    """The table of methods and settings: AI4U's names, and what stands for them."""
    table = FROM_AI4U.split("## Methods and settings")[1]
    return re.findall(r"^\| (`.*?) \| (.*?) \|$", table, re.MULTILINE)


def is_known(name: str) -> bool:
    """Return True if there is such a class, attribute, parameter, event or method."""
    owner, _, member = name.rpartition(".")
    if owner == "BasicAgent":
        return hasattr(small_sim().agents[0], member)
    if owner:
        cls = getattr(ai4u_edu, owner)
        return hasattr(cls, member) or (owner != "Command" and member in cls.parameters())
    return name in {*dir(ai4u_edu), *ai4u_edu.EVENTS, *WORDS}


WORDS = {"Box", "Discrete", "handler", "default_time_scale"} | {
    f"__{each}__" for each in ("restart", "pause", "resume", "stop")
}
"""Words in the rows that are no names of the package."""


def test_the_picture_of_the_architecture_is_drawn_from_the_code() -> None:
    drawn = architecture.PICTURE.read_text(encoding="utf-8")
    assert drawn == architecture.draw(), "draw it again: python -m tests.architecture"
