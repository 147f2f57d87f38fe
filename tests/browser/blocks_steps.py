"""Programs of blocks that make the five steps in the maze, as the steps describe them."""

from tests.browser.blocks import State, act, block, compare, program, stack


def near(side: str) -> State:
    return block("near:vision", {"SIDE": side})


def calculated(left: State, operator: str, right: float) -> State:
    return block("arithmetic", {"OP": operator}, A=left, B=right)


def either(condition: State, yes: State, no: State) -> State:
    return block("if_else", IF=condition, DO=yes, ELSE=no)


def at_each_decision(*blocks: State) -> State:
    return program(stack({**block("on_decision"), "x": 16, "y": 16}, *blocks))


FOLLOW = either(
    compare(near("ahead"), "LT", 0.9),
    act(1, -0.8),
    stack(act(0, 0.5), act(1, calculated(near("right"), "MINUS", 0.8))),
)
TO_EXIT = stack(
    act(0, 0.6), act(1, calculated(block("angle:vision", {"GROUP": "target"}), "DIVIDE", 40))
)
SEES_EXIT = block("sees:vision", {"GROUP": "target", "SIDE": "around"})
PROGRAMS = [
    at_each_decision(act(0, 1)),
    at_each_decision(block("if", IF=compare(near("ahead"), "GT", 0.8), DO=act(0, 0.5))),
    at_each_decision(either(compare(near("ahead"), "LT", 0.8), act(1, 0.5), act(0, 0.5))),
    at_each_decision(FOLLOW),
    at_each_decision(either(SEES_EXIT, TO_EXIT, FOLLOW)),
]
