"""High-order Taylor maps and generating functions of Hamiltonian flows.

    import hamjet

    result = hamjet.run("data/scenes/molniya.toml")
    jet = result.runs["gauss8"].jet
    final = jet.evaluate(deviations)               # (N, 6) initial deviations, canonical
    f1 = jet.invert_partially("F1")                # a generating function
    transfers = hamjet.transfer("data/scenes/transfer-earth-orbit.toml")

A scene is a TOML file, its text, or a dict, which `orbit` makes of keyword arguments;
data/scenes/README.md has its keys. A Hamiltonian or a vector
field of your own is a function, text, or an expression of SymPy: see `system`. Coefficients, exponents and
trajectories are NumPy arrays, read-only. Mistakes are raised as subclasses of `Error`, with the
text that the command prints. Long work lets other threads run and ends within a second of Ctrl-C.
"""

from ._hamjet import GeneratingFunction, Jet, Units, __version__
from .axes import change_axes
from .bounded import Bounded, Event, FrozenOrbit, Periodic, bounded, event, periodic, poincare
from .collisions import Collisions, collision_probability, conjunctions
from .elements import elements_of_states, mean_states, osculating_states, states_of_elements
from .errors import (Error, ExistingFileError, InputOutputError, MissingFileError, NumericalError,
                     SceneError, TooLargeError, UsageError)
from .many import ManyJets, propagate_many
from .orbits import orbit
from .polynomials import Polynomials, polynomials
from .relative_motion import (Assignment, Motion, Separation, Transfers, Validity, assign, motion,
                              transfer, validity)
from .relative_states import RelativeStates
from .results import AlongTime, Nominal, Result, Run, StudyResult, load, run
from .systems import System, system
from .trajectory import Trajectory, trajectory
from .uncertainty import Moments, Uncertainty, polynomial_moments, uncertainty

__all__ = [
    "AlongTime", "Assignment", "Bounded", "Collisions", "Error", "Event", "ExistingFileError",
    "FrozenOrbit", "GeneratingFunction", "InputOutputError", "Jet", "ManyJets",
    "MissingFileError", "Moments", "Motion", "Nominal", "NumericalError", "Periodic",
    "Polynomials", "RelativeStates", "Result", "Run", "SceneError", "Separation",
    "StudyResult", "System", "TooLargeError", "Trajectory", "Transfers", "Uncertainty",
    "Units", "UsageError", "Validity", "__version__", "assign", "bounded",
    "change_axes", "collision_probability", "conjunctions", "elements_of_states", "event", "load", "mean_states", "motion",
    "orbit", "osculating_states", "periodic", "poincare", "polynomial_moments", "polynomials",
    "propagate_many", "run", "states_of_elements", "system", "trajectory", "transfer",
    "uncertainty", "validity",
]
