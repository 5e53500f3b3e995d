"""Text to a checked `Problem`: YAML nodes with positions, expressions, names.

Reading runs nothing of what it reads.
"""

from lagcli.reader.expressions import parse_equation_text, parse_text
from lagcli.reader.problem_file import Reading, read_problem
from lagcli.reader.settings import set_parameters, set_state

__all__ = [
    "Reading",
    "parse_equation_text",
    "parse_text",
    "read_problem",
    "set_parameters",
    "set_state",
]
