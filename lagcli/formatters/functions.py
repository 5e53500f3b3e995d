"""The names of functions on paper."""

from __future__ import annotations

#: Functions whose powers stand behind their names: sin²(x), ln²(x).
POWERED = frozenset(("sin", "cos", "tan", "cot", "sec", "csc", "sinh", "cosh", "tanh", "log"))

#: Those that have another name on paper than in the grammar.
ON_PAPER = {
    "log": "ln",
    "sign": "sgn",
    "asin": "arcsin",
    "acos": "arccos",
    "atan": "arctan",
    "asinh": "arsinh",
    "acosh": "arcosh",
    "atanh": "artanh",
}

#: Functions whose names are set upright.
FIXED = POWERED | {"exp", "atan2", *ON_PAPER}
