"""The table and the strips of bench/run_recovery.

Usage: recovery.py FOLDER DOCS
"""
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.image as files
import numpy as np

from results import psnr_at, seconds_to, write_table

SCENES = {"room": "light moved", "indirect": "chair moved", "poolhall": "camera moved round the balls"}
AFTER = 30  # seconds of path tracing whose error is the mark
TIMES = (0.5, 1, 2, 5, 10)


def decibels(rows, seconds):
    """PSNR then; before the first picture there is none."""
    value = psnr_at(rows, seconds)
    return f"{value:.1f}" if value is not None else "-"


def row(scene, run):
    edited, fresh, path = (run["methods"][name] for name in ("edited", "best", "path"))
    mark = psnr_at(path, AFTER)
    needed, anew = seconds_to(edited, mark), seconds_to(fresh, mark)
    times = f"{AFTER / needed:.0f}" if needed else "not reached"
    cells = [f"{scene}: {SCENES[scene]}", f"{mark:.1f}", f"{needed:.2f}" if needed else "-", times,
             f"{anew:.2f}" if anew else "-"]
    cells += [f"{decibels(edited, t)} / {decibels(path, t)}" for t in TIMES]
    return "| " + " | ".join(cells) + " |"


def table(runs):
    head = ["edit", f"path tracing after {AFTER} s [dB]", "cache as good after [s]", "times sooner", "a new cache after [s]"]
    head += [f"{t} s" for t in TIMES]
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join(lines + [row(scene, run) for scene, run in runs.items()])


def strip(folder, run, title):
    """The pictures of a method, the first at or after each of the times."""
    names = [p["name"] for p in run["of_methods"][title]["pictures"]][:len(TIMES)]
    pictures = [files.imread(folder / f"{name}.png")[::2, ::2, :3] for name in names]
    while len(pictures) < len(TIMES):
        pictures.append(np.zeros_like(pictures[0]))
    return np.hstack(pictures)


def main():
    folder, docs = (pathlib.Path(a) for a in sys.argv[1:3])
    runs = {scene: json.loads((folder / f"{scene}.json").read_text()) for scene in SCENES}
    write_table(docs, "recovery", table(runs))
    strips = [strip(folder / scene, run, title) for scene, run in runs.items() for title in ("edited", "path")]
    files.imsave(docs / "pictures" / "recovery.png", np.vstack(strips))


if __name__ == "__main__":
    main()
