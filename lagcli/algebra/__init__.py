"""Normal forms and simplification made for mechanics, with no physics in it."""

from lagcli.algebra.derivative import derivative
from lagcli.algebra.entry import Field
from lagcli.algebra.leaves import to_expression
from lagcli.algebra.linear import LinearSolution, dot, left_nullspace, nullspace, rank, solve_linear
from lagcli.algebra.relations import Relations
from lagcli.algebra.shapes import Shapes
from lagcli.algebra.simplification import is_zero, shape, simplify
from lagcli.algebra.terms import terms

__all__ = [
    "Field",
    "LinearSolution",
    "Relations",
    "Shapes",
    "derivative",
    "dot",
    "is_zero",
    "left_nullspace",
    "nullspace",
    "rank",
    "shape",
    "simplify",
    "solve_linear",
    "terms",
    "to_expression",
]
