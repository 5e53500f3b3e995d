"""Answers that are kept: found again, never wrong, never in the way."""

from __future__ import annotations

import json
import os
import signal
import stat
import subprocess
import sys
import time
from hashlib import sha256
from pathlib import Path

import pytest

from lagcli.platform.cache import Cache, KeptAnswer, folder, key

FREE = "coordinates: [x]\nparameters: {m: {assume: positive, value: 3}}\nL: m*x'^2/2\n"
WRONG = "coordinates: [x]\nL: x'^2/2 + y\n"
PROBE = """
import sys
from lagcli.cli.run import run
status = run(sys.argv[1:])
sys.stdout.flush()
heavy = ("sympy", "flint", "mpmath", "lark", "yaml", "rich", "lagcli.statements.answers", "lagcli.reader")
sys.stderr.write("loaded: " + ",".join(name for name in heavy if name in sys.modules))
sys.exit(status)
"""
KEY = "a" + "0" * 63


@pytest.fixture
def here(tmp_path):
    (tmp_path / "free.yaml").write_text(FREE)
    (tmp_path / "wrong.yaml").write_text(WRONG)
    return tmp_path


@pytest.fixture
def solve(here):
    """Run `lagcli solve …` with a cache of its own; says what was loaded."""

    def run(*arguments, **environment):
        done = subprocess.run(
            [sys.executable, "-c", PROBE, "solve", *arguments],
            cwd=here,
            env={
                **os.environ,
                "PYTHONIOENCODING": "utf-8",
                "LAGCLI_CACHE_DIR": str(here / "cache"),
                **environment,
            },
            capture_output=True,
            text=True,
            encoding="utf-8",
            timeout=120,
            check=False,
        )
        said, _, loaded = done.stderr.rpartition("loaded: ")
        return (done.returncode, done.stdout, said), loaded

    return run


@pytest.fixture(autouse=True)
def _kept(monkeypatch):
    monkeypatch.delenv("LAGCLI_NO_CACHE")


def entries(here):
    return [path for path in (here / "cache").rglob("*") if path.is_file()]


@pytest.mark.long
def test_the_second_run_prints_the_same_and_loads_nothing(solve, here):
    first, loaded = solve("free.yaml")
    assert first[0] == 0
    assert "sympy" in loaded
    assert solve("free.yaml") == (first, "")
    assert len(entries(here)) == 1


@pytest.mark.long
def test_mistakes_of_a_file_are_repeated_with_their_status(solve):
    first, _ = solve("free.yaml", "wrong.yaml", "-f", "json")
    assert first[0] == 2
    assert "unknown name 'y'" in first[2]
    assert len(json.loads(first[1])) == 1
    assert solve("free.yaml", "wrong.yaml", "-f", "json") == (first, "")


@pytest.mark.long
def test_an_output_file_is_written_again(solve, here):
    solve("free.yaml", "-f", "json", "-o", "out.json")
    text = (here / "out.json").read_bytes()
    (here / "out.json").unlink()
    assert solve("free.yaml", "-f", "json", "-o", "out.json") == ((0, "", ""), "")
    assert (here / "out.json").read_bytes() == text
    (status, _, said), _ = solve("free.yaml", "-f", "json", "-o", "nowhere/out.json")
    assert status == 2
    assert "no directory" in said


@pytest.mark.long
@pytest.mark.parametrize(
    "change",
    [
        ["-f", "json"], ["--show", "energy"], ["--set", "m=2"], ["--numeric"],
        ["--width", "40"], ["-f", "latex"], ["-f", "latex", "--standalone"],
    ],
    ids=" ".join,
)  # fmt: skip
def test_other_options_are_another_answer(solve, change):
    plain, _ = solve("free.yaml")
    changed, loaded = solve("free.yaml", *change)
    assert "sympy" in loaded
    assert solve("free.yaml", *change) == (changed, "")
    assert solve("free.yaml") == (plain, "")


@pytest.mark.long
def test_another_content_is_another_answer(solve, here):
    before, _ = solve("free.yaml")
    (here / "free.yaml").write_text(FREE.replace("/2", "/3"))
    after, loaded = solve("free.yaml")
    assert "sympy" in loaded
    assert after[1] != before[1]


@pytest.mark.long
@pytest.mark.parametrize("off", [(["--no-cache"], {}), ([], {"LAGCLI_NO_CACHE": "1"})])
def test_the_cache_can_be_turned_off(solve, here, off):
    arguments, environment = off
    solve("free.yaml", *arguments, **environment)
    assert not entries(here)


@pytest.mark.long
@pytest.mark.parametrize("arguments", [["missing.yaml"], ["free.yaml", "-f", "nothing"]])
def test_what_may_change_by_itself_is_not_kept(solve, here, arguments):
    (status, _, _), _ = solve(*arguments)
    assert status == 2
    assert not entries(here)


def damages(data):
    yield data[: len(data) // 2]
    yield b""
    yield data.replace(b'"status":0', b'"status":1')
    yield os.urandom(len(data))
    yield b"lagcli result 1\n"


@pytest.mark.long
def test_damaged_entries_are_replaced(solve, here):
    right, _ = solve("free.yaml")
    [path] = entries(here)
    data = path.read_bytes()
    for damaged in damages(data):
        assert damaged != data
        path.write_bytes(damaged)
        again, loaded = solve("free.yaml")
        assert again == right
        assert "sympy" in loaded
        assert path.read_bytes() == data


MALFORMED = {
    "no text": b"\xff\xfe",
    "no object": b"[]",
    "too deep": b"[" * 100_000,
    "no status": json.dumps({"key": KEY, "text": "x", "said": []}).encode(),
    "no key": json.dumps({"status": 0, "text": "x", "said": []}).encode(),
    "a status of no command": json.dumps(
        {"key": KEY, "status": 7, "text": "x", "said": []}
    ).encode(),
    "a status that is a word": json.dumps(
        {"key": KEY, "status": "0", "text": "x", "said": []}
    ).encode(),
    "a text that is a number": json.dumps(
        {"key": KEY, "status": 0, "text": 1, "said": []}
    ).encode(),
    "sentences that are none": json.dumps(
        {"key": KEY, "status": 0, "text": "x", "said": 5}
    ).encode(),
    "sentences that are numbers": json.dumps(
        {"key": KEY, "status": 0, "text": "x", "said": [5]}
    ).encode(),
}


@pytest.mark.parametrize("body", MALFORMED.values(), ids=MALFORMED)
def test_an_entry_with_a_malformed_body_is_not_believed(tmp_path, body):
    cache = Cache(str(tmp_path))
    cache.keep(KEY, KeptAnswer(0, "x"))
    digest = sha256(body).hexdigest().encode()
    (tmp_path / "a" / KEY).write_bytes(b"lagcli result 1\n" + digest + b"\n" + body)
    assert cache.find(KEY) is None


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with names")
def test_a_pipe_in_the_folder_is_not_waited_for(tmp_path):
    cache = Cache(str(tmp_path))
    cache.keep("a" + "1" * 63, KeptAnswer(0, "x"))
    os.mkfifo(tmp_path / "a" / KEY)
    assert cache.find(KEY) is None
    cache.keep(KEY, KeptAnswer(0, "y"))
    assert cache.find(KEY) == KeptAnswer(0, "y")


def test_an_entry_under_a_wrong_name_is_not_believed(tmp_path):
    cache = Cache(str(tmp_path))
    cache.keep(KEY, KeptAnswer(0, "mine"))
    other = KEY[:-1] + "1"
    (tmp_path / "a" / KEY).rename(tmp_path / "a" / other)
    assert cache.find(other) is None


@pytest.mark.long
def test_processes_at_once_see_whole_entries(tmp_path):
    code = (
        "import sys; from lagcli.platform.cache import Cache, KeptAnswer\n"
        f"cache, entry = Cache(sys.argv[1]), KeptAnswer(0, 'x' * 200_000, ('said',))\n"
        "for _ in range(100):\n"
        f"    cache.keep({KEY!r}, entry)\n"
        f"    found = cache.find({KEY!r})\n"
        "    assert found == entry, found\n"
    )
    runs = [subprocess.Popen([sys.executable, "-c", code, str(tmp_path)]) for _ in range(6)]
    assert [run.wait(60) for run in runs] == [0] * 6
    assert Cache(str(tmp_path)).size()[0] == 1


def test_a_killed_writer_leaves_no_wrong_entry(tmp_path):
    code = (
        "import sys; from lagcli.platform.cache import Cache, KeptAnswer\n"
        "while True:\n"
        f"    Cache(sys.argv[1]).keep({KEY!r}, KeptAnswer(0, 'x' * 3_000_000))\n"
    )
    cache = Cache(str(tmp_path))
    for pause in (0.0, 0.01, 0.02, 0.05):
        run = subprocess.Popen([sys.executable, "-c", code, str(tmp_path)])
        while not any(tmp_path.rglob("*" + KEY + "*")):
            time.sleep(0.01)
        time.sleep(pause)
        run.send_signal(signal.SIGKILL)
        run.wait()
        found = cache.find(KEY)
        assert found is None or found == KeptAnswer(0, "x" * 3_000_000)
    cache.keep(KEY, KeptAnswer(0, "new"))
    assert cache.find(KEY) == KeptAnswer(0, "new")


def test_what_was_left_half_written_is_removed_in_time(tmp_path):
    cache = Cache(str(tmp_path))
    cache.keep(KEY, KeptAnswer(0, "x"))
    left = tmp_path / "a" / f".{KEY}.12345"
    left.write_bytes(b"half")
    os.utime(left, (1, 1))
    cache.keep(KEY, KeptAnswer(0, "y"))
    assert not left.exists()


def test_the_size_is_bounded_and_the_least_used_go_first(tmp_path):
    cache = Cache(str(tmp_path), limit=16 * 10_000)
    keys = ["a" + format(n, "063x") for n in range(30)]
    for n, one in enumerate(keys):
        cache.keep(one, KeptAnswer(0, "x" * 800))
        os.utime(tmp_path / "a" / one, (n + 1, n + 1))
        assert cache.find(keys[0]) == KeptAnswer(0, "x" * 800)  # used again and again
    count, size = cache.size()
    assert size <= 10_000
    assert 5 < count < 12
    assert cache.find(keys[-1]) is not None
    assert cache.find(keys[1]) is None
    cache.keep(keys[1], KeptAnswer(0, "x" * 20_000))
    assert cache.find(keys[1]) is None


def test_clearing_removes_entries_and_nothing_else(tmp_path):
    cache = Cache(str(tmp_path))
    cache.keep(KEY, KeptAnswer(0, "x"))
    other = tmp_path / "a" / "thesis.tex"
    other.write_text("mine")
    cache.clear()
    assert cache.size() == (0, 0)
    assert other.exists()


def test_nobody_else_can_read_or_write_it(tmp_path):
    cache = Cache(str(tmp_path / "new"))
    cache.keep(KEY, KeptAnswer(0, "x"))
    for path, mode in (("new", 0o700), ("new/a", 0o700), (f"new/a/{KEY}", 0o600)):
        assert stat.S_IMODE((tmp_path / path).stat().st_mode) == mode
    (tmp_path / "new" / "a").chmod(0o777)
    assert cache.find(KEY) is None


def test_a_shelf_that_is_a_link_is_not_used(tmp_path):
    (tmp_path / "elsewhere").mkdir(mode=0o700)
    (tmp_path / "a").symlink_to(tmp_path / "elsewhere")
    cache = Cache(str(tmp_path))
    cache.keep(KEY, KeptAnswer(0, "x"))
    assert cache.find(KEY) is None
    assert not any((tmp_path / "elsewhere").iterdir())


@pytest.mark.long
@pytest.mark.parametrize("place", ["/dev/null/cache", "/proc/none", "free.yaml"])
def test_a_place_that_cannot_be_used_is_no_mistake(solve, here, place):
    (status, text, said), _ = solve("free.yaml", LAGCLI_CACHE_DIR=place)
    assert (status, said) == (0, "")
    assert text


@pytest.mark.long
def test_a_folder_that_cannot_be_written_is_no_mistake(solve, here):
    (here / "cache").mkdir()
    (here / "cache").chmod(0o500)
    (status, _, said), _ = solve("free.yaml")
    assert (status, said) == (0, "")


def test_the_place_follows_the_environment(tmp_path):
    home = Path.home()
    assert folder({"LAGCLI_CACHE_DIR": "/a"}) == "/a"
    assert folder({"XDG_CACHE_HOME": "/b"}) == "/b/lagcli"
    assert folder({"XDG_CACHE_HOME": "not/absolute"}) == f"{home}/.cache/lagcli"
    assert folder({}) == f"{home}/.cache/lagcli"


def test_another_program_is_another_answer(monkeypatch, tmp_path):
    (tmp_path / "deep").mkdir()
    source = tmp_path / "deep" / "one.py"
    source.write_text("1")
    monkeypatch.setattr("lagcli.__file__", str(tmp_path / "__init__.py"))
    keys = [key({}, [])]
    assert key({}, []) == keys[0]
    os.utime(source, ns=(1, 1))
    keys.append(key({}, []))
    source.write_text("11")
    os.utime(source, ns=(1, 1))
    keys.append(key({}, []))
    (tmp_path / "two.py").touch()
    keys.append(key({}, []))
    monkeypatch.setattr("lagcli.__version__", "99")
    keys.append(key({}, []))
    monkeypatch.setattr(sys, "version", "4.0")
    keys.append(key({}, []))
    monkeypatch.setattr("lagcli.platform.cache._versions", lambda: [["sympy", "2.0"]])
    keys.append(key({}, []))
    assert len(set(keys)) == len(keys)


def test_names_and_contents_cannot_be_confused():
    contents = [("a", b"1"), ("b", b"2")]
    assert key({}, contents) != key({}, contents[::-1])
    assert key({}, [("a", b"1b2")]) != key({}, contents)
    assert key({}, [("ab", b"1")]) != key({}, [("a", b"b1")])


@pytest.mark.long
def test_the_command_shows_the_place_and_clears_it(here, solve):
    solve("free.yaml")

    def command(*arguments, **environment):
        return subprocess.run(
            [sys.executable, "-m", "lagcli", "cache", *arguments],
            env={**os.environ, "LAGCLI_CACHE_DIR": str(here / "cache"), **environment},
            capture_output=True, text=True, check=True,
        ).stdout  # fmt: skip

    assert command().startswith(f"{here / 'cache'}: 1 answer, ")
    assert "0 answers" in command("--clear")
    assert not entries(here)
