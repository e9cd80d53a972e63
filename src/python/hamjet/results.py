"""Results of scenes: computed by `run`, or stored by the command and read by `load`."""

from __future__ import annotations

import json
import os
import types
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from . import _hamjet, arguments, scenes, shown
from ._hamjet import Jet
from .errors import InputOutputError, NumericalError, UsageError
from .immutable import Immutable
from .tables import Table, data_frame, read_table

Floats = npt.NDArray[np.float64]
Progress = Callable[[str, float], object]
_T = TypeVar("_T")


def _read_only(array: Floats) -> Floats:
    array.flags.writeable = False
    return array


@dataclass(frozen=True, eq=False)
class Nominal(Immutable):
    """The nominal trajectory of a run at the ends of its steps, M points; read-only arrays."""

    times_canonical: Floats  #: (M,)
    times_s: Floats  #: (M,)
    states: Floats  #: (M, 2n): (q, p), canonical
    energy_error: Floats  #: (M,): (H - H(0)) / abs(H(0)); H - H(0) where H(0) = 0

    def __repr__(self) -> str:
        return shown.of(self, f": {shown.span(self.times_s, 'points')}, energy error up to "
                        f"{shown.largest(self.energy_error)}")


@dataclass(frozen=True, eq=False)
class AlongTime(Immutable):
    """What the scene's [figure] watches, at some hundred times; read-only arrays."""

    times_canonical: Floats  #: (M,)
    times_s: Floats  #: (M,)
    exactness: Floats  #: (M,): residual of degree 0, scaled; NaN where the kind does not exist
    condition: Floats  #: (M,): of the kind's linear part
    energy_error: Floats  #: (M,): relative, signed
    singular_times_canonical: Floats  #: at which the kind does not exist

    def __repr__(self) -> str:
        return shown.of(self, f": {shown.span(self.times_s)}, exactness up to "
                        f"{shown.largest(self.exactness)}, energy error up to "
                        f"{shown.largest(self.energy_error)}, "
                        f"{len(self.singular_times_canonical)} singular times")


@dataclass(frozen=True, eq=False)
class Run(Immutable):
    """What one integrator of a scene gave."""

    label: str
    #: Why there is no result; None if there is one.
    error: str | None
    #: The checks of the scene that failed, and the self-checks, one line each.
    failed_checks: tuple[str, ...]
    _jet: Jet | None = field(repr=False)
    _nominal: Nominal | None = field(repr=False)
    #: None unless the scene has a [figure].
    along_time: AlongTime | None = field(repr=False)
    _summary: str = field(repr=False)

    def __repr__(self) -> str:
        if self.error is not None:
            return shown.of(self, f" {self.label}, failed: {self.error}")
        checks = "".join(f"\n failed check: {check}" for check in self.failed_checks[:2])
        more = len(self.failed_checks) - 2
        return shown.of(self, f" {self.label} with {self.jet!r}{checks}"
                        + (f"\n and {more} more" if more > 0 else ""))

    @property
    def jet(self) -> Jet:
        """The flow's jet; raises NumericalError, saying why, if the run has no result."""
        return self._required(self._jet)

    @property
    def nominal(self) -> Nominal:
        """The nominal trajectory; raises NumericalError if the run has no result."""
        return self._required(self._nominal)

    @property
    def summary(self) -> dict[str, Any]:
        """The run's part of summary.json: steps, times, checks, residuals and errors by degree."""
        return dict(json.loads(self._summary))

    @property
    def error_estimate_by_degree(self) -> Floats | None:
        """Estimated relative errors of degrees 0..order, without a reference; a read-only array.

        None if the check error-estimate is off, or if the independent runs failed: then its text in
        the checks of the summary says why.
        """
        rows = json.loads(self._summary).get("error_estimate_by_degree")
        if rows is None:
            return None
        return _read_only(np.array([row["relative"] for row in rows]))

    def _required(self, result: _T | None) -> _T:
        if result is None:
            raise NumericalError(self.error)
        return result


@dataclass(frozen=True, eq=False)
class Result(Immutable):
    """All results of a scene whose study is a flow's jet; immutable."""

    #: Runs by label, in the order of the scene.
    runs: Mapping[str, Run]
    #: The command's exit code: 0, 1 (a check failed) or 4 (a numerical failure left a part out).
    exit_code: int
    _summary: str = field(repr=False)
    _propagation: _hamjet.Propagation | None = field(repr=False)

    def __repr__(self) -> str:
        runs = shown.listed(label + (" (failed)" if run.error is not None else "")
                            for label, run in self.runs.items())
        return shown.of(self, f" of {self.summary['scene']}: {len(self.runs)} "
                        f"{'run' if len(self.runs) == 1 else 'runs'}, {runs}; exit code "
                        f"{self.exit_code}")

    @property
    def summary(self) -> dict[str, Any]:
        """What the command writes as summary.json; a new dict each time."""
        return dict(json.loads(self._summary))

    def write(self, directory: str | os.PathLike[str]) -> None:
        """Writes what ``hamjet run`` writes: the whole set or nothing. Raises InputOutputError."""
        if self._propagation is None:
            raise UsageError("write: these results were read from files, or unpickled")
        self._propagation.write(arguments.path(directory, "directory"))

    def __getstate__(self) -> dict[str, Any]:
        # The propagation, which files are written from, is many times larger than what is shown.
        return {**super().__getstate__(), "_propagation": None}


@dataclass(frozen=True, eq=False)
class StudyResult(Immutable):
    """Results of a study without a flow jet, of relative motion or a sweep as stored; immutable."""

    #: The command's exit code: 0, 1 (a check failed) or 4 (a numerical failure).
    exit_code: int
    #: Why the exit code is not 0, one line; empty if it is or if that is not stored.
    failure: str
    #: The CSV files by name without suffix, columns by name.
    tables: Mapping[str, Table]
    _summary: str = field(repr=False)
    _report: _hamjet.StudyReport | None = field(repr=False)

    def __repr__(self) -> str:
        tables = shown.listed(f"{name} ({len(next(iter(table.values()), ()))} rows)"
                              for name, table in self.tables.items())
        return shown.of(self, f" with the tables {tables}; exit code {self.exit_code}"
                        + (f"\n {self.failure}" if self.failure else ""))

    @property
    def summary(self) -> dict[str, Any]:
        """What the command writes as summary.json; a new dict each time."""
        return dict(json.loads(self._summary))

    def write(self, directory: str | os.PathLike[str]) -> None:
        """Writes what the command writes: the whole set or nothing. Raises InputOutputError."""
        if self._report is None:
            raise UsageError("write: these results were read from files")
        self._report.write(arguments.path(directory, "directory"))

    def to_dataframe(self, table: str | None = None) -> Any:
        """A pandas.DataFrame of one of the tables, for a sweep of the only one.

        table: its name; None: the only one. Raises UsageError, naming the tables, if there is none
        of this name or several without a name, ImportError where pandas is not installed.
        """
        if table is None and len(self.tables) == 1:
            (table,) = self.tables
        if table is None or table not in self.tables:
            names = ", ".join(sorted(self.tables)) or "none"
            raise UsageError(f"table: got {table!a}, must be one of: {names}")
        return data_frame(self.tables[table])


def _nominal(times: Floats, states: Floats, energy_error: Floats, time_s: float) -> Nominal:
    return Nominal(times, _read_only(times * time_s), states, energy_error)


def _computed_run(propagation: _hamjet.Propagation, index: int, summary: dict[str, Any],
                  time_s: float) -> Run:
    watched = propagation.along_time(index)
    along_time = None
    if watched is not None:
        times, exactness, condition, energy_error, singular = watched
        along_time = AlongTime(times, _read_only(times * time_s), exactness, condition,
                               energy_error, singular)
    jet = propagation.jet(index)
    nominal = None if jet is None else _nominal(*propagation.nominal(index), time_s)
    return Run(summary["label"], summary["error"], tuple(summary["failed_checks"]), jet, nominal,
               along_time, json.dumps(summary))


def run(scene: scenes.Scene, *, overrides: scenes.Overrides | None = None,
        threads: int | None = None, progress: Progress | None = None) -> Result | StudyResult:
    """Runs a scene, as ``hamjet run`` does, and writes no files.

    scene: a path, TOML text (a str with a line break), or the tables as a dict; keys and checks are
    those of the command, see data/scenes/README.md.
    overrides: changes of keys as ``--set`` makes them: {"jet.order": 6, "reference": None}, where
    None removes the key, or strings such as "jet.order=6".
    threads: for the arcs of a scene with jet.arcs, 1 to 1024; the results do not depend on it.
    None: as many as this process may run at once.
    progress: called with (task, fraction in 0..1) a few times a second; what it raises stops the
    work, as Ctrl-C does.

    Returns a Result for a flow's jet, a StudyResult for the studies that have none. What fails
    numerically, or fails a check, is in the result with its exit_code, and the other runs go on.
    Raises SceneError, UsageError, InputOutputError, TooLargeError. Other threads run meanwhile.
    """
    most_threads = arguments.threads(threads)
    reported = arguments.progress(progress)
    given = scenes.read(scene, overrides)
    if not given.is_flow_jet:
        report = _hamjet.run_other_study(given, reported)
        files = report.files
        tables = {name.removesuffix(".csv"): read_table(text)
                  for name, text in files.items() if name.endswith(".csv")}
        return StudyResult(report.exit_code, report.failure, types.MappingProxyType(tables),
                           report.summary, report)
    propagation = _hamjet.run_flow_jet(given, most_threads, reported)
    summary = json.loads(propagation.summary)
    time_s = summary["units"]["time_s"]
    runs = {entry["label"]: _computed_run(propagation, index, entry, time_s)
            for index, entry in enumerate(summary["runs"])}
    return Result(types.MappingProxyType(runs), summary["exit_code"], propagation.summary,
                  propagation)


def _stored_along_time(text: str, time_s: float) -> AlongTime:
    table = read_table(text)
    exactness = np.asarray(table["exactness_degree_0_scaled"])
    # The column is all numbers if the kind exists throughout.
    is_singular = (exactness == "singular" if exactness.dtype.kind == "U"
                   else np.zeros(exactness.shape, dtype=np.bool_))
    times = np.asarray(table["time_canonical"], dtype=np.float64)

    def column(name: str) -> Floats:
        values = np.asarray(table[name])[~is_singular]
        if values.dtype.kind == "U":
            values = np.where(values == "", "nan", values)
        return _read_only(values.astype(np.float64))

    at = _read_only(times[~is_singular])
    return AlongTime(at, _read_only(at * time_s), column("exactness_degree_0_scaled"),
                     column("condition"), column("energy_error"), _read_only(times[is_singular]))


def _stored_run(directory: str | os.PathLike[str], summary: dict[str, Any], files: set[str],
                time_s: float) -> Run:
    label = summary["label"]
    failed_checks = tuple(summary["failed_checks"])
    if summary["error"] is not None:
        return Run(label, summary["error"], failed_checks, None, None, None, json.dumps(summary))
    jet = _hamjet.load_jet(directory, label)
    names = [name for name in (f"{label}/nominal.csv", f"{label}/along_time.csv") if name in files]
    texts = _hamjet.read_files(directory, names)
    table = np.loadtxt(texts[names[0]].splitlines()[1:], delimiter=",", ndmin=2)
    nominal = _nominal(_read_only(table[:, 0].copy()), _read_only(table[:, 2:-1].copy()),
                       _read_only(table[:, -1].copy()), time_s)
    along_time = _stored_along_time(texts[names[1]], time_s) if len(names) > 1 else None
    return Run(label, None, failed_checks, jet, nominal, along_time, json.dumps(summary))


def _require_run(directory: str | os.PathLike[str], label: str, summary: dict[str, Any]) -> None:
    """Raises what is wrong with the label, or with its run."""
    try:
        _hamjet.load_jet(directory, arguments.text(label, "run"))
    except InputOutputError as error:
        failed = any(entry["label"] == label and entry["error"] for entry in summary["runs"])
        # Files of another version are refused before their runs are looked at.
        if failed and summary["version"] == _hamjet.__version__:
            raise NumericalError(str(error)) from None
        raise


def load(directory: str | os.PathLike[str], run: str | None = None) -> Result | StudyResult:
    """Reads results that the command, or ``write``, has stored.

    run: the label of the one run to read; all by default. Coefficients are those of the run bit by
    bit, the nominal trajectory too (its energy errors to the six digits printed). Results of
    studies without runs (transfers and sweeps among them) come as a StudyResult with their tables.

    Raises InputOutputError if anything is missing or was changed since, or is of another version of
    hamjet; UsageError if no run has this label; NumericalError, saying why, if the one run that has
    it failed.
    """
    directory = arguments.path(directory, "directory")
    text = _hamjet.read_files(directory, [])["summary.json"]
    summary = json.loads(text)
    files = {entry["path"] for entry in summary["files"]}
    if "study" in summary or "runs" not in summary:  # a sweep has neither
        if run is not None:
            raise UsageError(f"no run has the label {ascii(run)}; these results are of a study "
                             "without runs of a flow jet, leave run out")
        names = [name for name in sorted(files) if name.endswith(".csv")]
        texts = _hamjet.read_files(directory, names)
        tables = {name.removesuffix(".csv"): read_table(texts[name]) for name in names}
        return StudyResult(summary.get("exit_code", 0), "", types.MappingProxyType(tables), text,
                           None)
    if run is not None:
        _require_run(directory, run, summary)
    runs = {entry["label"]: _stored_run(directory, entry, files, summary["units"]["time_s"])
            for entry in summary["runs"] if run in (None, entry["label"])}
    return Result(types.MappingProxyType(runs), summary["exit_code"], text, None)
