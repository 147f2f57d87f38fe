"""Jobs: pure functions of data, run here, in other processes, or on other machines.

A job that was done once is not run again (:class:`Journal`); one whose process or machine dies is
tried again (:func:`run_jobs`). See ``docs/adr/0012-jobs-on-three-engines.md``.
"""

from ai4u_edu.games.jobs.engine import Engine, engine
from ai4u_edu.games.jobs.job import Job, JobOutcome
from ai4u_edu.games.jobs.journal import Journal
from ai4u_edu.games.jobs.run_jobs import TRIES, run_jobs

__all__ = ["TRIES", "Engine", "Job", "JobOutcome", "Journal", "engine", "run_jobs"]
