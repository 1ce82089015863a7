"""Writes the table of efficiencies in docs/results.md from the JSON of `efficiency`.

Usage: efficiency_table.py FOLDER_WITH_JSON DOCS_FOLDER
"""
import json
import pathlib
import sys

from results import write_table

KINDS = {  # in the table's order
    "direct": "lit directly (Cornell box, all light)",
    "indirect": "mostly indirect (lamp in a box)",
    "caustic": "caustic (glossy ring)",
    "furnished_few": "furnished room",
    "furnished": "furnished room",
}


def table(folder):
    lines = ["| places | renderer | relative squared error | bias | seconds | efficiency over path's |",
             "|---|---|---|---|---|---|"]
    for kind, words in KINDS.items():
        file = folder / f"{kind}.json"
        if not file.exists():
            continue
        measured = json.loads(file.read_text())
        renderers = measured["renderers"]
        words += f", {measured['places']} x {measured['samples']}"
        for name, row in renderers.items():
            ratio = row["efficiency"] / renderers["path"]["efficiency"]
            lines.append(f"| {words} | {name} | {row['relative_mse']:.2e} ± {row['relative_mse_deviation']:.0e} | {100 * row['bias']:+.1f} % |"
                         f" {row['seconds']:.2f} | **{ratio:.2f}** |")
    return "\n".join(lines)


def main():
    folder, docs = (pathlib.Path(argument) for argument in sys.argv[1:3])
    write_table(docs, "efficiency", table(folder))


if __name__ == "__main__":
    main()
