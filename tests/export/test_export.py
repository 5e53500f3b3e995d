"""Exported code is compiled, run, and compared with what lagcli computes itself."""

from __future__ import annotations

import ctypes
import math
import operator
import random
import re
import shutil
import subprocess
import sys

import pytest

import lagcli
from lagcli.cli.run import run
from lagcli.export import LANGUAGES, code_of
from lagcli.export.identifiers import identifiers
from lagcli.export.routines import SECTIONS
from lagcli.pipeline import Request, derive, state

#: With constraints, decimals, trigonometric functions, drives, damping, signs, charges, pi.
NAMES = ["kepler", "hoop", "double-pendulum", "spherical-pendulum-cartesian", "heavy-symmetric-top"]
MADE_UP = """
coordinates: [θ, y]
parameters: {lambda: {value: 2}, beta: {value: 1/3}, E: {value: 1.5}}
T: (θ'^2 + y'^2*(2 + cos(θ)))/2
V: E*abs(y)^3 + cot(θ + pi/3) + lambda*atan2(y, 2) + sinh(y)
dissipation: beta*θ'^2/2
forces: {y: cos(lambda*t) - sign(y')}
initial: {θ: 0.3, y: 0.2, y': 1}
"""


def exported(name, language, folder, capsysbinary):
    ending, _ = LANGUAGES[language]
    path = folder / f"mech{ending}"
    assert run(["export", str(name), "--to", language, "-o", str(path)]) == 0, (
        capsysbinary.readouterr().err
    )
    return path


@pytest.fixture(params=[*NAMES, "made-up"])
def problem(request, tmp_path):
    if request.param != "made-up":
        return request.param
    path = tmp_path / "made-up.yaml"
    path.write_text(MADE_UP)
    return path


def module_of(path):
    names = {}
    exec(compile(path.read_text("utf-8"), str(path), "exec"), names)
    return names


def random_arguments(count, of, seed=1):
    draw = random.Random(seed)
    return [
        0.4,
        [draw.uniform(0.2, 0.9) for _ in range(count)],
        [draw.uniform(0.5, 2) for _ in range(of)],
    ]


@pytest.mark.long
def test_python_gives_what_the_formulas_give(problem, tmp_path, capsysbinary):
    """rhs against the printed accelerations, evaluated by another route."""
    code = module_of(exported(problem, "python", tmp_path, capsysbinary))
    loaded = lagcli.load(problem)
    solved = lagcli.solve(loaded, ["accelerations"])
    t, y, p = random_arguments(len(code["STATE"]), len(code["PARAMETERS"]))
    coordinates = [one.name for one in loaded.coordinates]
    names = [*coordinates, *(f"{name}'" for name in coordinates)]
    values = dict(zip(names, y, strict=True)) | {"t": t}
    values |= dict(zip((one.name for one in loaded.parameters), p, strict=True))
    got = code["rhs"](t, y, p)
    for k, name in enumerate(coordinates):
        formula = solved.accelerations[name]
        expected = formula.to_numpy(formula.arguments)(
            *(values[each] for each in formula.arguments)
        )
        assert got[len(coordinates) + k] == pytest.approx(float(expected), rel=1e-11)
        assert got[k] == y[len(coordinates) + k]


@pytest.mark.long
def test_the_jacobian_is_the_derivative(problem, tmp_path, capsysbinary):
    """Against central differences of rhs."""
    code = module_of(exported(problem, "python", tmp_path, capsysbinary))
    t, y, p = random_arguments(len(code["STATE"]), len(code["PARAMETERS"]))
    jacobian = code["jacobian"](t, y, p)
    for k in range(len(y)):
        h = 1e-5
        up, down = ([*y[:k], y[k] + s * h, *y[k + 1 :]] for s in (1, -1))
        slope = (code["rhs"](t, up, p) - code["rhs"](t, down, p)) / (2 * h)
        assert jacobian[:, k] == pytest.approx(slope, rel=2e-7, abs=2e-7)


def test_matrices_and_multipliers_fit_together(tmp_path, capsysbinary):
    """M q'' = forcing + A^T lambda, A q'' + bias = 0 at a state on the constraint."""
    code = module_of(exported("spherical-pendulum-cartesian", "python", tmp_path, capsysbinary))
    p = [1.3, 9.81, 3.0, 1.0]
    y = [1.0, 2.0, -2.0, 2.0, -1.0, 0.0]
    q2 = code["rhs"](0, y, p)[3:]
    force = code["constraint_jacobian"](0, y, p).T @ code["multipliers"](0, y, p)
    left = code["mass_matrix"](0, y, p) @ q2
    assert left == pytest.approx(code["forcing"](0, y, p) + force, rel=1e-13)
    assert code["constraint_jacobian"](0, y, p) @ q2 + code["constraint_bias"](0, y, p) == (
        pytest.approx([0], abs=1e-12)
    )


def runge_kutta(f, y, p, until, steps):
    h = until / steps
    for k in range(steps):
        t = k * h
        a = f(t, y, p)
        b = f(t + h / 2, [u + h / 2 * v for u, v in zip(y, a, strict=True)], p)
        c = f(t + h / 2, [u + h / 2 * v for u, v in zip(y, b, strict=True)], p)
        d = f(t + h, [u + h * v for u, v in zip(y, c, strict=True)], p)
        y = [
            u + h / 6 * (e + 2 * g + 2 * i + j) for u, e, g, i, j in zip(y, a, b, c, d, strict=True)
        ]
    return y


def compiled_c(path, module):
    library = path.with_suffix(".so")
    subprocess.run(
        [
            "cc",
            "-std=c99",
            "-Wall",
            "-Werror",
            "-shared",
            "-fPIC",
            "-O1",
            str(path),
            "-lm",
            "-o",
            str(library),
        ],
        check=True,
    )
    loaded = ctypes.CDLL(str(library))

    def call(routine, size, t, y, p):
        out = (ctypes.c_double * size)()
        function = getattr(loaded, f"{module}_{routine}")
        function.restype = None
        function(
            ctypes.c_double(t),
            (ctypes.c_double * len(y))(*y),
            (ctypes.c_double * max(1, len(p)))(*p),
            out,
        )
        return list(out)

    return call


@pytest.mark.long
def test_c_gives_what_python_gives(problem, tmp_path, capsysbinary):
    code = module_of(exported(problem, "python", tmp_path, capsysbinary))
    call = compiled_c(exported(problem, "c", tmp_path, capsysbinary), "mech")
    t, y, p = random_arguments(len(code["STATE"]), len(code["PARAMETERS"]))
    for routine in ("rhs", "jacobian", "mass_matrix", "forcing", "energy"):
        expected = code[routine](t, y, p).ravel()
        assert call(routine, expected.size, t, y, p) == pytest.approx(
            list(expected), rel=1e-11, abs=1e-12
        )


@pytest.mark.long
@pytest.mark.parametrize("name", ["plane-pendulum", "kepler"])
def test_a_motion_by_the_exported_code_is_that_of_simulate(name, tmp_path, capsysbinary):
    """Four thousand steps of the classical Runge-Kutta method on the C code."""
    code = module_of(exported(name, "python", tmp_path, capsysbinary))
    call = compiled_c(exported(name, "c", tmp_path, capsysbinary), "mech")
    motion = lagcli.simulate(lagcli.load(name), 3, samples=2, show="coordinates,velocities")
    p = [0.0 if value is None else value for value in code["PARAMETERS"].values()]
    start = list(motion.rows[0][1:])
    end = runge_kutta(lambda t, y, q: call("rhs", len(y), t, y, q), start, p, 3.0, 4000)
    assert end == pytest.approx(list(motion.rows[-1][1:]), rel=1e-9, abs=1e-9)


FORTRAN_MAIN = """
program main
  use mech
  implicit none
  real(dp) :: out({n})
  call rhs({t}_dp, (/ &
    {y} /), (/ &
    {p} /), out)
  print '({n}(es25.17))', out
end program main
"""


def printed(values, suffix="", comma=", "):
    return comma.join(f"{value!r}{suffix}" for value in values)


@pytest.mark.long
@pytest.mark.skipif(not shutil.which("gfortran"), reason="gfortran is not there")
def test_fortran_gives_what_python_gives(problem, tmp_path, capsysbinary):
    code = module_of(exported(problem, "python", tmp_path, capsysbinary))
    path = exported(problem, "fortran", tmp_path, capsysbinary)
    t, y, p = random_arguments(len(code["STATE"]), len(code["PARAMETERS"]))
    main = tmp_path / "main.f90"
    main.write_text(
        FORTRAN_MAIN.format(
            n=len(y),
            t=t,
            y=printed(y, "_dp", ", &\n    "),
            p=printed(p or [0.0], "_dp", ", &\n    "),
        )
    )
    program = tmp_path / "program"
    subprocess.run(["gfortran", str(path), str(main), "-o", str(program)], check=True, cwd=tmp_path)
    out = subprocess.run([str(program)], check=True, capture_output=True, text=True).stdout
    assert [float(x) for x in out.split()] == pytest.approx(list(code["rhs"](t, y, p)), rel=1e-11)


@pytest.mark.long
@pytest.mark.skipif(not shutil.which("octave-cli"), reason="octave-cli is not there")
def test_matlab_gives_what_python_gives(problem, tmp_path, capsysbinary):
    code = module_of(exported(problem, "python", tmp_path, capsysbinary))
    exported(problem, "matlab", tmp_path, capsysbinary)
    t, y, p = random_arguments(len(code["STATE"]), len(code["PARAMETERS"]))
    call = f"f = mech(); printf('%.17g ', f.rhs({t}, [{printed(y)}], [{printed(p)}]))"
    done = subprocess.run(
        ["octave-cli", "--eval", call], check=True, capture_output=True, text=True, cwd=tmp_path
    )
    assert [float(x) for x in done.stdout.split()] == pytest.approx(
        list(code["rhs"](t, y, p)), rel=1e-11
    )


@pytest.mark.long
def test_sympy_gives_what_python_gives(problem, tmp_path, capsysbinary):
    import sympy

    code = module_of(exported(problem, "python", tmp_path, capsysbinary))
    matrices = module_of(exported(problem, "sympy", tmp_path, capsysbinary))
    t, y, p = random_arguments(len(code["STATE"]), len(code["PARAMETERS"]))
    values = dict(zip([*code["STATE"], *code["PARAMETERS"], "t"], [*y, *p, t], strict=True))
    put_in = {sympy.Symbol(name, real=True): value for name, value in values.items()}
    found = [float(entry.subs(put_in)) for entry in matrices["rhs"]]
    assert found == pytest.approx(list(code["rhs"](t, y, p)), rel=1e-11)


def test_sympy_gets_the_formulas_exactly(tmp_path, capsysbinary):
    """1/3 and pi stay what they are, and 1/2 does not become 0.5."""
    path = tmp_path / "exact.yaml"
    path.write_text("coordinates: [x]\nT: x'^2/2\nV: (x^2/3)^(1/3) + cos(pi*x)/7 + sqrt(2)*x")
    matrices = module_of(exported(path, "sympy", tmp_path, capsysbinary))
    problem = lagcli.load(path)
    answers = state(derive(problem), Request(sections=SECTIONS))
    for routine in code_of(problem, answers, "mech").routines:
        assert tuple(matrices[routine.name]) == routine.formulas


ROLLING = """
coordinates: [x, y, phi, psi]
parameters: {R: {value: 1/2}}
T: (x'^2 + y'^2)/2 + phi'^2/8 + psi'^2/4
constraints:
  along: {equation: x' = R*psi'*cos(phi)}
  across: {equation: y' = R*psi'*sin(phi)}
initial: {phi: 0, phi': 1, psi': 2}
"""


def test_the_start_is_on_the_constraints(tmp_path, capsysbinary):
    """A velocity that the file leaves out is the one that a run begins with, not 0."""
    path = tmp_path / "rolling.yaml"
    path.write_text(ROLLING)
    code = module_of(exported(path, "python", tmp_path, capsysbinary))
    assert code["STATE"]["x_dot"] == 1.0
    text = exported(path, "modelica", tmp_path, capsysbinary).read_text("utf-8")
    assert "x_dot(start = 1.0, fixed = true)" in text


@pytest.mark.parametrize(("language", "first"), [("matlab", 1), ("fortran", 1), ("c", 0)])
def test_the_head_counts_as_the_language_does_and_names_what_is_left_out(
    language, first, tmp_path, capsysbinary
):
    text = exported("bouncing-ball", language, tmp_path, capsysbinary).read_text("utf-8")
    assert min(re.findall(r"y\[(\d)\]: ", text)) == str(first)
    assert "motion between impacts" in text
    assert "contacts" in capsysbinary.readouterr().err.decode()


@pytest.mark.long
def test_mathematica_is_read_back_by_sympys_parser(problem, tmp_path, capsysbinary):
    """The steps of rhs, evaluated as they stand in the file."""
    import sympy
    from sympy.parsing.mathematica import parse_mathematica

    code = module_of(exported(problem, "python", tmp_path, capsysbinary))
    text = exported(problem, "mathematica", tmp_path, capsysbinary).read_text()
    t, y, p = random_arguments(len(code["STATE"]), len(code["PARAMETERS"]))
    body = text.split("Module[", 1)[1].split("\n]\n", 1)[0]
    settings, *steps, result = [line.strip() for line in body.strip().splitlines()]
    values = {"t": t}
    for setting in settings.strip("{},").split(", "):
        name, _, place = setting.partition(" = ")
        if place:
            values[name] = (y if place.startswith("y") else p)[int(place[3:-2]) - 1]

    def value(found):
        put_in = found.subs({each: values[str(each)] for each in found.free_symbols})
        return float(
            put_in.replace(lambda e: e.func.__name__ == "Abs", lambda e: sympy.Abs(*e.args))
        )  # the parser leaves Abs undefined

    for step in steps:
        name, _, formula = step.rstrip(";").partition(" = ")
        values[name] = value(parse_mathematica(formula))
    got = [value(each) for each in parse_mathematica(result)]
    assert got == pytest.approx(list(code["rhs"](t, y, p)), rel=1e-10)


OPERATORS = {
    "+": operator.add, "-": lambda *x: x[0] - x[1] if len(x) > 1 else -x[0], "*": operator.mul,
    "/": operator.truediv, "//": operator.truediv, "^": operator.pow, "abs": abs, "sign": lambda x: (x > 0) - (x < 0),
}  # fmt: skip


class Model:
    """A Modelica model as pymoca reads it, at a state: names stand for numbers or equations."""

    def __init__(self, text, values):
        from pymoca.parser import parse

        *_, self.model = parse(text).classes.values()
        self.values = dict(values)
        self.equations = {str(each.left): each.right for each in self.model.equations}

    def __call__(self, node):
        if hasattr(node, "operator"):
            name = str(node.operator)
            function = OPERATORS.get(name) or getattr(math, name)
            return function(*map(self, node.operands))
        if hasattr(node, "value"):
            return node.value
        name = str(node)
        if name not in self.values:
            self.values[name] = self(self.equations[name])
        return self.values[name]

    def rates(self):
        derivatives = (e for e in self.model.equations if hasattr(e.left, "operator"))
        return {str(each.left.operands[0]): self(each.right) for each in derivatives}


@pytest.mark.long
def test_modelica_gives_what_python_gives(problem, tmp_path, capsysbinary):
    """Read by a compiler of Modelica, evaluated equation by equation."""
    code = module_of(exported(problem, "python", tmp_path, capsysbinary))
    text = exported(problem, "modelica", tmp_path, capsysbinary).read_text()
    t, y, p = random_arguments(len(code["STATE"]), len(code["PARAMETERS"]))
    values = dict(zip([*code["STATE"], *code["PARAMETERS"], "time"], [*y, *p, t], strict=True))
    rates = Model(text, values).rates()
    assert [rates[name] for name in code["STATE"]] == pytest.approx(
        list(code["rhs"](t, y, p)), rel=1e-11
    )


class Julia:
    """A function of a module as tree-sitter's grammar of Julia reads it, on numbers."""

    def __init__(self, text):
        import tree_sitter
        import tree_sitter_julia

        language = tree_sitter.Language(tree_sitter_julia.language())
        root = tree_sitter.Parser(language).parse(text.encode()).root_node
        assert not root.has_error
        [module] = root.named_children[-1:]
        self.functions = {
            each.named_children[0].named_children[0].named_children[0].text.decode(): each
            for each in module.named_children
            if each.type == "function_definition"
        }

    def __call__(self, name, t, y, p):
        values = {"t": t, "y": y, "p": p, "pi": math.pi}
        _, *steps, last = self.functions[name].named_children
        for step in steps:
            place, _, formula = step.named_children
            values[place.text.decode()] = self.value(formula, values)
        return self.value(last.named_children[0], values)

    def value(self, node, values):
        parts = [each for each in node.named_children if each.type != "operator"]
        text = node.text.decode()
        match node.type:
            case "identifier":
                return values[text]
            case "integer_literal" | "float_literal":
                return float(text)
            case "parenthesized_expression":
                return self.value(parts[0], values)
            case "matrix_expression" | "vector_expression" | "matrix_row" | "argument_list":
                return [self.value(part, values) for part in parts]
            case "index_expression":
                [place] = self.value(parts[1], values)
                return self.value(parts[0], values)[int(place) - 1]
            case "call_expression":
                name = node.named_children[0].text.decode()
                function = OPERATORS.get(name) or getattr(math, name)
                return function(*self.value(parts[-1], values))
            case "unary_expression" | "binary_expression":
                [operator] = [each for each in node.named_children if each.type == "operator"]
                given = (self.value(part, values) for part in parts)
                return OPERATORS[operator.text.decode()](*given)
        raise AssertionError(node.type)


@pytest.mark.long
def test_julia_gives_what_python_gives(problem, tmp_path, capsysbinary):
    """Read by a grammar of Julia that editors use, evaluated step by step."""
    code = module_of(exported(problem, "python", tmp_path, capsysbinary))
    julia = Julia(exported(problem, "julia", tmp_path, capsysbinary).read_text())
    t, y, p = random_arguments(len(code["STATE"]), len(code["PARAMETERS"]))
    for name in julia.functions:
        expected, found = code[name](t, y, p), julia(name, t, y, p)
        assert len(found) == len(expected)
        entries = [x for row in found for x in (row if isinstance(row, list) else [row])]
        assert entries == pytest.approx(list(expected.ravel()), rel=1e-11, abs=1e-12)


@pytest.mark.long
@pytest.mark.parametrize("language", ["julia", "modelica"])
def test_no_name_of_the_file_is_left_that_the_language_does_not_have(
    language, problem, tmp_path, capsysbinary
):
    text = exported(problem, language, tmp_path, capsysbinary).read_text()
    comments = ("#", '"', "//")
    lines = [line for line in text.splitlines() if not line.startswith(comments)]
    assert all(line.isascii() and "'" not in line for line in lines)
    code = "\n".join(lines)
    assert not any(word in code for word in ("**", ".*", "Abs(", "cot(", "Derivative", "Piecewise"))


def test_an_unspecified_function_has_no_code(tmp_path, capsysbinary):
    path = tmp_path / "p.yaml"
    path.write_text("{coordinates: [x], functions: {U: [x]}, T: x'^2/2, V: U(x)}")
    assert run(["export", str(path), "--to", "c"]) == 1
    assert b"U is left unspecified" in capsysbinary.readouterr().err


def test_mistakes_are_answered(tmp_path, capsysbinary):
    assert run(["export", "kepler", "--to", "pyton"]) == 2
    assert b"did you mean 'python'" in capsysbinary.readouterr().err
    assert run(["export", "keppler", "--to", "c"]) == 2
    (tmp_path / "bad.yaml").write_text("T: 1")
    assert run(["export", str(tmp_path / "bad.yaml"), "--to", "c"]) == 2


@pytest.mark.parametrize("seed", range(20))
def test_identifiers_are_distinct_and_words_of_no_language(seed):
    draw = random.Random(seed)
    letters = "xyzθφΘE_IlambdaNQλ"
    names = {
        "".join(draw.choice(letters[:8]) for _ in range(draw.randint(1, 3))) for _ in range(12)
    }
    names |= {"lambda", "end", "if", "E", "e", "y", "p", "t", "θ", "theta", "M", "m"}
    found = identifiers(sorted(names))
    assert len({word.casefold() for word in found.values()}) == len(names)
    assert all(word.isidentifier() and word.isascii() for word in found.values())
    assert not {"lambda", "end", "if", "y", "p", "t"} & set(found.values())


@pytest.mark.long
def test_the_same_input_gives_the_same_bytes(tmp_path):
    done = [
        subprocess.run([sys.executable, "-m", "lagcli", "export", "double-pendulum", "--to", "c"],
                       capture_output=True, check=True, env={"PYTHONHASHSEED": seed, "PATH": ""}).stdout
        for seed in ("1", "2")
    ]  # fmt: skip
    assert done[0] == done[1]
    assert done[0]
