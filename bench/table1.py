"""Writes the paper's Table 1 with our columns beside its own in docs/results.md.

python3 table1.py FOLDER DOCS: FOLDER holds what --stats wrote, SCENE_SCHEME_THREADS.json (threads 0: all).
"""
import json
import pathlib
import sys

import results

# Table 1 of the paper: one rendering client, a dual 1.7 GHz Pentium 4.
PAPER = {
    "room": {"points": 70, "sample_selection": 50, "patch_subdivision": "< 1", "tessellation": 12, "aging": "< 1",
             "update_display_meshes": 1, "rendering": 611, "total": 675},
    "indirect": {"points": 72, "sample_selection": 36, "patch_subdivision": "< 1", "tessellation": 0, "aging": "< 1",
                 "update_display_meshes": 1, "rendering": 490, "total": 529},
    "poolhall": {"points": 61, "sample_selection": 12, "patch_subdivision": "< 1", "tessellation": 9, "aging": "< 1",
                 "update_display_meshes": 2, "rendering": 506, "total": 533},
}
ROWS = {
    "points": "points rendered per update",
    "sample_selection": "sample selection (ms)",
    "patch_subdivision": "patch subdivision (ms)",
    "tessellation": "curved surface tessellation (ms)",
    "aging": "aging (ms)",
    "update_display_meshes": "updating display meshes (ms)",
    "rendering": "rendering time (ms)",
    "total": "time per iteration (ms)",
    "points_per_second": "points a second",
    "bytes_per_patch": "bytes a patch",
}
COLUMNS = {("paper", 1): "paper's scheme, 1 thread", ("paper", 0): "all threads",
           ("best", 1): "best scheme, 1 thread", ("best", 0): "all threads",
           ("walk", 0): "and along the scene's path"}


def figures(path):
    stats = json.loads(path.read_text())
    return {**stats["cycle_ms"], "points": stats["points_shaded"] / stats["cycles"],
            "points_per_second": stats["points_per_second"], "bytes_per_patch": stats["bytes_per_patch"]}


def shown(value):
    if isinstance(value, str):
        return value
    return f"{value:.0f}" if value >= 100 else "< 0.01" if 0 < value < 0.01 else f"{value:.3g}"


def table(folder):
    lines = []
    for scene, paper in PAPER.items():
        ours = [figures(folder / f"{scene}_{scheme}_{threads}.json") for scheme, threads in COLUMNS]
        lines += [f"| {scene} | the paper | " + " | ".join(COLUMNS.values()) + " |", "|---" * (2 + len(ours)) + "|"]
        for row, name in ROWS.items():
            values = [paper.get(row, "")] + [column[row] for column in ours]
            lines.append(f"| {name} | " + " | ".join(shown(v) for v in values) + " |")
        lines.append("")
    return "\n".join(lines).rstrip()


def main():
    folder, docs = (pathlib.Path(a) for a in sys.argv[1:3])
    results.write_table(docs, "table1", table(folder))


if __name__ == "__main__":
    main()
