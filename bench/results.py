"""What the scripts that write docs/results.md and draw its pictures share."""
import math


def write_table(docs, name, table):
    """Puts `table` between the marks of that name in docs/results.md, and prints it."""
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    results = docs / "results.md"
    before, rest = results.read_text().split(begin)
    after = rest.split(end)[1]
    results.write_text(f"{before}{begin}\n{table}\n{end}{after}")
    print(table)


def seconds_to(rows, psnr):
    """Seconds after which `psnr` is reached for good, between measurements by logarithm."""
    last_below = max((i for i, r in enumerate(rows) if r["psnr"] < psnr), default=-1)
    if last_below + 1 >= len(rows):
        return None
    if last_below < 0:
        return rows[0]["seconds"]
    a, b = rows[last_below], rows[last_below + 1]
    part = (psnr - a["psnr"]) / (b["psnr"] - a["psnr"])
    return math.exp(math.log(a["seconds"]) + part * math.log(b["seconds"] / a["seconds"]))


def psnr_at(rows, seconds):
    """PSNR of the picture after that time, between measurements by logarithm; None before and after these."""
    for a, b in zip(rows, rows[1:]):
        if a["seconds"] <= seconds <= b["seconds"]:
            part = math.log(seconds / a["seconds"]) / math.log(b["seconds"] / a["seconds"])
            return a["psnr"] + part * (b["psnr"] - a["psnr"])
    return None


def draw_error(axis, rows, **style):
    """A curve of PSNR over time, the first whole picture marked."""
    line, = axis.plot([r["seconds"] for r in rows], [r["psnr"] for r in rows], linewidth=2, **style)
    axis.plot(rows[0]["seconds"], rows[0]["psnr"], "o", color=line.get_color(), markersize=4)


def finish_error(axis, run):
    """Title, scales and names of a panel with curves of draw_error()."""
    axis.set_xscale("log")
    axis.set_title(f"{run['scene']}, {run['size']}, {run['threads']} threads")
    axis.set_xlabel("seconds after loading")
    axis.set_ylabel("PSNR against the reference [dB]")
    axis.grid(True, which="both", alpha=0.3)
    axis.legend(loc="lower right", fontsize=8)


def finish_sizes(axis, what):
    """Scale, grid and names of a titled panel with curves over the number of `what` in a scene."""
    axis.set_xscale("log")
    axis.set_xlabel(what)
    axis.grid(True, which="both", alpha=0.3)
    axis.legend(fontsize=8)
    axis.title.set_fontsize(10)
