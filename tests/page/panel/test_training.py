"""Progress of a training through the panel's socket."""

from ai4u_edu.runtime.training_progress import CurvePoint, TrainingProgress
from tests.page.panel.rooms import panel_room

POINT = CurvePoint(decisions=500, reward=12.5, success=0.25)


def test_a_page_follows_a_training() -> None:
    with panel_room() as room, room.page() as page:
        room.runner.training = TrainingProgress(decisions=500, total=2000, is_over=False, curve=())
        told = page.part("training", points=[])
        assert told["text"] == "Learned from 500 of 2,000 decisions so far."
        assert told["share"] == 0.25
        room.runner.training = TrainingProgress(
            decisions=2000, total=2000, is_over=True, curve=(POINT,)
        )
        told = page.part("training", is_over=True)
        assert told["points"] == [[500, 12.5, 0.25]]
        assert told["text"] == (
            "Training is over after 2,000 decisions. The best policy drives now."
        )
