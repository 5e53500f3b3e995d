"""What is spared is there the moment it is used, and nothing is answered differently."""

import os
import subprocess
import sys

import pytest
from sympy.core import numbers

START = "from lagcli.sparing import spare_sympy; spare_sympy(); import sys; "


def told(code, **environment):
    run = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        env={**os.environ, **environment},
        check=False,
    )
    assert run.returncode == 0, run.stderr
    return run.stdout


def test_symbols_and_functions_import_no_solvers_integrals_or_geometry():
    code = (
        START + "from sympy import Symbol, sin; sin(Symbol('x')); "
        "print([m for m in ('integrals.manualintegrate', 'solvers.ode', 'geometry.point', 'sets.conditionset')"
        "if 'sympy.' + m in sys.modules])"
    )
    assert told(code).strip() == "[]"


@pytest.mark.long
@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("Matrix([[1, 2], [3, 4]]).det()", "-2"),
        ("integrate(x**2, (x, 0, 1))", "1/3"),
        ("Integral(sin(x), (x, 0, pi)).evalf(3)", "2.00"),
        ("isinstance(MatrixSymbol('A', 2, 2) * 2, MatrixExpr)", "True"),
        ("Sum(1 / x**2, (x, 1, 3)).doit()", "49/36"),
        ("minimal_polynomial(sqrt(2), x)", "x**2 - 2"),
        ("solve(x**2 - 4, x)", "[-2, 2]"),
        ("expand_func(binomial(x, 2))", "x*(x - 1)/2"),
        ("cos(3 * acos(x)).expand(trig=True)", "4*x**3 - 3*x"),
        ("bernoulli(4)", "-1/30"),
        ("rf(Poly(x, x), 2)", "Poly(x**2 + x, x, domain='ZZ')"),
        ("factor(x**2 - 1)", "(x - 1)*(x + 1)"),
        ("limit(sin(x) / x, x, 0)", "1"),
        ("sin(x).series(x, 0, 4)", "x - x**3/6 + O(x**4)"),
        ("AccumBounds(1, 2) + 1", "AccumBounds(2, 3)"),
        ("(Q.real, ask(Q.real(pi)))", "(Q.real, True)"),
        ("(Reals.contains(1), EmptySet)", "(True, EmptySet)"),
    ],
)
@pytest.mark.parametrize("whole", ["", "1"])
def test_what_is_asked_for_is_sympys_own(expression, value, whole):
    code = START + f"from sympy import *; x = Symbol('x'); print({expression})"
    names = "from sympy.matrices.expressions import MatrixExpr; print("
    if expression.startswith("isinstance"):
        code = code.replace("print(", names)
    assert told(code, LAGCLI_WHOLE_SYMPY=whole).strip() == value


#: Where a class is that SymPy's core recognises, and a name there.
RECOGNISED = (
    "calculus.accumulationbounds.AccumBounds concrete.products.Product concrete.summations.Sum "
    "functions.special.polynomials.chebyshevt integrals.integrals.Integral "
    "matrices.expressions.matexpr.MatrixExpr matrices.matrixbase.MatrixBase "
    "sets.setexpr.SetExpr tensor.tensor.TensExpr"
).split()
AT_WORK = (
    "assert abs(Integral(sin(x), (x, 0, pi)).evalf() - 2) < 1e-9; "
    "assert abs(Sum(1 / x**2, (x, 1, 3)).evalf() - 49 / 36) < 1e-9; "
    "assert abs(Product(x, (x, 1, 4)).evalf() - 24) < 1e-9; "
    "assert sin(AccumBounds(0, pi)) == AccumBounds(0, 1); assert x + AccumBounds(1, 1) == x + 1; "
    "assert Matrix([x**2]).diff(x) == Matrix([2 * x]); assert cos(3 * acos(x)).expand(trig=True) == 4 * x**3 - 3 * x; "
    "A, B = MatrixSymbol('A', 2, 3), MatrixSymbol('B', 3, 2); assert (2 * A * B).shape == (2, 2); "
    "assert (A + A) == 2 * A; assert (sqrt(2) + sqrt(3) - sqrt(5 + 2 * sqrt(6))).is_zero"
)


@pytest.mark.long
@pytest.mark.parametrize("place", RECOGNISED)
@pytest.mark.parametrize(
    "before", ["sin(pi / 7).evalf(3)", "(x * y + sin(x) * sqrt(y)).diff(x, 2)", "exp(x).is_real"]
)
def test_what_is_recognised_without_its_module_works_when_it_is_there(place, before):
    module, _, name = f"sympy.{place}".rpartition(".")
    told(
        f"{START}from sympy import Symbol, exp, pi, sin, sqrt; x, y = map(Symbol, 'xy'); {before}; "
        f"from {module} import {name}; from sympy import *; {AT_WORK}"
    )


@pytest.mark.long
def test_every_name_of_every_package_is_the_one_that_sympy_hands_out():
    packages = (
        "sympy sympy.functions sympy.polys sympy.ntheory sympy.sets sympy.matrices sympy.series "
        "sympy.solvers sympy.simplify sympy.integrals sympy.printing sympy.logic sympy.tensor "
        "sympy.calculus sympy.concrete sympy.assumptions sympy.discrete sympy.geometry"
    )
    code = (
        "import importlib\n"
        f"for package in {packages.split()!r}:\n"
        "    module = importlib.import_module(package)\n"
        "    for name in NAMES(module):\n"
        "        found = getattr(module, name)\n"
        "        where = getattr(found, '__module__', None)\n"
        "        print(package, name, type(found).__name__, where)\n"
    )
    lazily = told(
        "from lagcli.sparing import spare_sympy\nspare_sympy()\n"
        + code.replace("NAMES(module)", "sorted(module.__all__)")
    )
    wholly = told(code.replace("NAMES(module)", "sorted(vars(module))"))
    ours, theirs = (
        {tuple(line.split()[:2]): line for line in lines.splitlines()} for lines in (lazily, wholly)
    )
    assert len(ours) > 900
    different = {
        key: (line, theirs.get(key)) for key, line in ours.items() if theirs.get(key) != line
    }
    assert not different


@pytest.mark.long
@pytest.mark.parametrize(
    "problem",
    ["hoop", "central/kepler", "pendulums/double-pendulum", "nonholonomic/skate-on-incline"],
)
def test_the_answers_are_the_same_with_the_whole_of_sympy(problem, tmp_path):
    def answered(whole):
        run = subprocess.run(
            [sys.executable, "-m", "lagcli", "solve", "--no-cache", f"problems/{problem}.yaml"],
            capture_output=True,
            env={**os.environ, "LAGCLI_WHOLE_SYMPY": whole},
            check=True,
        )
        return run.stdout

    assert answered("") == answered("1")


@pytest.mark.long
def test_what_there_is_one_of_is_there_at_its_first_use():
    """Nobody asks for `S.Reals` by its module: each name alone, in a process of its own."""
    code = (
        "from sympy import S; import sympy; "
        "print(*sorted(n for n in {*vars(type(S)), *S._classes_to_install} if n[0].isupper()))"
    )
    names = told(code).split()
    assert {"Reals", "EmptySet", "Half"} <= set(names)
    asked = "; ".join(f"from sympy import S; print(S.{name})" for name in names)
    whole = told(asked).splitlines()
    for name, value in zip(names, whole, strict=True):
        if not hasattr(numbers, name):  # every process has these
            assert told(f"{START}from sympy import S; print(S.{name})").strip() == value


@pytest.mark.parametrize(
    "first", ["concrete.products", "concrete.summations", "integrals.integrals"]
)
def test_numbers_are_worked_out_whatever_is_read_first_once_there_are_some(first):
    """The table of numerical methods asks for these modules, and is there at the first number."""
    code = (
        START + "from sympy import Symbol, sqrt; sqrt(2).evalf()\n"
        f"import sympy.{first} as first; first.Expr, first.S\n"
        "from sympy import Integral, Product, Sum; x = Symbol('x')\n"
        "print(*(f(x, (x, 1, 2)).evalf(3) for f in (Integral, Product, Sum)))"
    )
    assert told(code).split() == ["1.50", "2.00", "3.00"]
