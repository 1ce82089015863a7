"""Prints the figures of bench/run_swing as Markdown. python3 swing.py FOLDER: FOLDER holds what swing printed."""
import json
import pathlib
import sys

COLUMNS = ["what", "cycles", "mean ms", "median", "95 %", "longest", "processor ms", "points a cycle",
           "cache, MB at 1/6, 1/2, the end", "PSNR after half of the rest, all (fresh)"]
EDITED = ["lamp", "dimmed", "table", "camera", "bulb", "chair"]


def row(name, d):
    ms = d["cycle_ms"]
    megabytes = ", ".join(f"{b / 1e6:.1f}" for b in d["bytes"].values())
    psnr = ""
    if "psnr" in d:
        fresh = d["psnr"]["fresh"]
        psnr = ", ".join(f"{v:.1f} ({fresh[when]:.1f})" for when, v in d["psnr"]["edited"].items())
    cells = [f"{d['scene']}, {name}", d["cycles"], *(f"{ms[k]:.0f}" for k in ("mean", "median", "p95", "max")),
             f"{d['processor_ms']:.0f}", f"{d['points_a_cycle']:.0f}", megabytes, psnr]
    return "| " + " | ".join(str(c) for c in cells) + " |"


def main():
    folder = pathlib.Path(sys.argv[1])
    print("| " + " | ".join(COLUMNS) + " |")
    print("|---" * len(COLUMNS) + "|")
    for name in EDITED:
        print(row(name, json.loads((folder / f"{name}.json").read_text())))
    steps = json.loads((folder / "return.json").read_text())["points_a_step"]
    print(f"\nPoints shaded a step of a camera that goes aside: {steps['out']}; and back: {steps['back']}")


if __name__ == "__main__":
    main()
