"""hamjet uncertainty with [uncertainty.safety]: least separations of every pair against flights."""
import numpy as np

import orbit
from command import Run
from drawing import rounded
from flight import REAL, coast_times
from refusal import results
from uncertain import (burn_covariance, draw_burn, draw_known, inertial_covariance, judge_quantile,
                       samples_of, share_interval)

SAMPLES = 800


def draw(source):
    scene = source.scene(revolutions=(0.2, source.one_of([2, 4])), orders=(1, 2, 3),
                  weights=(1, 4, 2), may_go_back=False, coordinates=False,
                  whole=source.one_of([None, 2.0, 4.0], [5, 2, 1]))
    deputy = scene.tables["deputy"] = {}
    scene.deputy_frame = scene.frame(deputy)
    distance = source.logarithmic(50, 2e4)
    scene.spacecraft = {"chief": scene.chief}
    if scene.has_node and source.chance(0.4):
        # Of the chief's period, so that it comes back to where it was.
        numbers = [0.0] + source.vector(distance) + source.vector(distance)[:2]
        deputy.update(zip(orbit.RELATIVE_ELEMENTS, numbers))
        scene.spacecraft["deputy"] = orbit.from_form(scene.mu, scene.chief, "relative-elements",
                                                     numbers)
    else:
        scene.spacecraft["deputy"] = scene.deputy(deputy, scene.chief, distance,
                                                  scene.deputy_frame)
    table = scene.tables["uncertainty"] = {"samples": 0, "seed": source.integer(1, 10 ** 6)}
    sigma = distance * source.logarithmic(1e-4, 0.1)
    scene.covariances = {}
    covariance, frame = draw_known(scene, table, sigma, frames=False)
    scene.covariances["chief"] = inertial_covariance(scene.chief, covariance, frame)
    own = table["deputy"] = {}
    covariance, frame = draw_known(scene, own, sigma * source.uniform(0.3, 1), frames=False)
    scene.covariances["deputy"] = inertial_covariance(scene.spacecraft["deputy"], covariance, frame)
    safety = table["safety"] = {"keep_apart_m": distance * source.logarithmic(0.05, 1),
                                "samples": source.one_of([500, 2000])}
    scene.burn = None
    if source.chance(0.5):
        scene.burn = table["burn"] = {}
        scene.burn_frame = draw_burn(scene, scene.burn,
                                     distance * float(scene.rate) * source.logarithmic(0.01, 1))
        scene.shares = [0.0, 1.0]
        if source.chance(0.3):
            scene.shares = safety["burn_shares"] = [source.uniform(0.1, 0.9), 1.0]
    if source.chance(0.3):
        further = {}
        scene.spacecraft["deputy 2"] = scene.deputy(further, scene.chief, distance,
                                                    scene.deputy_frame)
        safety["deputy"] = [further]
        scene.covariances["deputy 2"] = inertial_covariance(scene.spacecraft["deputy 2"],
                                                            covariance, frame)
    scene.window = [0.0, float(scene.duration)]
    if source.chance(0.4):
        a, b = sorted([source.uniform(0, 0.9), source.uniform(0.1, 1)])
        scene.window = [rounded(a * float(scene.duration)), rounded(b * float(scene.duration))]
        if source.chance(0.4) and abs(scene.revolutions) >= 1:
            scene.window = [0.0, float(scene.period) * int(abs(scene.revolutions))]
        if scene.window[1] > float(scene.duration) or scene.window[0] >= scene.window[1]:
            scene.window = [0.0, float(scene.duration)]
        else:
            safety["window_s"] = scene.window
    if source.chance(0.3):
        safety["keep_out_m"] = [distance * source.logarithmic(0.02, 0.5) for _ in range(3)]
    safety["share"] = source.one_of([0.9, 0.95, 0.99])
    return scene


def spacecraft(scene, name, share):
    """Mean and covariance at the start where a share of the burn is done."""
    state, covariance = scene.spacecraft[name], scene.covariances[name]
    if name != "deputy" or scene.burn is None or share is None:
        return state, covariance
    change = np.array([0] * 3 + scene.burn["velocity_change_m_s"], dtype=REAL)
    # A change of velocity is the same whichever way derivatives are told.
    change = orbit.from_frame(state, change, scene.burn_frame[0], "inertial")
    return (state - (1 - REAL(share)) * change,
            covariance + burn_covariance(state, scene.burn, scene.burn_frame, share))


def judge(judgement, scene, folder):
    run = Run(folder, ["uncertainty", "scene.toml", "-o", "out"], limit=120)
    summary = results(judgement, scene, run)
    if summary is None:
        return
    told = summary["safety"]
    scene.printed = run.printed
    random = np.random.default_rng(scene.draw.integer(0, 2 ** 31))
    names = list(scene.spacecraft)
    count = len(names) * (len(names) - 1) // 2
    if scene.burn is not None:
        count += (len(scene.shares) - 1) * (len(names) - 1)
    judgement.require(f"{len(told['pairs'])} pairs, must be {count}", len(told["pairs"]) == count)
    for pair in told["pairs"]:
        judge_pair(judgement, scene, told, pair, random)


def judge_pair(judgement, scene, told, pair, random):
    names = pair["first"], pair["second"]
    share = pair["burn_share"]
    states, covariances = zip(*(spacecraft(scene, n, share) for n in names))
    begin, end = (REAL(x) for x in scene.window)
    what = f"{names[0]} and {names[1]}, burn {share}"
    mean, _ = scene.field.least_separations(states[0][None], states[1][None], begin, end, looks=60,
                                            tolerance=REAL(2) ** -50)
    # Between nodes paths are cubics; an interval says nothing of them, so that they must be good to
    # a hundredth of the least separation and of what is to be kept.
    keep = told["keep_apart_m"]
    judgement.within(f"{what}: least of the means (m)", pair["mean_separation_m"], mean[0],
                     0.01 * float(mean[0]) + 0.001 * keep)
    samples = [s + samples_of(random, c, SAMPLES) for s, c in zip(states, covariances)]
    least, _ = scene.field.least_separations(*samples, begin, end)
    least = np.array(least, dtype=float)
    difference = pair["flight_difference_m"]
    if difference > 0.05 * min(pair["separation_m"], keep):
        judgement.mark(f"{what}: differs from flights by {difference:.3g} m")
        return
    slack = 0.01 + 3 * difference / max(pair["separation_m"], 1e-9)
    judge_quantile(judgement, f"{what}: separation", 1 - told["share"], pair["separation_m"],
                   *pair["separation_interval_m"], least, slack)
    low = int(np.sum(least < keep * (1 - slack)))
    high = int(np.sum(least < keep * (1 + slack)))
    for hits, side in ((low, 0), (high, 1)):
        judgement.checks += 1
        interval = share_interval(hits, SAMPLES)
        lower, upper = pair["probability_nearer_interval"]
        width = upper - lower
        if (side == 0 and interval[0] > upper + width) or (side == 1 and interval[1]
                                                           < lower - width):
            told_share = pair["probability_nearer"]
            judgement.wrong(f"{what}: nearer than {keep:.6g} m told {told_share:.5g} "
                            f"({lower:.5g} to {upper:.5g}), {hits} of {SAMPLES} flown")
    if pair.get("keep_out_deviations") is not None:
        judge_margin(judgement, scene, what, pair, states, covariances, begin, end, random)


def judge_margin(judgement, scene, what, pair, states, covariances, begin, end, random):
    """No deviations clearly shorter than the told ones may touch the ellipsoid."""
    axes = np.array(scene.tables["uncertainty"]["safety"]["keep_out_m"], dtype=REAL)
    if pair["keep_out_deviations"] == 0:
        judgement.at_most(f"{what}: the means are inside, their ratio", pair["keep_out_flown_ratio"], 1)
        return
    if abs(pair["keep_out_flown_ratio"] - 1) > 0.05:
        if judgement.require(f"{what}: its deviations come to {pair['keep_out_flown_ratio']:.3g} of the "
                             "ellipsoid, and nothing says so", "in doubt" in scene.printed):
            judgement.mark(f"{what}: in doubt")
        return
    count = 200
    vectors = random.normal(size=(count, 12))
    vectors *= (0.95 * pair["keep_out_deviations"] / np.linalg.norm(vectors, axis=1))[:, None]
    starts = []
    for k in range(2):
        factor = np.linalg.cholesky(covariances[k] * scaled(covariances[k]))
        back = np.sqrt(np.diag(covariances[k]))
        starts.append(states[k] + (vectors[:, 6 * k:6 * k + 6] @ factor.T) * back)
    first = [scene.field.to(s, begin) for s in starts]
    times = coast_times(scene.field, scene.field.to(scene.chief, begin), end - begin, 12)
    chiefs = scene.field.fly(first[0], times, REAL(1e-13))
    deputies = scene.field.fly(first[1], times, REAL(1e-13))
    x, v = chiefs[..., :3], chiefs[..., 3:]
    R = x / orbit.norm(x)[..., None]
    N = np.cross(x, v)
    N /= orbit.norm(N)[..., None]
    T = np.cross(N, R)
    apart = (deputies - chiefs)[..., :3]
    ratio = np.sqrt(sum((np.sum(apart * a, axis=-1) / w) ** 2 for a, w in zip((R, T, N), axes)))
    judgement.at_most(f"{what}: least ratio within 0.95 of {pair['keep_out_deviations']:.4g} "
                      "deviations, negative", -float(np.min(ratio)), -0.99)


def scaled(covariance):
    s = 1 / np.sqrt(np.diag(covariance))
    return np.outer(s, s) + 1e-12 * np.eye(6)
