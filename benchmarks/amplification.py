"""The picture of docs/method.md: amplification factor of a stiff rate per step, with and without smoothing.

    python benchmarks/amplification.py      # writes docs/method/amplification.svg and prints the table of the page

The equation is v' = -A v.  The Jacobian of the step is A/ratio; z = gamma A/ratio, gamma = h/2.
A step is a matrix that acts on (v_n, gamma a_n, gamma a_{n-1}).
"""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from svg import save_svg

PAGE = Path(__file__).resolve().parents[1] / "docs" / "method"
SMOOTHING = 0.15  # verlet.c


def step(z, theta, ratio=1.0):
    """One step as a matrix [3, 3]; theta: smoothing, ratio: true rate / rate of the Jacobian."""
    H, true = z / (1.0 + z), ratio * z
    new = np.array([-true, z - 2.0 * true, 0.0]) / (1.0 + z)  # gamma a_{n+1} before the smoothing
    smoothed = new - theta * H * (new - np.array([0.0, 2.0, -1.0]))
    return np.array([np.array([1.0, 1.0, 0.0]) + new, smoothed, [0.0, 1.0, 0.0]])


def factor(z, theta, ratio=1.0):
    """Modulus of the largest eigenvalue: the amplification factor of a long run."""
    return np.max(np.abs(np.linalg.eigvals(step(z, theta, ratio))))


def explicit_roots(z):
    """Eigenvalues without a Jacobian: lambda^2 - (1 - 3 z) lambda - z = 0."""
    return np.roots([1.0, 3.0 * z - 1.0, -z])


def draw():
    plt.rcParams.update({"font.size": 10, "axes.grid": True, "grid.alpha": 0.25})
    z = np.geomspace(0.05, 1000.0, 80)
    figure, axes = plt.subplots(figsize=(5.4, 4.4), layout="constrained")  # letters of 10 pixels on a page of 390
    curves = (
        ("trapezoidal rule, no damping", 0.0, 1.0, {"color": "#a33", "linestyle": "--"}),
        ("damped with 0.15", SMOOTHING, 1.0, {"color": "#0b3c8c", "linewidth": 2.2}),
        (
            "the same, Jacobian twice too large",
            SMOOTHING,
            0.5,
            {"color": "#0b3c8c", "linewidth": 1.0, "linestyle": ":"},
        ),
        (
            "the same, Jacobian 10 % too small",
            SMOOTHING,
            1.0 / 0.9,
            {"color": "#0b3c8c", "linewidth": 1.0, "linestyle": "-."},
        ),
    )
    for label, theta, ratio, style in curves:
        axes.semilogx(z, [factor(value, theta, ratio) for value in z], label=label, **style)
    axes.semilogx(z, np.exp(-2.0 * z), color="#888", linewidth=1.0, label="exact, exp(-h A)")
    axes.axvline(2.0, color="#888", linewidth=0.8)
    axes.text(2.2, 1.04, "balls are damped from here on", color="#555")
    axes.set(xlabel="γ A of the Jacobian, γ = h/2", ylim=(0.0, 1.1), xlim=(0.05, 1000.0))
    axes.set_title("amplification factor", loc="left", weight="bold")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.16), frameon=False)
    save_svg(figure, PAGE / "amplification.svg")


def main():
    for theta in (0.0, 0.05, 0.1, 1.0 / 9.0, SMOOTHING, 0.2, 0.25):
        worst = max(factor(z, theta) for z in np.geomspace(2.0, 1e6, 400))
        limit = f"{factor(1e9, theta):.3f} in the limit, error constant {1 / 12 - theta / 2:+.4f}"
        print(f"smoothing {theta:.3f}: at most {worst:.3f} for gamma A > 2, {limit}")
    ratios = np.linspace(0.5, 1.5, 1001)
    stable = ratios[[factor(1e9, SMOOTHING, r) <= 1.0 + 1e-7 for r in ratios]]
    print(f"stable up to a true rate of {stable.max():.3f} times the Jacobian's")
    print("without a Jacobian, roots at gamma A = 0.2:", explicit_roots(0.2), "and at 0.5:", explicit_roots(0.5))
    draw()


if __name__ == "__main__":
    main()
