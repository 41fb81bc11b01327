#!/usr/bin/python3
"""Error against wall time of the geotube of 5.56 m2 (cases/geotube_556.toml) on all bases and ways to carry the pressure:
runs each at three resolutions and writes geotube_bases.csv and geotube_bases.svg (error of height / width).

    perf/geotube_bases.py OUTPUT_DIR [--threads N] [--end SECONDS]
"""
import argparse
import csv
import json
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
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


def run(name, settings, spacing, arguments):
    """One row of the table."""
    with tempfile.TemporaryDirectory() as directory:
        command = [str(ROOT / "geodrop"), "run", str(ROOT / "cases/geotube_556.toml"), "--threads", str(arguments.threads),
                   "--output", directory]
        for setting in settings + [f"grid.spacing={spacing}", f"time.end={arguments.end}"]:
            command += ["--set", setting]
        subprocess.run(command, capture_output=True, check=False)
        with open(Path(directory) / "summary.json") as file:
            summary = json.load(file)
    value = {key: entry["value"] for key, entry in summary["results"].items()}
    ok = summary["status"] == "done"
    ratio = value["height_m"] / value["width_m"] if ok else float("nan")
    return {"name": name, "spacing_m": spacing, "status": summary["status"], "wall_s": summary["wall_s"],
            "height_over_width_error": abs(ratio / EXACT - 1),
            "tension_std_over_mean": value["tension_std_N_m"] / value["tension_mean_N_m"] if ok else float("nan"),
            "out_of_balance_ratio": value["out_of_balance_ratio"], "steps": summary["steps"]}


def draw(rows, path):
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "geodrop"  # the same file for the same numbers
    import matplotlib.pyplot as plt

    figure, panel = plt.subplots(figsize=(7, 5))
    for name in WAYS:
        points = [(row["wall_s"], row["height_over_width_error"]) for row in rows if row["name"] == name]
        panel.loglog(*zip(*points), "o-", label=name)
    panel.set(xlabel="wall time [s]", ylabel="error of height / width [-]", title="Geotube, 5.56 m2")
    panel.grid(alpha=0.3)
    panel.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=Path)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--end", type=float, default=4.0, help="simulated time of runs that do not come to rest [s]")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    rows = []
    with open(arguments.output / "geotube_bases.csv", "w", newline="") as file:
        for name, settings in WAYS.items():
            for spacing in (0.2, 0.1, 0.05):
                rows.append(run(name, settings, spacing, arguments))
                print(rows[-1], flush=True)
                writer = csv.DictWriter(file, rows[0].keys())
                if len(rows) == 1:
                    writer.writeheader()
                writer.writerow(rows[-1])
    draw(rows, arguments.output / "geotube_bases.svg")


if __name__ == "__main__":
    main()
