"""What the studies of table [uncertainty] share: spacecraft whose states are Gaussian, as a scene
tells them, and samples of these."""
import numpy as np
from scipy.stats import beta

import orbit
from flight import REAL

SURE = 1e-7  # of a judge's own interval, on each side


def draw_known(scene, table, sigma, default_derivatives="inertial", frames=True):
    """Draws how well a spacecraft is known, into a table; gives its covariance along its frame."""
    source = scene.draw
    frame = ("RTN", default_derivatives)
    if frames:
        frame = scene.frame(table, default_derivatives)
    rate = float(scene.rate)
    if source.chance(0.25):
        factor = source.generator.normal(size=(6, 6)) * np.array(
            [sigma] * 3 + [sigma * rate] * 3)[:, None] / 3
        covariance = factor @ factor.T
        covariance = np.vectorize(lambda x: float(f"{x:.15g}"))((covariance + covariance.T) / 2)
        table["covariance_m_m_s"] = [list(row) for row in covariance]
        return covariance, frame
    table["position_m"] = [sigma * source.logarithmic(0.2, 1) for _ in range(3)]
    table["velocity_m_s"] = [sigma * rate * source.logarithmic(0.05, 0.5) for _ in range(3)]
    return np.diag(np.array(table["position_m"] + table["velocity_m_s"]) ** 2), frame


def inertial_covariance(state, covariance, frame):
    """The covariance along inertial axes, from one along the axes of the spacecraft's own orbit."""
    matrix = orbit.from_frame(state, np.eye(6, dtype=REAL), *frame).T
    return np.array(matrix @ covariance @ matrix.T, dtype=float)


def draw_burn(scene, table, speed):
    source = scene.draw
    frame = scene.frame(table, "inertial")
    table["velocity_change_m_s"] = source.vector(speed)
    table["magnitude"] = source.logarithmic(1e-3, 0.1)
    table["direction_deg"] = source.logarithmic(0.05, 5)
    return frame


def burn_covariance(state, table, frame, share=1.0):
    """The covariance of Gates's model to first order, with the parts proportional to the change."""
    v = np.array(table["velocity_change_m_s"])
    m, d = table["magnitude"], np.radians(table["direction_deg"])
    along = (m * m - d * d) * np.outer(v, v) + d * d * v @ v * np.eye(3)
    whole = np.zeros((6, 6))
    whole[3:, 3:] = along * share ** 2
    return inertial_covariance(state, whole, frame)


def samples_of(random, covariance, count):
    values, vectors = np.linalg.eigh(covariance * scaling(covariance))
    factor = vectors * np.sqrt(np.maximum(values, 0))
    back = 1 / np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    return (random.normal(size=(count, 6)) @ factor.T) / back


def scaling(covariance):
    deviations = 1 / np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    return np.outer(deviations, deviations)


def share_interval(hits, count):
    """Clopper and Pearson's interval."""
    low = beta.ppf(SURE, hits, count - hits + 1) if hits else 0.0
    high = beta.ppf(1 - SURE, hits + 1, count - hits) if hits < count else 1.0
    return low, high


def judge_share(judgement, name, told, lower, upper, hits, count, slack=0.0):
    """A told probability whose 95 % interval is widened by itself on both sides; `hits` are the
    fewest and the most that may count."""
    low, high = share_interval(hits[0], count)[0], share_interval(hits[1], count)[1]
    width = upper - lower
    judgement.checks += 1
    if not (0 <= lower <= told <= upper <= 1):
        judgement.wrong(f"{name}: told {told}, interval {lower} to {upper}")
    elif lower - width - slack > high or upper + width + slack < low:
        judgement.wrong(f"{name}: told {told:.5g} ({lower:.5g} to {upper:.5g}), {hits[0]} to "
                        f"{hits[1]} of {count} flown ({low:.5g} to {high:.5g})")


def judge_quantile(judgement, name, share, told, lower, upper, values, slack):
    """A told quantile with its interval: of the flown values a share lies below it."""
    count = len(values)
    width = 0.5 * ((upper if upper is not None else told) - lower)
    below = int(np.sum(values < (lower - width) * (1 - slack)))
    low, _ = share_interval(below, count)
    judgement.checks += 1
    if low > share:
        judgement.wrong(f"{name}: told {told:.6g} m (from {lower:.6g}) for {share}, of {count} "
                        f"flown {below} are nearer")
    if upper is not None:
        below = int(np.sum(values <= (upper + width) * (1 + slack)))
        _, high = share_interval(below, count)
        if high < share:
            judgement.wrong(f"{name}: told {told:.6g} m (to {upper:.6g}) for {share}, of {count} "
                            f"flown {below} are nearer")
