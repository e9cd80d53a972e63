"""Threads: as many as asked for or as the process may use, without influence on the results."""

import os

import pytest

import hamjet
from conftest import OSCILLATOR, SOURCE, command, scene

ARCS = scene(OSCILLATOR, jet={"order": 2, "duration_canonical": 10, "arcs": 4})


def threads_of(result):
    return result.summary["runs"][0]["arcs"]["threads"]


def test_arcs_run_on_the_threads_asked_for():
    results = [hamjet.run(ARCS, threads=threads) for threads in (1, 2, 3, 1024)]
    assert [threads_of(result) for result in results] == [1, 2, 3, 4]
    for result in results:
        assert (result.runs["gauss8"].jet.coefficients
                == results[0].runs["gauss8"].jet.coefficients).all()


@pytest.fixture(autouse=True)
def no_task(monkeypatch):
    """The tests may themselves be a task of Slurm."""
    monkeypatch.delenv("SLURM_CPUS_PER_TASK", raising=False)


@pytest.fixture
def one_processor():
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(before)})
    yield
    os.sched_setaffinity(0, before)


def test_by_default_they_are_as_many_as_may_run():
    processors = len(os.sched_getaffinity(0))
    assert threads_of(hamjet.run(ARCS)) == min(processors, 4)


def test_a_process_on_one_processor_uses_one_thread(one_processor):
    assert threads_of(hamjet.run(ARCS)) == 1
    assert threads_of(hamjet.run(ARCS, threads=2)) == 2


@pytest.mark.parametrize("threads", [0, -1, 1025, 10**30, 2.5, "x"])
def test_other_numbers_are_refused_with_the_command(tmp_path, threads):
    file = SOURCE / "data" / "scenes" / "molniya.toml"
    printed = command("run", file, "--threads", threads, directory=tmp_path)
    with pytest.raises(hamjet.UsageError) as raised:
        hamjet.run(file, threads=threads)
    assert str(raised.value).startswith("threads: ")
    assert str(raised.value).endswith("must be an integer from 1 to 1024")
    assert printed.returncode == raised.value.exit_code
