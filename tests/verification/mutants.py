"""Changes of a sign, a factor, a term in the program, and which of them an answer shows.

    python -m tests.verification.mutants [--count 200] [--seed 1]

A mutant is one change of one expression in `lagcli.mechanics` or `lagcli.algebra`, in a line
that the problems below reach.  Each solves all of them in a process of its own, with and
without the verification.  It *changes an answer* where a formula has another value than before
at a random state, or a verdict is another; it is *noticed* where the verification withholds or
warns of it.
"""

from __future__ import annotations

import argparse
import ast
import copy
import json
import os
import resource
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import spec_from_loader
from pathlib import Path
from random import Random
from types import ModuleType
from typing import Any

ROOT = Path(__file__).parents[2]
PACKAGES = ("lagcli/mechanics", "lagcli/algebra")
#: Explanations and numbers of runs are no answers of `solve`.
LEFT_OUT = ("explaining", "float_states")
#: CPU seconds after which a mutant is stopped: all problems take some four.
LIMIT = 60

ASKED: dict[str, tuple[str, ...]] = {
    "hoop": (
        "lagrangian", "equations", "matrix_form", "accelerations", "multipliers",
        "constraint_forces", "momenta", "energy", "hamiltonian", "canonical_equations",
        "charges", "find", "equilibria",
    ),
    "pendulums/pendulum-cartesian": ("accelerations", "multipliers", "constraint_forces", "charges"),
    "nonholonomic/chaplygin-sleigh": ("equations", "accelerations", "multipliers", "charges"),
    "oscillations/damped-oscillator": ("accelerations", "energy", "charges", "canonical_equations"),
    "central/kepler": ("accelerations", "hamiltonian", "charges", "reduction"),
    "classics/spherical-pendulum": ("accelerations", "charges", "equilibria", "steady_motions"),
    "chains/coupled-pendulums": ("accelerations", "equilibria", "modes"),
    "pulleys/atwood-tension": ("accelerations", "multipliers", "forces"),
}  # fmt: skip


# -- sites ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class Site:
    """One change: the module's file, the number of the node in it, what is done, the line."""

    file: str
    node: int
    change: str
    line: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line} {self.change}"


def changes_of(node: ast.AST) -> list[str]:
    """What can be done to a node."""
    match node:
        case ast.BinOp(op=ast.Add()):
            return ["a + b -> a - b", "a + b -> a", "a + b -> b"]
        case ast.BinOp(op=ast.Sub()):
            return ["a - b -> a + b", "a - b -> a"]
        case ast.BinOp(op=ast.Mult()):
            return ["a*b -> a", "a*b -> b"]
        case ast.BinOp(op=ast.Div()):
            return ["a/b -> a", "a/b -> a*b"]
        case ast.UnaryOp(op=ast.USub(), operand=operand) if not isinstance(operand, ast.Constant):
            return ["-a -> a"]
        case ast.Call(args=[ast.Starred(), *_]) if _name(node.func) in {"Add", "Mul"}:
            return ["the first term is dropped"]
        case ast.Call(args=[_, _, *_]) if _name(node.func) in {"Add", "Mul"}:
            return ["the first term is dropped"]
        case ast.Attribute(attr="One" | "NegativeOne" | "Half"):
            return ["S.One -> -S.One"]
    return []


def _name(node: ast.AST) -> str:
    match node:
        case ast.Attribute(attr=name) | ast.Name(id=name):
            return name
    return ""


def changed(node: Any, change: str) -> ast.AST:
    """The node with the change made."""
    left, right = getattr(node, "left", None), getattr(node, "right", None)
    match change:
        case "a + b -> a - b":
            return ast.BinOp(left, ast.Sub(), right)
        case "a - b -> a + b":
            return ast.BinOp(left, ast.Add(), right)
        case "a + b -> b" | "a*b -> b":
            return right
        case "a + b -> a" | "a - b -> a" | "a*b -> a" | "a/b -> a":
            return left
        case "a/b -> a*b":
            return ast.BinOp(left, ast.Mult(), right)
        case "-a -> a":
            return node.operand
        case "S.One -> -S.One":
            return ast.UnaryOp(ast.USub(), node)
    return _without_first(node)


def _without_first(node: ast.Call) -> ast.Call:
    call = copy.deepcopy(node)
    first = call.args[0]
    if isinstance(first, ast.Starred):
        listed = ast.Call(ast.Name("list", ast.Load()), [first.value], [])
        rest = ast.Subscript(listed, ast.Slice(ast.Constant(1), None, None), ast.Load())
        call.args[0] = ast.Starred(rest, ast.Load())
    else:
        del call.args[0]
    return call


def sites(reached: dict[str, set[int]]) -> list[Site]:
    """Every change of a line that is reached."""
    found = []
    for file in sorted(reached):
        tree = ast.parse((ROOT / file).read_text())
        skipped = set(_of_annotations(tree))
        for number, node in enumerate(ast.walk(tree)):
            line = getattr(node, "lineno", 0)
            if line in reached[file] and id(node) not in skipped:
                found += [Site(file, number, change, line) for change in changes_of(node)]
    return found


def _of_annotations(tree: ast.AST) -> Iterator[int]:
    """Texts put together are no mathematics; neither are types."""
    for node in ast.walk(tree):
        texts = (ast.JoinedStr,)
        if isinstance(node, ast.BinOp):
            parts = list(ast.walk(node))
            if any(isinstance(p, texts) or (isinstance(p, ast.Constant) and isinstance(p.value, str))
                   for p in parts):  # fmt: skip
                yield id(node)


# -- a mutated program ------------------------------------------------------------------------


class Mutating(MetaPathFinder, Loader):
    """Imports one module with one node changed."""

    def __init__(self, site: Site) -> None:
        self.site = site
        self.module = site.file.removesuffix(".py").removesuffix("/__init__").replace("/", ".")

    def find_spec(self, fullname: str, path: Any, target: Any = None) -> ModuleSpec | None:
        del path, target
        if fullname != self.module:
            return None
        file = str(ROOT / self.site.file)
        package = file.endswith("__init__.py")
        spec = spec_from_loader(fullname, self, origin=file, is_package=package)
        if package and spec is not None:
            spec.submodule_search_locations = [str(Path(file).parent)]
        return spec

    def exec_module(self, module: ModuleType) -> None:
        file = ROOT / self.site.file
        module.__file__ = str(file)
        tree = ast.parse(file.read_text())
        node = list(ast.walk(tree))[self.site.node]
        new = ast.copy_location(changed(copy.deepcopy(node), self.site.change), node)
        tree = ast.fix_missing_locations(_Replace(node, new).visit(tree))
        exec(compile(tree, str(file), "exec"), module.__dict__)


class _Replace(ast.NodeTransformer):
    def __init__(self, old: ast.AST, new: ast.AST) -> None:
        self.old, self.new = old, new

    def visit(self, node: ast.AST) -> ast.AST:
        return self.new if node is self.old else self.generic_visit(node)


# -- answers ------------------------------------------------------------------------------------


def solve_all(asked: dict[str, tuple[str, ...]]) -> dict[str, Any]:
    """Each problem as it is derived, and as it is printed after the verification."""
    from lagcli.formatters.json import to_object
    from lagcli.pipeline import _statements, derive, load
    from lagcli.verification import verified

    found: dict[str, Any] = {}
    for name, sections in asked.items():
        try:
            derivation = derive(load(ROOT / f"problems/{name}.yaml"))
            answers = _statements(derivation).answers(sections)
            printed = verified(derivation.problem, answers)
            found[name] = {"derived": to_object(answers), "printed": to_object(printed)}
            found[name]["noticed"] = len(printed.warnings) > len(answers.warnings)
        except Exception as error:  # noqa: BLE001 - a mutant may do anything
            found[name] = {"error": f"{type(error).__name__}: {error}"[:200]}
    return found


def in_a_process(site: Site | None, asked: dict[str, tuple[str, ...]]) -> dict[str, Any] | None:
    """What `solve_all` gives in a process of its own; None where it did not end."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))
        sys.stderr = open(os.devnull, "w")  # noqa: PTH123, SIM115 - to the end of the process
        if site is not None:
            sys.meta_path.insert(0, Mutating(site))
        with os.fdopen(writing, "w") as out:
            try:
                json.dump(solve_all(asked), out)
            except BaseException as error:  # noqa: BLE001
                json.dump({name: {"error": repr(error)[:200]} for name in asked}, out)
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as lines:
        text = lines.read()
    os.waitpid(child, 0)
    return json.loads(text) if text else None


def reached_lines(asked: dict[str, tuple[str, ...]]) -> dict[str, set[int]]:
    """The lines of each module that the problems reach (in a process of its own)."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        lines: dict[str, set[int]] = {}
        _trace(lines)
        solve_all(asked)
        sys.settrace(None)
        with os.fdopen(writing, "w") as out:
            json.dump({file: sorted(each) for file, each in lines.items()}, out)
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as text:
        found = json.load(text)
    os.waitpid(child, 0)
    return {file: set(lines) for file, lines in found.items()}


def _trace(lines: dict[str, set[int]]) -> None:
    wanted: dict[str, str | None] = {}

    def file_of(name: str) -> str | None:
        if name not in wanted:
            try:
                file = str(Path(name).relative_to(ROOT))
            except ValueError:
                file = ""
            mine = file.startswith(PACKAGES) and not any(part in file for part in LEFT_OUT)
            wanted[name] = file if mine else None
        return wanted[name]

    def tracer(frame: Any, event: str, argument: Any) -> Any:
        file = file_of(frame.f_code.co_filename)
        if file is None or frame.f_code.co_name == "<module>":
            return None
        known = lines.setdefault(file, set())

        def local(frame: Any, event: str, argument: Any) -> Any:
            known.add(frame.f_lineno)
            return local

        return local(frame, event, argument)

    sys.settrace(tracer)


# -- what a mutant did ------------------------------------------------------------------------------

#: Prose, which no arithmetic verifies.
PROSE = {"where", "reason", "warnings", "ansatz", "note", "title"}


def differences(name: str, before: Any, after: Any) -> list[str]:
    """Where the answers differ as mathematics, by paths; a null instead is no difference."""
    return list(_differ(_Compared(name, before, after), "", before, after))


def _differ(compared: _Compared, path: str, a: Any, b: Any) -> Iterator[str]:
    if b is None or a == b:
        return
    if isinstance(a, dict) and isinstance(b, dict):
        for key in a.keys() | b.keys():
            if key not in PROSE:
                yield from _differ(compared, f"{path}/{key}", a.get(key), b.get(key))
    elif isinstance(a, list) and isinstance(b, list):
        if len(a) != len(b):
            yield path
            return
        for place, (one, other) in enumerate(zip(a, b, strict=True)):
            yield from _differ(compared, f"{path}/{place}", one, other)
    elif not (isinstance(a, str) and isinstance(b, str) and compared.equal(a, b)):
        yield path


class _Compared:
    """Values of two formulas at two random states of a problem, by the tests' oracle."""

    def __init__(self, name: str, before: Any, after: Any) -> None:
        from lagcli.pipeline import load
        from tests.oracle.examine import with_momenta
        from tests.oracle.reference import Reference
        from tests.oracle.states import random_states

        self.reference = Reference(load(ROOT / f"problems/{name}.yaml"))
        states = random_states(self.reference, 3)
        self.moments = [with_momenta(self.reference, s) for s in states]
        self.where = [each.get("where", {}) for each in (before, after)]
        self.loose = [s.moment.shifted(2, {0: 1, len(s.accelerations) - 1: 2}) for s in states]

    def equal(self, a: str, b: str) -> bool:
        from lagcli.reader import parse_equation_text
        from tests.oracle.examine import agree

        try:
            first, second = parse_equation_text(a), parse_equation_text(b)
            pairs = [(first.left, second.left), (first.right, second.right)]
            if "=" in a:
                one = [self._values(side, 0) for side in (first.left, first.right)]
                two = [self._values(side, 1) for side in (second.left, second.right)]
                gaps = zip(*one, *two, strict=True)
                return all(agree(p - q, r - s) for p, q, r, s in gaps)
            return all(
                agree(x, y)
                for one, two in pairs
                for x, y in zip(self._values(one, 0), self._values(two, 1), strict=True)
            )
        except Exception:  # noqa: BLE001 - no value, so not the same
            return False

    def _values(self, node: Any, which: int) -> list[Any]:
        from dataclasses import replace

        from mpmath import mpf

        from lagcli.expression import Name, walk
        from lagcli.reader import parse_text
        from tests.oracle.jets import real_part

        values = []
        for moment in self.moments:
            known = moment
            for name, text in self.where[which].items():
                value = real_part(self.reference.of(parse_text(text))(known))
                known = replace(known, extra={**known.extra, name: value})
            names = {p.name for p in walk(node) if isinstance(p, Name)}
            free = names - set(self.reference.names) - {"t", "pi"} - set(known.extra)
            extra = {n: mpf(len(n) * 7 + ord(n[-1]) % 11 + 13) / 19 for n in free}
            there = replace(known, extra={**known.extra, **extra})
            values.append(real_part(self.reference.of(node)(there)))
        return values


@dataclass
class Outcome:
    """What came of one mutant."""

    site: Site
    ended: bool
    wrong: dict[str, list[str]]
    escaped: dict[str, list[str]]

    @property
    def kind(self) -> str:
        """Unchanged, noticed, escaped, or did not end."""
        if not self.ended:
            return "no end"
        if not self.wrong:
            return "unchanged"
        return "escaped" if self.escaped else "noticed"


def outcome(site: Site, before: dict[str, Any], asked: dict[str, tuple[str, ...]]) -> Outcome:
    """Solve with one mutant and compare: an answer that is wrong and still printed escaped."""
    after = in_a_process(site, asked)
    result = Outcome(site, after is not None, {}, {})
    for name, found in (after or {}).items():
        if "error" in found:
            continue
        was = before[name]["derived"]
        wrong = differences(name, was, found["derived"])
        if wrong:
            result.wrong[name] = wrong
            printed = differences(name, was, found["printed"])
            if printed:
                result.escaped[name] = printed
    return result


def sampled(count: int, seed: int) -> Sequence[Site]:
    """Random sites."""
    every = sites(reached_lines(ASKED))
    return Random(seed).sample(every, min(count, len(every)))


def run(count: int, seed: int) -> list[Outcome]:
    """The outcome of random mutants."""
    import sympy  # noqa: F401 - in all processes

    before = in_a_process(None, ASKED)
    assert before is not None
    wrong = {name: each["error"] for name, each in before.items() if "error" in each}
    assert not wrong, wrong
    found = []
    for site in sampled(count, seed):
        each = outcome(site, before, ASKED)
        found.append(each)
        if __name__ == "__main__":
            places = dict(list(each.escaped.items())[:3])
            print(f"{each.kind:9} {site} {places or ''}", flush=True)
    return found


def main() -> None:
    """Print each mutant and the share that was noticed."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    found = run(arguments.count, arguments.seed)
    kinds = Counter(each.kind for each in found)
    changed = kinds["noticed"] + kinds["escaped"]
    print(dict(kinds), f"noticed {kinds['noticed']} of {changed} that change an answer")


if __name__ == "__main__":
    main()
