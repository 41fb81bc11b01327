"""What the scripts that draw error against wall time have in common."""
import csv
import json
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def run_scene(scene, settings, threads, check=False):
    """The summary of a run; with `check` a run that breaks is an error."""
    with tempfile.TemporaryDirectory() as directory:
        command = [str(ROOT / "geodrop"), "run", str(scene), "--threads", str(threads), "--output", directory]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, capture_output=True, check=check)
        return json.loads((Path(directory) / "summary.json").read_text())


def measure(ways, spacings, run, path):
    """The rows that `run(name, spacing)` gives, printed and written to a CSV file as they come."""
    rows = []
    with open(path, "w", newline="") as file:
        for name in ways:
            for spacing in spacings:
                rows.append(run(name, spacing))
                print(rows[-1], flush=True)
                writer = csv.DictWriter(file, rows[0].keys())
                if len(rows) == 1:
                    writer.writeheader()
                writer.writerow(rows[-1])
    return rows


def draw(rows, error, labels, path):
    """A curve for each name: the column `error` against wall_s, on logarithmic axes."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "geodrop"  # the same file for the same numbers
    import matplotlib.pyplot as plt

    figure, panel = plt.subplots(figsize=(7, 5))
    for name in dict.fromkeys(row["name"] for row in rows):
        points = [(row["wall_s"], row[error]) for row in rows if row["name"] == name]
        panel.loglog(*zip(*points), "o-", label=name)
    panel.set(xlabel="wall time [s]", **labels)
    panel.grid(alpha=0.3)
    panel.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
