"""Poses as seven numbers."""

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


def seven_numbers(matrix: Array) -> Array:
    """x y z qw qx qy qz. The quaternion is the eigenvector of the matrix that every rotation has for it."""
    r = matrix[:3, :3]
    off = [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]
    k = np.empty((4, 4))
    k[0, 0] = np.trace(r)
    k[0, 1:] = k[1:, 0] = off
    k[1:, 1:] = r + r.T - np.trace(r) * np.eye(3)
    return np.concatenate([matrix[:3, 3], np.linalg.eigh(k)[1][:, -1]])
