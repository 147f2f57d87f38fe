"""A complete exchange of a script with a world, byte by byte, for the page of the protocol.

``python -m tests.remote.protocol_exchange`` writes it into ``docs/protocol.md``.
"""

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any
from unittest.mock import patch

import msgspec

from ai4u_edu import Scene
from ai4u_edu.page.server.scripts import Rules, agent_lease
from ai4u_edu.wire import native
from ai4u_edu.wire.json_form import JsonForm
from ai4u_edu.wire.message_codec import Record
from tests.page.server.rooms import served
from tests.remote.rooms import Script, patient_rules

PAGE = Path(__file__).parents[2] / "docs/protocol.md"
BEGIN, END = "<!-- exchange -->\n", "<!-- end of the exchange -->\n"
SESSION = "5e551017"
SECRET = "chosen by the script"
BYTES_A_LINE = 12
SCENE = "box_chase"

Said = tuple[str, native.Message]
"""A sentence on a message, and the message."""


def exchange() -> list[Said]:
    """Let a script speak with the world of a scene; return all that both said."""
    said: list[Said] = []
    rules = patient_rules(grace=Rules().grace)  # real time: no connection is lost here
    with (
        patch.object(agent_lease, "token_hex", lambda _: SESSION),
        served(Scene.load(SCENE).build(), title="Box chase", rules=rules) as room,
        Script(room) as script,
    ):

        def say(sentence: str, message: native.Message) -> None:
            said.append((f"The script {sentence}", message))
            script.say(message)

        def hear(sentence: str) -> native.Message:
            message = script.hear()
            if isinstance(message, native.Percept) and message.seq == 1:
                # when the script joined is another moment each time
                at_first = {"tick": 0, "step": 0, "reward": 0.0, "terms": {}}
                message = msgspec.structs.replace(message, **at_first)
            said.append((f"The world {sentence}", message))
            return message

        say(
            "asks for the only agent, and for one of its readings.",
            native.Hello(1, "", "", "lockstep", ("orientation",), "", SECRET),
        )
        hear("gives it the agent, and describes it.")
        hear("sends the first percept.")
        say("answers percept 1: it wants a new episode, with seed 1.", native.Reset(1, 1))
        percept = hear("sends the first percept of that episode.")
        assert isinstance(percept, native.Percept)
        answered = percept.episode, percept.step, percept.seq
        say(
            "acts: ahead, with full power.",
            native.Action(*answered, {"move": (1.0, 0.0, 0.0, 0.0)}),
        )
        percept = hear("sends the next percept as soon as the decision is over.")
        assert isinstance(percept, native.Percept)
        answered = percept.episode, percept.step, percept.seq
        say("makes a mistake.", native.Action(*answered, {"mvoe": (1.0, 0.0, 0.0, 0.0)}))
        hear("says what was wrong; percept 3 can be answered again.")
        say(
            "leaves. The world gives the agent back, and closes the connection.", native.Bye("done")
        )
        script.end()
    return said


def rendered(said: list[Said]) -> str:
    """Return the exchange as Markdown."""
    form = JsonForm()
    parts = []
    for number, (sentence, message) in enumerate(said, 1):
        frame = native.encode(message)
        lines = list(_frame_lines(message))
        assert b"".join(data for data, _ in lines) == frame
        width = 3 * BYTES_A_LINE
        dump = "\n".join(
            f"{row.hex(' '):<{width}}{text if not index else ''}".rstrip()
            for data, text in lines
            for index, row in enumerate(_rows(data))
        )
        text = form.text_of(frame)
        parts.append(f"{number}. {sentence}\n\n```text\n{dump}\n```\n\n```json\n{text}\n```\n")
    return "\n".join(parts)


def _rows(data: bytes) -> Iterator[bytes]:
    for start in range(0, len(data), BYTES_A_LINE):
        yield data[start : start + BYTES_A_LINE]


def _frame_lines(message: native.Message) -> Iterator[tuple[bytes, str]]:
    """Yield the bytes of each element of a frame, with what they are."""
    name = type(message).__name__.lower()
    sent = msgspec.msgpack.decode(native.encode(message))
    fields = message.__struct_fields__[: len(sent) - 1]
    yield _head(len(sent)), f"array of {len(sent)}"
    yield msgspec.msgpack.encode(name), json.dumps(name)
    for field in fields:
        yield from _field_lines(field, getattr(message, field))


def _field_lines(name: str, value: Any, indent: str = "") -> Iterator[tuple[bytes, str]]:
    if isinstance(value, tuple) and value and isinstance(value[0], Record):
        yield _head(len(value)), f"{indent}{name}: array of {len(value)}"
        for record in value:
            inner = f"{indent}  "
            fields = record.__struct_fields__
            yield _head(len(fields)), f"{inner}array of {len(fields)}"
            for field in fields:
                yield from _field_lines(field, getattr(record, field), inner)
        return
    yield msgspec.msgpack.encode(value), f"{indent}{name}: {_shown(value)}"


def _shown(value: Any) -> str:
    if isinstance(value, bytes):
        return f"{len(value)} bytes"
    if isinstance(value, Mapping):
        return json.dumps({key: list(each) if isinstance(each, tuple) else each
                           for key, each in value.items()})  # fmt: skip
    return json.dumps(value)


def _head(length: int) -> bytes:
    """Return the first bytes of an array of ``length`` elements."""
    return msgspec.msgpack.encode([None] * length)[: 1 if length < 16 else 3]


def in_page() -> str:
    """Return the exchange that is in the page."""
    return PAGE.read_text(encoding="utf-8").partition(BEGIN)[2].partition(END)[0]


def main() -> None:
    """Write the exchange into the page."""
    text = PAGE.read_text(encoding="utf-8")
    before, _, rest = text.partition(BEGIN)
    _, _, after = rest.partition(END)
    PAGE.write_text(f"{before}{BEGIN}\n{rendered(exchange())}\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
