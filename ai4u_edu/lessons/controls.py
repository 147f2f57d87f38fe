"""``sliders`` and ``cards``: exercises that are solved without code, with widgets in a notebook."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.optional_deps import has
from ai4u_edu.lessons.checking import check_as
from ai4u_edu.lessons.exercise import find
from ai4u_edu.lessons.filming import film, film_check
from ai4u_edu.lessons.notebook_output import card, in_notebook, put, tell
from ai4u_edu.lessons.student_errors import mistake_in
from ai4u_edu.lessons.time_limit import TimeLimit, TimeLimitError
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, translate
from ai4u_edu.scenes import Scene

STEPS = 40
"""Steps of a slider from end to end."""
MISSING = _(
    "The sliders need ipywidgets, which is not installed: "
    '`pip install "ai4u-edu[lessons]"`. You can solve the exercise with code as well.'
)
SLIDERS_LEAD = _("Move the sliders, then press Try or Check.")
CARDS_LEAD = _("Tick some boxes, move their sliders, then press Try or Check.")
RUN_AGAIN = _("If nothing happens, run this cell again.")
NOTHING_TO_FILM = _("This exercise has nothing to film. Press Check.")

Range = tuple[float, float]
Make = Callable[..., Any]


def sliders(
    exercise_id: str, make: Make, *, preview: Callable[[Any], Any] | None = None, **ranges: Range
) -> None:
    """Show a slider for each number of an exercise, a button to try them and one to check.

    Args:
        exercise_id: such as ``"05.2"``.
        make: gets the numbers by name; returns what the exercise's ``check`` takes.
        preview: gets what ``make`` returned, and shows it, or returns a world to be filmed; left
            out, the first world of the check is filmed.
        ranges: lowest and highest value of each number, by name.

    Raises:
        SetupError: there is no such exercise, or a range is none.
    """
    _show(exercise_id, make, preview, ranges, has_switches=False)


def cards(
    exercise_id: str, make: Make, *, preview: Callable[[Any], Any] | None = None, **ranges: Range
) -> None:
    """Show a card for each number: as ``sliders`` does, with a box that switches it on.

    Args:
        exercise_id: such as ``"09.2"``.
        make: gets the numbers that are on, by name; the others are left out of the call.
        preview: as in ``sliders``.
        ranges: lowest and highest value of each number, by name.

    Raises:
        SetupError: there is no such exercise, or a range is none.
    """
    _show(exercise_id, make, preview, ranges, has_switches=True)


def _show(
    exercise_id: str,
    make: Make,
    preview: Callable[[Any], Any] | None,
    ranges: Mapping[str, Range],
    *,
    has_switches: bool,
) -> None:
    find(exercise_id)
    for name, (low, high) in ranges.items():
        if not low < high:
            raise SetupError(
                _(
                    "{name}: expected (lowest, highest), got {value}",
                    name=name,
                    value=str((low, high)),
                )
            )
    words = translate(
        _(
            "{exercise}: {names} can be set in JupyterLab.",
            exercise=exercise_id,
            names=", ".join(ranges),
        )
    )
    if not has("ipywidgets"):
        tell("grey", _("No sliders."), [MISSING])
    elif not in_notebook():
        put("", words)
    else:
        from IPython import display

        lead = CARDS_LEAD if has_switches else SLIDERS_LEAD
        put(
            f"<p>{translate(join([lead, RUN_AGAIN]))}</p>", words
        )  # stays in a saved notebook; widgets don't
        show: Any = display.display
        show(Controls(exercise_id, make, preview, ranges, has_switches=has_switches).panel)


class Controls:
    """Widgets that set the numbers of an exercise.

    Args:
        exercise_id: id of the exercise.
        make: gets the numbers by name; returns what the exercise's check takes.
        preview: gets what ``make`` returned, and shows it; None films the check.
        ranges: lowest and highest value of each number, by name.
        has_switches: whether each number can be switched on and off; all begin off.
    """

    def __init__(
        self,
        exercise_id: str,
        make: Make,
        preview: Callable[[Any], Any] | None,
        ranges: Mapping[str, Range],
        *,
        has_switches: bool,
    ) -> None:
        import ipywidgets as widgets

        self._exercise, self._make, self._preview = find(exercise_id), make, preview
        self._sliders = {name: _slider(name, *ends) for name, ends in ranges.items()}
        self._switches: dict[str, Any] = {}
        rows: list[Any] = list(self._sliders.values())
        if has_switches:
            rows = [self._switched(name, slider) for name, slider in self._sliders.items()]
        self._buttons = [
            widgets.Button(
                description=translate(_("Try")), tooltip=translate(_("Show what these numbers do"))
            ),
            widgets.Button(
                description=translate(_("Check")),
                tooltip=translate(_("Check the exercise")),
                button_style="primary",
            ),
        ]
        for button, answer in zip(self._buttons, (self._try, self._check), strict=True):
            button.on_click(partial(self._pressed, answer))
        self._output = widgets.Output()
        self.panel = widgets.VBox([*rows, widgets.HBox(self._buttons), self._output])
        """Widget with all others in it."""

    @property
    def numbers(self) -> dict[str, float]:
        """Return the numbers that are on, by name."""
        return {
            name: round(slider.value, 6)
            for name, slider in self._sliders.items()
            if name not in self._switches or self._switches[name].value
        }

    def _switched(self, name: str, slider: Any) -> Any:
        import ipywidgets as widgets

        switch = widgets.Checkbox(
            description=name, indent=False, layout=widgets.Layout(width="12em")
        )
        slider.description, slider.disabled = "", True
        slider.value = (slider.min + slider.max) / 2  # a card that is switched on does something

        def follow(change: Any) -> None:
            slider.disabled = not change["new"]

        switch.observe(follow, names="value")
        self._switches[name] = switch
        layout = widgets.Layout(
            border="1px solid #c9ced4", padding="4px 8px", margin="2px 0", max_width="40em"
        )
        return widgets.HBox([switch, slider], layout=layout)

    def _pressed(self, answer: Callable[[Any], None], _button: object) -> None:
        for each in self._buttons:
            each.disabled = True
        self._output.clear_output(wait=True)
        try:
            with self._output, TimeLimit() as limit:
                try:
                    answer(self._make(**self.numbers))
                except TimeLimitError:
                    _stopped(limit.text)
                except (Exception, SystemExit) as error:
                    mistake = mistake_in(error)
                    _stopped(
                        f"{type(error).__name__}: {error}" if mistake is None else mistake.text
                    )
        finally:
            for each in self._buttons:
                each.disabled = False

    def _try(self, made: Any) -> None:
        if self._preview is None:
            if not film_check(self._exercise, made):
                page = card("grey", _("Nothing to film."), [NOTHING_TO_FILM])
                put(page, translate(NOTHING_TO_FILM))
            return
        world = self._preview(made)
        if isinstance(world, ControlRequestor | Scene):
            film(world)

    def _check(self, made: Any) -> None:
        numbers = ", ".join(f"{name}={number:g}" for name, number in self.numbers.items())
        check_as(self._exercise.id, made, code=f"# set with sliders or cards: {numbers}")


def _slider(name: str, low: float, high: float) -> Any:
    import ipywidgets as widgets

    step = (high - low) / STEPS
    digits = next((each for each in range(4) if abs(step - round(step, each)) < 1e-9), 4)
    return widgets.FloatSlider(
        value=min(max(0.0, low), high),
        min=low,
        max=high,
        step=step,
        description=name,
        readout_format=f".{digits}f",
        continuous_update=False,
        style={"description_width": "8em"},
        layout=widgets.Layout(width="32em"),
    )


def _stopped(text: str) -> None:
    tell("vermillion", _("Stopped."), [text])
