#!/usr/bin/env python3
"""Attacks the studies of hamjet with random scenes: the command is run as a user runs it, and what
it tells is judged by flights and formulas that share no code with it.

  attack.py COUNT [SEED] [--earth] [--only STUDY,...] [--scene N] [--folder DIR] [--jobs N]

Environment: HAMJET_COMMAND, the built command; HAMJET_ATTACK_FLIGHTS, the library of flights.cpp.
Exit code 1 if an answer is wrong and the program does not say so itself."""
import argparse
import collections
import concurrent.futures
import importlib
import os
import shutil
import sys
import tempfile
import traceback

sys.dont_write_bytecode = True
try:
    import numpy as np
    import scipy  # noqa: F401, of the judges
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

from command import NoNumber, TooSlow
from drawing import Draw, Scene
from earth_scene import EarthScene
from judgement import Judgement

# Studies by the weight with which they are drawn.
STUDIES = {"motion": 5, "evaluation": 6, "transfer": 6, "validity": 3, "assignment": 3,
           "moments": 4, "collision": 3, "safety": 2, "event": 3, "poincare": 1, "bounded": 2}
# The studies about the real Earth, whose forces depend on the time.
STUDIES_OF_EARTH = {"jet": 5, "motion": 5, "transfer": 4, "validity": 2, "evaluation": 4}

OUTCOMES = ("right", "marked", "wrong")


def processor_seconds():
    """Of this process and of the commands that it has run."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def attack(job):
    """Draws, runs and judges one scene."""
    study, seed, index, folder, scene_type = job
    judgement = Judgement()
    work = os.path.join(folder, f"{index}-{study}")
    os.makedirs(work)
    began = processor_seconds()
    text = ""
    try:
        module = importlib.import_module(study)
        scene = module.draw(Draw(seed, index, scene_type))
        text = scene.text
        with open(os.path.join(work, "scene.toml"), "w") as file:
            file.write(text)
        for name, content in scene.files.items():
            with open(os.path.join(work, name), "w") as file:
                file.write(content)
        module.judge(judgement, scene, work)
    except TooSlow as slow:
        judgement.mark("too slow to judge: " + str(slow))
    except NoNumber as fault:
        judgement.wrong(str(fault))
    except Exception:
        judgement.wrong("the judge failed: " + traceback.format_exc())
    outcome = judgement.outcome
    if outcome == "wrong":
        with open(os.path.join(work, "wrong.txt"), "w") as file:
            file.write("\n".join(judgement.faults) + "\n")
    else:
        shutil.rmtree(work)
    return (study, index, outcome, judgement.faults, judgement.marks, judgement.notes,
            judgement.checks, processor_seconds() - began)


def studies_of(arguments):
    """The study of every scene, the same for a seed whatever is left out."""
    generator = np.random.default_rng([arguments.seed, 2 ** 31])
    # Every study comes in turn, as often as its weight says.
    studies = STUDIES_OF_EARTH if arguments.earth else STUDIES
    cycle = [name for name in studies for _ in range(studies[name])]
    order = []
    while len(order) < arguments.count:
        generator.shuffle(cycle)
        order += cycle
    return order[:arguments.count]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", type=int, nargs="?", default=200)
    parser.add_argument("seed", type=int, nargs="?",
                        default=int.from_bytes(os.urandom(4), "big"))
    parser.add_argument("--earth", action="store_true", help="scenes about the real Earth")
    parser.add_argument("--only", help="studies, between commas")
    parser.add_argument("--scene", type=int, help="this scene alone")
    parser.add_argument("--folder", help="where scenes that come out wrong are kept")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--marks", action="store_true", help="print marked scenes too")
    arguments = parser.parse_args()
    folder = arguments.folder or tempfile.mkdtemp(prefix="hamjet-attack-")
    os.makedirs(folder, exist_ok=True)
    print(f"seed {arguments.seed}, {arguments.count} scenes; wrong ones are kept in {folder}",
          flush=True)
    wanted = set(arguments.only.split(",")) if arguments.only else {*STUDIES, *STUDIES_OF_EARTH}
    scene_type = EarthScene if arguments.earth else Scene
    jobs = [(study, arguments.seed, index, folder, scene_type)
            for index, study in enumerate(studies_of(arguments))
            if study in wanted and arguments.scene in (None, index)]
    counts = collections.defaultdict(collections.Counter)
    statistics = collections.defaultdict(list)
    spent = collections.Counter()
    checks = 0
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        for study, index, outcome, faults, marks, notes, made, seconds in pool.map(attack, jobs):
            counts[study][outcome] += 1
            checks += made
            for name, value in notes:
                statistics[name].append(value)
            if outcome == "wrong":
                print(f"WRONG scene {index} ({study}): {folder}/{index}-{study}/scene.toml")
                for fault in faults[:6]:
                    print("  " + fault)
            elif outcome == "marked" and arguments.marks:
                print(f"marked scene {index} ({study}): {'; '.join(marks)[:400]}")
            spent[study] += seconds
            if seconds > 20:
                print(f"slow scene {index} ({study}): {seconds:.1f} s")
            sys.stdout.flush()
    print(f"\n{'study':12}{'right':>8}{'marked':>8}{'wrong':>8}{'seconds':>9}")
    total = collections.Counter()
    for study, outcomes in sorted(counts.items()):
        total.update(outcomes)
        print(f"{study:12}" + "".join(f"{outcomes[o]:8}" for o in OUTCOMES)
              + f"{spent[study]:9.0f}")
    print(f"{'all':12}" + "".join(f"{total[o]:8}" for o in OUTCOMES)
          + f"{sum(spent.values()):9.0f}")
    print(f"{checks} comparisons; seed {arguments.seed}")
    for name, values in sorted(statistics.items()):
        print(f"  {name}: median {np.median(values):.3g}, largest {np.max(values):.3g} of "
              f"{len(values)}")
    return 1 if total["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())
