"""Plots of motions, transfers and validity, with matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .optional_packages import required

if TYPE_CHECKING:
    from .relative_motion import Motion, Transfers, Validity

_SECONDS_PER_HOUR = 3600.0


def _axes(given: Any) -> Any:
    """The axes to draw in: those given, or those of a new figure."""
    pyplot = required("matplotlib.pyplot", "plot")
    return pyplot.subplots()[1] if given is None else given


def draw_motion(motion: Motion, axes: Any) -> Any:
    axes = _axes(axes)
    hours = motion.times_s / _SECONDS_PER_HOUR
    axes.plot(hours, motion.separation_m, ".-", label="separation")
    for name, at in (("nearest", motion.nearest), ("farthest", motion.farthest)):
        axes.plot(at.time_s / _SECONDS_PER_HOUR, at.separation_m, "o", label=name)
    axes.set(xlabel="time (h)", ylabel="separation (m)", ylim=(0, None))
    axes.legend()
    return axes


def draw_transfers(transfers: Transfers, axes: Any) -> Any:
    axes = _axes(axes)
    hours = transfers.times_s / _SECONDS_PER_HOUR
    # Near a singularity the changes are large and say nothing, and a line across would hide it.
    shown = np.where(transfers.near_singular, np.nan, transfers.total_change_m_s)
    axes.semilogy(hours, shown, ".-", label="away from singularities")
    if transfers.near_singular.any():
        near = np.where(transfers.near_singular, transfers.total_change_m_s, np.nan)
        axes.semilogy(hours, near, "x", color="gray", label="near a singularity")
    if transfers.best is not None:
        axes.semilogy(hours[transfers.best], transfers.total_change_m_s[transfers.best], "o",
                      label="least")
    for time_s in transfers.singular_times_s:
        axes.axvline(time_s / _SECONDS_PER_HOUR, color="gray", linestyle=":", linewidth=0.8)
    axes.set(xlabel="transfer time (h)", ylabel="velocity change (m/s)")
    axes.legend()
    return axes


def draw_validity(validity: Validity, axes: Any) -> Any:
    axes = _axes(axes)
    hours = validity.time_s / _SECONDS_PER_HOUR
    for order, proved_m in enumerate(validity.proved_m.T, start=1):
        # No separation that was tried holds: a logarithmic axis has no place for 0.
        axes.semilogy(hours, np.where(proved_m > 0, proved_m, np.nan), ".-",
                      label=f"order {order}")
    axes.set(xlabel="time (h)", ylabel="separation up to which the polynomial holds (m)")
    axes.legend()
    return axes
