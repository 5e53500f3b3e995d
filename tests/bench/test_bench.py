"""The bench's own logic; nothing here looks at a clock."""

import json

from lagcli import load
from lagcli.expression import Name, Sum
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.system import System
from lagcli.pipeline import read
from tests.bench import certificate, library
from tests.bench.compare import compare
from tests.bench.exchange import not_exchanged
from tests.bench.formulas import expanded
from tests.bench.measure import ROOT, Row
from tests.bench.printed import solved


def problem(cpu, lagcli_cpu, *, fails=None, late=False, formula=None):
    return {
        "cpu": cpu, "lagcli_cpu": lagcli_cpu, "fails": fails, "late": late, "agrees": True,
        "lagcli_fails": False, "simplify": [], "formulas": {"x": formula or operations(1, 1)},
    }  # fmt: skip


def operations(mine, simplify):
    forms = {"lagcli": "a", "simplify": "b"}
    return forms | {"lagcli_operations": mine, "simplify_operations": simplify}


def test_bars():
    assert Row("", 1.0, "x", 1).holds
    assert not Row("", 1.1, "x", 1).holds
    assert Row("", 1.1, "x", 1, at_least=True).holds
    assert not Row("", None, "x", 1).holds
    assert Row("", None, "x").holds


def test_what_sympy_cannot_do_is_not_counted():
    problems = {
        "problems/a.yaml": problem(1, 2),
        "problems/b.yaml": problem(6, 2, late=True),
        "problems/c.yaml": problem(0.1, 2, fails="singular"),
        "problems/d.yaml": problem(9, 2, late=True, formula={"simplify": "a"}),
    }
    least, median, different, slower = library.speed_rows(problems)
    assert (least.value, median.value, different.value) == (0.5, 1.75, 0)
    assert (slower.what.strip(), slower.value) == ("a.yaml", 0.5)


def test_longer_formulas_are_named():
    problems = {
        "problems/a.yaml": problem(1, 1, formula=operations(3, 3)),
        "problems/b.yaml": problem(1, 1, formula=operations(4, 3)),
    }
    [row] = library.operation_rows(problems)
    assert (row.value, row.holds) == (50, False)
    [told] = library.exceptions(problems)
    assert told.startswith("4 > 3 problems/b.yaml x")


def test_definitions_of_the_textbook_form_are_written_out():
    text = (
        b"coordinates: [x]\ndefinitions:\n  s: x + 1\nT: s'^2/2\n"
        b"expect: {accelerations: {x: 2*s*s'}}\n"
    )
    found = read("x.yaml", text).problem
    node = expanded(found.expect.accelerations["x"], found.definitions, System(found))
    assert to_grammar(node) == "2*(x + 1)*x'"


def test_two_runs_side_by_side(tmp_path, capsys):
    paths = []
    for name, value, count in (("old", 1.0, 5), ("new", 3.0, 4)):
        kept = {
            "version": name,
            "rows": [Row("solve", value, "x", 2).kept()],
            "library": {"problems/a.yaml": problem(1, value, formula=operations(count, 3))},
        }
        paths.append(tmp_path / f"{name}.json")
        paths[-1].write_text(json.dumps(kept))
    compare(*paths)
    told = capsys.readouterr().out
    assert "1.00 →     3.00 x                now MISSED" in told
    assert "problems/a.yaml: 3.00 times the time" in told
    assert "x: 5 → 4 operations" in told


def examined(name, **runs):
    return {"name": name, "until": 1.0, "runs": runs}


def test_a_false_claim_is_named_and_chaos_may_decline():
    good = {"reached": True, "error": 1e-14, "holds": True, "residual": 3e-16}
    false = {"reached": True, "error": 1e-5, "holds": False, "residual": None}
    declined = {"reached": False, "why": "chaos", "holds": True}
    found = [
        examined("problems/a.yaml", **{"1e-03": good, "1e-12": false}),
        examined("double pendulum", **{"1e-12": declined}),
    ]
    held, *shares, residual = certificate.rows(found)
    assert not held.holds
    assert "problems/a.yaml at 1e-12" in held.note
    assert shares[-1].value == 100
    assert residual.value < 1


def test_what_is_shown_beyond_the_accuracy_is_no_claim():
    """A run that ends early is judged by the rows it shows."""
    numbers = certificate.numbers
    reference = certificate.ReferenceMotion(
        rows=numbers([["0", "1", "2"], ["1", "2", "2"]]), bound=0.0, kind="", seconds=0.0
    )
    told = {"reached": False, "rows": [["0", "1", "2"], ["0.5", "7", "2"]], "method": "dop853"}
    told |= {"total": 0.1, "residual": None}
    judged = certificate.judged(told, 1e-6, reference)
    assert judged["holds"]
    assert not judged["reached"]
    told["rows"][0][1] = "1.1"
    assert not certificate.judged(told, 1e-6, reference)["holds"]


def test_a_row_that_is_not_the_exchanged_one_is_noticed():
    path = ROOT / "problems/chains/coupled-pendulums.yaml"
    found = solved(path, ("lagrangian", "equations", "multipliers"))
    assert not list(not_exchanged(load(path), found))
    row = "/equations/equations/1/left"
    broken = {**found, row: Sum((found[row], Name("k")))}
    assert row in list(not_exchanged(load(path), broken))
