#!/usr/bin/env python3
"""How far from exact maps are in air, against the drag: exactness_in_air.py HAMJET PICTURE.png. What
falls with the density is the air's, what stays is the integrator's."""

import json
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

TOLERANCE = 1e-9
SCENE = f"""
[system]
model = "earth"
gravity_degree = 8
atmosphere = "harris-priester"
[spacecraft]
drag_m2_kg = 0.0165
[nominal]
epoch_utc = "2026-03-01T06:00:00"
height_km = 514
i_deg = 97.5
raan_deg = 30
u_deg = 0
[jet]
order = 3
duration_s = 4000
[generating_function]
kinds = ["F1"]
despite_drag = true
[[integrator]]
label = "gauss8"
method = "gauss"
stages = 8
tolerance = {TOLERANCE}
[[integrator]]
label = "cvode"
method = "cvode-adams"
tolerance = {TOLERANCE}
"""
FACTORS = [10.0**k for k in range(-12, 2)]


def residuals(hamjet, folder, factor):
    """By run: the largest scaled exactness residual of F1 and defect of the Poisson brackets."""
    command = [hamjet, "run", "air.toml", "-q", "-o", "out", "--set", f"system.density_factor={factor}"]
    subprocess.run(command, cwd=folder, check=True)
    with open(f"{folder}/out/summary.json") as file:
        runs = json.load(file)["runs"]
    return {run["label"]: [max(row["scaled"] for row in rows) for rows in
                           (run["exactness"][0]["by_degree"], run["symplecticity_by_degree"])]
            for run in runs}


def main():
    hamjet, picture = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        with open(f"{folder}/air.toml", "w") as file:
            file.write(SCENE)
        found = [residuals(hamjet, folder, factor) for factor in FACTORS]
    figure, axes = plt.subplots(figsize=(7, 4.2))
    for label, name, colour in (("gauss8", "Gauss, 8 stages", "tab:blue"),
                                ("cvode", "CVODE, Adams", "tab:red")):
        for k, (what, line) in enumerate((("exactness of F1", "-"), ("Poisson brackets", "--"))):
            values = [row[label][k] for row in found]
            axes.loglog(FACTORS, values, line, color=colour, marker=".", label=f"{name}: {what}")
            print(f"{name}, {what}: " + " ".join(f"{value:.1e}" for value in values))
    axes.set_xlabel("density factor of the air (1: 514 km up, C_D A / m = 0.0165 m²/kg)")
    axes.set_ylabel("largest residual over degrees 0 to 2, scaled")
    axes.legend(fontsize="small")
    axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main()
