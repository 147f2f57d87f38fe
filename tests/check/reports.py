"""Access to the findings of a check's report."""

from typing import Any

from ai4u_edu import Report
from ai4u_edu.check import Outcome

SHORT: dict[str, Any] = {"decisions": 20}
"""Arguments for a short run."""


def failed(report: Report) -> dict[str, str]:
    """Return the failed checks and their texts."""
    return {finding.check: finding.text for finding in report.failed}


def outcome(report: Report, check: str) -> tuple[Outcome, str]:
    """Return the outcome and the text of one check."""
    (finding,) = (each for each in report.findings if each.check == check)
    return finding.outcome, finding.text
