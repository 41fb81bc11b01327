#!/usr/bin/python3
"""Are the defaults on the front of error against time? Runs verification scenes at several spacings in ways that differ
in one choice each (basis, transfer, mass matrix, particles per cell, time-step factor, where the pressure acts), writes
defaults.csv and prints, for each use, in how many of its cases a way is on the front: no other point of the case has an
error 10 % smaller in less than two thirds of the time, and it is no worse than the coarsest grid of the scene as it stands.

    perf/defaults.py OUTPUT_DIR [--threads N] [--runs N] [--only CASE] [--from-csv]
"""
import argparse
import csv
import math
import tomllib
from pathlib import Path

from runs import ROOT, run_scene

BLEND = "solver.transfer=blend"
TRANSFERS = {
    "tpic": ["solver.transfer=tpic", "solver.blend_rate="],
    "blend 1/s": [BLEND, "solver.blend_rate=1"],
    "blend 10/s": [BLEND, "solver.blend_rate=10"],
    "musl 1/s": ["solver.transfer=musl", "solver.blend_rate=1"],
    "musl 10/s": ["solver.transfer=musl", "solver.blend_rate=10"],
}
BASES = {"gimp": ["grid.basis=gimp"], "linear": ["grid.basis=linear"],
         "linear, musl 1/s": ["grid.basis=linear", *TRANSFERS["musl 1/s"]]}
OTHERS = {"consistent mass": ["solver.mass_matrix=consistent"]}
STEPS = {f"C = {c}": [f"solver.courant={c}"] for c in (0.2, 0.3, 0.5, 0.8)}
PARTICLES = {f"n = {n}": n for n in (1, 2, 3, 4)}
WAYS = {**TRANSFERS, **BASES, **OTHERS, **STEPS}

# use: cases, with their spacings; the measure is the first [[verify]] of a scene
USES = {
    "water": {"hydrostatic_column": (0.5, 0.25, 0.125), "taylor_green": (1 / 16, 1 / 32), "poiseuille_startup": (0.1, 0.05, 0.025),
              "viscous_standing_wave": (1 / 16, 1 / 32, 1 / 64), "rotating_square": (1 / 8, 1 / 16, 1 / 32),
              "sloshing": (1 / 16, 1 / 32)},
    "solids": {"elastic_bar": (1.25, 0.625, 0.3125), "mms_small_strain": (1 / 16, 1 / 32), "mms_axis_aligned": (1 / 16, 1 / 32),
               "generalized_vortex": (1 / 8, 1 / 16), "gravity_column": (0.05, 0.025)},
    "soil, quasi-static": {"gravity_column_damped": (0.05, 0.025, 0.0125), "infinite_slope_slides": (0.1, 0.05, 0.025),
                           "disc_on_incline": (0.125, 0.0625, 0.03125)},
    "membranes": {"tube_mode_2": (0.2, 0.1), "pressurised_tube": (0.2, 0.1), "geotube_556": (0.2, 0.1)},
    "dumping": {"ellipse_release": (0.5, 0.25), "cylinder_release": (0.5, 0.25)},
}


def scene_of(case):
    path = next(ROOT.joinpath("cases").rglob(case + ".toml"))
    return path, tomllib.loads(path.read_text())


def pressure_ways(scene):
    """The other support of the pressure, for bodies that have a choice."""
    to = {"cell": "particle", "particle": "cell"}
    settings = []
    for body in scene["bodies"]:
        now = body.get("pressure", "cell")
        if now not in to:
            return {}
        settings.append(f"bodies.{body['name']}.pressure={to[now]}")
    return {"pressure of particles" if "particle" in settings[0] else "pressure of cells": settings}


def ways_of(scene):
    """What differs from the scene as it stands, by name."""
    shifting = [body["name"] for body in scene["bodies"] if body.get("shift")]
    ways = {"as it stands": [], **WAYS}
    if "blend_rate" not in scene["solver"]:
        ways["tpic"] = TRANSFERS["tpic"][:1]
    for name, n in PARTICLES.items():
        ways[name] = [f"bodies.{body['name']}.particles_per_cell_axis={n}" for body in scene["bodies"]]
    ways.update(pressure_ways(scene))
    if shifting:
        ways["no shifting"] = [s for body in shifting for s in (f"bodies.{body}.shift=false", f"bodies.{body}.shift_speed=")]
    return ways


def measure(case, name, settings, spacing, threads, runs):
    """One row: error and best wall time of the stepping loop [s], that of a driving force excluded; infinite if it breaks or
    the scene does not allow it."""
    path, scene = scene_of(case)
    gate = scene["verify"][0]
    row = {"case": case, "way": name, "spacing_m": spacing, "error": math.inf, "wall_s": math.inf}
    for _ in range(runs):
        try:
            summary = run_scene(path, [*settings, f"grid.spacing={spacing}"], threads)
        except FileNotFoundError:  # refused
            break
        if summary["status"] != "done":
            break
        value = summary["results"][gate["result"]]["value"]
        scale = gate.get("scale", abs(gate["expected"]))
        row["error"] = abs(value - gate["expected"]) / scale if value is not None else math.inf
        forcing = sum(stage["seconds"] for stage in summary["stages"] if stage["name"] == "body_force")
        row["wall_s"] = min(row["wall_s"], summary["wall_s"] - forcing)
    return row


def on_front(row, rows):
    coarsest = next(other["error"] for other in rows if other["way"] == "as it stands")
    return row["error"] <= 1.1 * coarsest and not any(
        other["error"] < row["error"] / 1.1 and other["wall_s"] < row["wall_s"] / 1.5 for other in rows)


def print_fronts(rows):
    """For each use and way: in how many cases the way is on the front, and in how many it breaks or is refused at some spacing."""
    for use, cases in USES.items():
        print(f"\n{use}")
        table = {}
        for case in cases:
            mine = [row for row in rows if row["case"] == case]
            for way in dict.fromkeys(row["way"] for row in mine):
                points = [row for row in mine if row["way"] == way]
                table.setdefault(way, []).append((any(on_front(row, mine) for row in points),
                                                  any(math.isinf(row["error"]) for row in points)))
        for way, found in table.items():
            hits, breaks = (sum(column) for column in zip(*found))
            print(f"  {way:24s} {hits} of {len(found)}" + (f", breaks in {breaks}" if breaks else ""))


def read_rows(path):
    with open(path, newline="") as file:
        return [{**row, **{key: float(row[key]) for key in ("spacing_m", "error", "wall_s")}} for row in csv.DictReader(file)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=Path)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--runs", type=int, default=2)
    parser.add_argument("--only", default="")
    parser.add_argument("--from-csv", action="store_true", help="only print what defaults.csv holds")
    options = parser.parse_args()
    path = options.output / "defaults.csv"
    if options.from_csv:
        return print_fronts(read_rows(path))
    options.output.mkdir(parents=True, exist_ok=True)
    rows = []
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, ["case", "way", "spacing_m", "error", "wall_s"])
        writer.writeheader()
        for cases in USES.values():
            for case, spacings in cases.items():
                if options.only not in case:
                    continue
                for name, settings in ways_of(scene_of(case)[1]).items():
                    for spacing in spacings:
                        rows.append(measure(case, name, settings, spacing, options.threads, options.runs))
                        writer.writerow(rows[-1])
                        file.flush()
                print(case, flush=True)
    print_fronts(rows)


if __name__ == "__main__":
    main()
