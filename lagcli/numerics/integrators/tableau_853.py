"""The coefficients of DOP853, from the table beside this file: {stage: coefficient}, from 1.

Stages 1 to 12 make the step, 13 is the rate at its end, 14 to 16 belong to the dense
output alone.

References
----------
Hairer, Norsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., section II.5
and the tables of the code DOP853 in the appendix.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

Row = dict[int, float]


def _by_stage(given: dict[str, Any]) -> dict[Any, Any]:
    return {int(key) if key.isdecimal() else key: value for key, value in given.items()}


_TABLE: dict[str, Any] = json.loads(
    Path(__file__).with_suffix(".json").read_bytes(), object_hook=_by_stage
)
#: c_i: where in the step a stage stands
NODES: Row = _TABLE["nodes"]
#: a_ij; the row of stage 13 holds the weights b_j of the step itself
STAGES: dict[int, Row] = _TABLE["stages"]
#: the differences to the embedded methods of order 5 and 3
ERROR_5: Row = _TABLE["error_5"]
ERROR_3: Row = _TABLE["error_3"]
#: the four highest coefficients of the interpolation
DENSE: list[Row] = _TABLE["dense"]
