"""From results to text: every formatter is one pure function `render(answers, options)`.

None of them computes, and none of them imports SymPy, NumPy or rich.  How a section is
worded stands once in `sections`; how an expression is bracketed stands once in
`precedence`; a formatter adds only its own notation.
"""

from __future__ import annotations

from lagcli.formatters.options import Formatter, Options

__all__ = ["Formatter", "Options"]
