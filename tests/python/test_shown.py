"""What objects show of themselves: a few lines that say what matters."""

import dataclasses
import pickle

import numpy as np
import pytest

import hamjet
from hamjet.studies import Study
from conftest import ORBIT, OSCILLATOR, SOURCE, scene
from test_bounded import SCENE as BOUNDED, SHORT
from test_motion import CIRCLES
from test_relative_motion import TRANSFER
from test_to_dataframe import VALIDITY
from test_uncertainty import SCENE as UNCERTAINTY


def objects():
    result = hamjet.run(scene(ORBIT, figure={"quantity": "exactness", "kind": "F1"},
                              generating_function={"kinds": ["F1"]}))
    run = result.runs["gauss8"]
    motion = hamjet.motion(CIRCLES)
    study = hamjet.run(SOURCE / "data" / "scenes" / "paper" / "double-well.toml",
                       overrides=["canonical_transformation.duration_canonical=5"])
    return [result, run, run.nominal, run.along_time, run.jet, run.jet.units,
            run.jet.invert_partially("F1"), run.jet.evaluate_relative(np.ones((500, 6))),
            motion, motion.nearest, hamjet.transfer(TRANSFER), hamjet.validity(VALIDITY), study,
            hamjet.assign(SOURCE / "data" / "scenes" / "assignment-tetrahedron.toml",
                          overrides=["transfer.count=3"]),
            hamjet.poincare(BOUNDED, overrides=SHORT), hamjet.bounded(BOUNDED, overrides=SHORT),
            hamjet.event(BOUNDED, overrides=[*SHORT, "event.surface='apsis'"]),
            hamjet.periodic(SOURCE / "data" / "scenes" / "own" / "earth-moon-halo-l2.toml",
                            overrides=["periodic.family.to=1.6"]),
            hamjet.uncertainty(UNCERTAINTY),
            hamjet.system("p^2/2 - g*cos(q)", coordinates="q", parameters={"g": 9.81}),
            hamjet.collision_probability([[7e6, 0, 0, 0, 7546, 0], [7e6, 0, 0, 0, 6622, 3618]],
                                         np.broadcast_to(np.diag([1e4] * 3 + [1e-2] * 3), (2, 6, 6)),
                                         10, (0, 60), samples=4096),
            hamjet.polynomial_moments([[0.0, 1.0]], [[0], [1]], [[1.0]])]


@pytest.mark.parametrize("value", objects(), ids=lambda value: type(value).__name__)
def test_results_show_one_to_three_lines(value):
    text = repr(value)
    assert "hamjet." + type(value).__name__ in text or text.startswith("Units(")
    assert len(text) < 300 and text.count("\n") <= 2 and "array(" not in text, text
    # What has come out of a pickle shows the same.
    assert repr(pickle.loads(pickle.dumps(value))) == text


def test_every_data_class_shows_itself():
    shown = {type(value) for value in objects()}
    classes = {getattr(hamjet, name) for name in hamjet.__all__}
    assert {each for each in classes if dataclasses.is_dataclass(each)
            or isinstance(each, type) and issubclass(each, Study)} <= shown


def test_motion_shows_how_near_how_far_and_how_wrong():
    motion = hamjet.motion(CIRCLES)
    assert repr(motion) == (
        f"<hamjet.Motion: {len(motion.time_s)} times from 0 s to {motion.time_s[-1]:.6g} s, RTN "
        "with rotating derivatives\n"
        f" nearest {motion.separation_m.min():.6g} m at {motion.nearest.time_s:.6g} s, farthest "
        f"{motion.farthest.separation_m:.6g} m at {motion.farthest.time_s:.6g} s\n"
        f" order 3 is wrong by up to {motion.error_m_by_order[:, 2].max():.3g} m>")


def test_transfers_show_the_best_or_that_there_is_none():
    transfers = hamjet.transfer(TRANSFER)
    best = transfers.best
    assert repr(transfers).endswith(
        f"\n best={best}: {transfers.total_change_m_s[best]:.6g} m/s in "
        f"{transfers.time_s[best]:.6g} s, missing by {transfers.miss_m[best]:.3g} m>")
    none = pickle.loads(pickle.dumps(transfers))
    vars(none)["best"] = None
    assert repr(none).endswith(
        "\n no answer within the tolerance and away from singularities>")


def test_one_relative_state_shows_its_numbers(jet):
    found = jet.evaluate_relative(np.zeros(6))
    assert repr(found).startswith("<hamjet.RelativeStates: R_m 0, T_m 0, N_m 0, vR_m_s ")
    assert "\n inside, miss about " in repr(found)


def test_failed_runs_and_many_runs_are_shown():
    # Beyond Verlet's limit of stability: step times frequency is 6.
    failing = {"label": "verlet", "method": "velocity-verlet", "order": 2, "step_canonical": 3.0}
    many = [dict(OSCILLATOR["integrator"][0], label=f"run{i}") for i in range(10)]
    shown = repr(hamjet.run(scene(OSCILLATOR, integrator=many)))
    assert shown == ("<hamjet.Result of scene: 10 runs, run0, run1, run2, run3, run4, run5, run6, "
                     "run7, 2 more; exit code 0>")
    result = hamjet.run(scene(OSCILLATOR, integrator=[*many[:1], failing],
                              jet={"order": 1, "duration_canonical": 30}))
    assert repr(result) == "<hamjet.Result of scene: 2 runs, run0, verlet (failed); exit code 4>"
    failed = result.runs["verlet"]
    assert repr(failed) == f"<hamjet.Run verlet, failed: {failed.error}>"


def test_failed_checks_are_shown():
    result = hamjet.run(OSCILLATOR, overrides={"integrator.gauss8.require_symplecticity": 1e-30})
    run = result.runs["gauss8"]
    assert repr(run) == (f"<hamjet.Run gauss8 with {run.jet!r}\n"
                         f" failed check: {run.failed_checks[0]}>")
