"""One call of a job, where it runs: its result or its error, and the time that it took."""

import json
import time
import traceback
from pathlib import Path
from typing import Any, NamedTuple

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.games.jobs.job import Job

MAX_ERROR_CHARS = 2000


class JobAnswer(NamedTuple):
    """Result of a call, or its error."""

    result: Any = None
    error: str = ""
    seconds: float = 0.0
    """Duration; 0 where the process died with the job."""
    can_retry: bool = True
    """False if another try would end in the same way."""


def call(job: Job) -> JobAnswer:
    """Run a job, and return its error instead of raising it."""
    begin = time.perf_counter()
    try:
        # as a journal would give it back: lists for tuples, texts for keys
        result = json.loads(json.dumps(job.run()))
    except AI4UError as error:  # wrong arguments stay wrong
        return JobAnswer(None, text_of(error), time.perf_counter() - begin, can_retry=False)
    except Exception as error:  # it is reported, and the other jobs go on
        last = traceback.extract_tb(error.__traceback__)[-1]
        text = f"{type(error).__name__}: {error} ({Path(last.filename).name}:{last.lineno})"
        return JobAnswer(None, text[:MAX_ERROR_CHARS], time.perf_counter() - begin)
    return JobAnswer(result, "", time.perf_counter() - begin)
