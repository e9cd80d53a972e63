"""Long work: other threads run, Ctrl-C and exceptions end it, arithmetic is the command's."""

import ctypes
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import hamjet
from conftest import ORBIT, OSCILLATOR, scene

#: Some minutes of work, in steps of some milliseconds.
LONG = scene(ORBIT, jet={"order": 5, "duration_canonical": 100000.0})

#: A jet that is soon there, but whose inversion takes seconds, as do millions of values.
HIGH = scene(ORBIT, jet={"order": 10, "duration_canonical": 0.1})

LOW = scene(ORBIT, jet={"order": 2, "duration_canonical": 1.0})

#: Each is long work that a signal must end; inversion has no steps between which to ask for one.
WORKS = {
    "run": "hamjet.run(LONG)",
    "invert": "jet.invert_partially('F1')",
    "evaluate": "jet.evaluate(points, out=points)",
    "transfer": "hamjet.transfer({**LONG, 'jet': {'order': 5, 'duration_canonical': 2400.0}, "
                "'transfer': {'frame': 'RTN', 'count': 100, "
                "'start': {'position_m': [0, -1000, 0]}, 'end': {'position_m': [0, -1, 0]}}})",
}


@pytest.mark.parametrize("work", WORKS)
def test_ctrl_c_ends_work_within_a_second(work):
    program = textwrap.dedent("""
        import signal
        import time
        import numpy as np
        import hamjet
        # A job in the background inherits that it is ignored.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        LONG = LONG_SCENE
        jet = hamjet.run(JET_SCENE).runs["gauss8"].jet
        points = np.zeros((POINTS, 6))
        print("ready", flush=True)
        try:
            WORK
        except KeyboardInterrupt:
            print("interrupted", time.monotonic(), flush=True)
    """).replace("WORK", WORKS[work]).replace("LONG_SCENE", repr(LONG)).replace(
        "JET_SCENE", repr(HIGH if work in ("invert", "evaluate") else LOW)).replace(
        "POINTS", "5_000_000" if work == "evaluate" else "1")
    child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None
    limit = threading.Timer(20, child.kill)  # what is read then is empty
    limit.start()
    try:
        assert child.stdout.readline() == "ready\n"
        time.sleep(0.3)
        assert child.poll() is None
        sent = time.monotonic()
        os.kill(child.pid, signal.SIGINT)
        word, when = child.stdout.readline().split()
        assert word == "interrupted"
        # On Linux the monotonic clock is one for all processes.
        assert float(when) - sent < 1.0
        assert child.wait(timeout=10) == 0
    finally:
        limit.cancel()
        child.kill()
        child.wait()
        child.stdout.close()


def test_progress_is_reported_and_may_stop_the_work():
    seen = []

    def watch(task, fraction):
        seen.append((task, fraction))
        assert threading.current_thread() is threading.main_thread()
        if len(seen) == 3:
            raise RuntimeError("enough")

    # Of the processor, which other programs may keep busy too.
    start = time.process_time()
    with pytest.raises(RuntimeError, match="^enough$"):
        hamjet.run(LONG, progress=watch)
    assert time.process_time() - start < 20
    assert [task for task, _ in seen] == ["gauss8"] * 3
    fractions = [fraction for _, fraction in seen]
    assert 0 < fractions[0] < fractions[1] < fractions[2] < 1
    # Short work reports once.
    seen.clear()
    hamjet.run(OSCILLATOR, progress=lambda task, fraction: seen.append((task, fraction)))
    assert seen == [("gauss8: inversion", 1.0)]


def test_other_threads_run_meanwhile(jet):
    points = np.random.default_rng(5).uniform(-1e-3, 1e-3, (1_000_000, 6))
    counts = {}

    def count_during(work):
        """How often this thread gets its turn while another works."""
        thread = threading.Thread(target=work)
        count = 0
        thread.start()
        while thread.is_alive():
            count += 1
            time.sleep(0.0002)
        return count

    counts["evaluate"] = count_during(lambda: jet.evaluate(points))
    counts["run"] = count_during(lambda: hamjet.run(ORBIT, overrides={"jet.order": 8}))
    # With the GIL held it would be two or three turns.
    assert min(counts.values()) > 20, counts


def test_threads_share_a_jet(jet):
    points = np.random.default_rng(6).uniform(-1e-3, 1e-3, (20000, 6))
    expected = jet.evaluate(points)
    results = [None] * 4

    def work(i):
        results[i] = jet.evaluate(points), hamjet.run(ORBIT).runs["gauss8"].jet.coefficients

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for values, coefficients in results:
        assert (values == expected).all() and (coefficients == jet.coefficients).all()


def test_arithmetic_is_the_commands_whatever_the_process_has_set(jet):
    # Other modules round otherwise, or let denormal numbers vanish.
    library = ctypes.CDLL("libm.so.6")
    points = np.random.default_rng(7).uniform(-1e-3, 1e-3, (1000, 6))
    expected = jet.evaluate(points)
    upward = 0x800  # FE_UPWARD of x86
    before = library.fegetround()
    try:
        assert library.fesetround(upward) == 0
        values = jet.evaluate(points)
        coefficients = hamjet.run(ORBIT).runs["gauss8"].jet.coefficients
        after = library.fegetround()
    finally:
        library.fesetround(before)
    assert (values == expected).all()
    assert (coefficients == jet.coefficients).all()
    assert after == upward  # it is the process's own affair


def test_memory_that_is_not_there_is_a_memoryerror():
    program = textwrap.dedent(f"""
        import resource
        import numpy as np
        import hamjet
        jet = hamjet.run({LOW!r}).runs["gauss8"].jet
        states = np.zeros((4_000_000, 6))  # the results take as much again, 192 MB
        used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (used + (20 << 20),) * 2)
        try:
            jet.evaluate_relative(states)
        except MemoryError as error:
            print(error)
    """)
    result = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True,
                            check=False, timeout=120)
    assert result.stdout == "out of memory; a lower order or fewer variables would fit\n"
