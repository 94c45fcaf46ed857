# %% [markdown]
# # The clearance of a path as a function of torch
# The least distance along a path of a robot has a gradient by each joint of each knot. A few lines make it a function that
# torch differentiates. It needs the package `torch`.

# %%
import pathlib

import numpy as np
import torch

import chasles

folder = pathlib.Path(__file__).parents[1] / "robot"
robot = chasles.Robot.load(folder / "arm.urdf")
robot.ignore("left_finger", "right_finger")
scene = chasles.Scene()
scene.add("pole", chasles.capsule(0.05, 2), [1.0, -0.2, 0.6, 1, 0, 0, 0])
checker = chasles.RobotChecker(robot, scene)

# %% [markdown]
# ## The wrapper


# %%
class Clearance(torch.autograd.Function):
    """The least distance along the straight path through knots (knots, variables); 0, without a slope, in contact."""

    @staticmethod
    def forward(context, knots: torch.Tensor) -> torch.Tensor:
        near = checker.least_distance_on_path(knots.detach().numpy())
        gradient = np.zeros(knots.shape) if near.gradient is None else near.gradient
        context.save_for_backward(torch.from_numpy(gradient))
        return knots.new_tensor(near.distance_upper)

    @staticmethod
    def backward(context, outer: torch.Tensor) -> torch.Tensor:
        (gradient,) = context.saved_tensors
        return outer * gradient


# %% [markdown]
# ## A path that keeps away from the pole
# Both ends stay; the knots between are moved until the path is 5 cm from the pole.

# %%
start, goal = np.array([-0.6, 0.1, 0.2, 0.01]), np.array([-0.1, 0.9, 0.5, 0.02])
ends = torch.from_numpy(np.stack([start, goal]))
inner = torch.from_numpy(np.linspace(start, goal, 5)[1:-1]).requires_grad_()
before = float(Clearance.apply(torch.cat([ends[:1], inner, ends[1:]])).detach())
optimiser = torch.optim.Adam([inner], lr=0.01)
for _ in range(100):
    optimiser.zero_grad()
    path = torch.cat([ends[:1], inner, ends[1:]])
    loss = torch.relu(0.05 - Clearance.apply(path)) + 0.1 * torch.diff(path, n=2, dim=0).square().sum()
    loss.backward()
    optimiser.step()
after = float(Clearance.apply(torch.cat([ends[:1], inner, ends[1:]])).detach())
print(f"clearance {before:.4f} before, {after:.4f} after")
assert after > 0.045 > before
