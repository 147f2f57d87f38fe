"""A file is read in C, and as YAML 1.2 has it: no `no` is a false, no date anything but a text."""

import io
import math
from contextlib import suppress
from pathlib import Path

import pytest
import yaml
from ruamel.yaml import YAML

from ai4u_edu.base.errors import SceneError
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.yaml.file import MAX_SCENE_CHARS, YamlFile
from ai4u_edu.scenes.yaml.tree import HAS_LIBYAML, read_tree

PLAIN = (
    "true True TRUE false False FALSE null Null NULL ~ yes no on off y n tRUE nil 1 -1 +1 007 "
    "1_000 0o17 0x1F 0b101 -0x1f 1.5 -1.5 .5 -.5 1. 1.e3 1e3 1E-3 1.5e+3 1_0.2_5 .inf -.inf +.INF "
    ".Inf .nan .NaN inf nan 1.2.3 1-2 . .. -x +x 0o8 0xg 1e e1 12:30 a1 1a true1 north a#b a:b"
)


@pytest.mark.parametrize("text", PLAIN.split())
def test_a_value_without_quotes_is_what_yaml_says(text: str) -> None:
    expected = YAML(typ="safe", pure=True).load(io.StringIO(f"a: {text}"))["a"]
    got = read_tree(f"a: {text}").data["a"]
    assert type(got) is type(expected)
    assert got == expected or (math.isnan(got) and math.isnan(expected))


def test_a_date_is_a_text() -> None:
    assert read_tree("a: 2024-01-31").data == {"a": "2024-01-31"}


def test_a_value_in_quotes_is_a_text() -> None:
    assert read_tree("""a: ['1', "true", '~', "\\u00e9"]""").data == {"a": ["1", "true", "~", "é"]}


def test_keys_are_words_as_they_stand_there() -> None:
    assert read_tree("1: a\ntrue: b\n~: c").data == {"1": "a", "true": "b", "~": "c"}


def test_every_entry_has_its_line() -> None:
    file = YamlFile("a:\n  - b: 1\n    c: 2\n  -\n    d:\n      3\ne: [\n 1,\n 2]", "x.yaml")
    paths: list[tuple[str | int, ...]] = [("a",), ("a", 0), ("a", 0, "c"), ("a", 1), ("a", 1, "d")]
    assert [file.line(path) for path in paths] == [1, 2, 3, 5, 5]
    assert [file.line(path) for path in (("e",), ("e", 1), ("e", 7), ("f",), ())] == [7, 9, 7, 1, 1]


def test_it_is_read_in_c() -> None:
    assert HAS_LIBYAML
    assert yaml.__with_libyaml__


def test_a_file_of_the_largest_size_has_all_its_lines() -> None:
    entries = MAX_SCENE_CHARS // 25
    text = "bodies:\n" + "".join(f"  - name: body {number}\n" for number in range(entries))
    file = YamlFile(text, "x.yaml")
    assert file.data["bodies"][-1] == {"name": f"body {entries - 1}"}
    assert file.line(("bodies", entries - 1, "name")) == entries + 1


def test_of_very_many_mistakes_the_first_ones_are_told() -> None:
    with pytest.raises(SceneError) as told:
        Scene.loads("name: x\nagents: [{body: a}]\nbodies:\n" + "  - {}\n" * 1000, name="x.yaml")
    lines = str(told.value).splitlines()
    assert lines[0] == "x.yaml, line 4: bodies[0].name: is missing and has no default"
    assert (len(lines), lines[-1]) == (21, "x.yaml: and 980 more like these")


FAULTS = {
    "name: x\nbodies:\n\t- name: a": (3, 1, "a tab stands here; expected spaces"),
    "\tname: x": (1, 1, "a tab stands here"),
    "name: x\ntitle\ngoal: y": (2, 1, "no colon follows; expected 'name: value'"),
    "name x\ntitle: y": (2, 6, "'name x', which stands above, has no colon"),
    "name: a: b": (1, 8, "a second colon in this line; put the value in quotes"),
    "name: x\n  title: y": (2, 3, "this line is indented more than the one above"),
    "bodies:\n    - name: a\n   - name: b": (3, 4, "this line begins at column 4"),
    "bodies:\n  - name: a\n   position: [1, 2]": (3, 4, "this line begins at column 4"),
    "a:\n  b: 1\n c: 2": (3, 2, "this line begins at column 2, and none of those above"),
    "name: x\n- a": (2, 1, "a list's entry (-) among the 'name: value' lines from line 1 on"),
    "- a\nname: x": (2, 1, "expected '- ' before each entry of the list"),
    'a: 1\nname: "x\ntitle: y': (2, 7, 'this " is never closed'),
    "name: 'x\ntitle: y": (1, 7, "this ' is never closed"),
    "name: [a, b\ntitle: y": (1, 7, "this [ is never closed; expected ] at the end"),
    "name: {a: b\ntitle: y": (1, 7, "this { is never closed; expected } at the end"),
    "name: [a, b}": (1, 12, "expected a comma or ] before this"),
    "name: {a: 1 b: 2}": (1, 14, "expected a comma or } before this"),
    "name: ['a' 'b']": (1, 12, "expected a comma or ] before this"),
    "name: x\nbodies: [": (2, 9, "this [ is never closed"),
    "name: a\nb: ]": (2, 4, "] stands here, and nothing was opened that it closes"),
    "name: @x": (1, 7, "a value can't begin with @; put it in quotes"),
    "name: %x": (1, 7, "a value can't begin with %"),
    "name: *": (1, 7, "a value can't begin with *"),
    "name: | x": (1, 9, "the text after | or > begins on the next line"),
    'name: "C:\\dir"': (1, 7, "in double quotes a \\ begins a special character"),
    'name: "a" b': (1, 11, "something follows after the value; put all of it in quotes"),
    "name: x\nname: y": (2, 1, "'name' stands here for the second time, after line 1"),
    "a: 1\nb: x\x07": (2, 5, "expected text, got the control character 0x07"),
}


@pytest.mark.parametrize("text", FAULTS, ids=range(len(FAULTS)))
@pytest.mark.parametrize("loader", [yaml.CSafeLoader, yaml.SafeLoader])
def test_a_fault_is_told_in_words_with_its_place_and_its_line(
    text: str, loader: type, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ai4u_edu.scenes.yaml.tree._Loader", loader)  # where libyaml is missing
    line, column, words = FAULTS[text]
    with pytest.raises(SceneError) as caught:
        YamlFile(text, "x.yaml")
    said, quoted, pointer = str(caught.value).split("\n")
    assert said.startswith(f"x.yaml, line {line}, column {column}: {words}")
    shown = text.split("\n")[line - 1]
    assert (
        quoted
        == "    " + "".join(c if c.isprintable() else "? "[c == "\t"] for c in shown).rstrip()
    )
    assert pointer == " " * (4 + column - 1) + "^"


def test_of_a_long_line_the_place_is_shown() -> None:
    with pytest.raises(SceneError) as caught:
        YamlFile("a: [" + "1, " * 500 + "b c: d: e]", "x.yaml")
    _, quoted, pointer = str(caught.value).split("\n")
    assert len(quoted) <= 80
    assert len(pointer) <= len(quoted) + 1


def test_whatever_is_wrong_is_told() -> None:
    """A file that is cut off, or in which a character is another one, gives an error of ours."""
    good = (Path(__file__).parents[2] / "ai4u_edu/scenes/library/box_chase.yaml").read_text()
    for place in range(0, len(good), 23):
        for text in (good[:place], good[:place] + "\t" + good[place:], good[:place] + '"['):
            with suppress(SceneError):
                YamlFile(text, "x.yaml")


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ("name: x".encode("utf-16"), "expected UTF-8 text, got UTF-16; save it as UTF-8"),
        (b"\x7fELF\x80\x00\x01", "got a file that is no text"),
        (
            "a: 1\ntitle: L\u00e4ufer".encode("latin-1"),
            "line 2: expected UTF-8 text, got the byte 0xe4",
        ),
    ],
)
def test_a_file_in_another_encoding(tmp_path: Path, data: bytes, words: str) -> None:
    file = tmp_path / "x.yaml"
    file.write_bytes(data)
    with pytest.raises(SceneError) as caught:
        Scene.load(file)
    assert words in str(caught.value)


def test_a_mark_that_editors_begin_with_is_no_fault(tmp_path: Path) -> None:
    library = Path(__file__).parents[2] / "ai4u_edu/scenes/library/box_chase.yaml"
    file = tmp_path / "x.yaml"
    file.write_bytes(b"\xef\xbb\xbf" + library.read_bytes())
    assert Scene.load(file) == Scene.load("box_chase")
