"""Everything that `solve` prints for a problem, formula by formula; two prints compared by value.

    python tests/bench/printed.py keep OUT.json [FILE.yaml…]     # of the whole library without files
    python tests/bench/printed.py quick OUT.json [FILE.yaml…]    # only what the rules are counted on
    python tests/bench/printed.py compare OLD.json NEW.json

A formula that is written in another shape must have the same value at every state that the
constraints allow: each pair is evaluated at random ones, at 50 digits.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

import mpmath
import sympy

from lagcli import load
from lagcli.algebra.numeric import Evaluator
from lagcli.expression import Expression, walk
from lagcli.formatters.grammar import to_grammar
from lagcli.pipeline import Request, derive, state
from lagcli.reader.expressions import parse_text

ROOT = Path(__file__).parents[2]
#: The sections whose formulas are counted; the candidates' charges are among the charges.
COUNTED = ("accelerations", "multipliers", "momenta", "energy", "hamiltonian", "charges")
#: All that is compared by value.
SECTIONS = (
    "lagrangian", "equations", *COUNTED[:2], "constraint_forces", *COUNTED[2:5],
    "canonical_equations", "charges", "find", "equilibria", "modes", "reduction", "steady_motions",
)  # fmt: skip
QUICK = ("lagrangian", *COUNTED, "constraint_forces", "find")
STATES = 3
DIGITS = 50
EQUAL = mpmath.mpf(10) ** -30


def formulas(value: object, path: str = "") -> Iterator[tuple[str, Expression]]:
    """Every formula inside a section, by the path of keys and places that leads to it."""
    match value:
        case Expression():
            yield path, value
        case tuple() | list():
            for place, part in enumerate(value):
                yield from formulas(part, f"{path}/{getattr(part, 'name', place)}")
        case Mapping():
            for key, part in value.items():
                yield from formulas(part, f"{path}/{key}")
        case _ if is_dataclass(value):
            for each in fields(value):
                yield from formulas(getattr(value, each.name), f"{path}/{each.name}")


def solved(path: Path, sections: tuple[str, ...]) -> dict[str, Expression]:
    """The printed formulas of one file."""
    found = state(derive(load(path)), Request(sections=sections)).sections
    return dict(formulas(dict(found)))


def library() -> list[Path]:
    """The files of the library."""
    return sorted((ROOT / "problems").rglob("*.yaml"))


def keep(out: Path, files: list[Path], sections: tuple[str, ...] = SECTIONS) -> None:
    """Write every formula of the files, and the seconds that each file took."""
    result = {}
    for path in files:
        began = time.process_time()
        try:
            found = {key: to_grammar(node) for key, node in solved(path, sections).items()}
        except Exception as error:  # noqa: BLE001 - a file that fails is part of the picture
            found = {"error": f"{type(error).__name__}: {error}"}
        name = str(path.resolve().relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)
        result[name] = {"seconds": time.process_time() - began, "formulas": found}
        print(f"{result[name]['seconds']:7.2f} {name}", flush=True)
    out.write_text(json.dumps(result, indent=0, ensure_ascii=False), "utf-8")


def compare(old: Path, new: Path) -> int:
    """Print every formula whose value changed, is new or is gone; how many changed."""
    before, after = (json.loads(p.read_text("utf-8")) for p in (old, new))
    changed = shapes = total = 0
    for file in sorted({*before} & {*after}):
        one, other = before[file]["formulas"], after[file]["formulas"]
        pairs = {key: (one[key], other[key]) for key in one if key in other}
        total += len(pairs)
        moved = {key: pair for key, pair in pairs.items() if pair[0] != pair[1]}
        shapes += len(moved)
        stated = {key.split("/")[1] for key in one} & {key.split("/")[1] for key in other}
        for key in sorted({*one} ^ {*other}):
            if key.split("/")[1] not in stated:
                continue
            print(f"{file} {key}: {'gone' if key in one else 'new'}: {(one | other)[key]}")
        for key, verdict in differing(ROOT / file, moved):
            changed += 1
            print(f"{file} {key}: {verdict}\n  {moved[key][0]}\n  {moved[key][1]}")
    print(f"{total} formulas in both, {shapes} written differently, {changed} with another value")
    return changed


def differing(path: Path, pairs: Mapping[str, tuple[str, str]]) -> Iterator[tuple[str, str]]:
    """The keys of the pairs whose values are not equal, or were not compared."""
    if not pairs:
        return
    derivation = derive(load(path))
    system, states = derivation.system, derivation.dynamics.states.take(STATES)
    for key, (a, b) in pairs.items():
        try:
            one, other = (_built(system, text) for text in (a, b))
        except Exception as error:  # noqa: BLE001 - said beside the formula
            yield key, f"not read: {error}"
            continue
        verdict = _verdict(one, other, states)
        if verdict:
            yield key, verdict


def _built(system, text: str):
    """The SymPy expression of a printed formula; unknown names (E, p_phi, alpha_1) are symbols."""
    tree = parse_text(text)
    known = system.build.names
    for part in walk(tree):
        name = getattr(part, "name", None)
        if name is not None and name not in known and name not in ("t", "pi"):
            known[name] = sympy.Symbol(name, positive=True)
    return system.build(tree)


def _verdict(one, other, states) -> str:
    evaluate = Evaluator([one, other], DIGITS)
    free = sorted(one.free_symbols | other.free_symbols, key=lambda s: s.name)
    compared = 0
    for number, at in enumerate(states):
        missing = {
            s: mpmath.mpf(7 * number + 3 * k + 11) / 17 for k, s in enumerate(free) if s not in at
        }
        try:
            with mpmath.workdps(DIGITS + 15):
                a, b = evaluate({**at, **missing})
        except (ArithmeticError, ValueError, KeyError, TypeError):
            continue
        if not (mpmath.isfinite(a) and mpmath.isfinite(b)):
            continue
        compared += 1
        if abs(a - b) > EQUAL * max(1, abs(a), abs(b)):
            return f"DIFFERENT: {mpmath.nstr(a, 8)} and {mpmath.nstr(b, 8)}"
    return "" if compared else "not compared"


def main() -> int:
    """Run one of the two commands."""
    command, *arguments = sys.argv[1:]
    paths = [Path(each) for each in arguments]
    if command in ("keep", "quick"):
        files = [p.resolve() for p in paths[1:]] or library()
        keep(paths[0], files, SECTIONS if command == "keep" else QUICK)
        return 0
    return 1 if compare(*paths) else 0


if __name__ == "__main__":
    sys.exit(main())
