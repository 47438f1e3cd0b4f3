"""Slow readable twin of the rasteriser in float64: every chord against every pixel, gradients by autograd."""

import math

import torch
from torch import Tensor

TOLERANCE = 0.05  # px, as the rasteriser flattens
LEAST_CHORDS, MOST_CHORDS = 4, 64


def rasterize(
    points: Tensor,
    stops: Tensor,
    axis: Tensor,
    gradient: list[bool],
    canvas: Tensor,
    size: tuple[int, int],
    subrows: int = 1,
) -> list[Tensor]:
    """Pictures [H, W, 3] before the first path and after every path."""
    height, width = size
    picture = canvas.expand(height, width, 3)
    pictures = [picture]
    for i in range(len(points)):
        colour, opacity = fill(stops[i], axis[i], gradient[i], height, width)
        alpha = (opacity * coverage(points[i], height, width, subrows))[..., None]
        picture = picture + alpha * (colour - picture)
        pictures.append(picture)
    return pictures


def fill(stops: Tensor, axis: Tensor, gradient: bool, height: int, width: int) -> tuple[Tensor, Tensor]:
    """Colour [H, W, 3] and opacity [H, W] at pixel centres."""
    y, x = torch.meshgrid(torch.arange(height) + 0.5, torch.arange(width) + 0.5, indexing="ij")
    delta = axis[2:] - axis[:2]
    position = ((x - axis[0]) * delta[0] + (y - axis[1]) * delta[1]) / (delta @ delta).clamp_min(1e-12)
    s = position.clamp(0, 1)[..., None] if gradient else torch.zeros(height, width, 1)
    first, second = (2 * s).clamp(0, 1), (2 * s - 1).clamp(0, 1)
    rgba = stops[0] + first * (stops[1] - stops[0]) + second * (stops[2] - stops[1])
    return rgba[..., :3], rgba[..., 3]


def coverage(ring: Tensor, height: int, width: int, subrows: int) -> Tensor:
    """`min(|winding|, 1)` averaged over sub-rows, [H, W]."""
    vertices = flatten(ring) * torch.tensor([1.0, subrows], dtype=torch.float64)
    w = winding(vertices, torch.roll(vertices, -1, 0), height * subrows, width)
    return w.abs().clamp(max=1).reshape(height, subrows, width).mean(1)


def flatten(ring: Tensor) -> Tensor:
    """Vertices of the polygon that stands for the cubics, [V, 2]."""
    vertices = []
    segments = ring.reshape(-1, 3, 2)
    for j in range(len(segments)):
        p0, p1, p2 = segments[j]
        p3 = segments[(j + 1) % len(segments)][0]
        n = n_chords(torch.stack([p0, p1, p2, p3]).detach())
        t = (torch.arange(n, dtype=torch.float64) / n)[:, None]
        curve = (1 - t) ** 3 * p0 + 3 * (1 - t) ** 2 * t * p1 + 3 * (1 - t) * t**2 * p2 + t**3 * p3
        acceleration = 6 * ((1 - t) * (p0 - 2 * p1 + p2) + t * (p1 - 2 * p2 + p3))
        vertices.append(torch.where(t > 0, curve - acceleration / (12 * n * n), curve))  # as much area as the cubic
    return torch.cat(vertices)


def n_chords(p: Tensor) -> int:
    """By how far a chord over 1/n of the parameter strays: |P''⊥| / 8n², P'' at five parameters."""
    strays = []
    for t in (0, 0.25, 0.5, 0.75, 1):
        velocity = 3 * ((1 - t) ** 2 * (p[1] - p[0]) + 2 * t * (1 - t) * (p[2] - p[1]) + t**2 * (p[3] - p[2]))
        acceleration = 6 * ((1 - t) * (p[0] - 2 * p[1] + p[2]) + t * (p[1] - 2 * p[2] + p[3]))
        cross = velocity[0] * acceleration[1] - velocity[1] * acceleration[0]
        strays.append(float(cross.abs() / velocity.norm().clamp_min(1e-3)) / 8)
    return min(max(math.ceil(math.sqrt(max(strays) / TOLERANCE)), LEAST_CHORDS), MOST_CHORDS)


def winding(start: Tensor, end: Tensor, height: int, width: int) -> Tensor:
    """Box-filtered winding [H, W]: per chord and row, the part inside the row covers all that lies to its right."""
    (x0, y0), (x1, y1) = start.T[..., None], end.T[..., None]
    rows = torch.arange(height)[None]
    flat = y0 == y1
    slope = (x1 - x0) / torch.where(flat, torch.ones_like(y0), y1 - y0)
    ya, yb = (
        torch.clamp(y0, rows, rows + 1),
        torch.clamp(y1, rows, rows + 1),
    )  # chords × rows
    xa, xb = x0 + (ya - y0) * slope, x0 + (yb - y0) * slope
    right = torch.arange(width) + 1
    va, vb = (
        right - xa[..., None],
        right - xb[..., None],
    )  # how far the pixel's right side lies beyond the chord
    upright = (va - vb).abs() < 1e-9
    mean = (ramp(va) - ramp(vb)) / torch.where(upright, torch.ones_like(va), va - vb)
    return ((yb - ya)[..., None] * torch.where(upright, va.clamp(0, 1), mean)).sum(0)


def ramp(v: Tensor) -> Tensor:
    """Integral of `clamp(v, 0, 1)`."""
    inside = v.clamp(0, 1)
    return inside**2 / 2 + (v - 1).clamp_min(0)
