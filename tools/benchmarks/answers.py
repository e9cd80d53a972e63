"""What answers cost: whole commands on shipped scenes, and how their cost grows.

Times are processor time of the command alone, without pictures (no gnuplot is found on the path),
medians of repeats. With a second program, both are run in turns, and stand beside each other.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "data" / "scenes"
SATELLITES = str(ROOT / "data/examples/two-satellites/two-satellites.toml")
# The paper's orbit by the default method alone.
PAPER_ORBIT = """
system = { model = "zonal-gravity", mu_km3_s2 = 398600.4405, radius_km = 6378.137, \
J2 = 1.082626675e-3, J3 = 2.532436e-6 }
nominal = { a_km = 10000, e = 0.3, i_deg = 60, raan_deg = 0, argp_deg = 0, ta_deg = 0 }
jet = { order = 4, duration_canonical = 31.41592653589793 }
integrator = [{ method = "gauss", stages = 8, tolerance = 1e-12 }]
"""
# Commands that take less than so many seconds are repeated so many times at least.
SHORT = 0.3
SHORT_REPEATS = 15
COLUMNS = "R_m,T_m,N_m,vR_m_s,vT_m_s,vN_m_s"


class Runner:
    """Runs commands of one program in a folder of its own."""

    def __init__(self, program: str, folder: Path) -> None:
        self.program = os.path.abspath(program)
        self.folder = folder
        self.environment = dict(os.environ, PATH=str(folder))
        folder.mkdir()
        (folder / "paper-orbit.toml").write_text(PAPER_ORBIT)

    def run(self, *arguments: str, draws: bool = False) -> tuple[float, float]:
        """Seconds of processor time (children included) and megabytes."""
        environment = os.environ if draws else self.environment
        with open(self.folder / "said", "w+") as said:
            child = subprocess.Popen([self.program, *arguments], cwd=self.folder, env=environment,
                                     stdout=subprocess.DEVNULL, stderr=said)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            if child.returncode not in (0, 1):  # 1: a check of the scene failed
                said.seek(0)
                last = said.read().strip().splitlines()[-1:]
                print(f"    {' '.join(arguments[:2])}: exit code {child.returncode}: {last}",
                      file=sys.stderr)
                return float("nan"), float("nan")
        return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def revolutions(count: float) -> list[str]:
    return ["--set", "jet.duration_s=null", "--set", f"jet.duration_orbits={count}"]


def deviations(folder: Path, rows: int) -> str:
    """A file of deviations of some hundred metres."""
    file = folder / f"deviations-{rows}.csv"
    if not file.exists():
        draw = random.Random(1)
        with open(file, "w") as text:
            text.write(COLUMNS + "\n")
            for _ in range(rows):
                numbers = [f"{draw.gauss(0, 100):.3f}" for _ in range(3)]
                numbers += [f"{draw.gauss(0, 0.1):.6f}" for _ in range(3)]
                text.write(",".join(numbers) + "\n")
    return str(file)


def study(command: str, scene: str, *changes: str) -> list[str]:
    return [command, scene, "-q", "-o", command, *changes]


def evaluated(folder: Path, rows: int) -> list[str]:
    return ["eval", "jet", "--deviations", deviations(folder, rows), "-q", "-o", "end.csv"]


def answers(folder: Path) -> list[tuple[str, list[str]]]:
    scene = {name: str(SCENES / f"{name}.toml") for name in
             ("bounded-molniya", "conjunction-geosynchronous", "uncertainty-leo", "grace-fo-pair")}
    return [
        ("run, cold, order 4", study("run", "paper-orbit.toml")),
        ("transfer, a day", study("transfer", SATELLITES)),
        ("transfer, 100 revolutions", study("transfer", SATELLITES, *revolutions(100))),
        ("transfer, 1000 revolutions", study("transfer", SATELLITES, *revolutions(1000))),
        ("validity in J6, 100 revolutions",
         study("validity", scene["grace-fo-pair"], *revolutions(100))),
        ("bounded, Molniya", study("bounded", scene["bounded-molniya"])),
        ("conjunction", study("uncertainty", scene["conjunction-geosynchronous"])),
        ("uncertainty, low orbit", study("uncertainty", scene["uncertainty-leo"])),
        ("eval, a million deputies", evaluated(folder, 1_000_000)),
    ]


def growth(folder: Path) -> list[tuple[str, list[tuple[float, list[str]]]]]:
    return [
        ("transfer by revolutions",
         [(n, study("transfer", SATELLITES, *revolutions(n))) for n in (1, 10, 100, 1000)]),
        ("motion by revolutions",
         [(n, study("motion", SATELLITES, *revolutions(n))) for n in (1, 10, 100, 1000)]),
        ("transfer by times",
         [(n, study("transfer", SATELLITES, "--set", f"transfer.count={n}"))
          for n in (24, 96, 384)]),
        ("run by coefficients (orders 1, 2, 4, 6 and 8)",
         [(n, study("run", "paper-orbit.toml", "--set", f"jet.order={order}"))
          for order, n in ((1, 6), (2, 27), (4, 209), (6, 923), (8, 3002))]),
        ("eval by rows", [(n, evaluated(folder, n)) for n in (1000, 10_000, 100_000, 1_000_000)]),
        ("uncertainty by samples",
         [(n, study("uncertainty", str(SCENES / "uncertainty-leo.toml"), "--set",
                    f"uncertainty.samples={n}")) for n in (1000, 10_000, 100_000)]),
    ]


def measured(runners: list[Runner], arguments: list[str],
             repeats: int) -> list[tuple[float, float]]:
    """For each program the medians of seconds and megabytes, from runs in turns."""
    for runner in runners:
        if arguments[0] == "eval" and not (runner.folder / "jet").exists():
            runner.run("run", "paper-orbit.toml", "-q", "-o", "jet")
    runs: list[list[tuple[float, float]]] = [[] for _ in runners]
    while len(runs[0]) < repeats or (len(runs[0]) < SHORT_REPEATS and runs[-1][-1][0] < SHORT):
        for runner, results in zip(runners, runs):
            results.append(runner.run(*arguments))
    return [(statistics.median(s for s, _ in results), max(m for _, m in results))
            for results in runs]


def told(seconds: float) -> str:
    return "refused" if seconds != seconds else f"{seconds:.3g}"


def print_answers(runners: list[Runner], folder: Path, repeats: int, only: str) -> None:
    names = [" before", ""] if len(runners) > 1 else [""]
    print("| answer |" + "".join(f" seconds{n} | MB{n} |" for n in names))
    print("|---|" + "---|---|" * len(runners))
    for name, arguments in answers(folder):
        if only not in name:
            continue
        cells = measured(runners, arguments, repeats)
        print(f"| {name} |" + "".join(f" {told(s)} | {m:.0f} |" for s, m in cells), flush=True)
    if only in "pictures":
        print_pictures(runners, repeats)
    if only in "first jet":
        print_first_jets(runners)


def print_pictures(runners: list[Runner], repeats: int) -> None:
    """What gnuplot and the wait for it take of a motion."""
    wholes, pictures = [], []
    for runner in runners:
        plain, drawn = [], []
        for _ in range(max(repeats, SHORT_REPEATS)):
            plain.append(runner.run(*study("motion", SATELLITES))[0])
            drawn.append(runner.run(*study("motion", SATELLITES), draws=True)[0])
        wholes.append(statistics.median(drawn))
        pictures.append(wholes[-1] - statistics.median(plain))
    print("| motion with its seven pictures |" + "".join(f" {told(s)} | |" for s in wholes))
    print("| of it, the pictures |" + "".join(f" {told(s)} | |" for s in pictures), flush=True)


def print_first_jets(runners: list[Runner]) -> None:
    """The first integration of a process, by the clock, as the command tells it."""
    for order in (1, 4):
        times: list[list[float]] = [[] for _ in runners]
        for _ in range(2 * SHORT_REPEATS):
            for runner, results in zip(runners, times):
                runner.run(*study("run", "paper-orbit.toml", "--set", f"jet.order={order}"))
                summary = json.loads((runner.folder / "run" / "summary.json").read_text())
                results.append(summary["runs"][0]["wall_seconds"])
        cells = "".join(f" {told(statistics.median(results))} | |" for results in times)
        print(f"| first jet of a process, order {order} (clock) |{cells}", flush=True)


def print_growth(runner: Runner, folder: Path, picture: str | None) -> None:
    print("\n| answer | seconds at each count | growth of time over that of the count |")
    print("|---|---|---|")
    curves = []
    for name, points in growth(folder):
        times = [(n, measured([runner], arguments, 1)[0][0]) for n, arguments in points]
        (first, start), (last, end) = times[0], times[-1]
        cells = ", ".join(f"{n:g}: {told(s)}" for n, s in times)
        print(f"| {name} | {cells} | {end / start / (last / first):.2g} |", flush=True)
        curves.append((name, times))
    if picture:
        draw(curves, picture)


def draw(curves: list[tuple[str, list[tuple[float, float]]]], picture: str) -> None:
    lines = ["set terminal pngcairo size 900,560 font ',11'", f"set output '{picture}'",
             "set logscale xy", "set xlabel 'count'", "set ylabel 'processor time (s)'",
             "set grid", "set key below"]
    for i, (_, points) in enumerate(curves):
        rows = "\n".join(f"{n} {s}" for n, s in points if s == s)
        lines.append(f"$c{i} << EOD\n{rows}\nEOD")
    plots = [f"$c{i} with linespoints lw 2 pt {i + 4} title '{name}'"
             for i, (name, _) in enumerate(curves)]
    lines.append("plot " + ", ".join(plots))
    subprocess.run(["gnuplot"], input="\n".join(lines), text=True, check=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", help="the command, build/hamjet")
    parser.add_argument("--before", help="another one, to stand beside it")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--only", default="", help="answers whose names have this text")
    parser.add_argument("--growth", action="store_true", help="how each grows, too")
    parser.add_argument("--picture", help="file (PNG) for a picture of the growth")
    given = parser.parse_args()
    print(time.strftime("%Y-%m-%d"), f"medians of {given.repeats}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        programs = [given.before, given.program] if given.before else [given.program]
        runners = [Runner(program, folder / str(i)) for i, program in enumerate(programs)]
        print_answers(runners, folder, given.repeats, given.only)
        if given.growth or given.picture:
            print_growth(runners[-1], folder, given.picture)


if __name__ == "__main__":
    main()
