# %% tags=["solution"]
def plan(ahead, left):
    steps = []
    for _ in range(ahead):
        steps.append("forward")
    steps.append("left")
    for _ in range(left):
        steps.append("forward")
    return steps


# %% tags=["right", "lists times numbers"]
def plan(ahead, left):
    return ["forward"] * ahead + ["left"] + ["forward"] * left


# %% tags=["right", "to the left first"]
def plan(ahead, left):
    steps = ["left"]
    for _ in range(left):
        steps.append("forward")
    steps.append("right")
    for _ in range(ahead):
        steps.append("forward")
    return steps


# %% tags=["right", "one loop"]
def plan(ahead, left):
    steps = []
    for number in range(ahead + left):
        if number == ahead:
            steps.append("left")
        steps.append("forward")
    return steps


# %% tags=["right", "three times to the right"]
def plan(ahead, left):
    steps = []
    for _ in range(ahead):
        steps.append("forward")
    for _ in range(3):
        steps.append("right")
    for _ in range(left):
        steps.append("forward")
    return steps


# %% tags=["wrong", "early", "returns in the loop"]
def plan(ahead, left):
    steps = []
    for _ in range(ahead):
        steps.append("forward")
        return steps
    steps.append("left")
    for _ in range(left):
        steps.append("forward")
    return steps


# %% tags=["wrong", "reset", "starts again in the loop"]
def plan(ahead, left):
    for _ in range(ahead):
        steps = []
        steps.append("forward")
    steps.append("left")
    for _ in range(left):
        steps = []
        steps.append("forward")
    return ["forward", "left"] + steps


# %% tags=["wrong", "turn", "never turns"]
def plan(ahead, left):
    steps = []
    for _ in range(ahead):
        steps.append("forward")
    for _ in range(left):
        steps.append("forward")
    return steps


# %% tags=["wrong", "mirrored", "turns right"]
def plan(ahead, left):
    steps = []
    for _ in range(ahead):
        steps.append("forward")
    steps.append("right")
    for _ in range(left):
        steps.append("forward")
    return steps


# %% tags=["wrong", "swapped", "the numbers are swapped"]
def plan(ahead, left):
    steps = []
    for _ in range(left):
        steps.append("forward")
    steps.append("left")
    for _ in range(ahead):
        steps.append("forward")
    return steps


# %% tags=["wrong", "count", "one too many"]
def plan(ahead, left):
    steps = []
    for _ in range(ahead + 1):
        steps.append("forward")
    steps.append("left")
    for _ in range(left + 1):
        steps.append("forward")
    return steps


# %% tags=["wrong", "words", "a list in the list"]
def plan(ahead, left):
    steps = []
    steps.append(["forward"] * ahead)
    steps.append("left")
    steps.append(["forward"] * left)
    return steps


# %% tags=["wrong", "list", "one long word"]
def plan(ahead, left):
    return "forward" * ahead + "left" + "forward" * left


# %% tags=["wrong", "no-return", "prints"]
def plan(ahead, left):
    for _ in range(ahead):
        print("forward")
    print("left")
    for _ in range(left):
        print("forward")


# %% tags=["wrong", "error", "a number is no range"]
def plan(ahead, left):
    steps = []
    for _ in ahead:
        steps.append("forward")
    return steps


# %% tags=["lucky", "the plan of the text"]
def plan(ahead, left):
    return ["forward", "forward", "left", "forward"]


# %% tags=["lucky", "three and one"]
def plan(ahead, left):
    return ["forward", "forward", "forward", "left", "forward"]


# %% tags=["lucky", "stairs"]
def plan(ahead, left):
    steps = []
    for _ in range(left):
        steps = steps + ["forward", "left", "forward", "right"]
    return steps


# %% tags=["lucky", "by chance"]
import random


def plan(ahead, left):
    return [random.choice(["forward", "left"]) for _ in range(ahead + left + 1)]


# %% tags=["wrong", "turns", "turns in the loop"]
def plan(ahead, left):
    steps = []
    for _ in range(ahead):
        steps.append("forward")
        steps.append("left")
    for _ in range(left):
        steps.append("forward")
    return steps


# %% tags=["wrong", "early", "returns in the second loop"]
def plan(ahead, left):
    steps = []
    for _ in range(ahead):
        steps.append("forward")
    steps.append("left")
    for _ in range(left):
        steps.append("forward")
        return steps
