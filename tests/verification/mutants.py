"""Changes of a sign, a factor, a term, a condition in the program, and which of them an answer shows.

    python -m tests.verification.mutants [--count 200] [--seed 1]

A mutant is one change of one expression in the packages below.  It solves
some of the problems below that reach its line, without and with the verification.

It *changes an answer* where a sheet claims something else than before (`tests.verification.meaning`:
lists by what they hold, formulas by their values).  It is *noticed* where none of these claims
is printed after the verification, which withholds it or warns of its section; otherwise it
*escaped*.  Where the derivation itself refuses (null, undecided, not complete, with its
sentence in the warnings or as the section's reason) nothing wrong is printed: such mutants are
*refused*, and count neither as changed nor as noticed.  A null without a sentence escaped.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import resource
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

from tests.verification.meaning import Difference, Meaning
from tests.verification.sites import ROOT, Mutating, Site, sites

PACKAGES = ("lagcli/mechanics", "lagcli/algebra", "lagcli/graph", "lagcli/notation")
#: Explanations and numbers of runs are no answers of `solve`.
LEFT_OUT = ("explaining", "float_states")
#: CPU seconds after which a mutant is stopped: most problems take one or two.
LIMIT = 60
#: Problems that each mutant solves.
EACH = 3

ASKED: dict[str, tuple[str, ...]] = {
    "hoop": (
        "lagrangian", "equations", "matrix_form", "accelerations", "multipliers",
        "constraint_forces", "momenta", "energy", "hamiltonian", "canonical_equations",
        "charges", "find", "equilibria", "dimensions",
    ),
    "pendulums/pendulum-cartesian": (
        "accelerations", "multipliers", "constraint_forces", "charges", "equilibria",
    ),
    "nonholonomic/chaplygin-sleigh": ("equations", "accelerations", "multipliers", "charges"),
    "oscillations/damped-oscillator": (
        "accelerations", "energy", "charges", "canonical_equations", "modes",
    ),
    "central/kepler": ("accelerations", "hamiltonian", "charges", "reduction", "dimensions"),
    "classics/spherical-pendulum": ("accelerations", "charges", "equilibria", "steady_motions"),
    "chains/coupled-pendulums": ("accelerations", "equilibria", "modes"),
    "pulleys/atwood-tension": ("accelerations", "multipliers", "forces"),
    "steady/bead-on-rotating-hoop": ("accelerations", "equilibria", "reduction", "steady_motions"),
    "hamilton-jacobi/kepler-polar": ("hamilton_jacobi", "hamiltonian"),
    "hamilton-jacobi/anisotropic-oscillator": ("hamilton_jacobi",),
    "hamiltonian/brackets-of-angular-momentum": ("brackets",),
    "hamiltonian/oscillator-by-generating-function": ("canonical", "brackets"),
    "symmetry/free-particle": ("discovered", "algebra", "dimensions", "charges"),
    "particles/isotropic-oscillator": ("discovered", "algebra"),
    "contact/mass-sliding-off-sphere": ("accelerations", "energy", "find"),
    "driven/pendulum-horizontal-drive": ("equations", "accelerations", "energy", "charges"),
    "rolling/disk-on-incline": ("equations", "accelerations", "multipliers", "charges", "model"),
    "oscillations/coupled-oscillators": ("hamiltonian", "equilibria", "modes"),
    "stability/ziegler-pendulum": ("accelerations", "equilibria"),
}  # fmt: skip


# -- answers ------------------------------------------------------------------------------------


def solved(name: str, before: Any = None) -> dict[str, Any]:
    """One problem as it is derived, and, where that is not as before, as it is then printed."""
    from lagcli import load, pipeline
    from lagcli.formatters.built_in.json import to_object
    from lagcli.verification import verified

    pipeline.VERIFYING = False
    try:
        derivation = pipeline.derive(load(ROOT / f"problems/{name}.yaml"))
        answers = pipeline.state(derivation, pipeline.Request(sections=ASKED[name]))
        derived = json.loads(json.dumps(to_object(answers)))
        if derived == before:
            return {"derived": derived}
        printed = verified(derivation.problem, answers)
        warnings = [w for w in printed.warnings if w not in answers.warnings]
        return {"derived": derived, "printed": to_object(printed), "warnings": warnings}
    except Exception as error:  # noqa: BLE001 - a mutant may do anything
        return {"error": f"{type(error).__name__}: {error}"[:200]}


def in_a_process(work: Any) -> dict[str, Any]:
    """What a generator of (name, found) gives in a process of its own, until its end or limit."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))
        sys.stderr = open(os.devnull, "w")  # noqa: PTH123, SIM115 - to the end of the process
        with os.fdopen(writing, "w") as out:
            try:
                for name, found in work():
                    print(json.dumps([name, found]), file=out, flush=True)
            except BaseException as error:  # noqa: BLE001
                print(json.dumps(["", {"error": repr(error)[:200]}]), file=out, flush=True)
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as lines:
        found = dict(json.loads(line) for line in lines if line.endswith("\n"))
    os.waitpid(child, 0)
    return found


# -- before any change ----------------------------------------------------------------------------


def untouched() -> dict[str, Any]:
    """Each problem's sheet and the lines that it reaches, kept between runs of one program."""
    files = [p for p in sorted((ROOT / "lagcli").rglob("*.py")) if "verification" not in p.parts]
    sources = "".join(p.read_text() for p in files) + repr(ASKED)
    key = hashlib.sha256(sources.encode()).hexdigest()[:16]
    kept = Path(tempfile.gettempdir()) / f"mutants-{key}.json"
    if kept.exists():
        return json.loads(kept.read_text())  # type: ignore[no-any-return]
    found: dict[str, Any] = {}
    for name in ASKED:
        found |= in_a_process(lambda name=name: _traced(name))
        assert "error" not in found[name], (name, found[name])
    kept.write_text(json.dumps(found))
    return found


def _traced(name: str) -> Iterator[tuple[str, Any]]:
    lines: dict[str, set[int]] = {}
    _trace(lines)
    found = solved(name)
    sys.settrace(None)
    yield name, {**found, "lines": {file: sorted(each) for file, each in lines.items()}}


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


@dataclass
class Outcome:
    """What came of one mutant: the problems that it solved, by what they show."""

    site: Site
    changed: dict[str, list[str]]
    escaped: dict[str, list[str]]
    refused: list[str]
    failed: list[str]

    @property
    def kind(self) -> str:
        """Escaped before noticed before refused before failed; else unchanged."""
        if self.escaped:
            return "escaped"
        if self.changed:
            return "noticed"
        return "refused" if self.refused else "failed" if self.failed else "unchanged"


def outcome(site: Site, before: dict[str, Any], names: Sequence[str]) -> Outcome:
    """Solve with one mutant and compare."""

    def work() -> Iterator[tuple[str, Any]]:
        sys.meta_path.insert(0, Mutating(site))
        for name in names:
            yield name, solved(name, before[name]["derived"])

    after = in_a_process(work)
    result = Outcome(site, {}, {}, [], [])
    for name in names:
        if "printed" in after.get(name, {}):
            judge(result, name, before[name]["derived"], after[name])
        elif "derived" not in after.get(name, {}):
            result.failed.append(name)
    return result


def judge(result: Outcome, name: str, before: Any, after: Any) -> None:
    """What one problem shows of a mutant."""
    from lagcli import load

    problem = load(ROOT / f"problems/{name}.yaml")
    derived = Meaning(problem, before, after["derived"]).differences()
    wrong = [d for d in derived if not _said(d, before, after["derived"])]
    if not wrong:
        result.refused += [name] if derived else []
        return
    result.changed[name] = [str(d) for d in wrong]
    printed = Meaning(problem, before, after["printed"]).differences()
    left = [
        d
        for d in printed
        if not _said(d, before, after["printed"]) and not _warned(d, after["warnings"])
    ]
    if left:
        result.escaped[name] = [str(d) for d in left]


def _said(difference: Difference, before: Any, sheet: Any) -> bool:
    """Whether an answer that claims less has its sentence: a new warning, or a new reason."""
    path, _, rest = difference.path.partition(":")
    open_ = [sum(map(_is_open, each.get("modes") or ())) for each in (before, sheet)]
    if path == "modes" and open_[1] > open_[0] and int(rest.split()[-2]) <= open_[1]:
        return True  # "No closed form was found for 2 frequencies."
    if difference.kind == "wrong" and not rest.endswith(" 0 others"):
        return False
    if difference.kind == "weaker" and path.endswith(UNDECIDED):
        return True
    section = path.split("/")[0]
    reasons = [set(_reasons(each.get(section))) for each in (before, sheet)]
    return bool(set(sheet["warnings"]) - set(before["warnings"])) or not reasons[1] <= reasons[0]


def _is_open(mode: dict[str, Any]) -> bool:
    """Whether it says that frequencies have no closed form."""
    return not any(
        mode.get(key) for key in ("frequency", "frequency_squared", "decay", "exponents")
    )


def _reasons(part: Any) -> Iterator[str]:
    """Every reason and note of a section."""
    if isinstance(part, list):
        for each in part:
            yield from _reasons(each)
    elif isinstance(part, dict):
        said = (v for k, v in part.items() if k in {"reason", "note", "ansatz"} and v)
        yield from (v for v in said if isinstance(v, str))
        for each in part.values():
            yield from _reasons(each)


#: A null here is the word "undecided", or claims nothing.
UNDECIDED = (
    "/stable", "/minimum", "/hurwitz", "/spectrum", "/unstable", "/name", "/named", "/integrable", "/in_involution", "/separable", "/turning_points",
    "/generator",
)  # fmt: skip

#: The sentence that says that a list may not hold everything.
_OTHERS = {"equilibria": "no other equilibrium", "steady_motions": "no other steady motion",
           "discovered": "no other", "modes": "normal modes about all",
           "reduction/one_freedom/periods": "periods about all"}  # fmt: skip


def _warned(difference: Difference, warnings: Sequence[str]) -> bool:
    """Whether the verification says that a list does not hold everything."""
    section, _, rest = difference.path.partition(":")
    said = _OTHERS.get(section)
    return bool(rest) and said is not None and any(said in each for each in warnings)


def sampled(count: int, seed: int, before: dict[str, Any]) -> list[tuple[Site, list[str]]]:
    """Random sites, each with some of the problems that reach it, those first that few share."""
    reached: dict[str, set[int]] = {}
    for each in before.values():
        for file, lines in each["lines"].items():
            reached.setdefault(file, set()).update(lines)
    random, every = Random(seed), sites(reached)
    found = []
    for site in random.sample(every, min(count, len(every))):
        names = [n for n, b in before.items() if site.line in b["lines"].get(site.file, ())]
        found.append((site, random.sample(names, min(EACH, len(names)))))
    return found


def run(count: int, seed: int) -> Iterator[Outcome]:
    """The outcome of random mutants."""
    import sympy  # noqa: F401 - in all processes

    before = untouched()
    for site, names in sampled(count, seed, before):
        yield outcome(site, before, names)


def main() -> None:
    """Print each mutant and the share that was noticed."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    kinds: Counter[str] = Counter()
    for each in run(arguments.count, arguments.seed):
        kinds[each.kind] += 1
        shown = {"escaped": each.escaped, "noticed": each.changed}.get(each.kind)
        what = {n: places[:3] for n, places in (shown or {}).items()}
        print(f"{each.kind:9} {each.site} {what or each.refused or each.failed or ''}", flush=True)
    changed = kinds["noticed"] + kinds["escaped"]
    print(dict(kinds), f"noticed {kinds['noticed']} of {changed} that change an answer")


if __name__ == "__main__":
    main()
