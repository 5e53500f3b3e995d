"""The equations of a problem as code: one function a quantity, in several languages.

Every function takes the time t, the state y (coordinates, then velocities) and the parameters
p in the order of the file.  Subexpressions that occur more than once are computed once.
"""

from __future__ import annotations

from lagcli.export.languages import LANGUAGES, render
from lagcli.export.routines import Code, NoCode, code_of

__all__ = ["LANGUAGES", "Code", "NoCode", "code_of", "render"]
