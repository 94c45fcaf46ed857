"""Bodies and motions that the tests share."""

import numpy as np

CUBE_VERTICES = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], np.float64
)
CUBE_FACES = np.array([[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
RAGGED = "(not an array|an array of object is not|the shape is)"  # NumPy before 1.24 makes objects of ragged lists


def pose(x: float, y: float, z: float, *quaternion: float) -> np.ndarray:
    return np.array([x, y, z, *(quaternion or (1, 0, 0, 0))], np.float64)


def matrix(x: float, y: float, z: float) -> np.ndarray:
    result = np.eye(4)
    result[:3, 3] = x, y, z
    return result


def random_motions(count: int, seed: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Starts and goals (count, 7) of a cube that moves past another cube or into it. About half of the motions touch."""
    random = np.random.default_rng(seed)
    starts = np.zeros((count, 7))
    starts[:, 0] = 3
    starts[:, 1:3] = random.uniform(-1, 1, (count, 2))
    starts[:, 3] = 1
    goals = starts.copy()
    goals[:, 0] = -1
    goals[:, 3:] = random.normal(size=(count, 4))
    return starts, goals
