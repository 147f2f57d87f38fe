"""A file is read in C, and as YAML 1.2 has it: no `no` is a false, no date anything but a text."""

import io
import math

import pytest
import yaml
from ruamel.yaml import YAML

from ai4u_edu.errors import SceneError
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.yaml_file import MAX_SIZE, YamlFile
from ai4u_edu.scenes.yaml_tree import IS_QUICK, read_tree

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
    assert IS_QUICK
    assert yaml.__with_libyaml__


def test_a_file_of_the_largest_size_has_all_its_lines() -> None:
    entries = MAX_SIZE // 25
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
