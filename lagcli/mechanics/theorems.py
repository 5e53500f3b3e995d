"""The theorems that answers are justified by: hypotheses, source, and where they are checked.

`theorems.json` has their texts.  An answer names a theorem only where `checked_by` has found its
hypotheses fulfilled.
"""

from __future__ import annotations

import json
from pathlib import Path

from lagcli.record import record


@record
class Theorem:
    """A theorem of mechanics.

    Attributes
    ----------
    name
        As it is printed.
    hypotheses, conclusion
        In one sentence each.
    source
        Author, title, edition, section.
    checked_by
        Module and function (or property) that check the hypotheses.
    """

    name: str
    hypotheses: str
    conclusion: str
    source: str
    checked_by: str


_TEXTS = json.loads(Path(__file__).with_name("theorems.json").read_text("utf-8"))
THEOREMS = tuple(Theorem(**text) for text in _TEXTS)
_BY_NAME = {theorem.name: theorem for theorem in THEOREMS}

LAGRANGE_DIRICHLET = _BY_NAME["Lagrange and Dirichlet"]
ROUTH = _BY_NAME["Routh"]
KELVIN_TAIT_CHETAEV = _BY_NAME["Kelvin, Tait and Chetaev"]
LASALLE = _BY_NAME["LaSalle"]
KOZLOV = _BY_NAME["Kozlov"]
HURWITZ = _BY_NAME["Hurwitz"]
LYAPUNOV_MALKIN = _BY_NAME["Lyapunov and Malkin"]
