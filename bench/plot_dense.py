"""Draws what bench/run_dense has measured, and writes its tables in docs/results.md.

Usage: plot_dense.py FOLDER_OF_JSON DOCS_FOLDER
"""
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.image as files
import matplotlib.pyplot as plt

from results import draw_error, finish_error, finish_sizes, psnr_at, write_table

ORDER = ["room", "kitchen", "classroom"]
NAMES = {"best": "levels", "roots": "no levels"}
STYLES = {"best": "-", "roots": "--"}
COLORS = {False: "tab:blue", True: "tab:orange"}  # whether edges were halved
LATE = 8  # seconds after which a picture counts as late
# Places to look at closely: left, top, width and height as parts of the picture.
CLOSE = {
    "room": [(0.28, 0.58, 0.25, 0.2), (0.62, 0.46, 0.35, 0.32), (0.38, 0.26, 0.25, 0.32)],
    "kitchen": [(0.36, 0.62, 0.3, 0.36), (0.16, 0.04, 0.42, 0.34)],
    "classroom": [(0.42, 0.62, 0.26, 0.36), (0.06, 0.2, 0.44, 0.34)],
}
LOADED = {"ring": "one smooth mesh", "furnished": "60 flat-shaded meshes", "room": "built-in room"}


def read(file):
    return json.loads(file.read_text()) if file.exists() else None


def first(run, method):
    return run["methods"][method][0]


def late(run, method):
    rows = run["methods"][method]
    if rows[0]["seconds"] > LATE:
        return "no picture"
    psnr = psnr_at(rows, LATE)
    return f"{psnr:.1f} dB" if psnr is not None else "-"


def besides_rendering(run):
    """The part of the later cycles that is spent on anything but shading points."""
    seconds = run["of_methods"]["best"]["second_half_seconds"]
    return f"{100 * (1 - seconds['rendering'] / sum(seconds.values())):.0f} %"


def dense_table(runs):
    lines = ["| scene | triangles | in view | first whole picture | without levels | sooner by | over the plain scene's"
             f" | after {LATE} s | without levels | all but rendering | levels made in | Embree's build |",
             "|---|" + "---|" * 11]
    for plain, dense in runs:
        for run in (plain, dense):
            best, roots = first(run, "best"), first(run, "roots")
            over = best["seconds"] / first(plain, "best")["seconds"]
            loading = run["of_methods"]["best"]["loading"]
            lines.append(
                f"| {run['scene']}{', dense' if run is dense else ''} | {run['loading']['triangles']} |"
                f" {loading['visible_triangles']} | {best['seconds']:.2f} s, {best['psnr']:.1f} dB |"
                f" {roots['seconds']:.2f} s, {roots['psnr']:.1f} dB |"
                f" **{roots['seconds'] / best['seconds']:.1f}** | {f'{over:.1f}' if run is dense else ''} |"
                f" {late(run, 'best')} | {late(run, 'roots')} | {besides_rendering(run)} | {loading['graphs_seconds']:.3f} s |"
                f" {run['loading']['embree_seconds']:.3f} s |")
    return "\n".join(lines)


def first_table(runs):
    lines = ["| scene | triangles | in view | first whole picture | without levels | sooner by |"
             " all but rendering |", "|---|" + "---|" * 6]
    for run in runs:
        best, roots = first(run, "best")["seconds"], first(run, "roots")["seconds"]
        lines.append(f"| {run['scene']} | {run['loading']['triangles']} |"
                     f" {run['of_methods']['best']['loading']['visible_triangles']} |"
                     f" {best:.2f} s | {roots:.2f} s | **{roots / best:.1f}** | {besides_rendering(run)} |")
    return "\n".join(lines)


def load_table(rows):
    """A row for each scene and size; the numbers of threads side by side."""
    threads = sorted({row["threads"] for row in rows})
    sizes = list(dict.fromkeys((row["scene"], row["triangles"]) for row in rows))
    head = [f"levels, {n} thread{'s' * (n > 1)} | Embree's build | ratio" for n in threads]
    lines = [f"| scene | triangles | {' | '.join(head)} | bytes of levels | vertices alone | Embree's |",
             "|---|" + "---|" * (3 * len(threads) + 4)]
    for size in sizes:
        own = sorted((row for row in rows if (row["scene"], row["triangles"]) == size), key=lambda row: row["threads"])
        line = f"| {LOADED[size[0]]} | {size[1]} |"
        for row in own:
            levels, embree = row["graphs"]["seconds"]["median"], row["embree"]["seconds"]["median"]
            line += f" {levels:.3f} s | {embree:.3f} s | **{levels / embree:.2f}** |"
        for step in ("graphs", "graphs_without_levels", "embree"):
            line += f" {most_bytes(own, step) / 1e6:.1f} MB |"
        lines.append(line)
    return "\n".join(lines)


def most_bytes(rows, step):
    """The most of all repetitions: memory that is used anew does not show."""
    return max(row[step]["bytes"]["high"] for row in rows)


def draw_errors(runs, file):
    figure, axes = plt.subplots(1, len(runs), figsize=(5 * len(runs), 4), squeeze=False)
    for pair, axis in zip(runs, axes[0]):
        for run in pair:
            dense = run["bisect"] > 0
            for method, rows in run["methods"].items():
                visible = run["of_methods"][method]["loading"]["visible_triangles"]
                draw_error(axis, rows, label=f"{visible} triangles in view, {NAMES[method]}",
                           color=COLORS[dense], linestyle=STYLES[method])
        finish_error(axis, pair[0])
    figure.tight_layout()
    figure.savefig(file, dpi=80)


def draw_load(rows, file):
    figure, (seconds, space) = plt.subplots(1, 2, figsize=(10, 4))
    for number, scene in enumerate(dict.fromkeys(row["scene"] for row in rows)):
        of_scene = [row for row in rows if row["scene"] == scene]
        for step, style in (("graphs", "o-"), ("embree", "o:")):
            for threads in sorted({row["threads"] for row in of_scene}):
                own = [row for row in of_scene if row["threads"] == threads]
                label = f"{LOADED[scene]}, {threads} thread{'s' * (threads > 1)}" if step == "graphs" else None
                seconds.plot([row["triangles"] for row in own], [row[step]["seconds"]["median"] for row in own], style,
                             color=f"C{number}", linewidth=0.3 + 0.7 * threads, markersize=3, label=label)
            sizes = sorted({row["triangles"] for row in of_scene})
            each = [most_bytes([row for row in of_scene if row["triangles"] == size], step) / size for size in sizes]
            space.plot(sizes, each, style, color=f"C{number}", markersize=3,
                       label=LOADED[scene] if step == "graphs" else None)
    seconds.set_title("seconds (dotted: Embree's build)")
    seconds.set_yscale("log")
    space.set_title("bytes a triangle (dotted: Embree's)")
    space.set_ylim(bottom=0)
    for axis in (seconds, space):
        finish_sizes(axis, "triangles")
    figure.tight_layout()
    figure.savefig(file, dpi=80)


def cut(picture, place):
    height, width = picture.shape[:2]
    left, top, across, down = place
    return picture[int(top * height):int((top + down) * height), int(left * width):int((left + across) * width)]


def draw_strips(folder, strips, place, size, file):
    """A row for each of the strips (its words, a run, a method), a column for each time, and the reference last. Only
    what was there at the time is shown. `place` as in CLOSE; `size` of a picture in inches."""
    times = sorted({p["time"] for _, run, method in strips for p in run["of_methods"][method]["pictures"]})
    figure, axes = plt.subplots(len(strips), len(times) + 1, squeeze=False,
                                figsize=(size[0] * (len(times) + 1), size[1] * len(strips)))
    for row, (words, run, method) in zip(axes, strips):
        pictures = folder / (run["scene"] + ("_dense" if run["bisect"] else ""))
        taken = {p["time"]: p for p in run["of_methods"][method]["pictures"]}
        for axis, time in zip(row, times + [None]):
            axis.set_xticks([])
            axis.set_yticks([])
            for spine in axis.spines.values():
                spine.set_visible(False)
            # Checkpoints come a little late; a picture that nobody had is not shown.
            begun = first(run, method)["seconds"]
            if time is not None and (time not in taken or begun > 1.2 * time):
                note = f"first picture\nafter {begun:.2f} s" if begun > 1.2 * time else "not measured"
                axis.text(0.5, 0.5, note, ha="center", va="center", transform=axis.transAxes, fontsize=9)
                continue
            name = "reference" if time is None else taken[time]["name"]
            axis.imshow(cut(files.imread(pictures / f"{name}.png"), place), interpolation="lanczos", aspect="auto")
            axis.set_title("reference" if time is None else f"{taken[time]['seconds']:.2f} s", fontsize=8, pad=2)
        row[0].set_ylabel(words, fontsize=9)
    figure.subplots_adjust(left=0.02, right=0.998, top=0.96, bottom=0.004, wspace=0.01, hspace=0.1)
    figure.savefig(file, dpi=100, pil_kwargs={"quality": 88})
    plt.close(figure)


def draw_pictures(folder, runs, pictures):
    for plain, dense in runs:
        name = plain["scene"]
        strips = [("dense, levels", dense, "best"), ("dense, no levels", dense, "roots"),
                  ("plain, levels", plain, "best"), ("plain, no levels", plain, "roots")]
        draw_strips(folder, strips, (0, 0, 1, 1), (2.8, 2.1), pictures / f"dense_{name}.jpg")
        for number, place in enumerate(CLOSE[name], 1):
            draw_strips(folder, strips, place, (2.8, 2.8 * 0.75 * place[3] / place[2]),
                        pictures / f"dense_{name}_{number}.jpg")


def main():
    folder, docs = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    pictures = docs / "pictures"
    pictures.mkdir(exist_ok=True)
    runs = [(read(folder / f"{name}.json"), read(folder / f"{name}_dense.json")) for name in ORDER]
    runs = [pair for pair in runs if all(pair)]
    if runs:
        draw_errors(runs, pictures / "dense.png")
        draw_pictures(folder, runs, pictures)
        write_table(docs, "dense", dense_table(runs))
    firsts = [run for run in (read(folder / f"{name}_first.json") for name in ORDER) if run]
    if firsts:
        write_table(docs, "first", first_table(firsts))
    loading = read(folder / "load_time.json")
    if loading:
        draw_load(loading["rows"], pictures / "load_time.png")
        write_table(docs, "load", load_table(loading["rows"]))


if __name__ == "__main__":
    main()
