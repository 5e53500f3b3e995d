"""The runs of a study: what is left out, and why."""

from lagcli.studies.tradeoff import study
from lagcli.studies.tradeoff.trial import Given
from lagcli.studies.tradeoff.writing import line_of

TEXT = "{coordinates: [x], T: x'^2/2, V: x^2/2, initial: {x: 1}}"


def test_after_an_interruption_the_table_has_what_was_made(monkeypatch):
    """The first run is one, the second is interrupted, the others are not begun."""
    begun = []

    def interrupted(given):
        begun.append(given)
        if len(begun) == 2:
            raise KeyboardInterrupt
        return made(given)

    made = study.answer
    monkeypatch.setattr(study, "answer", interrupted)
    given = Given(
        name="o", text=TEXT, settings=(), until=3.0, samples=3, project=False, method="auto",
        tolerance=None, accuracy=None, limit=10.0,
    )  # fmt: skip
    told = []
    found = study.study(given, ["dop853"], run_printer=told.append)
    assert told == [*found.points, *found.certified, found.proved]
    first, second = found.points
    assert (first.error is not None, first.why) == (True, "")
    assert second.why == "interrupted"
    assert {point.why for point in (*found.certified, found.proved)} == {"not made: interrupted"}
    assert len(begun) == 2
    assert line_of(first).startswith("dop853, tolerance 1e-04: true error ")
    assert line_of(second) == "dop853, tolerance 1e-06: interrupted"
