"""A page in a browser; those of the library are looked at in tests/library."""

from __future__ import annotations

import pytest

from tests.browser import PROGRAM, Browser
from tests.gallery import main

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(PROGRAM is None, reason="chromium is missing"),
]


@pytest.fixture
def browser():
    with Browser() as made:
        yield made


def test_an_animation_plays_in_its_page(browser, tmp_path):
    main(tmp_path, ["pendulums/plane-pendulum"])
    assert browser.complaints(tmp_path / "pendulums" / "plane-pendulum.html") == []
    assert browser.pixels_too_wide() == 0
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
