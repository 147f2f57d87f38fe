"""Values that blocks return, checked: texts of sensors and amounts of reward functions."""

from ai4u_edu.base.errors import ReadingError
from ai4u_edu.blocks import Sensor
from ai4u_edu.blocks.percept import Texts
from ai4u_edu.world import BodyView, WorldView


def read_text(sensor: Sensor, body: BodyView, view: WorldView) -> Texts:
    """Return the reading of a sensor of type sstring."""
    return str(sensor.read(body, view)) if sensor.is_active else ""


def read_texts(sensor: Sensor, body: BodyView, view: WorldView) -> Texts:
    """Return the reading of a sensor of type sstrings.

    Raises:
        ReadingError: the reading is not a list of texts.
    """
    if not sensor.is_active:
        return ()
    texts = sensor.read(body, view)
    if not isinstance(texts, list | tuple) or not all(isinstance(each, str) for each in texts):
        raise ReadingError(f"expected a list of texts, got {texts!r}")
    return tuple(texts)


def refuse_amount(amount: float) -> None:
    """Raise a ReadingError for an amount that is not finite."""
    raise ReadingError(f"expected a finite number, got {amount}")


def as_amount(value: object) -> float:
    """Return an amount that a reward function paid as a float.

    Raises:
        ReadingError: the amount is no number.
    """
    try:
        return float(value)  # type: ignore[arg-type]  # anything may come; the next line says so
    except (TypeError, ValueError):
        raise ReadingError(f"expected a number from on_update, got {value!r}") from None
