#!/usr/bin/python3
"""Error against wall time of the fall in cases/verification/fall_free_slip.toml: velocity after 1.5 s with one velocity field
(mixture) and two (sharp), at several spacings and sound speeds, beside that of an ideal fluid. Writes
fall_work_precision.csv and .svg.

    perf/fall_work_precision.py OUTPUT_DIR [--threads N]
"""
import argparse
import tempfile
from pathlib import Path

from runs import ROOT, draw, measure, run_scene

SCENE = ROOT / "cases/verification/fall_free_slip.toml"
LIMIT = 5.135  # m/s, a rigid ellipse in an ideal fluid, by boundary elements; docs/dumping.md
ZONES = "grid.refine=[{{axis='x',from=-1.5,to=1.5,spacing={0}}}]"
SPACINGS = (0.5, 0.25, 0.125)
WAYS = {
    "one field, c = 60 m/s": ("mixture", []),
    "sharp, c = 60 m/s": ("sharp", []),
    "sharp, c = 120 m/s": ("sharp", ["materials.water.sound_speed=120"]),
    "sharp, c = 60 m/s, water coarser beyond 1.5 m": ("sharp", [ZONES]),
}


def run(name, spacing, threads):
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
        summary = run_scene(scene, settings, threads, check=True)
    velocity = summary["results"]["velocity_at_1_5_m_s"]["value"]
    return {"name": name, "spacing_m": spacing, "wall_s": summary["wall_s"], "steps": summary["steps"],
            "velocity_m_s": velocity, "error": abs(velocity / LIMIT - 1)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=Path)
    parser.add_argument("--threads", type=int, default=2)
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    rows = measure(WAYS, SPACINGS, lambda name, spacing: run(name, spacing, arguments.threads),
                   arguments.output / "fall_work_precision.csv")
    labels = {"ylabel": "error of the velocity after 1.5 s [-]", "title": f"Container falling in free slip, beside {LIMIT} m/s"}
    draw(rows, "error", labels, arguments.output / "fall_work_precision.svg")


if __name__ == "__main__":
    main()
