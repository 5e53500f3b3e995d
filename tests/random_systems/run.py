"""Random systems, solved and judged: `python -m tests.random_systems.run --count 500`.

One worker imports once and forks for each system, so that a crash or a hang is one system's.
"""

from __future__ import annotations

import argparse
import gc
import importlib
import json
import os
import pkgutil
import random
import resource
import sys
import traceback
from collections import Counter
from dataclasses import asdict
from pathlib import Path

import lagcli
from lagcli.diagnostics import ProblemError
from lagcli.formatters.built_in.json import to_object
from lagcli.pipeline import Request, derive, read, state

from .judge import Finding, Judge
from .kinds import KINDS
from .system import System

LIMIT = 60


def system(kind: str, number: int) -> System:
    """The system of a kind and a number, always the same."""
    made = KINDS[kind](random.Random(f"{kind} {number}"))
    made.kind, made.seed = kind, number
    return made


def answer(made: System) -> dict:
    """What lagcli says of it, as JSON; {"refused": sentences} where it refuses."""
    found = read(made.kind, made.text.encode())
    if found.problem is None:
        return {"refused": [each.message for each in found.diagnostics]}
    try:
        answers = state(derive(found.problem), Request(sections=tuple(made.sections)))
    except ProblemError as error:
        return {"refused": [each.message for each in error.diagnostics]}
    return json.loads(json.dumps(to_object(answers)))


def judged(made: System) -> list[Finding]:
    """What is wrong or missing in what lagcli says of a system."""
    try:
        sheet = answer(made)
    except Exception:  # noqa: BLE001 - a crash is a finding
        return [Finding("crash", "", traceback.format_exc(limit=-3))]
    if "refused" in sheet:
        if not made.known.get("valid", True):
            return []
        judge = Judge(made, {"warnings": []}, count=1)
        if not judge.states:
            return []  # no regular state is known, so that nothing contradicts it
        return [Finding("wrong", "refused", " / ".join(sheet["refused"]))]
    if not made.known.get("valid", True):
        return [Finding("wrong", "accepted", "no state satisfies the constraints")]
    judge = Judge(made, sheet)
    if not judge.states and not judge.stuck:
        return [Finding("judge", "", "no state was found")]
    return judge.examine()


def in_a_fork(made: System, limit: float = LIMIT) -> tuple[list[dict], float]:
    """The findings of one system, from a process of its own, and the seconds of a processor it took."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.close(reading)
            resource.setrlimit(resource.RLIMIT_CPU, (int(limit), int(limit) + 5))
            found = [asdict(each) for each in judged(made)]
        except BaseException:  # noqa: BLE001
            found = [asdict(Finding("judge", "", traceback.format_exc(limit=-4)))]
        with os.fdopen(writing, "w") as out:
            json.dump(found, out)
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as answer_:
        text = answer_.read()
    _, status, used = os.wait4(child, 0)
    seconds = used.ru_utime + used.ru_stime
    if text:
        return json.loads(text), seconds
    verdict = "slow" if seconds >= limit else "crash"
    return [asdict(Finding(verdict, "", f"status {status} after {seconds:.0f} s"))], seconds


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--count", type=int, default=100, help="systems of each kind")
    options.add_argument("--first", type=int, default=0, help="the first number")
    options.add_argument("--kinds", default=",".join(KINDS))
    options.add_argument("--limit", type=float, default=LIMIT)
    options.add_argument("--keep", type=Path, help="findings, one JSON object a line")
    options.add_argument("--show", action="store_true", help="the file of what is not right")
    chosen = options.parse_args()
    totals = {kind: Counter() for kind in chosen.kinds.split(",")}
    for number in range(chosen.first, chosen.first + chosen.count):
        for kind, counts in totals.items():
            made = system(kind, number)
            found, seconds = in_a_fork(made, chosen.limit)
            for verdict in {each["verdict"] for each in found} or {"right"}:
                counts[verdict] += 1
            _report(chosen, made, found, seconds)
    for kind, counts in totals.items():
        print(f"{kind:16} {dict(counts)}")
    print(f"all: {dict(sum(totals.values(), Counter()))}")


def _report(chosen, made, found, seconds):
    for each in found[:4]:
        print(f"{made.kind} {made.seed} {each['verdict']} {each['section']}: {each['what'][:300]}")
    if found and chosen.show:
        print(made.text)
    if chosen.keep and (found or seconds > 8):
        line = {"kind": made.kind, "number": made.seed, "seconds": seconds, "found": found}
        with chosen.keep.open("a") as out:
            out.write(json.dumps(line | {"text": made.text}) + "\n")
    sys.stdout.flush()


def _import_all() -> None:
    """What is imported before the fork is not imported in it, nor changed under way."""
    for module in pkgutil.walk_packages(lagcli.__path__, "lagcli."):
        if not module.name.endswith("__main__"):
            importlib.import_module(module.name)
    gc.collect()
    gc.freeze()  # a collection in a fork would write to, and so copy, all pages


if __name__ == "__main__":
    _import_all()
    main()
