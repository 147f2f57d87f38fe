"""Teaching an agent in the page: a network learns from a person's drives, and then it drives."""

from ai4u_edu.teach.option import TeachOption

__all__ = ["TeachOption", "page_option"]

page_option = TeachOption
"""Makes the option for a world's page."""
