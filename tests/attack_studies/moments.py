"""hamjet uncertainty: means and covariances against flown samples, and the linear covariance
against the linear flow."""
import numpy as np

import orbit
from command import Run
from flight import REAL, coast_times
from refusal import judge_surface, results
from uncertain import (burn_covariance, draw_burn, draw_known, inertial_covariance, samples_of)

SAMPLES = 1200
SCATTERS = 7


def draw(source):
    scene = source.scene(revolutions=(0.1, source.one_of([2, 5, 12])), orders=(1, 2, 3, 4),
                  weights=(1, 4, 4, 2))
    table = scene.tables["uncertainty"] = {}
    scene.frame_of_results = scene.frame(table, "inertial")
    sigma = source.logarithmic(0.1, 3000)
    covariance, _ = draw_known(scene, table, sigma, frames=False)
    scene.chief_covariance = inertial_covariance(scene.chief, covariance, scene.frame_of_results)
    scene.deputy_state = None
    if source.chance(0.4):
        deputy = scene.tables["deputy"] = {}
        frame = scene.frame(deputy)
        scene.deputy_state = scene.deputy(deputy, scene.chief, source.logarithmic(10, 2e4), frame)
        own = table["deputy"] = {}
        # The frame of the results is that of the deputy's covariance too, where none is said.
        covariance, frame = draw_known(scene, own, sigma * source.uniform(0.1, 1), frames=False)
        scene.deputy_covariance = inertial_covariance(scene.deputy_state, covariance,
                                                      scene.frame_of_results)
    if source.chance(0.2):
        burn = table["burn"] = {}
        frame = draw_burn(scene, burn, sigma * float(scene.rate) * source.logarithmic(1, 100))
        # What is not said is of [uncertainty].
        if "frame" not in burn:
            frame = (scene.frame_of_results[0], burn.get("derivatives",
                                                         scene.frame_of_results[1]))
        if frame[0] == "inertial":
            burn.pop("derivatives", None)
        state = scene.chief if scene.deputy_state is None else scene.deputy_state
        added = burn_covariance(state, burn, frame)
        if scene.deputy_state is None:
            scene.chief_covariance = scene.chief_covariance + added
        else:
            scene.deputy_covariance = scene.deputy_covariance + added
    scene.density = 0.0
    if source.chance(0.15):
        speed = sigma * float(scene.rate)
        scene.density = speed ** 2 / float(scene.period) * source.uniform(0, 1)
        table["acceleration_density_m2_s3"] = scene.density
    keys, scene.times = scene.times(2)
    table.update(keys)
    table["samples"] = source.one_of([500, 1500])
    table["seed"] = source.integer(1, 10 ** 6)
    # A frame of the results decides what a table below it inherits.
    return scene


def judge(judgement, scene, folder):
    run = Run(folder, ["uncertainty", "scene.toml", "-o", "out"], limit=90)
    summary = results(judgement, scene, run)
    if summary is None:
        return
    judge_surface(judgement, scene, run, summary)
    random = np.random.default_rng(scene.draw.integer(0, 2 ** 31))
    starts = {"chief": scene.chief + samples_of(random, scene.chief_covariance, SAMPLES)}
    if scene.deputy_state is not None:
        starts["deputy"] = scene.deputy_state + samples_of(random, scene.deputy_covariance, SAMPLES)
    judgement.require("one entry a time", len(summary["times"]) == len(scene.times))
    for entry, time in zip(summary["times"], scene.times):
        judgement.within("time (s)", entry["time_s"], float(time), 1e-11 * abs(float(time)))
        judge_time(judgement, scene, entry, time, starts)


def judge_time(judgement, scene, entry, time, starts):
    chief = scene.chief_at(time)
    ends = {name: scene.field.to(states, time, REAL(1e-13)) for name, states in starts.items()}
    told_in = {name: orbit.to_frame(chief, states - chief, *scene.frame_of_results)
               for name, states in ends.items()}
    if "deputy" in told_in:
        told_in["relative"] = told_in["deputy"] - told_in["chief"]
    linear = linear_covariances(scene, time, chief)
    for state in entry["states"]:
        name = f"{state['name']} after {float(time):.6g} s"
        if state["name"] not in told_in:
            judgement.wrong(f"{name}: no such state")
            continue
        mine = np.array(told_in[state["name"]], dtype=float)
        family = state["families"][0]
        judge_linear(judgement, name, family["orders"][0], linear.get(state["name"]))
        noise = np.zeros(6)
        if scene.density:
            noise = np.diag(linear["noise"]) * (2 if state["name"] == "relative" else 1)
        judge_samples(judgement, name, state, mine, noise, family)


def moments(samples):
    mean, s = samples.mean(axis=0), samples.std(axis=0, ddof=1)
    z = (samples - mean) / s
    kurtosis = (z ** 4).mean(axis=0)
    count = len(samples)
    return mean, s, s / np.sqrt(count), s * np.sqrt(np.maximum(kurtosis - 1, 1) / (4 * count))


def judge_samples(judgement, name, state, mine, noise, family):
    mean, s, mean_scatter, s_scatter = moments(mine)
    # White noise of the acceleration is added to what is flown, as it is to the moments.
    s_with = np.sqrt(s ** 2 + noise)
    s_scatter, mean_scatter = s_scatter * s_with / s, mean_scatter * s_with / s
    flown = state["flown"]
    if flown:
        for i in range(6):
            judgement.within(
                f"{name}: flown mean of {family['components'][i]}", flown["mean"][i], mean[i],
                SCATTERS * np.hypot(mean_scatter[i], flown["mean_scatter"][i]))
            judgement.within(
                f"{name}: flown deviation of {family['components'][i]}",
                flown["standard_deviation"][i], s_with[i],
                SCATTERS * np.hypot(s_scatter[i], flown["standard_deviation_scatter"][i])
                + 0.02 * s_with[i])
    orders = family["orders"]
    if len(orders) < 2:
        return
    last, before = orders[-1], orders[-2]
    told = np.array(last["standard_deviation"])
    changes = np.abs(told - before["standard_deviation"])
    shifts = np.abs(np.subtract(last["mean"], before["mean"]))
    # Where orders still change the moments, what they leave out is as large, and each polynomial's
    # moments are no more than its own.
    if np.any(changes > 0.05 * told) or np.any(shifts > 0.05 * told):
        return
    for i in range(6):
        judgement.within(f"{name}: mean of {family['components'][i]}, order {len(orders)}",
                         last["mean"][i], mean[i],
                         SCATTERS * mean_scatter[i] + 3 * shifts[i] + 1e-3 * told[i])
        judgement.within(f"{name}: deviation of {family['components'][i]}, order {len(orders)}",
                         told[i], s_with[i],
                         SCATTERS * s_scatter[i] + 3 * changes[i] + 1e-2 * s_with[i])


def linear_covariances(scene, time, chief):
    frame = orbit.to_frame(chief, np.eye(6, dtype=REAL), *scene.frame_of_results).T

    def carried(state, covariance):
        matrix = np.array(frame @ scene.field.transition(state, time), dtype=float)
        return matrix @ covariance @ matrix.T

    found = {"chief": carried(scene.chief, scene.chief_covariance)}
    if scene.density:
        # int Phi(T, s) G q G^T Phi(T, s)^T ds by Gauss's rule, a few nodes for each radian.
        nodes, weights = np.polynomial.legendre.leggauss(6)
        edges = coast_times(scene.field, scene.chief, time, 2.5)
        times = np.concatenate([(a + b) / 2 + (b - a) / 2 * nodes for a, b in
                                zip(edges, edges[1:])])
        weights = np.concatenate([abs(b - a) / 2 * weights for a, b in zip(edges, edges[1:])])
        whole = scene.field.transition(scene.chief, time)
        noise = np.zeros((6, 6))
        for F, w in zip(scene.field.transition(scene.chief, times), weights):
            inverse = np.vstack([np.hstack([F[3:, 3:].T, -F[:3, 3:].T]),
                                 np.hstack([-F[3:, :3].T, F[:3, :3].T])])
            B = np.array(frame @ whole @ inverse, dtype=float)[:, 3:]
            noise += float(w) * scene.density * B @ B.T
        found["noise"] = noise
        found["chief"] = found["chief"] + noise
    return found


def judge_linear(judgement, name, order, mine):
    if mine is None:
        return
    s = np.sqrt(np.diag(mine))
    # What the flow keeps small beside what it stretches has the differences' rounding.
    s = np.concatenate([np.hypot(part, 1e-6 * np.max(part)) for part in (s[:3], s[3:])])
    told = np.array(order["covariance"])
    difference = np.abs(told - mine) / np.outer(s, s)
    worst = np.unravel_index(np.argmax(difference), (6, 6))
    judgement.note("moments: linear covariance, share", difference[worst])
    judgement.within(f"{name}: linear covariance at {worst}, in deviations",
                     told[worst] / s[worst[0]] / s[worst[1]],
                     mine[worst] / s[worst[0]] / s[worst[1]], 1e-4)
