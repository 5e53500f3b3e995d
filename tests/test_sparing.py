"""SymPy without its tensors, until somebody wants them."""

import subprocess
import sys

SUM = """
import sys
from lagcli.sparing import spare_tensors
spare_tensors()
from sympy import Symbol
x, y = Symbol("x"), Symbol("y")
assert str(x + y + x) == "2*x + y"
assert "sympy.combinatorics" not in sys.modules
"""

TENSORS = """
from sympy.tensor.tensor import TensorIndexType, TensorHead, TensExpr, tensor_indices
space = TensorIndexType("L", dim=3)
i, j = tensor_indices("i j", space)
A, B = TensorHead("A", [space]), TensorHead("B", [space])
from sympy import Add
assert str(Add(A(i), B(i))) == "A(i) + B(i)"
assert isinstance(Add(A(i), B(i)), TensExpr)
assert A(i) + A(i) == 2 * A(i)
assert "sympy.combinatorics" in sys.modules
spare_tensors()
assert A(i) + A(i) == 2 * A(i)
"""


def test_sums_load_no_tensors():
    subprocess.run([sys.executable, "-c", SUM], check=True)


def test_tensors_are_there_when_they_are_wanted():
    subprocess.run([sys.executable, "-c", SUM + TENSORS], check=True)
