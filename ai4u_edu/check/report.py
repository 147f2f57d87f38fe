"""The report of a check."""

from dataclasses import dataclass, field
from enum import StrEnum

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.locale import Text, join, translate
from ai4u_edu.locale import gettext as _


class CheckError(AI4UError):
    """A block or a scene did not pass its check; the message is the report."""


class Outcome(StrEnum):
    """The result of one check."""

    PASSED = "passed"
    FAILED = "FAILED"
    WARNING = "warning"
    """Suspicious, but it may be intended, or the run was too short to tell."""
    NOT_APPLICABLE = "not applicable"


_OUTCOMES = {
    Outcome.PASSED: _("passed"),
    Outcome.FAILED: _("FAILED"),
    Outcome.WARNING: _("warning"),
    Outcome.NOT_APPLICABLE: _("not applicable"),
}


@dataclass(frozen=True, slots=True)
class Finding:
    """One check and its result."""

    check: str
    outcome: Outcome
    text: str = ""
    """Expected, got and how to mend it; or why the check doesn't apply. Empty if it passed."""

    def __str__(self) -> str:
        """Return the finding as one line, in the language of the terminal or notebook."""
        return translate(self.line)

    @property
    def line(self) -> str:
        """The finding as one line, as a text that can be translated."""
        line = Text(
            "{outcome:<14}  {check}", {"outcome": _OUTCOMES[self.outcome], "check": self.check}
        )
        return join([line, self.text], ": ") if self.text else line


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
        """True if no check failed; warnings are allowed."""
        return not self.failed

    @property
    def failed(self) -> list[Finding]:
        """The failed checks."""
        return [each for each in self.findings if each.outcome is Outcome.FAILED]

    def add(self, check: str, problem: str = "", *, outcome: Outcome | None = None) -> None:
        """Add a finding.

        Args:
            check: the check's name.
            problem: a description of what is wrong; empty if the check passed.
            outcome: given if the check neither passed nor failed.
        """
        found = outcome or (Outcome.FAILED if problem else Outcome.PASSED)
        self.findings.append(Finding(check, found, problem))

    def raise_for_findings(self) -> None:
        """Raise an error with the report as its message if a check failed.

        Raises:
            CheckError: at least one check failed.
        """
        if not self.ok:
            raise CheckError(self.text)

    def __str__(self) -> str:
        """Return :attr:`text` in the language of the terminal or notebook."""
        return translate(self.text)

    @property
    def text(self) -> str:
        """A summary line, then a line for each finding, as a text that can be translated."""
        failed, total = len(self.failed), len(self.findings)
        if failed:
            summary = _("{failed} of {total} checks failed", failed=failed, total=total)
        else:
            summary = _("in order ({total} checks)", total=total)
        lines = [Text("  {line}", {"line": each.line}) for each in self.findings]
        return join([join([self.subject, summary], ": "), *lines], "\n")
