"""Puts pictures side by side.

Usage: side_by_side.py row OUT A B ...          all in rows of three
       side_by_side.py difference OUT A B       A, B and four times their absolute difference
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.image as files
import numpy as np


def main():
    mode, out = sys.argv[1:3]
    pictures = [files.imread(name)[:, :, :3] for name in sys.argv[3:]]
    if mode == "difference":
        pictures.append(np.clip(4 * np.abs(pictures[0] - pictures[1]), 0, 1))
    rows = [np.hstack(pictures[i:i + 3]) for i in range(0, len(pictures), 3)]
    files.imsave(out, np.vstack(rows))


if __name__ == "__main__":
    main()
