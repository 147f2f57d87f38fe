"""Explanations in the page: why an agent acts as it does, what if, and maps over the floor."""

from ai4u_edu.explain.page.option import ExplainOption

__all__ = ["ExplainOption", "page_option"]

page_option = ExplainOption
"""Makes the option of a world's page; see :mod:`ai4u_edu.base.options`."""
