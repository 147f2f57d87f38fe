"""Messages of rooms, for tests."""

from ai4u_edu.wire.class_link import Drawing, ExerciseResult, Poses, State


def result(number: int) -> ExerciseResult:
    return ExerciseResult(f"result-{number:04}", "04.2", "wrong", "04.2/narrow")


def state(seconds: float) -> State:
    return State("driving", "Box chase", "A person", seconds, 1, 0, False)


def drawing(number: int) -> Drawing:
    return Drawing(number, (0.0, 0.0, 8.0, 6.0), (), ())


def poses(number: int, x: float = 0.0) -> Poses:
    return Poses(number, (x, 0.0, 0.0, 1.0))
