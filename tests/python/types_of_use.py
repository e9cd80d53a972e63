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
    jet.save(pathlib.Path("jet.h5"), overwrite=True)
    again: hamjet.Jet = hamjet.Jet.load("jet.h5", run=names[0]) @ jet
    made = hamjet.Jet.from_arrays(again.coefficients, again.exponents, model=jet.model,
                                  nominal_initial=jet.nominal_initial,
                                  duration_canonical=jet.duration_canonical,
                                  units=hamjet.Units(7000, 900), variables=names)
    matrices: npt.NDArray[np.float64] = made.jacobian(points)
    scene = hamjet.orbit(a_km=7078, e=0.001, i_deg=98, order=4, duration_orbits=0.8)
    hamjet.validity({**scene, "validity": {"frame": "RTN"}}).plot()
    print(hamjet.transfer(scene).to_dataframe().head(), matrices.shape)
    nearest: hamjet.Separation = hamjet.motion({**scene, "deputy": {}}).nearest
    print(nearest.time_s, nearest.position_m @ nearest.velocity_m_s)
    stored = hamjet.load(pathlib.Path("out"), run=names[0])
    assert isinstance(stored, hamjet.StudyResult)
    try:
        times, flown = hamjet.transfer("scene.toml").trajectory(0)
    except (hamjet.SceneError, hamjet.InputOutputError) as error:
        print(error.exit_code)
    return values + states[:, 0]
