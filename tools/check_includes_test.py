#!/usr/bin/env python3
"""check_includes.py finds each kind of breach in a tree made wrong on purpose, and nothing else."""

import pathlib
import subprocess
import sys
import tempfile

SCRIPT = pathlib.Path(__file__).with_name("check_includes.py")

ALLOWED = {
    "src/base/a.h": '#include <vector>\n#include "base/b.h"\n',
    "src/scene/a.h": '#include "base/a.h"\n',
    "src/base/a.cpp": "#include <tbb/parallel_for.h>\n",
    "src/rays/a.cpp": '#include <embree3/rtcore.h>\n#include <tbb/task_arena.h>\n#include "scene/a.h"\n',
    "src/import/a.cpp": "#include <tiny_gltf.h>\n#include <ImfRgbaFile.h>\n#include <fmt/format.h>\n",
    "src/apps/a.cpp": '#include <CLI/CLI.hpp>\n#include <nlohmann/json.hpp>\n#include "rays/a.h"\n',
    "src/update/a.cpp": '// #include "apps/a.h"\n',
}
REFUSED = {
    "src/base/up.h": '\n#include "scene/a.h"\n',
    "src/rays/sideways.h": '\n#include "import/a.h"\n',
    "src/rays/angled.h": "\n#include <update/a.h>\n",
    "src/update/tbb.cpp": "\n#include <tbb/parallel_for.h>\n",
    "src/scene/fmt.cpp": "\n#include <fmt/format.h>\n",
    "src/scene/embree.cpp": "\n#include <embree3/rtcore.h>\n",
    "src/rays/json.cpp": "\n# include <nlohmann/json.hpp>\n",
    "src/update/cli.cpp": "\n#include <CLI/CLI.hpp>\n",
}


def run(files):
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = pathlib.Path(root, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        result = subprocess.run([sys.executable, SCRIPT, root], capture_output=True, text=True)
        return result.returncode, result.stdout


status, output = run(ALLOWED)
assert (status, output) == (0, ""), output

for name, text in REFUSED.items():
    status, output = run({**ALLOWED, name: text})
    assert status == 1 and f"{name}:2: " in output and output.count("\n") == 1, (name, output)

status, output = run({"src/stray/a.h": ""})
assert status == 1 and "stray has no rank" in output, output
print("check_includes.py finds what it should")
