"""No test fails because the machine is busy."""

import gc
import signal
from collections import Counter

import pytest
from hypothesis import HealthCheck, settings

# a run in the background ignores Ctrl-C, and so would the commands that it starts
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

settings.register_profile("busy", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("busy")

# Garbage is looked for after five million new objects: 9 % less processor time than with 200,000 in
# tests of mechanics, and 0.6 GB a process, not 0.2; with tests of pictures 1.3 GB.
gc.set_threshold(5_000_000, 10, 10)


#: Rooms whose cases solve a problem each: before a commit one case stands for its family.
SOLVING = ("mechanics", "notation", "verification")


def pytest_addoption(parser):
    parser.addoption(
        "--every", type=int, default=1, metavar="N", help="of a family's long cases run every N-th"
    )


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """Of a family of cases marked `first_quick`, or in these rooms, all but the first are long."""
    seen = set()
    for item in items:
        if item.get_closest_marker("long"):
            continue
        if item.get_closest_marker("first_quick") or item.path.parent.name in SOLVING:
            family = (item.path, item.originalname)
            if family in seen:
                item.add_marker("long")
            seen.add(family)
    leave_out(items, config.getoption("every"))


def leave_out(items, number):
    """Leave the long cases of each family but every so many to a run without `--every`."""
    counted = Counter()
    for item in items:
        if item.get_closest_marker("long"):
            family = (item.path, item.originalname)
            if counted[family] % number:
                item.add_marker("hours")
            counted[family] += 1


@pytest.fixture(autouse=True)
def precision_of_mpmath():
    """What a test sets it to ends with the test: the judge of random systems has its own."""
    from mpmath import mp

    usual = mp.prec
    yield
    mp.prec = usual
