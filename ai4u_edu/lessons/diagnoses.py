"""Mistakes that may occur in every exercise, each with a hint."""

from collections.abc import Container

from ai4u_edu.locale import gettext as _

UNKNOWN = "unknown"
"""Name of the diagnosis of a mistake that no check knows."""

COMMON = {
    UNKNOWN: _(
        "This is none of the usual mistakes. Read the task once more, and compare what the "
        "check says with what you expected. `print(...)` inside your function shows what it "
        "gets and what it computes."
    ),
    "unfinished": _(
        "Write your answer into the cell of the exercise, run that cell with Shift + Enter, "
        "and then run the check again."
    ),
    "error": _(
        "The message ends with the line that failed. Read that line slowly: is every name "
        "spelled as it was when it was made, and is every bracket closed?"
    ),
    "no-return": _(
        "A function gives its answer with `return`. Every way through it needs one: also the "
        "way on which no `if` applies."
    ),
    "set-up": _(
        "The message says what was expected and what came instead. Look for that name or "
        "number in your cell."
    ),
    "exit": _(
        "`exit()` and `quit()` end a whole program. A function ends by itself after its last "
        "line, or at `return`."
    ),
    "endless": _(
        "The robot calls your function again at every decision, twelve times a second. "
        "Decide about this one moment, with `if` and `else`. A loop that waits for the world "
        "to change waits for ever: the world stands still until your function has answered."
    ),
    "endless-loop": _(
        "A `while` loop goes on until its condition is no longer true: something in the loop "
        "has to change that. A `for` loop ends with its list, unless it adds to that list."
    ),
    "slow": _("Do less in each call: compute once what stays the same, outside the function."),
    "parameters": _(
        "The names in the brackets after `def` are what a function is given. Compare them "
        "with the line that the exercise began with."
    ),
    "not-a-function": _(
        "Give the name of your function without brackets after it: `go` is the function, "
        "`go(...)` is its answer."
    ),
    "no-base": _(
        "A class gets its abilities from the class that stands in brackets after its name, "
        "as in `class Patrol(Controller):`."
    ),
    "not-finite": _(
        "Somewhere a number was divided by 0, or grew without end. Which values can the "
        "divisor have?"
    ),
    "not-a-number": _(
        "A number is written without quotes, and it is neither True nor False. "
        "`print(type(x))` shows what a value is."
    ),
    "list-for-number": _(
        "One number was expected, and there is a list. `numbers[0]` is its first number, "
        "`len(numbers)` says how many there are, and `sum(numbers)` adds them up."
    ),
    "table-for-number": _(
        'One number was expected, and there is a table in curly brackets. `table["left"]` is '
        'the number that belongs to "left".'
    ),
    "number-for-list": _(
        "Several numbers were expected. They stand in square brackets, with commas between "
        "them: `[1, 0.5]`."
    ),
    "action": _(
        "An action is a table in curly brackets: the actuator's name in quotes, a colon, and "
        "a list of numbers. The message says which of them did not fit this robot."
    ),
    "list": _(
        "A list stands in square brackets, with commas between its parts: `[first, second]`. "
        "A list of one needs the brackets too."
    ),
    "called": _(
        "`connect(...)` takes a function to be called later. Brackets after a name call it "
        "now: write `lambda agent: ...` before it."
    ),
}
"""Hint by name of the diagnosis; an exercise's own diagnosis of the same name comes first."""

COMMON_ID = "any"
"""First part of the ids of these diagnoses."""


def diagnosis_id(exercise_id: str, name: str, own: Container[str]) -> str:
    """Return the id of a diagnosis, unique in the course and never changed.

    Args:
        exercise_id: such as ``"04.2"``.
        name: of the diagnosis; empty for an unknown mistake.
        own: the exercise's own hints, by name.

    >>> diagnosis_id("04.2", "narrow", {"narrow": "..."}), diagnosis_id("04.2", "", {})
    ('04.2/narrow', 'any/unknown')
    """
    if name and name in own:
        return f"{exercise_id}/{name}"
    return f"{COMMON_ID}/{name or UNKNOWN}"
