"""Classes of blocks that another thread registers while scenes are read."""

import pytest

from ai4u_edu import Block, Brain, Scene
from ai4u_edu.scenes import serialization


def test_a_scene_is_read_while_another_thread_registers_blocks(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(Block, "types", dict(Block.types))
    is_serializable = serialization.is_serializable

    def then_one_more(cls: type[Block]) -> bool:
        type("Another", (Brain,), {})
        return is_serializable(cls)

    monkeypatch.setattr(serialization, "is_serializable", then_one_more)
    before = len(Block.types)
    assert Scene.load("box_chase").build().agents
    assert len(Block.types) > before
