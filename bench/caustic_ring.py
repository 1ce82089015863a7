"""Writes a scene whose light is focused: a glossy gold ring on a table under a small lamp (compare the paper's Figure 6).

Usage: caustic_ring.py FILE_WITHOUT_SUFFIX
"""
import math
import pathlib
import sys

SIDES = 128
RADIUS, HEIGHT = 1.0, 0.5
LAMP = 0.05  # half of its side
MATERIALS = """newmtl table
Kd 0.5 0.5 0.5
newmtl gold
Kd 0 0 0
Ks 0.95 0.8 0.5
Ns 300
illum 2
newmtl lamp
Kd 0 0 0
Ke 25000 25000 25000
"""


def main():
    stem = pathlib.Path(sys.argv[1])
    stem.with_suffix(".mtl").write_text(MATERIALS)
    lines = [f"mtllib {stem.name}.mtl", "usemtl table"]
    lines += ["v -5 0 5", "v 5 0 5", "v 5 0 -5", "v -5 0 -5", "f 1 2 3 4"]

    # The lamp looks at the ring's middle from 45 degrees above.
    lines.append("usemtl lamp")
    to_ring, across = (math.sqrt(0.5), -math.sqrt(0.5), 0), (0, 0, 1)
    up = (math.sqrt(0.5), math.sqrt(0.5), 0)
    for a, b in ((-1, -1), (-1, 1), (1, 1), (1, -1)):
        place = [c + LAMP * (a * x + b * y) for c, x, y in zip((-3, 3, 0), across, up)]
        lines.append("v " + " ".join(f"{x:.6f}" for x in place))
    lines.append("f 5 6 7 8")
    assert sum(x * y for x, y in zip(to_ring, up)) < 1e-9

    lines.append("usemtl gold")
    for i in range(SIDES):
        x, z = (f(2 * math.pi * i / SIDES) for f in (math.cos, math.sin))
        lines += [f"v {RADIUS * x:.6f} {y} {RADIUS * z:.6f}" for y in (0, HEIGHT)]
        lines.append(f"vn {x:.6f} 0 {z:.6f}")
    for i in range(SIDES):
        j = (i + 1) % SIDES
        corners = [(9 + 2 * j, 1 + j), (9 + 2 * i, 1 + i), (10 + 2 * i, 1 + i), (10 + 2 * j, 1 + j)]
        lines.append("f " + " ".join(f"{v}//{n}" for v, n in corners))
    stem.with_suffix(".obj").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
