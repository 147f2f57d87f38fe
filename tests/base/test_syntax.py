"""Syntax trees that several threads want at once."""

import ast
import gc
import sys
import threading
import time
from collections.abc import Iterator

import pytest

from ai4u_edu import BasicAgent, blocks
from ai4u_edu.base.syntax import parsed, parsed_class

CLASSES = [each for each in vars(blocks).values() if isinstance(each, type)][:6]


@pytest.fixture
def busy_collector() -> Iterator[None]:
    """Has threads give way in the middle of a tree: the collector of garbage may, there."""
    before, interval = gc.get_threshold(), sys.getswitchinterval()
    gc.collect()
    gc.freeze()  # else each of the many collections would look at everything

    def give_way(*_: object) -> None:
        time.sleep(0)

    gc.callbacks.append(give_way)
    gc.set_threshold(5)
    sys.setswitchinterval(1e-5)
    yield
    sys.setswitchinterval(interval)
    gc.set_threshold(*before)
    gc.callbacks.remove(give_way)  # what is frozen stays so, as the rest of the suite is


@pytest.mark.usefixtures("busy_collector")
def test_threads_that_parse_at_once_do_not_disturb_each_other() -> None:
    errors: list[Exception] = []

    def parse() -> None:
        try:
            for each in CLASSES:
                parsed_class(each)
                parsed("def f(x):\n    return [x, (x, {x: [x]})]")
        except Exception as error:
            errors.append(error)

    threads = [threading.Thread(target=parse) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert errors == []


def test_who_is_disturbed_by_others_tries_again(monkeypatch: pytest.MonkeyPatch) -> None:
    parse, calls = ast.parse, iter([SystemError("AST constructor recursion depth mismatch")] * 2)

    def disturbed(code: str) -> ast.Module:
        for error in calls:
            raise error
        return parse(code)

    monkeypatch.setattr(ast, "parse", disturbed)
    assert isinstance(parsed("x = 1").body[0], ast.Assign)


def test_to_tell_what_an_agent_was_given_makes_no_tree(monkeypatch: pytest.MonkeyPatch) -> None:
    """The world's thread and those of pages ask for it, whenever an episode begins."""

    def disturbed(*_: object) -> None:
        raise SystemError("AST constructor recursion depth mismatch")

    agent = BasicAgent(id="0", body="robot")
    with monkeypatch.context() as meanwhile:  # pytest parses what fails
        meanwhile.setattr(ast, "parse", disturbed)
        given = agent.given()
    assert given == {"body": "robot"}
