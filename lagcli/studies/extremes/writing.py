"""The study as text, JSON and CSV."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.json_values import fields_of, plain
from lagcli.numerics.tables.writing import records_as_csv
from lagcli.record import record
from lagcli.studies.extremes.case import GROUPS, KINDS, Case, CaseFormula, CaseTrial, Group, Loss
from lagcli.studies.extremes.study import ExtremesStudy

_WIDTH = 80
_NAME = 25
_HEAD = ("case", "cond", "acc.", "run", "mult.", "charges", "drift", "outcome")
#: The last column is aligned to the left.
_WIDTHS = (_NAME, 5, 8, 4, 8, 8, 6, 9)
#: A rewriting that gains fewer digits is not reported.
_WORTH = 1.0
_COLUMNS = (
    "kind", "case", "outcome", "condition", "accelerations", "accelerations_rewritten",
    "accelerations_in_a_run", "multipliers", "multipliers_rewritten", "charges",
    "charges_rewritten", "drift", "until", "holds_until", "accuracy", "error", "method",
    "seconds", "reason",
)  # fmt: skip


@record
class Gain:
    """A formula, and the case in which rewriting it gains most."""

    formula: CaseFormula
    case: str
    loss: Loss

    @property
    def digits(self) -> float:
        """How many are gained."""
        return (self.loss.printed or 0.0) - (self.loss.rewritten or 0.0)


def worst(trial: CaseTrial, group: Group) -> tuple[float, float] | None:
    """The most digits that a formula of the group loses, as printed and rewritten."""
    found = [x for x in trial.losses if x.group == group and x.printed is not None]
    if not found:
        return None
    return max(x.printed or 0.0 for x in found), max(x.rewritten or 0.0 for x in found)


def gains(study: ExtremesStudy) -> list[Gain]:
    """The formulas that are better rewritten, the best gain of each."""
    found: list[Gain] = []
    for place, formula in enumerate(study.formulas):
        every = [
            Gain(formula, case.name, trial.losses[place])
            for case, trial in study.trials
            if trial.losses
        ]
        best = max(every, key=lambda gain: gain.digits, default=None)
        if best is not None and best.digits >= _WORTH:
            found.append(best)
    return found


# -- text ----------------------------------------------------------------------------------------


def to_text(study: ExtremesStudy) -> str:
    """A table of at most 80 columns, then reasons and rewritten formulas."""
    lines = [f"{study.name}: its extremes, to the accuracy {study.wanted.accuracy:g}"]
    lines += [line for note in study.notes for line in textwrap.wrap(note, _WIDTH)]
    lines += ["", _row(_HEAD)]
    kind = ""
    for case, trial in study.trials:
        if case.kind != kind:
            kind = case.kind
            lines.append(f"{kind}: {KINDS[kind]}")
        lines += _case(case, trial)
    lines += ["", *_legend()]
    lines += _told(study)
    lines += _gains(study)
    count = {
        verdict: sum(t.verdict == verdict for _, t in study.trials)
        for verdict in ("right", "claimed", "refused", "wrong", "undecided")
    }
    proved = sum(t.proved for _, t in study.trials)
    summary = ", ".join(f"{n} {verdict}" for verdict, n in count.items() if n)
    summary += f"; {proved} proved" if proved else ""
    lines += ["", f"{len(study.trials)} case{'s' * (len(study.trials) != 1)}: {summary}"]
    return "".join(f"{line.rstrip()}\n" for line in lines)


def _row(cells: Sequence[str]) -> str:
    *first, last = (
        cell.ljust(width) if k in {0, len(_WIDTHS) - 1} else cell.rjust(width)
        for k, (cell, width) in enumerate(zip(cells, _WIDTHS, strict=True))
    )
    return " ".join([*first, last])


def _case(case: Case, trial: CaseTrial) -> Iterator[str]:
    name = f"  {case.name}"
    if len(name) > _NAME:
        yield name
        name = ""
    accelerations, multipliers, charges = (_lost(worst(trial, group)) for group in GROUPS)
    yield _row(
        (
            name,
            _short(trial.condition),
            accelerations,
            "-" if trial.run_loss is None else _digits(trial.run_loss),
            multipliers,
            charges,
            _short(trial.drift),
            trial.verdict,
        )
    )


def _lost(pair: tuple[float, float] | None) -> str:
    if pair is None:
        return "-"
    printed, rewritten = map(_digits, pair)
    return printed if printed == rewritten else f"{printed}>{rewritten}"


def _digits(value: float) -> str:
    return f"{value:.1f}" if value < 9.95 else f"{value:.0f}"


def _short(value: float | None) -> str:
    if value is None:
        return "-"
    return "0" if not value else f"{value:.0e}"


def _legend() -> list[str]:
    text = (
        "cond: of the mass matrix, scaled. acc., mult., charges: decimal digits of 16 that the "
        "printed formulas lose in doubles against 50 digits; 9.1>0.2: 9.1 as printed, 0.2 as "
        "rewritten. run: those lost by the accelerations of a run. drift: of a charge over a "
        "certified run. right: the claim was confirmed with more digits."
    )
    return textwrap.wrap(text, _WIDTH)


def _told(study: ExtremesStudy) -> Iterator[str]:
    reasons = [(case.name, trial.reason) for case, trial in study.trials if trial.reason]
    if reasons:
        yield ""
    for name, reason in reasons:
        yield from textwrap.wrap(f"{name}: {reason}", _WIDTH, subsequent_indent="  ")


def _gains(study: ExtremesStudy) -> Iterator[str]:
    found = gains(study)
    if found:
        yield ""
        yield "Better written so:"
    for gain in found:
        printed, rewritten = (_digits(x or 0.0) for x in (gain.loss.printed, gain.loss.rewritten))
        assert gain.formula.rewritten is not None
        formula = f"  {gain.formula.name} = {to_grammar(gain.formula.rewritten)}"
        yield from textwrap.wrap(formula, _WIDTH, subsequent_indent="      ")
        yield f"    loses {rewritten} digits and not {printed} at {gain.case}"


# -- for machines --------------------------------------------------------------------------------


def to_json(study: ExtremesStudy) -> str:
    """Everything; times in seconds of processor time, null where there is no number."""
    document = {
        "schema": 1,
        "problem": study.name,
        "accuracy": study.wanted.accuracy,
        "notes": list(study.notes),
        "formulas": plain(study.formulas),
        "cases": [_document(case, trial) for case, trial in study.trials],
    }
    return json.dumps(document, ensure_ascii=False, allow_nan=False) + "\n"


def _document(case: Case, trial: CaseTrial) -> dict[str, Any]:
    return {
        **fields_of(case, "kind name parameters"),
        "initial": {str(name): to_grammar(x) for name, x in case.initial.items()},
        "outcome": trial.verdict,
        "reason": trial.reason or None,
        "digits_lost": plain(trial.losses),
        "digits_lost_in_a_run": trial.run_loss,
        "condition": plain(trial.condition),
        "singular": trial.condition == float("inf"),
        **fields_of(trial, "until holds_until accuracy error proved drift"),
        "method": trial.method or None,
        "seconds": trial.seconds,
    }


def to_csv(study: ExtremesStudy) -> str:
    """One line for each case, the worst of each group of formulas."""
    return records_as_csv(_COLUMNS, (_record(case, trial) for case, trial in study.trials))


def _record(case: Case, trial: CaseTrial) -> dict[str, Any]:
    found: dict[str, Any] = {name: getattr(trial, name, None) for name in _COLUMNS}
    found |= {"kind": case.kind, "case": case.name, "outcome": trial.verdict}
    found["accelerations_in_a_run"] = trial.run_loss
    for group in GROUPS:
        found |= _pair(group, worst(trial, group))
    return found


def _pair(group: str, pair: tuple[float, float] | None) -> Mapping[str, float | None]:
    printed, rewritten = pair or (None, None)
    return {group: printed, f"{group}_rewritten": rewritten}


WRITERS: dict[str, Callable[[ExtremesStudy], str]] = {
    "text": to_text,
    "json": to_json,
    "csv": to_csv,
}
