#!/usr/bin/python3
"""Draws growth.csv of `geodrop bench --growth`: cost per particle-step against the number of particles, and against
the size of the domain around the same particles. Writes growth_particles.svg and growth_domain.svg beside the file.

    perf/plot_growth.py perf/results/zen4-2core/growth.csv
"""
import csv
import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "geodrop"  # the same file for the same numbers
import matplotlib.pyplot as plt

PLOTS = {
    "particles": ("particles", "particles", "growth_particles.svg"),
    "domain": ("domain_factor", "domain per axis over the smallest", "growth_domain.svg"),
}


def read_curves(path, kind, column):
    """{(dimension, benchmark, threads): [(x, ns)]} of one kind of row, x ascending."""
    curves = defaultdict(list)
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row["kind"] == kind:
                key = (int(row["dimension"]), row["name"], int(row["threads"]))
                curves[key].append((float(row[column]), float(row["ns_per_particle_step"])))
    return {key: sorted(points) for key, points in sorted(curves.items())}


def draw(path, kind):
    column, label, name = PLOTS[kind]
    curves = read_curves(path, kind, column)
    if not curves:
        sys.exit(f"{path}: no rows of kind {kind}")
    figure, panels = plt.subplots(1, 2, figsize=(10, 4))
    names = sorted({benchmark for _, benchmark, _ in curves})
    colours = {benchmark: f"C{k % 10}" for k, benchmark in enumerate(names)}
    for (dimension, benchmark, threads), points in curves.items():
        style = "o-" if threads == 1 else "s--"
        panels[dimension - 2].plot(*zip(*points), style, color=colours[benchmark], markersize=4,
                                   label=f"{benchmark}, {threads} thread{'s' * (threads > 1)}")
    for dimension, panel in zip((2, 3), panels):
        panel.set(xscale="log", xlabel=label, ylabel="ns per particle-step", title=f"{dimension}D")
        panel.set_ylim(bottom=0)
        panel.grid(alpha=0.3)
        if panel.lines:
            panel.legend(fontsize=6)
    figure.tight_layout()
    figure.savefig(Path(path).with_name(name), metadata={"Date": None})
    for key, points in curves.items():
        print(f"{kind}: {key[1]}, {key[2]} threads: last/first = {points[-1][1] / points[0][1]:.2f}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for plot in PLOTS:
        draw(sys.argv[1], plot)
