#!/usr/bin/python3
"""Error against wall time: runs the verification scenes with exact solutions over bases, transfers and resolutions, writes
work_precision.csv and prints tables with observed orders. Wall time is of the stepping loop, best of --runs, without
the evaluation of the force that drives the manufactured solution.

    perf/work_precision.py OUTPUT_DIR [--threads N] [--case mms_small|mms|vortices] [--runs N] [--only NAME]
"""
import argparse
import csv
import json
import math
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

PAPERS_ELEMENT = ["grid.basis=tri3", "solver.transfer=musl"]
# name: settings, for each of the bases and for the transfers on the default basis
MMS = {
    "bspline2": [],
    "bspline2, consistent mass": ["solver.mass_matrix=consistent"],
    "bspline2, blend 10": ["solver.transfer=blend", "solver.blend_rate=10"],
    "bspline2, MUSL (FLIP)": ["solver.transfer=musl", "solver.blend_rate=0"],
    "gimp": ["grid.basis=gimp"],
    "linear": ["grid.basis=linear"],
    "linear, MUSL (FLIP)": ["grid.basis=linear", "solver.transfer=musl", "solver.blend_rate=0"],
    "tri3, MUSL (FLIP)": PAPERS_ELEMENT + ["solver.blend_rate=0"],
}
TABLE_PARTICLES = ["bodies.water.particles_per_cell_axis=3"]  # as the table of docs/verification.md was taken
VORTICES = {
    "bspline2, blend 10": [],
    "bspline2, consistent mass": ["solver.mass_matrix=consistent"],
    "bspline2, TPIC": ["solver.transfer=tpic", "solver.blend_rate="],
    "bspline2, MUSL 10": ["solver.transfer=musl"],
    "gimp, blend 10": ["grid.basis=gimp"],
    "linear, blend 10": ["grid.basis=linear"],
    "linear, MUSL 10": ["grid.basis=linear", "solver.transfer=musl"],
    "tri3, nodal pressure, MUSL 10": PAPERS_ELEMENT
    + ["bodies.water.pressure=nodal", "bodies.water.shift=false", "bodies.water.shift_speed="],
    "tri3, no cure, MUSL 10": PAPERS_ELEMENT
    + ["bodies.water.pressure=particle", "bodies.water.shift=false", "bodies.water.shift_speed="],
}
SMALL = {name: ["exact.block.amplitude=0.01", *settings] for name, settings in MMS.items()}
CASES = {
    "mms_small": ("cases/verification/mms_axis_aligned.toml", "displacement_error_rms_m", SMALL),
    "mms": ("cases/verification/mms_axis_aligned.toml", "displacement_error_rms_m", MMS),
    "vortices": ("cases/verification/taylor_green.toml", "velocity_error_rms_ratio", {name: TABLE_PARTICLES + settings for name, settings in VORTICES.items()}),
}
SPACINGS = (1 / 16, 1 / 32, 1 / 64)


def run(scene, settings, threads, directory):
    """(summary of one run, or None if it broke)"""
    command = [ROOT / "geodrop", "run", ROOT / scene, "--output", directory, "--threads", str(threads)]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == 2:
        raise SystemExit(done.stderr)
    summary = json.loads((Path(directory) / "summary.json").read_text())
    return summary if summary["status"] == "done" else None


def measure(case, name, spacing, threads, runs):
    """One row: error and best wall time [s]; both infinite if the run broke."""
    scene, result, variants = CASES[case]
    row = {"case": case, "name": name, "spacing_m": spacing, "threads": threads, "error": math.inf, "wall_s": math.inf}
    with tempfile.TemporaryDirectory() as directory:
        for _ in range(runs):
            summary = run(scene, [*variants[name], f"grid.spacing={spacing}"], threads, directory)
            if summary is None:
                break
            row["error"] = summary["results"][result]["value"]
            forcing = sum(stage["seconds"] for stage in summary["stages"] if stage["name"] == "body_force")
            row["wall_s"] = min(row["wall_s"], summary["wall_s"] - forcing)
    return row


def print_table(rows):
    """One line for each name: error and wall time at each spacing, orders between neighbours."""
    for name in dict.fromkeys(row["name"] for row in rows):
        mine = [row for row in rows if row["name"] == name]
        cells = [f"{row['error']:.2e} {row['wall_s']:6.2f} s" for row in mine]
        orders = [f"{math.log2(a['error'] / b['error']):.1f}" if math.isfinite(a["error"] + b["error"]) else "-"
                  for a, b in zip(mine, mine[1:])]
        print(f"| {name} | {' | '.join(cells)} | {', '.join(orders)} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=Path)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--case", choices=CASES)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    rows = []
    for case in [options.case] if options.case else CASES:
        print(f"{case}: {CASES[case][1]} and wall time at h = {', '.join(f'1/{round(1 / h)}' for h in SPACINGS)}; orders")
        for name in CASES[case][2]:
            if options.only not in name:
                continue
            measured = [measure(case, name, spacing, options.threads, options.runs) for spacing in SPACINGS]
            print_table(measured)
            rows += measured
    options.output.mkdir(parents=True, exist_ok=True)
    with open(options.output / "work_precision.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=rows[0])
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
