"""A flexible rotor in ROSS on two bearing FMUs, motion in, force out: unbalance response against ROSS with the FMU's
own stiffness and damping.

    pip install -e ".[rotor]"; python examples/rotor/rotor.py [--unbalance 5e-5 5e-4] [--run-up 0.4] [--picture rotor.png]

The bearings' coefficients (bearing_ross.toml) are those of `riveted-bearing matrices examples/rotor/bearing.toml`.  The
master integrates the rotor by the trapezoidal rule.  Each step the FMUs get position, velocity and acceleration of
their nodes and say the force at the step's end; what the rotor then moves beside that prediction meets the linear
stiffness inside the master's matrix, so that the stiff joint of shaft and bearing stays passive.
"""

import argparse
from pathlib import Path

import numpy as np
import ross as rs
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from scipy.linalg import lu_factor, lu_solve

HERE, NODES, DISK, H = Path(__file__).resolve().parent, (0, 8), 4, 5e-6  # H: communication step [s]
FMU = HERE.parents[1] / "fmus" / "RivetedBearing.fmu"
# place of an inner ring under 500 N [m] at the speeds of bearing_ross.toml
AXIAL = np.array([105.611e-6, 105.273e-6, 104.667e-6, 103.733e-6])


def axial_place(omega):
    """Axial place of an inner ring [m], which springs press with 500 N: the ring that grows with its speed gives way."""
    return np.interp(omega, coefficients()["frequency"], AXIAL)


def rotor(bearings):
    """A shaft of 35 mm with a disk in the middle; x, y of ROSS are Y, Z of the bearings."""
    steel = rs.Material("steel", rho=7810.0, E=211e9, G_s=81.2e9)
    shaft = [rs.ShaftElement(L=0.05, idl=0.0, odl=0.035, material=steel, alpha=40.0) for _ in range(8)]
    return rs.Rotor(
        shaft, [rs.DiskElement.from_geometry(n=DISK, material=steel, width=0.04, i_d=0.035, o_d=0.2)], bearings
    )


class Bearing:
    """One FMU: its inner ring goes where the shaft goes."""

    def __init__(self, description, folder, omega, side, y, v):
        self.vr = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="bearing",
        )
        self.fmu.instantiate()
        self.fmu.setInteger([self.vr["ring.motion"], self.vr["scene.stress"]], [2, 1])
        self.fmu.setReal([self.vr["shaft.omega"], self.vr["shaft.x"]], [omega, side * axial_place(omega)])
        self.inputs = [self.vr[f"shaft.{name}"] for name in ("y", "z", "v_y", "v_z")]
        self.fmu.setReal(self.inputs, [*y, *v])
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def force(self):
        return np.array(self.fmu.getReal([self.vr["shaft.R_y"], self.vr["shaft.R_z"]]))

    def step(self, t, y, v, a):
        self.fmu.setReal(self.inputs, [*y, *v])
        self.fmu.setRealInputDerivatives(self.inputs[2:], [1, 1], list(a))
        self.fmu.doStep(currentCommunicationPoint=t, communicationStepSize=H)
        return self.force()


class Coupled:
    """The rotor on its two FMUs: displacements q, velocities v and accelerations a [degrees of freedom] at the time t
    [s].
    """

    def __init__(self, description, folder, omega, stiffness, q, v, load):
        self.rotor = rotor([rs.BearingElement(n=n, kxx=0.0, cxx=0.0) for n in NODES])
        self.at = np.array([6 * n + i for n in NODES for i in range(2)])
        self.K_joint = np.zeros((len(q), len(q)))
        self.K_joint[self.at, self.at] = stiffness
        self.bearings = [
            Bearing(description, folder, omega, side, q[at], v[at])
            for side, at in zip((1.0, -1.0), (self.at[:2], self.at[2:]), strict=True)
        ]
        self.M, self.q, self.v, self.n = self.rotor.M(omega), q, v, 0
        self.turn_at(omega)
        R = np.concatenate([bearing.force() for bearing in self.bearings])
        self.a = np.linalg.solve(self.M, self.force(load, R) - self.D @ v - self.K @ q)

    def turn_at(self, omega):
        """Gyroscopic moments of the speed omega [rad/s]."""
        self.K, self.D = self.rotor.K(omega), self.rotor.C(omega) + omega * self.rotor.G()
        self.solve = lu_factor(self.M + 0.5 * H * self.D + 0.25 * H * H * (self.K + self.K_joint))

    def force(self, load, R):
        """load: of the disk in x, y [N]; R: of the bearings' nodes."""
        f = np.zeros(len(self.q))
        f[6 * DISK : 6 * DISK + 2] = load
        f[self.at] += R
        return f

    def step(self, load):
        """One communication step; load: of the disk at its end."""
        at, q, v, a = self.at, self.q, self.v, self.a
        ends = q[at] + H * v[at] + 0.5 * H * H * a[at]  # where the FMUs' rings will be
        R = np.concatenate(
            [b.step(self.n * H, q[s], v[s], a[s]) for b, s in zip(self.bearings, (at[:2], at[2:]), strict=True)]
        )
        q_p, v_p = q + H * v + 0.25 * H * H * a, v + 0.5 * H * a
        joint = self.K_joint[:, at] @ (ends - q_p[at])
        self.a = lu_solve(self.solve, self.force(load, R) + joint - self.D @ v_p - self.K @ q_p)
        self.q, self.v, self.n = q_p + 0.25 * H * H * self.a, v_p + 0.5 * H * self.a, self.n + 1

    def free(self):
        for bearing in self.bearings:
            bearing.fmu.terminate()
            bearing.fmu.freeInstance()


def unbalance_load(unbalance, phi, omega, omega_dot=0.0):
    """Force [..., 2] of an unbalance [kg.m] at the angle phi [rad] that turns at omega [rad/s] and speeds up by
    omega_dot.
    """
    c, s = np.cos(phi), np.sin(phi)
    return unbalance * np.stack([omega**2 * c + omega_dot * s, omega**2 * s - omega_dot * c], axis=-1)


def coupled(description, folder, omega, unbalance, stiffness, start, settle=0.02, length=0.04):
    """Synchronous amplitudes [degrees of freedom] of the rotor on the FMUs, as q = Re(amplitude exp(i omega t)); start:
    those to begin with.

    settle, length [s]: whole revolutions are left out and then counted.
    """
    system = Coupled(
        description,
        folder,
        omega,
        stiffness,
        start.real.copy(),
        (1j * omega * start).real,
        unbalance_load(unbalance, 0.0, omega),
    )
    revolution, total = 2.0 * np.pi / omega, 0.0
    skip, steps = (round(np.ceil(time / revolution) * revolution / H) for time in (settle, settle + length))
    for n in range(steps):
        phi = omega * (n + 1) * H
        system.step(unbalance_load(unbalance, phi, omega))
        if n >= skip:
            total = total + system.q * np.exp(-1j * phi) * 2.0 / (steps - skip)
    system.free()
    return total


def coefficients():
    """Those of the bearing over speed, as arguments of ross.BearingElement."""
    element = rs.BearingElement.load(HERE / "bearing_ross.toml")
    return {
        name: getattr(element, name) for name in ("kxx", "kyy", "kxy", "kyx", "cxx", "cyy", "cxy", "cyx", "frequency")
    }


def run_up(omega, duration, unbalance, fmu=FMU):
    """Speeds [times] that rise evenly, and displacements in x, y of disk and first bearing [times, 4] by ROSS (Newmark)
    with the matrices and on the FMUs.

    omega: first and last speed [rad/s]; unbalance [kg.m] at rest in the rotor.  Both start straight; ROSS takes every
    fourth time (20 us).
    """
    table, rate = coefficients(), (omega[1] - omega[0]) / duration
    linear = rotor([rs.BearingElement(n=n, **table) for n in NODES])
    t = H * np.arange(round(duration / H) + 1)
    w, load = (
        omega[0] + rate * t,
        unbalance_load(unbalance, omega[0] * t + 0.5 * rate * t**2, omega[0] + rate * t, rate),
    )
    places = [6 * DISK, 6 * DISK + 1, 6 * NODES[0], 6 * NODES[0] + 1]
    F = np.zeros((len(t), linear.ndof))
    F[:, places[:2]] = load
    by_ross = linear.time_response(w[::4], F[::4], t[::4])[1][:, places]

    places_x = axial_place(w)
    stiffness, straight = np.interp(np.mean(omega), table["frequency"], table["kxx"]), np.zeros(linear.ndof)
    system = Coupled(
        read_model_description(str(fmu)), extract(str(fmu)), omega[0], stiffness, straight, straight, load[0]
    )
    on_fmus = [system.q[places]]
    for n in range(1, len(t)):
        if n % 100 == 0:
            system.turn_at(w[n])
            for bearing, side in zip(system.bearings, (1.0, -1.0), strict=True):
                bearing.fmu.setReal([bearing.vr["shaft.omega"], bearing.vr["shaft.x"]], [w[n], side * places_x[n]])
        system.step(load[n])
        on_fmus.append(system.q[places])
    system.free()
    return w[::4], by_ross, np.array(on_fmus)[::4]


def respond(speeds, unbalance, fmu=FMU):
    """Amplitudes [speeds, degrees of freedom] by ROSS with the matrices, and by the rotor on the FMUs.  speeds [rad/s],
    unbalance [kg.m].
    """
    description, folder = read_model_description(str(fmu)), extract(str(fmu))
    table = coefficients()
    linear = (
        rotor([rs.BearingElement(n=n, **table) for n in NODES])
        .run_unbalance_response(DISK, unbalance, 0.0, frequency=speeds)
        .forced_resp.T
    )
    stiffness = np.interp(speeds, table["frequency"], table["kxx"])
    return linear, np.array(
        [
            coupled(description, folder, w, unbalance, k, start)
            for w, k, start in zip(speeds, stiffness, linear, strict=True)
        ]
    )


def plot(speeds, responses, path):
    """Amplitude and phase of disk and bearing node over speed; lines ROSS, points FMUs."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(2, 2, figsize=(5.2, 4.8), sharex=True, layout="constrained")
    for column, (name, dof) in enumerate((("disk", 6 * DISK), ("bearing", 6 * NODES[0]))):
        for unbalance, (linear, fmus) in responses.items():
            for values, style in ((linear, "-"), (fmus, "o")):
                label = f"{1e6 * unbalance:g} g mm, {'ROSS' if style == '-' else 'FMUs'}"
                axes[0, column].semilogy(speeds * 30.0 / np.pi, np.abs(values[:, dof]) / unbalance, style, label=label)
                axes[1, column].plot(speeds * 30.0 / np.pi, np.degrees(np.angle(values[:, dof])), style)
        axes[0, column].set(title=name)
        axes[1, column].set(xlabel="speed [r/min]")
    axes[0, 0].set(ylabel="amplitude / unbalance [1/kg]")
    axes[1, 0].set(ylabel="phase [deg]")
    axes[0, 0].legend(fontsize=8)
    figure.savefig(path, dpi=150)


def plot_run_up(w, by_ross, on_fmus, path):
    """Distance of disk and bearing from the axis over the speed."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(2, 1, figsize=(9, 5), sharex=True, layout="constrained")
    for ax, i, name in ((axes[0], 0, "disk"), (axes[1], 2, "bearing")):
        for values, colour, label in ((by_ross, "#9aa2ad", "ROSS"), (on_fmus, "#c8442b", "FMUs")):
            ax.plot(w * 30.0 / np.pi, 1e6 * np.hypot(values[:, i], values[:, i + 1]), color=colour, lw=1.0, label=label)
        ax.set(ylabel=f"{name} [um]")
    axes[1].set(xlabel="speed [r/min]")
    axes[0].legend()
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--unbalance", type=float, nargs="+", default=[5e-5], help="of the disk [kg.m]")
    parser.add_argument(
        "--run-up",
        type=float,
        metavar="TIME",
        help="instead of steady speeds, from 3,000 to 12,000 r/min in this time [s]",
    )
    parser.add_argument("--picture", type=Path)
    options = parser.parse_args()
    if options.run_up:
        w, by_ross, on_fmus = run_up((100.0 * np.pi, 400.0 * np.pi), options.run_up, options.unbalance[0])
        for i, name in ((0, "disk"), (2, "bearing")):
            a, b = (np.hypot(values[:, i], values[:, i + 1]) for values in (by_ross, on_fmus))
            print(
                f"{name}: ROSS {1e6 * a.max():.2f} um at {w[a.argmax()] * 30 / np.pi:.0f} r/min, FMUs {1e6 * b.max():.2f} at {w[b.argmax()] * 30 / np.pi:.0f}"
            )
        if options.picture:
            plot_run_up(w, by_ross, on_fmus, options.picture)
        raise SystemExit
    speeds = np.linspace(3000.0, 12000.0, 10) * np.pi / 30.0
    responses = {unbalance: respond(speeds, unbalance) for unbalance in options.unbalance}
    for unbalance, (linear, fmus) in responses.items():
        for w, a, b in zip(speeds, linear, fmus, strict=True):
            values = []
            for d in (6 * DISK, 6 * NODES[0]):
                ratio = b[d] / a[d]
                values.append(
                    f"{1e6 * abs(a[d]):8.3f} {1e6 * abs(b[d]):8.3f} {100 * (abs(ratio) - 1):6.2f} % {np.degrees(np.angle(ratio)):6.2f} deg"
                )
            print(
                f"{unbalance:g} kg.m {w * 30.0 / np.pi:6.0f} r/min, disk, bearing: ROSS um, FMUs um, difference: {' | '.join(values)}"
            )
    if options.picture:
        plot(speeds, responses, options.picture)
