#!/usr/bin/python3
"""Error against wall time of the fall in cases/verification/fall_free_slip.toml: velocity after 1.5 s with one velocity field
(mixture) and two (sharp), at several spacings and sound speeds, beside the value that the sharp runs converge to. Writes
fall_work_precision.csv and .svg.

    perf/fall_work_precision.py OUTPUT_DIR [--threads N]
"""
import argparse
import csv
import json
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCENE = ROOT / "cases/verification/fall_free_slip.toml"
LIMIT = 4.79  # m/s, Richardson's of h = 0.25, 0.125, 0.0625 m at c = 60 m/s; docs/dumping.md
ZONES = "grid.refine=[{{axis='x',from=-1.5,to=1.5,spacing={0}}}]"
SPACINGS = (0.5, 0.25, 0.125)
WAYS = {
    "one field, c = 60 m/s": ("mixture", []),
    "sharp, c = 60 m/s": ("sharp", []),
    "sharp, c = 120 m/s": ("sharp", ["materials.water.sound_speed=120"]),
    "sharp, c = 60 m/s, water coarser beyond 1.5 m": ("sharp", [ZONES]),
}


def run(name, spacing, arguments):
    """One row of the table."""
    interface, settings = WAYS[name]
    text = SCENE.read_text()
    if interface == "mixture":
        text = text.replace('interface = "sharp"\nshear = "none"\n', "").replace('tips_of = "geotextile"\n', "")
        text = text[: text.rindex("[[results]]")]  # of strays, which a mixture has none of
        text = text[: text.rindex("[[results]]")]
    settings = settings + [f"grid.spacing={spacing}", "time.end=1.52"]
    if ZONES in settings:
        settings = [ZONES.format(spacing), f"grid.spacing={2 * spacing}", "time.end=1.52"]
    with tempfile.TemporaryDirectory() as directory:
        scene = Path(directory) / "fall.toml"
        scene.write_text(text)
        command = [str(ROOT / "geodrop"), "run", str(scene), "--threads", str(arguments.threads), "--output", directory + "/run"]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, capture_output=True, check=True)
        summary = json.loads((Path(directory) / "run/summary.json").read_text())
    velocity = summary["results"]["velocity_at_1_5_m_s"]["value"]
    return {"name": name, "spacing_m": spacing, "wall_s": summary["wall_s"], "steps": summary["steps"],
            "velocity_m_s": velocity, "error": abs(velocity / LIMIT - 1)}


def draw(rows, path):
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "geodrop"  # the same file for the same numbers
    import matplotlib.pyplot as plt

    figure, panel = plt.subplots(figsize=(7, 5))
    for name in WAYS:
        points = [(row["wall_s"], row["error"]) for row in rows if row["name"] == name]
        panel.loglog(*zip(*points), "o-", label=name)
    panel.set(xlabel="wall time [s]", ylabel="error of the velocity after 1.5 s [-]",
              title=f"Container falling in free slip, beside {LIMIT} m/s")
    panel.grid(alpha=0.3, which="both")
    panel.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=Path)
    parser.add_argument("--threads", type=int, default=2)
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    rows = []
    with open(arguments.output / "fall_work_precision.csv", "w", newline="") as file:
        for name in WAYS:
            for spacing in SPACINGS:
                rows.append(run(name, spacing, arguments))
                print(rows[-1], flush=True)
                writer = csv.DictWriter(file, rows[0].keys())
                if len(rows) == 1:
                    writer.writeheader()
                writer.writerow(rows[-1])
    draw(rows, arguments.output / "fall_work_precision.svg")


if __name__ == "__main__":
    main()
