"""What a check found."""

from dataclasses import dataclass, field
from enum import StrEnum

from ai4u_edu.base.errors import AI4UError


class CheckError(AI4UError):
    """A block or a scene did not pass its check; the message is the report."""


class Outcome(StrEnum):
    """How one of the checks went."""

    PASSED = "passed"
    FAILED = "FAILED"
    WARNING = "warning"
    """It may be meant so, or the run was too short to tell."""
    NOT_APPLICABLE = "not applicable"


@dataclass(frozen=True, slots=True)
class Finding:
    """One of the checks, and how it went."""

    check: str
    outcome: Outcome
    text: str = ""
    """What was expected, what came, how to mend it; or why it doesn't apply. Empty if passed."""

    def __str__(self) -> str:
        """One line."""
        return f"{self.outcome:<14}  {self.check}" + (f": {self.text}" if self.text else "")


@dataclass
class Report:
    """All findings about one block or scene.

    >>> report = Report("MySensor 'my'")
    >>> report.add("finite", "expected finite numbers, got [nan]")
    >>> report.add("documented")
    >>> print(report)
    MySensor 'my': 1 of 2 checks failed
      FAILED          finite: expected finite numbers, got [nan]
      passed          documented
    """

    subject: str
    """The block's class and name, or the scene's name."""
    findings: list[Finding] = field(default_factory=list)

    @property
    def ok(self) -> bool:
        """Whether no check failed; warnings are allowed."""
        return not self.failed

    @property
    def failed(self) -> list[Finding]:
        """The findings that have to be mended."""
        return [each for each in self.findings if each.outcome is Outcome.FAILED]

    def add(self, check: str, problem: str = "", *, outcome: Outcome | None = None) -> None:
        """Adds a finding.

        Args:
            check: what was looked at.
            problem: what is wrong; nothing for a check that passed.
            outcome: if it is neither passed nor failed.
        """
        found = outcome or (Outcome.FAILED if problem else Outcome.PASSED)
        self.findings.append(Finding(check, found, problem))

    def raise_for_findings(self) -> None:
        """Raises the report if a check failed.

        Raises:
            CheckError: at least one check failed.
        """
        if not self.ok:
            raise CheckError(str(self))

    def __str__(self) -> str:
        """A line in short, then a line a finding."""
        failed, total = len(self.failed), len(self.findings)
        short = f"{failed} of {total} checks failed" if failed else f"in order ({total} checks)"
        return "\n".join([f"{self.subject}: {short}", *(f"  {each}" for each in self.findings)])
