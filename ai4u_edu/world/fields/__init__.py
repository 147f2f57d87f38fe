"""Fields that are generated for each episode from its seed: mazes, lines, and rescue lines."""

from typing import Annotated

from pydantic import Field

from ai4u_edu.world.fields.field import FieldBase, GeneratedField
from ai4u_edu.world.fields.line import GAP_SHARE, LineField
from ai4u_edu.world.fields.maze import MazeField
from ai4u_edu.world.fields.rescue import RescueField

__all__ = [
    "GAP_SHARE",
    "AnyField",
    "FieldBase",
    "FieldDescription",
    "GeneratedField",
    "LineField",
    "MazeField",
    "RescueField",
]

AnyField = MazeField | LineField | RescueField
FieldDescription = Annotated[AnyField, Field(discriminator="type")]
