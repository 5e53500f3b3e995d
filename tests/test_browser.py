"""Pages in a browser: nothing is logged, nothing is asked for, nothing is wider than a phone."""

from __future__ import annotations

import pytest

from lagcli.library import entries
from tests.browser import PROGRAM, Browser
from tests.gallery import main

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(PROGRAM is None, reason="chromium is missing"),
]
#: A dozen problems make a test of some seconds.
_PARTS = 24
_PHONE = {"width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": True}
_TOO_WIDE = "document.documentElement.scrollWidth - document.documentElement.clientWidth"


@pytest.fixture
def browser():
    with Browser() as made:
        made.call("Emulation.setDeviceMetricsOverride", **_PHONE)
        yield made


@pytest.mark.parametrize("part", range(_PARTS))
def test_the_pages_of_the_library_are_quiet_and_fit_on_a_phone(part, browser, tmp_path):
    names = [entry.name for entry in entries()[part::_PARTS]]
    assert main(tmp_path, names) == 0
    pages = sorted(tmp_path.rglob("*.html"))
    assert {tmp_path / f"{name}.html" for name in ("index", *names)} <= {*pages}
    wrong = {}
    for page in pages:
        # the list of the gallery shows the pictures that lie beside it
        beside = tmp_path.as_uri()
        said = [each for each in browser.complaints(page) if not each.startswith(beside)]
        if said or browser.run(_TOO_WIDE) > 0:
            wrong[page.name] = said
    assert wrong == {}


def test_an_animation_plays_in_its_page(browser, tmp_path):
    main(tmp_path, ["pendulums/plane-pendulum"])
    assert browser.complaints(tmp_path / "pendulums" / "plane-pendulum.html") == []
    assert browser.run(_TOO_WIDE) == 0
    inside = "document.querySelector('iframe').contentDocument"
    assert browser.run(f"{inside}.querySelectorAll('.rod').length") == 1
    before = browser.run(f"{inside}.querySelector('.body').getAttribute('cx')")
    browser.run(f"{inside}.getElementById('play').click()")
    browser.run("new Promise((done) => setTimeout(done, 400))")
    assert browser.run(f"{inside}.querySelector('.body').getAttribute('cx')") != before


def test_what_a_page_does_wrong_is_seen(browser, tmp_path):
    page = tmp_path / "wrong.html"
    page.write_text("<img src='http://example.invalid/x.png'><script>nothing();</script>")
    said = " ".join(browser.complaints(page))
    assert "example.invalid" in said
    assert "nothing is not defined" in said
