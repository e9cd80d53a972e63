"""The least sum of impulses of a linear theory, by linear programmes (HiGHS) with columns or cuts
that are added until primal and dual agree."""
import numpy as np
from scipy.optimize import linprog


def least_sum(effects, change, rounds=60):
    """Impulses of any size at the times of effects [time, 6, 3], whose sum of effects is `change`:
    the least sum of magnitudes that was found, and a lower bound by duality."""
    scale = np.max(np.abs(effects), axis=(0, 2))
    effects, change = effects / scale[:, None], change / scale
    size = np.linalg.norm(change)
    if size == 0:
        return 0.0, 0.0
    change = change / size
    columns = [(k, s * np.eye(3)[i]) for k in range(len(effects)) for i in range(3)
               for s in (1, -1)]
    matrix = np.array([effects[k] @ d for k, d in columns]).T
    best = np.inf, 0.0
    for _ in range(rounds):
        done = linprog(np.ones(matrix.shape[1]), A_eq=matrix, b_eq=change, method="highs")
        if done.status != 0:
            return None
        y = done.eqlin.marginals
        primer = np.einsum("kij,i->kj", effects, y)
        sizes = np.linalg.norm(primer, axis=1)
        largest = sizes.max()
        best = min(best[0], done.fun), max(best[1], change @ y / largest)
        if best[1] >= best[0] * (1 - 1e-6):
            break
        # The new directions are those in which an impulse would save most.
        there = np.nonzero(sizes > 1 + 0.1 * (largest - 1))[0]
        there = there[np.argsort(sizes[there])[-60:]]
        new = [effects[k] @ (primer[k] / sizes[k]) for k in there]
        matrix = np.hstack([matrix, np.array(new).T])
    return best[0] * size, best[1] * size


def least_limited_sum(effects, change, limit, rounds=60):
    """The same with impulses up to a limit: cuts u.v <= s on the magnitudes s <= limit bring the
    programme's value up to the least sum, so that it is a lower bound; None where it has no
    solution, which proves that no impulses do it."""
    scale = np.max(np.abs(effects), axis=(0, 2))
    effects, change = effects / scale[:, None], change / scale
    count = len(effects)
    equal = np.hstack([np.hstack(list(effects)), np.zeros((6, count))])
    cost = np.concatenate([np.zeros(3 * count), np.ones(count)])
    bounds = [(None, None)] * (3 * count) + [(0, limit)] * count
    cuts = []

    def cut(k, direction):
        row = np.zeros(4 * count)
        row[3 * k:3 * k + 3] = direction
        row[3 * count + k] = -1
        cuts.append(row)

    for k in range(count):
        for i in range(3):
            cut(k, np.eye(3)[i])
            cut(k, -np.eye(3)[i])
    value = None
    for _ in range(rounds):
        done = linprog(cost, A_ub=np.array(cuts), b_ub=np.zeros(len(cuts)), A_eq=equal,
                       b_eq=change, bounds=bounds, method="highs")
        if done.status == 2:
            return None
        if done.status != 0:
            return value
        value = done.fun
        impulses = done.x[:3 * count].reshape(count, 3)
        sizes = np.linalg.norm(impulses, axis=1)
        if sizes.sum() <= value * (1 + 1e-5) and sizes.max() <= limit * (1 + 1e-5):
            break
        for k in np.nonzero(sizes > done.x[3 * count:] * (1 + 1e-6) + 1e-15)[0]:
            cut(k, impulses[k] / sizes[k])
    return value
