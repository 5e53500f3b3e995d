"""Sweeps on a Dask cluster: the same bytes as here, whoever is killed."""

from __future__ import annotations

import os
import random
import signal
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from importlib import import_module

import pytest

from lagcli.cli.run import run

SWEEP = [
    "sweep",
    "plane-pendulum",
    "--vary",
    "theta=0.1:3:24",
    "--vary",
    "l=0.5,1,2",
    "--until",
    "4",
]


def started(*arguments):
    return subprocess.Popen(
        [sys.executable, "-m", *arguments, "--no-dashboard"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
    )  # fmt: skip


def killed(*processes):
    for process in processes:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
        if process.stderr is None:
            process.wait()


def free_port():
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


def worker(address):
    return started("distributed.cli.dask_worker", address, "--nworkers", "1", "--nthreads", "1")


@contextmanager
def cluster(workers, port=None):
    port = port or free_port()
    address = f"tcp://127.0.0.1:{port}"
    scheduler = started(
        "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", str(port)
    )
    hands = [worker(address) for _ in range(workers)]
    try:
        wait_for(address, workers)
        yield address, scheduler, hands
    finally:
        killed(scheduler, *hands)


def wait_for(address, workers):
    from distributed import Client

    with Client(address, timeout=120, set_as_default=False) as client:
        if workers:
            client.wait_for_workers(workers, timeout=120)


@pytest.fixture(scope="module")
def address():
    with cluster(2) as (found, *_):
        yield found


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    path = tmp_path_factory.mktemp("here") / "whole.csv"
    assert run([*SWEEP, "-o", str(path)]) == 0
    return path.read_bytes()


@pytest.mark.long
def test_a_cluster_gives_the_same_bytes(address, whole, tmp_path):
    path = tmp_path / "there.csv"
    assert run([*SWEEP, "-o", str(path), "--scheduler", address]) == 0
    assert path.read_bytes() == whole


@pytest.mark.long
def test_a_member_that_cannot_be_run_is_a_row_without_numbers(address, tmp_path, capsysbinary):
    """At r = 0 the potential of Kepler is not defined."""
    arguments = ["sweep", "kepler", "--vary", "x=0,1", "--at", "y=0", "--until", "1", "-f", "csv"]
    status = run(arguments)
    here = capsysbinary.readouterr().out
    assert run([*arguments, "--scheduler", address]) == status == 1
    assert capsysbinary.readouterr().out == here


@pytest.mark.parametrize(
    ("there", "said"),
    [
        ("tcp://127.0.0.1:{port}", "no scheduler answers at"),
        ("nowhere://127.0.0.1:{port}", "unknown address scheme 'nowhere'"),
    ],
)
def test_without_a_scheduler_one_sentence_and_no_file(there, said, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(import_module("lagcli.studies.sweep.workers"), "_ANSWERS", 1)
    path = tmp_path / "out.csv"
    address = there.format(port=free_port())
    assert run([*SWEEP, "-o", str(path), "--scheduler", address]) == 2
    assert said in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.long
def test_a_cluster_without_workers(tmp_path, capsys):
    with cluster(0) as (address, *_):
        assert run([*SWEEP, "--scheduler", address]) == 2
    assert f"has no workers: dask worker {address}" in capsys.readouterr().err


@pytest.mark.long
def test_whoever_is_killed_the_next_call_ends_with_the_same_bytes(whole, tmp_path):
    """The client, a worker or the scheduler, at random moments."""
    draw, path = random.Random(int(os.environ.get("LAGCLI_SEED", "5"))), tmp_path / "out.csv"
    for who in os.environ.get("LAGCLI_KILLED", "client worker scheduler").split():
        with cluster(2) as (address, scheduler, hands):
            command = [sys.executable, "-m", "lagcli", *SWEEP, "-o", str(path)]
            client = subprocess.Popen(
                [*command, "--scheduler", address],
                stderr=subprocess.PIPE, text=True, start_new_session=True,
            )  # fmt: skip
            time.sleep(draw.uniform(0.5, 4))
            killed({"client": client, "worker": hands[0], "scheduler": scheduler}[who])
            told, status = client.communicate(timeout=120)[1], client.returncode
        assert "Traceback" not in told
        if who == "worker":  # the other one does its part
            assert status == 0
        if path.exists():
            assert path.read_bytes() == whole
            path.unlink()
    assert run([*SWEEP, "-o", str(path)]) == 0
    assert path.read_bytes() == whole
    assert [left.name for left in tmp_path.iterdir()] == ["out.csv"]
