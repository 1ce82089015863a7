#!/usr/bin/env python3
"""Checks who includes whom: `tools/check_includes.py [ROOT]`.

A folder of src/ may include itself and folders of a lower rank, never one of its own rank. A library
that faces the outside is included by one folder only.
"""

import pathlib
import re
import sys

RANKS = [
    {"base"},
    {"scene"},
    {"import", "rays", "shading_cache", "irradiance"},
    {"sample_renderer", "sample_selector", "image_generator"},
    {"update", "remote", "rivals"},
    {"user_interaction"},
    {"apps"},
]
RANK_OF = {folder: rank for rank, folders in enumerate(RANKS) for folder in folders}

OWNERS = [  # how the name of a library's header begins, and the folders that may include it
    ("embree", {"rays"}),
    ("tbb|oneapi", {"base", "rays"}),
    ("fmt", {"import"}),
    ("tiny_gltf|spng|jpeglib|turbojpeg|OpenEXR|Imf|Imath", {"import"}),
    ("opensubdiv", {"import"}),
    ("nlohmann", {"import", "apps"}),
    ("CLI", {"apps"}),
    ("GLFW|imgui|epoxy", {"user_interaction", "image_generator"}),
]
INCLUDE = re.compile(r'\s*#\s*include\s*[<"]([^>"]+)[>"]')


def fault(folder, header):
    """Why a file of `folder` may not include `header`, or None."""
    first = header.split("/")[0]
    if first in RANK_OF and "/" in header:
        if first != folder and RANK_OF[first] >= RANK_OF[folder]:
            return f"{folder} (rank {RANK_OF[folder]}) may not include {first} (rank {RANK_OF[first]})"
        return None
    for names, owners in OWNERS:
        if re.match(f"({names})", header) and folder not in owners:
            return f"only {' and '.join(sorted(owners))} may include {header}"
    return None


def main(root):
    faults = []
    for path in sorted((root / "src").rglob("*")):
        if path.suffix not in {".h", ".cpp"}:
            continue
        folder = path.relative_to(root / "src").parts[0]
        if folder not in RANK_OF:
            faults.append(f"{path}:1: {folder} has no rank in tools/check_includes.py")
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            why = match and fault(folder, match[1])
            if why:
                faults.append(f"{path}:{number}: {why}")
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    default = pathlib.Path(__file__).resolve().parent.parent
    sys.exit(main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default))
