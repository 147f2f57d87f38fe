"""Loading of blocks of one's own from a file: what is registered, told, and named to a child."""

import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from ai4u_edu import Block
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.loading import load_blocks, own_files, run_file

EAR = "from ai4u_edu import Sensor\n\nclass Ear(Sensor):\n    reach: float = {reach}\n"
NOSE = "from ai4u_edu import Sensor\n\nclass Nose(Sensor):\n    '''Smells.'''\n"


@pytest.fixture(autouse=True)
def _what_was_imported_ends_with_the_test(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[None]:
    monkeypatch.setattr(sys, "path", list(sys.path))
    yield
    files = {name: str(getattr(module, "__file__", "")) for name, module in sys.modules.items()}
    imported = [name for name, file in files.items() if file.startswith(str(tmp_path))]
    types = Block.types.items()
    Block.types = {name: cls for name, cls in types if cls.__module__ not in imported}
    for name in imported:
        del sys.modules[name]


def written(file: Path, text: str) -> Path:
    file.parent.mkdir(exist_ok=True)
    file.write_text(text)
    return file


@pytest.mark.parametrize("is_relative", [False, True], ids=["absolute", "relative"])
@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("x = 1\n", ": defines no block; expected a class made from Sensor, Actuator, RewardFunc, "
         "Brain or Controller"),
        ("from ai4u_edu import Sensor\n\nclass Ear(Sensr):\n    pass\n",
         ", line 3: NameError: name 'Sensr' is not defined"),
        ("class Ear(\n", ", line 1: SyntaxError: '(' was never closed"),
        ("import sys\nsys.exit('bye')\n", ", line 2: SystemExit: bye"),
        ("from ai4u_edu import Sensor\nclass TouchSensor(Sensor):\n    '''Mine.'''\n",
         ": TouchSensor is the name of a built-in block; expected another name"),
        ("from ai4u_edu import TouchSensor\nclass Ear(TouchSensor):\n    '''Mine.'''\nEar()\n",
         ", line 4: ParameterError: Ear: target: is missing and has no default"),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_file_is_told_and_nothing_is_known_of_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, told: str, is_relative: bool
) -> None:
    before = dict(Block.types)
    written(tmp_path / "mine.py", text)
    monkeypatch.chdir(tmp_path)
    file = Path("mine.py") if is_relative else tmp_path / "mine.py"
    with pytest.raises(SetupError) as caught:
        load_blocks(file)
    assert str(caught.value) == f"{file}{told}"
    assert Block.types == before
    assert own_files() == []


def test_what_lies_beside_the_file_can_be_imported(tmp_path: Path) -> None:
    written(tmp_path / "own_numbers.py", "REACH = 3.0\n")
    text = "from own_numbers import REACH\n" + EAR.format(reach="REACH")
    (ear,) = load_blocks(written(tmp_path / "ear.py", text))
    assert ear().values()["reach"] == 3.0


def test_two_files_of_one_name_are_both_named(tmp_path: Path) -> None:
    first = written(tmp_path / "one" / "mine.py", EAR.format(reach=1.0))
    second = written(tmp_path / "two" / "mine.py", NOSE)
    load_blocks(first)
    load_blocks(second)
    assert own_files() == [first, second]


def test_of_two_blocks_of_one_name_the_last_holds_in_a_child_too(tmp_path: Path) -> None:
    first = written(tmp_path / "b.py", EAR.format(reach=1.0) + NOSE)
    second = written(tmp_path / "a.py", EAR.format(reach=2.0))
    load_blocks(first)
    load_blocks(second)
    assert own_files() == [first, second]
    load_blocks(first)
    assert own_files() == [first], "the other's only block was replaced"
    load_blocks(second)
    assert own_files() == [first, second], "what is loaded again comes last"


def test_a_broken_file_of_the_same_name_changes_nothing(tmp_path: Path) -> None:
    good = written(tmp_path / "one" / "mine.py", EAR.format(reach=1.0))
    (ear,) = load_blocks(good)
    with pytest.raises(SetupError, match=r"line 1: SystemExit: bye"):
        load_blocks(written(tmp_path / "two" / "mine.py", "raise SystemExit('bye')\n"))
    with pytest.raises(SetupError, match=r"line 1: SystemExit: bye"):
        load_blocks(written(good, "raise SystemExit('bye')\n"))
    assert own_files() == [good]
    assert pickle.dumps(ear), "its module is still the one that knows it"


def test_a_file_that_imports_its_blocks_from_one_beside_it_is_named(tmp_path: Path) -> None:
    written(tmp_path / "my_ears.py", EAR.format(reach=1.0))
    file = written(tmp_path / "all_mine.py", "import my_ears\n")
    load_blocks(file)
    assert own_files() == [file]


def test_a_file_of_blocks_that_runs_for_a_driver_is_still_named(tmp_path: Path) -> None:
    file = written(tmp_path / "mine.py", EAR.format(reach=1.0) + "\ndef ahead(percept): ...\n")
    load_blocks(file)
    assert callable(run_file(file).ahead)
    assert own_files() == [file]
    written(tmp_path / "my_noses.py", NOSE)
    imports = written(tmp_path / "all_mine.py", "import my_noses\n")
    load_blocks(imports)
    run_file(imports)
    assert own_files() == [file, imports]


@pytest.mark.parametrize("run", [load_blocks, run_file])
def test_a_file_that_fails_leaves_no_module_behind(
    tmp_path: Path, run: Callable[[Path], object]
) -> None:
    before = set(sys.modules)
    with pytest.raises(SetupError):
        run(written(tmp_path / "mine.py", "class Ear(\n"))
    assert set(sys.modules) == before


def test_a_file_that_defines_no_block_takes_no_module_away(tmp_path: Path) -> None:
    file = written(tmp_path / "mine.py", EAR.format(reach=1.0))
    (ear,) = load_blocks(file)
    with pytest.raises(SetupError, match="defines no block"):
        load_blocks(written(file, "x = 1\n"))
    assert pickle.dumps(ear), "its module is still the one that knows it"


def test_a_driver_has_the_file_name_that_its_reader_knows(tmp_path: Path) -> None:
    with pytest.raises(
        SetupError, match=r"^mine\.py, line 1: ZeroDivisionError: division by zero$"
    ):
        run_file(written(tmp_path / "mine.py", "1 / 0\n"), "mine.py")
    with pytest.raises(SetupError, match=r"^there\.py: expected a Python file \(\.py\)$"):
        run_file(tmp_path / "there.py", "there.py")


def test_a_child_process_that_loads_the_same_files_knows_the_same_classes(tmp_path: Path) -> None:
    file = written(tmp_path / "my.ear.py", EAR.format(reach=1.5))
    (ear,) = load_blocks(file)
    program = (
        "import pickle, sys\nfrom pathlib import Path\n"
        "from ai4u_edu.blocks.loading import load_blocks\n"
        "load_blocks(Path(sys.argv[1]))\n"
        "print(pickle.loads(bytes.fromhex(sys.argv[2]))().reach)\n"
    )
    (known,) = own_files()
    command = [sys.executable, "-c", program, str(known), pickle.dumps(ear).hex()]
    told = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (told.stdout, told.stderr) == ("1.5\n", "")
