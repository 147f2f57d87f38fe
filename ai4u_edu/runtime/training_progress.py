"""State of a training that a page shows: decisions so far, and the learning curve."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Share = Annotated[float, Field(ge=0, le=1)]


class CurvePoint(BaseModel):
    """One evaluation of the policy on the way, a point of the learning curve."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    decisions: Annotated[int, Field(ge=0, description="decisions learned from until then")]
    reward: Annotated[float, Field(description="mean reward of an episode")]
    success: Annotated[
        Share | None,
        Field(description="share of episodes that reached the goal; null in a scene without one"),
    ]


class TrainingProgress(BaseModel):
    """Progress of a training whose policy drives in the world of a page."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    decisions: Annotated[int, Field(ge=0, description="decisions learned from so far")]
    total: Annotated[int, Field(ge=0, description="decisions after which it ends at the latest")]
    is_over: Annotated[bool, Field(description="true once the finished policy drives")]
    curve: tuple[CurvePoint, ...]
    easy_starts: Annotated[
        Share | None,
        Field(description="way from easy starts to all starts; null in a scene without easy ones"),
    ] = None
