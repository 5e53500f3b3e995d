"""What only a whole process shows: pipes, signals, encodings, standard input."""

from __future__ import annotations

import json
import os
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.cli.conftest import FILES

MOMENTA = ("--show", "momenta", "-f", "json")


@pytest.mark.long
def test_a_problem_may_come_from_standard_input(lagcli):
    done = lagcli("solve", "-", *MOMENTA, input=(FILES / "pendulum.yaml").read_bytes())
    assert json.loads(done.stdout)["momenta"] == {"theta": "m*l^2*theta'"}
    assert (done.returncode, done.stderr) == (0, b"")


def test_standard_input_is_named_with_a_dash(lagcli):
    done = lagcli("solve", "-", input=b"coordinates: [x]\nL: x'^2 + q\n")
    assert done.returncode == 2
    assert done.stderr.startswith(b"-:2:11: error: unknown name 'q'")


@pytest.mark.long
def test_the_same_input_gives_the_same_bytes(lagcli):
    one, other = (
        lagcli("solve", "atwood.yaml", env={"PYTHONHASHSEED": seed, "COLUMNS": columns})
        for seed, columns in (("1", "40"), ("2", "200"))
    )
    assert one.stdout == other.stdout
    assert one.returncode == 0


@pytest.mark.long
def test_a_reader_that_leaves_is_no_error(lagcli):
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(
        [sys.executable, "-m", "lagcli", "solve", "pendulum.yaml", "--show", "momenta"],
        cwd=FILES,
        stdout=writing,
        stderr=subprocess.PIPE,
        check=False,
    )
    os.close(writing)
    assert (done.returncode, done.stderr) == (0, b"")


@pytest.mark.long
@pytest.mark.skipif(sys.platform == "win32", reason="SIGINT is sent otherwise")
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="the device is Linux's")
@pytest.mark.parametrize("command", [["solve", "pendulum.yaml"], ["version"], ["--help"]])
def test_a_full_standard_output_is_told_and_is_no_bug(command):
    with Path("/dev/full").open("w") as full:
        done = subprocess.run([sys.executable, "-m", "lagcli", *command], stdout=full,
                              stderr=subprocess.PIPE, text=True, cwd=FILES, check=False)  # fmt: skip
    assert done.stderr == "standard output: error: no space left on device\n"
    assert done.returncode == 2


def test_a_closed_standard_output_is_told():
    line = shlex.join([sys.executable, "-m", "lagcli", "version"]) + " >&-"
    done = subprocess.run(
        ["sh", "-c", line], stderr=subprocess.PIPE, text=True, cwd=FILES, check=False
    )
    assert (done.stderr, done.returncode) == ("standard output: error: it is closed\n", 2)


@pytest.mark.long
def test_an_interrupt_ends_with_130_and_without_a_traceback(tmp_path):
    pipe = tmp_path / "pipe.yaml"  # nobody ever writes to it: lagcli waits
    os.mkfifo(pipe)
    # a build in the background ignores interrupts, and its children inherit that
    listening = (
        "import runpy, signal; signal.signal(signal.SIGINT, signal.default_int_handler); "
        "runpy.run_module('lagcli', run_name='__main__', alter_sys=True)"
    )
    running = subprocess.Popen(
        [sys.executable, "-c", listening, "solve", str(pipe)], stderr=subprocess.PIPE
    )
    time.sleep(1.5)
    running.send_signal(signal.SIGINT)
    _, told = running.communicate(timeout=20)
    assert (running.returncode, told) == (130, b"")


def test_the_handler_of_interrupts_is_set_before_anything_else_is_loaded():
    code = (
        "import sys; before = {*sys.modules}; from lagcli.cli.interrupts import end_at_once; "
        "end_at_once(); print(*sorted({*sys.modules} - before))"
    )
    bare = [sys.executable, "-c", code]
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}
    done = subprocess.run(bare, env=environment, capture_output=True, text=True, check=True)
    assert {*done.stdout.split()} <= {
        "__future__", "_signal", "lagcli", "lagcli.cli", "lagcli.cli.interrupts"
    }  # fmt: skip


def test_an_interrupt_in_the_callback_of_a_weak_reference_ends_with_130_and_without_a_word():
    code = (
        "import os, signal, weakref; from lagcli.cli.interrupts import raise_exceptions\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler); raise_exceptions()\n"
        "class Module: pass\n"
        "def callback(_):\n"
        "    os.kill(os.getpid(), signal.SIGINT)\n"
        "    for _ in range(1000): pass\n"
        "module = Module(); kept = weakref.ref(module, callback)\n"
        "del module\n"
        "print('it went on')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, b"", b"")


@pytest.mark.parametrize("module", ["lagcli.cli.run", "lagcli.cli.app", "yaml", "mpmath"])
def test_an_interrupt_while_modules_are_loaded_ends_with_130_and_without_a_word(tmp_path, module):
    """It comes in the middle of the import of a module, where a class is being made."""
    (tmp_path / "sitecustomize.py").write_text(
        "import os, signal, sys\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "class Named:\n"
        "    def __set_name__(self, owner, name):\n"
        "        os.kill(os.getpid(), signal.SIGINT)\n"
        "class Finder:\n"
        "    def find_spec(self, name, path=None, target=None):\n"
        f"        if name == {module!r}:\n"
        "            sys.meta_path.remove(self)\n"
        "            type('Made', (), {'named': Named()})\n"
        "sys.meta_path.insert(0, Finder())\n"
    )
    done = subprocess.run(
        [sys.executable, "-m", "lagcli", "solve", "pendulum.yaml"],
        env={**os.environ, "PYTHONPATH": str(tmp_path), "LAGCLI_NO_CACHE": "1"},
        cwd=FILES,
        capture_output=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, b"", b"")


@pytest.mark.long
@pytest.mark.parametrize("closed", ["<&-", "2>&-"])
def test_closed_streams_are_no_bug(closed):
    line = shlex.join([sys.executable, "-m", "lagcli", "solve", "-"]) + " " + closed
    done = subprocess.run(
        ["sh", "-c", line], capture_output=True, input=b"coordinates: [x]", cwd=FILES, check=False
    )
    told = b"-: error: standard input is closed\n" if closed == "<&-" else b""
    assert (done.returncode, done.stdout, done.stderr) == (2, b"", told)


@pytest.mark.long
def test_text_is_ascii_where_the_terminal_is(lagcli):
    done = lagcli("solve", "pendulum.yaml", env={"PYTHONIOENCODING": "ascii"})
    assert done.returncode == 0
    assert done.stdout.isascii()
    assert b"theta" in done.stdout


@pytest.mark.long
def test_a_mistake_of_lagcli_is_one_line(lagcli, tmp_path):
    (tmp_path / "sitecustomize.py").write_text(
        "import lagcli.mechanics.derivation as d\n"
        "def broken(self, problem): raise ZeroDivisionError('of a test')\n"
        "d.Derivation.__init__ = broken\n"
    )
    done = lagcli("solve", "pendulum.yaml", env={"PYTHONPATH": str(tmp_path)})
    assert (done.returncode, done.stdout) == (1, b"")
    assert done.stderr.decode() == (
        "pendulum.yaml: error: this is a bug of lagcli (ZeroDivisionError: of a test); "
        "LAGCLI_TRACEBACK=1 shows where\n"
    )
    env = {"PYTHONPATH": str(tmp_path), "LAGCLI_TRACEBACK": "1"}
    assert b"Traceback" in lagcli("solve", "pendulum.yaml", env=env).stderr


@pytest.mark.long
def test_deep_formulas_are_solved(lagcli, tmp_path):
    deep = "(" * 190 + "theta" + " + 1)" * 190
    (tmp_path / "deep.yaml").write_text(
        f"coordinates: [theta]\nT: theta'^2/2\nV: {deep}\n", encoding="utf-8"
    )
    done = lagcli("solve", "deep.yaml", "--show", "accelerations", "-f", "json", cwd=tmp_path)
    assert done.stderr == b""
    assert json.loads(done.stdout)["accelerations"] == {"theta": "-1"}


@pytest.mark.long
def test_a_missing_file_does_not_stop_the_others(lagcli):
    done = lagcli("solve", "nowhere.yaml", "pendulum.yaml", *MOMENTA)
    assert [each["title"] for each in json.loads(done.stdout)] == ["Pendulum"]
    assert done.returncode == 2
    assert done.stderr == b"nowhere.yaml: error: no such file or directory\n"
