"""Draws error over time from the JSON of quality_over_time, and writes the table of docs/results.md.

Usage: plot_quality.py FOLDER_OF_JSON DOCS_FOLDER
"""
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from results import draw_error, finish_error, seconds_to, write_table

ORDER = ["cornell", "room", "indirect", "poolhall", "kitchen", "classroom"]
NAMES = {"best": "Shading Cache, best scheme", "paper": "Shading Cache, paper's scheme",
         "best, traced": "best scheme, paths traced to their ends",
         "best, bidirectional": "best scheme, bidirectional", "path": "path tracing a pixel"}
COLORS = {"best": "tab:blue", "best, traced": "tab:green", "best, bidirectional": "tab:purple", "paper": "tab:orange", "path": "tab:gray"}


def extrapolated(rows, psnr):
    """Path tracing's error falls as 1 / time: the fit through its last half tells when it gets there."""
    tail = rows[len(rows) // 2:]
    offset = sum(r["psnr"] - 10 * math.log10(r["seconds"]) for r in tail) / len(tail)
    return 10 ** ((psnr - offset) / 10)


def say(seconds, measured=True):
    if seconds is None:
        return "not reached"
    return f"{seconds:.3g} s" if measured else f"({seconds:.3g} s)"


def path_seconds(rows, psnr):
    reached = seconds_to(rows, psnr)
    return (reached, True) if reached is not None else (extrapolated(rows, psnr), False)


def table(runs):
    """The best scheme with each renderer against the paper's and against path tracing."""
    lines = ["| scene | method | first picture | 40 dB | path tracing, 40 dB | ratio |"
             " common PSNR with the paper's | reached in | the paper's | ratio |", "|---|---|" + "---|" * 8]
    for run in runs:
        paper, path = run["methods"]["paper"], run["methods"]["path"]
        t40, measured = path_seconds(path, 40)
        for method in [name for name in NAMES if name.startswith("best") and name in run["methods"]]:
            rows = run["methods"][method]
            b40 = seconds_to(rows, 40)
            common = min(max(r["psnr"] for r in rows), max(r["psnr"] for r in paper)) - 0.1
            bc, pc = seconds_to(rows, common), seconds_to(paper, common)
            lines.append(
                f"| {run['scene']} | {NAMES[method]} | {rows[0]['seconds']:.2f} s, {rows[0]['psnr']:.1f} dB |"
                f" {say(b40)} | {say(t40, measured)} | {f'{t40 / b40:.0f}' if b40 else '-'} |"
                f" {common:.1f} dB | {say(bc)} | {say(pc)} | {f'{pc / bc:.1f}' if bc and pc else '-'} |")
        three = next((r["seconds"] for r in path if r.get("spp") == 3), None)
        lines.append(f"| {run['scene']} | three paths a pixel | {say(three)} | | | | | | | |")
    return "\n".join(lines)


def draw(runs, file):
    figure, axes = plt.subplots(1, len(runs), figsize=(5 * len(runs), 4), squeeze=False)
    for run, axis in zip(runs, axes[0]):
        for method, rows in run["methods"].items():
            draw_error(axis, rows, label=NAMES[method], color=COLORS[method])
        finish_error(axis, run)
    figure.tight_layout()
    figure.savefig(file, dpi=80)


def main():
    folder, docs = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    runs = [json.loads((folder / f"{n}.json").read_text()) for n in ORDER if (folder / f"{n}.json").exists()]
    (docs / "pictures").mkdir(exist_ok=True)
    draw(runs, docs / "pictures" / "quality.png")
    write_table(docs, "measured", table(runs))


if __name__ == "__main__":
    main()
