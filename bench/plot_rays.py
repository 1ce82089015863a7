"""Draws the JSON of ray_rate, and writes the table of docs/results.md.

Usage: plot_rays.py JSON_FILE DOCS_FOLDER
"""
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from results import finish_sizes, write_table

BAR = 0.8  # of Embree's own rate: what `path` is to reach


def table(rows):
    lines = ["| renderer | quads | points/s | Embree alone | ratio: median (lowest to highest) | rays a point |"
             " lanes in use |", "|---|---|---|---|---|---|---|"]
    for row in rows:
        rate, embree, ratio = row["points_a_second"], row["embree_points_a_second"], row["ratio"]
        lines.append(
            f"| {row['renderer']} | {row['quads']} | {rate['median']:.0f} | {embree['median']:.0f} |"
            f" **{ratio['median']:.3f}** ({ratio['low']:.3f} to {ratio['high']:.3f}) | {row['rays_a_point']:.0f} |"
            f" {100 * row['lanes_used']:.0f} % |")
    return "\n".join(lines)


def draw(rows, file):
    figure, (rates, ratios) = plt.subplots(1, 2, figsize=(10, 4))
    renderers = list(dict.fromkeys(row["renderer"] for row in rows))
    for renderer in renderers:
        own = [row for row in rows if row["renderer"] == renderer]
        quads = [row["quads"] for row in own]
        line, = rates.plot(quads, [row["points_a_second"]["median"] for row in own], "o-", label=renderer)
        rates.plot(quads, [row["embree_points_a_second"]["median"] for row in own], "o:", color=line.get_color())
        median = [row["ratio"]["median"] for row in own]
        below = [m - row["ratio"]["low"] for m, row in zip(median, own)]
        above = [row["ratio"]["high"] - m for m, row in zip(median, own)]
        ratios.errorbar(quads, median, [below, above], fmt="o-", capsize=3, color=line.get_color(), label=renderer)
    ratios.axhline(BAR, color="gray", linewidth=1, linestyle="--")
    ratios.set_ylim(0, 1)
    rates.set_yscale("log")
    rates.set_title("irradiance points a second, one thread (dotted: Embree alone)")
    ratios.set_title("part of Embree's own rate")
    for axis in (rates, ratios):
        finish_sizes(axis, "quads")
    figure.tight_layout()
    figure.savefig(file, dpi=80)


def main():
    measured, docs = json.loads(pathlib.Path(sys.argv[1]).read_text()), pathlib.Path(sys.argv[2])
    draw(measured["rows"], docs / "pictures" / "ray_rate.png")
    write_table(docs, "rays", table(measured["rows"]))


if __name__ == "__main__":
    main()
