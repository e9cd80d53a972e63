"""The least sum of impulses of a linear theory, by linear programmes (HiGHS) whose columns are
impulses in some directions, added until primal and dual agree."""
import numpy as np
from scipy.optimize import linprog
from scipy.sparse import csc_matrix

TOO_DEAR = 1e3  # of what nothing but impulses should do, in parts of a column's usual cost


def least_sum(effects, change, limit=None, rounds=40):
    """Impulses at the times of effects [time, 6, 3], none above the limit, whose sum of effects is
    `change`: the least sum of magnitudes that was found (none where the limit allows none), and a
    lower bound by the dual

        change.y - limit sum_k max(0, |B_k^T y| - 1) .
    """
    scale = np.max(np.abs(effects), axis=(0, 2))
    effects, change = effects / scale[:, None], change / scale
    size = np.linalg.norm(change)
    if size == 0:
        return 0.0, 0.0
    # In parts of the change: impulses are then as well, and so is the limit.
    change = change / size
    most = np.inf if limit is None else limit / size
    # Impulses along the axes; and what takes the place of what no impulses do.
    matrix = np.concatenate([np.concatenate([effects, -effects], axis=2).transpose(1, 0, 2)
                             .reshape(6, -1), np.eye(6), -np.eye(6)], axis=1)
    owner = np.concatenate([np.repeat(np.arange(len(effects)), 6), np.full(12, -1)])
    dear = TOO_DEAR / np.min(np.max(np.linalg.norm(effects, axis=1), axis=1))
    found, bound = np.inf, 0.0
    for _ in range(rounds):
        cost = np.where(owner < 0, dear, 1.0)
        limits = {}
        if np.isfinite(most):
            places = np.nonzero(owner >= 0)[0]
            limits = {"A_ub": csc_matrix((np.ones(len(places)), (owner[places], places)),
                                         shape=(len(effects), len(owner))),
                      "b_ub": np.full(len(effects), most)}
        done = linprog(cost, A_eq=matrix, b_eq=change, method="highs", **limits)
        if done.status != 0:
            return None
        y = done.eqlin.marginals
        primer = np.einsum("kij,i->kj", effects, y)
        sizes = np.linalg.norm(primer, axis=1)
        if np.isfinite(most):
            bound = max(bound, change @ y - most * np.sum(np.maximum(sizes - 1, 0)))
            worth = sizes - 1 + done.ineqlin.marginals
        else:
            bound = max(bound, change @ y / sizes.max())
            worth = sizes - 1
        is_done = done.x[owner < 0].sum() < 1e-9
        if is_done:
            found = done.fun
            if bound >= found * (1 - 1e-4):
                break
        if worth.max() < 1e-7:
            break
        there = np.nonzero(worth > 0.1 * worth.max())[0]
        there = there[np.argsort(worth[there])[-60:]]
        new = [effects[k] @ (primer[k] / sizes[k]) for k in there]
        matrix = np.hstack([matrix, np.array(new).T])
        owner = np.concatenate([owner, there])
    return (found * size if np.isfinite(found) else None), bound * size
