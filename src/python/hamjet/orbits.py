"""Scenes of orbits from keyword arguments."""

from __future__ import annotations

import inspect
import itertools
from typing import Any

from . import _hamjet, scenes

#: The name of the scene, for messages.
_NAME = "orbit"

#: Angles that an orbit has by default, which its shape does not depend on.
_ANGLES = {"raan_deg": 0, "argp_deg": 0}


def orbit(**keys: Any) -> dict[str, Any]:
    """A scene of an orbit from keyword arguments, for ``run``, ``motion`` and others.

        jet = hamjet.run(hamjet.orbit(a_km=7078, e=0.001, i_deg=98, J2=1.0826e-3, order=4,
                                      duration_orbits=0.8)).runs["gauss8"].jet

    The keywords are keys of a scene, listed below: those of the tables that every scene has, and
    whole tables as dicts (``transfer={...}``). What is None is left out. Without ``model`` it is
    zonal-gravity with the J_n that are given, and without mu, radius and a file of the field it is
    the Earth's mu and equatorial radius. With elements of an orbit, angles are 0 that are left out
    (node, perigee, and the place, if none is given: ta_deg, ea_deg, ma_deg or u_deg).

    Returns the tables of the scene as a dict, which was checked. Raises as ``run`` does: an unknown
    keyword is a SceneError that names the nearest key.
    """
    # Tables that no keyword is of are there, so that messages name the keys that they lack.
    scene: dict[str, Any] = {table: {} for _, table, _ in _hamjet.orbit_keys() if table}
    for keyword, value in keys.items():
        if value is None:
            continue
        table = _hamjet.table_of_keyword(_NAME, keyword)
        (scene[table] if table else scene)[keyword] = value
    system = scene["system"]
    if "model" not in system:
        earth = _hamjet.earth_system()
        # The mu of one body and the radius of another would make a field that is neither's.
        if system.keys() & {*earth, "gravity_file"}:
            earth = {"model": earth["model"]}
        scene["system"] = {**earth, **system}
    nominal = scene["nominal"]
    elements, places = _hamjet.element_keys()
    if nominal.keys() & set(elements):
        place = {} if nominal.keys() & set(places) else {places[0]: 0}
        scene["nominal"] = {**_ANGLES, **place, **nominal}
    scenes.read(scene, None, _NAME)
    return scene


def _listed_keys() -> str:
    """What the keywords are, a line for those that are alike."""
    lines = []
    for (table, text), group in itertools.groupby(_hamjet.orbit_keys(), lambda key: key[1:]):
        names = [key[0] for key in group]
        shown = f"{names[0]} to {names[-1]}" if len(names) > 2 else ", ".join(names)
        lines.append(f"    {shown}: {text}" + (f" ([{table}])" if table else ""))
    return "\n".join(lines)


orbit.__doc__ = f"{inspect.getdoc(orbit)}\n\nKeys:\n{_listed_keys()}\n"
# A call shows the keywords in help() and in editors, which read the signature.
setattr(orbit, "__signature__", inspect.Signature(
    [inspect.Parameter(key, inspect.Parameter.KEYWORD_ONLY, default=None)
     for key, _, _ in _hamjet.orbit_keys()], return_annotation="dict[str, Any]"))
