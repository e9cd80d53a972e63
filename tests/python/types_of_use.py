"""Typical use, for mypy alone: what a user writes has the types that he expects."""

import pathlib

import numpy as np
import numpy.typing as npt

import hamjet


def use(points: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    result = hamjet.run({"schema": 1}, overrides={"jet.order": 4}, threads=2,
                        progress=lambda task, fraction: print(task, fraction))
    assert isinstance(result, hamjet.Result)
    jet: hamjet.Jet = result.runs["gauss8"].jet
    names: tuple[str, ...] = jet.variables
    function: hamjet.GeneratingFunction = jet.invert_partially("F1")
    values = function.evaluate(jet.compose(jet.inverse()).evaluate(points, out=points))
    states: npt.NDArray[np.float64] = jet.evaluate_relative(points).states
    stored = hamjet.load(pathlib.Path("out"), run=names[0])
    assert isinstance(stored, hamjet.StudyResult)
    try:
        times, flown = hamjet.transfer("scene.toml").trajectory(0)
    except (hamjet.SceneError, hamjet.InputOutputError) as error:
        print(error.exit_code)
    return values + states[:, 0]
