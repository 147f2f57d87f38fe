"""A student's program, loaded and asked for decisions in the page and outside it alike.

The package uses the standard library alone and imports no other package of ai4u_edu, so that the
page can give it to the Python that runs in a browser.
"""

from ai4u_edu.program.mistakes import ProgramError
from ai4u_edu.program.output import PrintedOutput
from ai4u_edu.program.portable import obstacle_in
from ai4u_edu.program.program import Program
from ai4u_edu.program.reading import Reading, Readings, readings_of

__all__ = [
    "PrintedOutput",
    "Program",
    "ProgramError",
    "Reading",
    "Readings",
    "obstacle_in",
    "readings_of",
]
