"""Refusals that are true: what the command says when it has no answer, and of which scenes that may
be said. A refusal that is not here, or is not of such a scene, is a finding."""
import re

import numpy as np

from command import Refused
from flight import REAL


def is_eccentric(scene):
    return scene.e > 0.4


def is_long(scene):
    return abs(scene.revolutions) > 4


def is_flat(scene):
    return np.sin(scene.i) < 0.02


def has_far_deputy(scene):
    """A deputy that is farther from its chief than the centre: beside an equatorial chief, differences
    of nodes turn its apses away from the chief's."""
    states = [getattr(scene, "deputy_state", None), getattr(scene, "start", None),
              *getattr(scene, "spacecraft", {}).values()]
    return any(state is not None and np.linalg.norm(state[:3] - scene.chief[:3])
               > np.linalg.norm(scene.chief[:3]) for state in states)


def has_unlike_deputy(scene):
    return getattr(scene, "deputy_field", scene.field) is not scene.field


TRUE = [
    # Charts other than flow boxes have no parameters in which a deputy could differ.
    (r"coordinates: of a deputy whose coefficients differ from its chief's", has_unlike_deputy),
    # Charts that the orbit has not.
    (r"no node|equatorial|inclination|no orbital plane", is_flat),
    (r"(deputy|start|deputy\[\d+\]): too far from its chief", has_far_deputy),
    (r"out of memory|needs .* of memory|too large|memory", is_long),
]


def judge_refusal(judgement, scene, refused, more=()):
    """Marks a refusal whose reason is true; else it is wrong."""
    if refused.code in (1, 3, 4, 6):
        for pattern, holds in [*more, *TRUE]:
            if re.search(pattern, refused.text) and holds(scene):
                judgement.mark(f"refused, exit code {refused.code}: {first_line(refused.text)}")
                return
    judgement.wrong(f"refused, exit code {refused.code}: {first_line(refused.text)}")


def results(judgement, scene, run, more=()):
    """summary.json of a run that wrote to out; None where it refused, which is judged. An exit code
    beside results is marked."""
    try:
        summary = run.summary("out")
    except Refused as refused:
        judge_refusal(judgement, scene, refused, more)
        return None
    if run.code:
        judgement.mark(f"exit code {run.code}: {run.said.strip()[:200]}")
    return summary


def first_line(text):
    lines = [line for line in text.splitlines() if "error" in line] or text.splitlines() or [""]
    return lines[0][:300]


def says_below_surface(run, summary):
    words = run.printed + run.said + str(summary.get("verdict", "")) + str(
        summary.get("notes", "")) + str(summary.get("warnings", ""))
    return re.search(r"surface|below the|inside the body|ground", words) is not None


def judge_surface(judgement, scene, run, summary):
    if scene.highest and scene.lowest() < scene.radius * REAL(0.99999):
        if run.code or says_below_surface(run, summary):
            judgement.mark("below the surface")
        else:
            judgement.wrong("nothing is said of a chief below the surface")
