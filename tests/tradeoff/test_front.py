"""Which runs pay, by points made up for it."""

from hypothesis import given
from hypothesis import strategies as st

from lagcli.studies.tradeoff.front import COSTS, RunPoint, cheapest, front, verdict

TOTAL = COSTS["total"]


def point(error, total, method="a", **other):
    return RunPoint(method=method, taken=method, error=error, total=total, **other)


def test_the_front_is_what_no_other_beats():
    cheap, exact = point(1e-3, 1.0), point(1e-9, 5.0)
    beaten = point(1e-6, 6.0)
    without = RunPoint(method="b", why="takes more than 10 s")
    assert front([beaten, cheap, exact, without], TOTAL) == {cheap, exact}


def test_of_equals_the_first_is_on_the_front():
    one, other = point(1e-3, 1.0, "a"), point(1e-3, 1.0, "b")
    assert front([one, other], TOTAL) == {one}


def test_errors_below_the_reference_are_not_told_apart():
    cheap, lucky = point(3e-20, 1.0), point(1e-20, 2.0)
    assert front([cheap, lucky], TOTAL) == {cheap, lucky}
    assert front([cheap, lucky], TOTAL, resolved=1e-18) == {cheap}


numbers = st.floats(1e-12, 1.0)


@given(st.lists(st.tuples(numbers, numbers), min_size=1, max_size=12))
def test_every_point_is_on_the_front_or_beaten_by_it(pairs):
    points = [point(*pair, method=str(k)) for k, pair in enumerate(pairs)]
    found = front(points, TOTAL)
    for each in points:
        others = [p for p in points if p is not each and p.error <= each.error]
        beaten = any(
            p.total < each.total or (p.total == each.total and p.error < each.error) for p in others
        )
        if each in found:
            assert not beaten
        else:
            assert any(p.error <= each.error and p.total <= each.total for p in found)


def test_the_cheapest_reaches_the_accuracy():
    loose, tight = point(1e-4, 1.0), point(1e-10, 3.0)
    assert cheapest([loose, tight], 1e-3, TOTAL) is loose
    assert cheapest([loose, tight], 1e-9, TOTAL) is tight
    assert cheapest([loose, tight], 1e-12, TOTAL) is None


def certified(method, total, accuracy=1e-6, error=1e-8, taken=None, reached=True):
    return RunPoint(
        method=method, taken=taken or method, accuracy=accuracy, error=error, total=total,
        reached=reached,
    )  # fmt: skip


def test_auto_agrees_when_it_takes_the_cheapest_or_one_hardly_dearer():
    runs = [certified("a", 1.0), certified("b", 2.0)]
    assert verdict([*runs, certified("auto", 1.2, taken="a")], 1e-6).agrees
    assert verdict([*runs, certified("auto", 1.4, taken="b")], 1e-6).agrees
    late = verdict([*runs, certified("auto", 2.1, taken="b")], 1e-6)
    assert late.ratio == 2.1
    assert not late.agrees


def test_a_run_that_does_not_keep_its_promise_is_not_the_cheapest():
    runs = [
        certified("a", 1.0, error=1e-5),
        certified("b", 2.0),
        certified("c", 1.0, reached=False),
    ]
    assert verdict(runs, 1e-6).best.method == "b"
    assert verdict(runs, 1e-6).auto is None
