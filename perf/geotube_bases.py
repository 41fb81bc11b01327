#!/usr/bin/python3
"""Error against wall time of the geotube of 5.56 m2 (cases/geotube_556.toml) on all bases and ways to carry the pressure:
runs each at three resolutions and writes geotube_bases.csv and geotube_bases.svg (error of height / width).

    perf/geotube_bases.py OUTPUT_DIR [--threads N] [--end SECONDS]
"""
import argparse
from pathlib import Path

from runs import ROOT, draw, measure, run_scene

EXACT = 1.806097126 / 3.667189097  # height / width, J = 1e4 kN/m
CELLS = ["bodies.fluid.pressure=cell"]
MUSL = ["solver.transfer=musl", "solver.blend_rate=0"]
WAYS = {
    "bspline2, enclosed": [],
    "bspline2, cell": CELLS,
    "gimp, cell": CELLS + ["grid.basis=gimp"],
    "linear, cell, MUSL": CELLS + MUSL + ["grid.basis=linear"],
    "tri3, nodal, MUSL (the paper's element)": ["bodies.fluid.pressure=nodal", "grid.basis=tri3"] + MUSL,
}


def run(name, spacing, arguments):
    """One row of the table."""
    settings = WAYS[name] + [f"grid.spacing={spacing}", f"time.end={arguments.end}"]
    summary = run_scene(ROOT / "cases/geotube_556.toml", settings, arguments.threads)
    value = {key: entry["value"] for key, entry in summary["results"].items()}
    ok = summary["status"] == "done"
    ratio = value["height_m"] / value["width_m"] if ok else float("nan")
    return {"name": name, "spacing_m": spacing, "status": summary["status"], "wall_s": summary["wall_s"],
            "height_over_width_error": abs(ratio / EXACT - 1),
            "tension_std_over_mean": value["tension_std_N_m"] / value["tension_mean_N_m"] if ok else float("nan"),
            "out_of_balance_ratio": value["out_of_balance_ratio"], "steps": summary["steps"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=Path)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--end", type=float, default=4.0, help="simulated time of runs that do not come to rest [s]")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    rows = measure(WAYS, (0.2, 0.1, 0.05), lambda name, spacing: run(name, spacing, arguments),
                   arguments.output / "geotube_bases.csv")
    labels = {"ylabel": "error of height / width [-]", "title": "Geotube, 5.56 m2"}
    draw(rows, "height_over_width_error", labels, arguments.output / "geotube_bases.svg")


if __name__ == "__main__":
    main()
