"""The paper's study (Cui et al., Machines 2023, 11, 700, section 4): its figures again.

Every figure is a sweep in studies/, over at least eight seeds, in each of two scenes: `paper`, the
paper's equations as they read, and `physical`, with the physics that they leave out.  Curves are means over the seeds
with the 95 % confidence interval of that mean (Student's t).  Stress is shown three ways, because the paper does not
say which stress it means: the mean over time of the worst rivet, its 99.9 % quantile over every internal step, and the
dynamic range of a single rivet (99.9 % quantile - 0.1 % quantile of the samples, of the rivet with the largest
difference), in which the preload has no share.
"""

from dataclasses import dataclass, replace
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from scipy.stats import norm
from scipy.stats import t as student

from bearing_model.cage.common import joint_law
from bearing_model.physics.derived import default_table
from bearing_model.rivet import rivet_rom
from riveted_bearing.base.errors import unknown
from riveted_bearing.base.files import write_atomically
from riveted_bearing.base.toml_files import leaves
from riveted_bearing.running.summary import DEG, RPM
from riveted_bearing.show.style import FORCE, HEAD, MIDDLE, MUTED, RING, STYLE
from riveted_bearing.studies.sweep import run_sweep
from riveted_bearing.studies.sweep_file import load_sweep, plan_sweep

SHIPPED = Path(__file__).parent / "studies"
SCENES = {"paper": "the paper's equations", "physical": "centrifugal load, elastic halves"}
BESIDE = ("tolerance", "fretting", "rings_speed", "rings_clearance")  # sweeps beside the figures: scene `paper` only
T_S = 1.25  # strength of 90 % of the rivets over that of 10 %: machined steel (Haibach, Betriebsfestigkeit)
SLOPE = 15.0  # of the S-N curve below its knee (fatigue.k_2)
SCATTER = SLOPE * np.log10(T_S) / (2.0 * norm.ppf(0.9))  # of a rivet's life, in decades
LOADS = {2994: ("2994 / 515 N", HEAD), 2246: ("2246 / 386 N", MIDDLE), 1994: ("1994 / 258 N", RING)}  # Fr / Fa


def shipped_studies():
    """Names of the sweeps that make up the study."""
    return sorted(path.name.removesuffix(".toml") for path in SHIPPED.iterdir() if path.name.endswith(".toml"))


def check_names(names):
    """UserError for a name that is no sweep of the study."""
    for name in names:
        if name not in shipped_studies():
            raise unknown("study", "study", name, shipped_studies())


def study_sweep(name, model, repeats=None, scene=None, changed=None):
    """The Sweep of a shipped study; repeats: number of seeds in the place of the study's own, if the study varies the
    seed; scene: in the place of its own; changed: document of parameters and inputs that the study does not set.
    """
    check_names([name])
    path = SHIPPED / f"{name}.toml"
    sweep = load_sweep(path, model)
    document = dict(sweep.document)
    if repeats is not None and "repeats" in document:
        document["repeats"] = repeats
    if scene is not None:
        document["scene"] = scene
    for section in ("parameters", "inputs"):
        known = [*model.parameters, *model.inputs]
        own = dict(leaves(document.get(section, {}), known))
        further = {key: value for key, value in (changed or {}).get(section, {}).items() if key not in sweep.factors}
        if further:
            document[section] = further | own
    return sweep if document == sweep.document else plan_sweep(name, document, model, path)


def run_study(model, folder, client, names=None, repeats=None, progress=None, scene=None, changed=None):
    """Do the runs that the study's folder lacks and return its Runs by name; progress: called with name and the numbers
    of runs done, failed, in all; scene, changed: see study_sweep.
    """
    sweeps = [study_sweep(name, model, repeats, scene, changed) for name in names or shipped_studies()]
    progress = progress or (lambda *_: None)
    return {
        sweep.name: runs_of(
            run_sweep(
                sweep, Path(folder) / sweep.name, client, lambda *counts, name=sweep.name: progress(name, *counts)
            )
        )
        for sweep in sweeps
    }


def run_columns(model, folder, client, names=None, repeats=None, progress=None, yours=None):
    """The Runs of each column of the report, {column: {sweep: Runs}}: `paper`, `physical`, and if there is a document of
    changed parameters and inputs `yours`, scene `paper` with them.
    """
    chosen = names or shipped_studies()
    figures = [name for name in chosen if name not in BESIDE]
    columns = {"paper": ("paper", chosen, None), "physical": ("physical", figures, None)}
    if yours:
        columns = {"paper": ("paper", figures, None), "yours": ("paper", figures, yours)}
    return {
        column: run_study(
            model,
            Path(folder) / column,
            client,
            sweeps,
            repeats,
            progress and (lambda name, *counts, column=column: progress(f"{column}: {name}", *counts)),
            scene,
            changed,
        )
        for column, (scene, sweeps, changed) in columns.items()
        if sweeps
    }


# Figures of the runs --------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Estimate:
    """A mean with its 95 % confidence interval."""

    mean: float
    low: float
    high: float

    def __str__(self):
        if not np.isfinite(self.mean):
            return "undefined"
        size = np.nanmax(np.abs([self.mean, self.low, self.high])) if np.isfinite(self.low) else abs(self.mean)
        digits = int(np.clip(2 - np.floor(np.log10(max(size, 1e-12))), 0, 3))
        mean, low, high = (
            f"{value if abs(value) >= 0.5 * 10.0**-digits else 0.0:,.{digits}f}"
            for value in (self.mean, self.low, self.high)
        )
        return mean if low == high else f"{mean} [{low}, {high}]"


def estimate(values):
    """Mean of independent values with its 95 % confidence interval by Student's t; infinitely wide for a single value."""
    values = np.asarray(values, dtype=float)
    half = (
        student.ppf(0.975, len(values) - 1) * values.std(ddof=1) / np.sqrt(len(values)) if len(values) > 1 else np.inf
    )
    return Estimate(float(values.mean()), float(values.mean() - half), float(values.mean() + half))


@dataclass(frozen=True)
class Runs:
    """Completed runs of a sweep: columns by name, in the units of the figures (N, MPa, um, deg, r/min)."""

    columns: dict

    def __getitem__(self, name):
        return self.columns[name]

    def __len__(self):
        return len(self.columns["seed"])

    def at(self, **conditions):
        """The runs whose columns have these values."""
        chosen = np.ones(len(self), dtype=bool)
        for name, value in conditions.items():
            chosen &= (
                self[name] == value if isinstance(value, str) else np.isclose(self[name], value, rtol=1e-6, atol=1e-9)
            )
        if not chosen.any():
            raise KeyError(f"no run at {conditions}")
        return replace(self, columns={name: values[chosen] for name, values in self.columns.items()})

    def values(self, name):
        """A column by rising seed, so that two sets of runs are paired by their seeds."""
        return self[name][np.argsort(self["seed"], kind="stable")]

    def estimate(self, name):
        """Mean over these runs."""
        return estimate(self[name])

    def curve(self, x, name):
        """Values of x and there the Estimates of a column."""
        xs = np.unique(self[x])
        return xs, [self.at(**{x: value}).estimate(name) for value in xs]


def ratio(above, below, name):
    """Mean over the seeds of the ratio between two sets of runs."""
    return estimate(above.values(name) / below.values(name))


def rise(after, before, name):
    """Mean over the seeds of the difference between two sets of runs."""
    return estimate(after.values(name) - before.values(name))


def runs_of(rows):
    """The Runs of a sweep's rows; failed runs are left out."""
    done = rows["status"] == "done"
    rows = {name: values[done] for name, values in rows.items()}
    rivets = sum(name.startswith("stat.rivet_head_mean[") for name in rows)

    def of_rivets(pattern):
        return np.array([rows[pattern.format(k)] for k in range(1, rivets + 1)]) * 1e-6

    columns = {
        "seed": rows["start.seed"],
        "scene": rows["scene"],
        "cpu_time": rows["cpu_time"],
        "whole_cpu_time": rows["whole_cpu_time"],
        "simulated": rows["simulated_time"],
        "tolerance": rows["solver.tolerance"],
        "speed": np.round(rows["shaft.omega"] * RPM, 3),
        "F_r": rows["shaft.F_y"],
        "F_a": rows["shaft.F_x"],
        "tilt": np.round(rows["shaft.tilt_z"] * DEG, 6),
        "preload": rows["joint.preload"],
        "fit": np.round(rows["joint.fit"] * 1e6, 6),
        "pocket": np.round(rows["cage.pocket_clearance"] * 1e6, 3),
        "guide": np.round(rows["cage.guide_clearance"] * 1e6, 3),
        "fretting": rows["fatigue.fretting"],
        "tilt_mode": rows["ring.tilt_mode"],
        "centrifugal": rows["cage.centrifugal"],
        "impact": rows["pulse.F_r"],
        "width": np.round(rows["pulse.duration"] * 1e3, 6),
        "force": rows["stat.Q_c_mean"],
        "force_rms": rows["stat.Q_c_rms"],
        "force_peak": rows["stat.Q_c_p999"],
        "dislocation": rows["mean(cage.dislocation)"] * 1e6,
        "dislocation_max": rows["stat.dislocation_max"] * 1e6,
        "slip": (rows["max(cage.dislocation)"] - rows["min(cage.dislocation)"]) * 1e6,
    }
    rest = stress_by(rows) * 1e-6
    for place, channel in (("head", 0), ("mid", 1)):
        columns[place] = rows[f"stat.sigma_{place}_mean"] * 1e-6
        columns[f"{place}_peak"] = rows[f"stat.sigma_{place}_p999"] * 1e-6
        columns[f"{place}_range"] = (
            of_rivets(f"stat.rivet_{place}_p999[{{}}]") - of_rivets(f"p001(rivet[{{}}].sigma_{place})")
        ).max(axis=0)
        columns[f"{place}_rest"] = rest[:, channel]
        columns[f"{place}_above"] = columns[place] - rest[:, channel]
        if set(rows["scene.stress"]) == {"fatigue"}:
            counted = rows["t_end"] - rows["start.settle"]
            for k in range(1, rivets + 1):
                columns[f"{place}_damage_{k}"] = np.log10(rows[f"rivet[{k}].damage_{place}"] / counted * 3600.0)
            columns[f"{place}_damage"] = np.max([columns[f"{place}_damage_{k}"] for k in range(1, rivets + 1)], axis=0)
    if "rms(cage.omega)" in rows:
        mean, rms = rows["mean(cage.omega)"], rows["rms(cage.omega)"]
        columns["unsteady"] = 100.0 * np.sqrt(np.maximum(rms**2 - mean**2, 0.0)) / mean
    columns["ratio"] = np.round(columns["pocket"] / columns["guide"], 2)
    if "p999(rivet[1].M)" in rows:  # stress of the worst rivet under its preload and only one of its loads
        # the moment's sign: as the centrifugal load has it
        for name, letter, sign in (("tension", "N", 1.0), ("moment", "M_t", -1.0)):
            load = np.max([rows[f"p999(rivet[{k}].{letter[0]})"] for k in range(1, rivets + 1)], axis=0)
            columns[f"head_by_{name}"] = 1e-6 * stress_by(rows, **{letter: sign * load})[:, 0]
    if "rms(ball[1].Q_cx)" in rows:
        axial, whole = (
            np.sqrt(sum(rows[f"rms(ball[{j}].{name})"] ** 2 for j in range(1, rivets + 1))) for name in ("Q_cx", "Q_c")
        )
        columns["axial_share"] = 100.0 * axial / whole
        for name, letter in (("tension", "N"), ("shear", "V")):
            columns[name] = np.sqrt(sum(rows[f"rms(rivet[{k}].{letter})"] ** 2 for k in range(1, rivets + 1)) / rivets)
    return Runs(columns)


def stress_by(rows, **loads):
    """Stress of head and middle by preload, fit and loads (N, M_r, M_t) of a single joint [Pa], one line a run."""
    table = default_table()
    fits = rows["joint.fit"] + rows["joint.swell"]
    effective = [
        rivet_rom.rivet_rom_fit_eff(table, fit, model == "j2")
        for fit, model in zip(fits, rows["rivet.fit_model"], strict=True)
    ]
    T, m_r, m_t = joint_law.single_joint(table.half.law, rows["joint.preload"], **loads)
    stress, _ = rivet_rom.rivet_rom_stress(table, rivet_rom.RivetLoad(T=T, m_y=m_r, m_z=m_t), np.array(effective))
    return stress[:, [rivet_rom.HEAD_P1, rivet_rom.MID_VM]]


# Pictures -------------------------------------------------------------------------------------------------------------


def band(ax, runs, x, name, colour, label=None, style="-"):
    """A curve of means with its confidence band."""
    xs, estimates = runs.curve(x, name)
    ax.plot(xs, [e.mean for e in estimates], style, color=colour, label=label, marker="o", ms=2.5, lw=1.3)
    ax.fill_between(xs, [e.low for e in estimates], [e.high for e in estimates], color=colour, alpha=0.2, lw=0)


def finish(axes, xlabel):
    """Titles, limits and legends of a row of panels."""
    for ax in axes:
        ax.set_xlabel(xlabel)
        ax.set_ylim(bottom=0.0)  # forces, stresses, displacements: none is negative
        if labels := ax.get_legend_handles_labels()[1]:  # in a strip of its own above the curves
            ax.set_ylim(top=ax.get_ylim()[1] * (1.0 + 0.14 * -(-len(labels) // 2)))
            ax.legend(loc="upper left", ncols=2)


def stress_panels(axes, runs, x):
    """Total stress and dynamic range of head and middle over x, and the pocket force."""
    for place, colour, label in (("head", HEAD, "head"), ("mid", MIDDLE, "middle")):
        band(axes[0], runs, x, f"{place}_peak", colour, f"{label}, 99.9 %")
        band(axes[0], runs, x, place, colour, f"{label}, mean", "--")
        band(axes[0], runs, x, f"{place}_rest", MUTED, "at rest" if place == "head" else None, ":")
        band(axes[1], runs, x, f"{place}_range", colour, label)
    axes[0].set(title="Total stress, worst rivet", ylabel="MPa")
    axes[1].set(title="Dynamic range of a rivet", ylabel="MPa")
    band(axes[2], runs, x, "force", FORCE, "mean")
    band(axes[2], runs, x, "force_rms", FORCE, "RMS", "--")
    axes[2].set(title="Ball–pocket force", ylabel="N")


def canvas(rows, columns):
    """An empty figure of panels."""
    return plt.subplots(rows, columns, figsize=(4.0 * columns, 0.4 + 2.9 * rows), layout="constrained", squeeze=False)


def rows_of(columns, width):
    """A figure with a row of panels for each column: (figure, [(title, Runs by sweep, axes)])."""
    figure, axes = canvas(len(columns), width)
    for row, column in zip(axes, columns, strict=True):
        row[0].annotate(
            column,
            (0.0, 1.13),
            xycoords="axes fraction",
            ha="left",
            va="bottom",
            fontweight="bold",
            annotation_clip=False,
        )
    return figure, list(zip(columns, columns.values(), axes, strict=True))


def preload_picture(columns):
    """Figs. 10 and 11."""
    figure, rows = rows_of(columns, 4)
    for _, data, axes in rows:
        runs = data["preload"]
        for name, label, style in (
            ("dislocation_max", "largest", "-"),
            ("dislocation", "mean", "--"),
            ("slip", "range", ":"),
        ):
            band(axes[0], runs, "preload", name, RING, label, style)
        axes[0].axhline(10.0, color=MUTED, lw=0.8)
        axes[0].set(title="Dislocation of the halves", ylabel="µm")
        stress_panels(axes[1:], runs, "preload")
        finish(axes, "preload [N]")
    return figure


def fit_picture(columns):
    """Fig. 12."""
    figure, rows = rows_of(columns, 4)
    for _, data, axes in rows:
        stress_panels(axes, data["fit"], "fit")
        band(axes[3], data["fit"], "fit", "dislocation_max", RING)
        axes[3].set(title="Largest dislocation", ylabel="µm")
        for ax in axes:
            ax.axvspan(-20.0, 0.0, color="#f3f4f6", zorder=0)
        finish(axes, "fit, negative is clearance [µm]")
    return figure


def speed_picture(columns):
    """Fig. 13."""
    names = {
        "force": ("Mean ball–pocket force", "N"),
        "head": ("Head stress, mean", "MPa"),
        "head_peak": ("Head stress, 99.9 %", "MPa"),
        "head_range": ("Head stress, dynamic range", "MPa"),
    }
    figure, rows = rows_of(columns, len(names))
    for _, data, axes in rows:
        for ax, (name, (what, unit)) in zip(axes, names.items(), strict=True):
            for F_r, (label, colour) in LOADS.items():
                band(ax, data["speed"].at(F_r=F_r), "speed", name, colour, label if name == "force" else None)
            ax.set(title=what, ylabel=unit, xticks=range(4000, 24001, 4000))
        finish(axes, "speed [r/min]")
    return figure


def impact_picture(columns):
    """Fig. 14."""
    names = {
        "head_peak": "Head stress, 99.9 %",
        "head": "Head stress, mean",
        "mid_peak": "Middle stress, 99.9 %",
        "force": "Mean ball–pocket force",
    }
    figure, rows = rows_of(columns, len(names))
    for _, data, axes in rows:
        for ax, (name, what) in zip(axes, names.items(), strict=True):
            for width, colour in ((1, MIDDLE), (3, HEAD)):
                runs = with_none(data["impact"], width)
                band(ax, runs, "impact", name, colour, f"{width} ms" if name == "head_peak" else None)
            ax.set(title=what, ylabel="N" if name == "force" else "MPa")
        finish(axes, "radial impact [N]")
    return figure


def with_none(runs, width):
    """Runs with impacts of a width, and those without any."""
    chosen = np.isclose(runs["width"], width) | (runs["impact"] == 0.0)
    return replace(runs, columns={name: values[chosen] for name, values in runs.columns.items()})


def tilt_picture(columns):
    """Fig. 15."""
    figure, rows = rows_of(columns, 4)
    for _, data, axes in rows:
        runs = data["tilt"]
        stress_panels(axes, runs, "tilt")
        band(axes[3], runs, "tilt", "head_above", HEAD, "head")
        band(axes[3], runs, "tilt", "mid_above", MIDDLE, "middle")
        axes[3].set(title="Mean stress without the preload's share", ylabel="MPa")
        for ax in axes:
            ax.axvspan(-0.2, 0.2, color="#f3f4f6", zorder=0)
        finish(axes, "tilt: − opposes, + aids the tilt by the loads [deg]")
    return figure


CLEARANCES = {"constant sum 0.3 mm": HEAD, "guide 0.2 mm": MIDDLE}


def clearance_series(runs, label):
    """Runs along one of the two ways to change the ratio; both share the scene's own clearances."""
    holds = {
        "constant sum 0.3 mm": np.isclose(runs["pocket"] + runs["guide"], 300.0, atol=0.01),
        "guide 0.2 mm": runs["guide"] == 200.0,
    }
    return replace(runs, columns={name: values[holds[label]] for name, values in runs.columns.items()})


def clearance_picture(columns):
    """Fig. 16."""
    names = {
        "force": ("Mean ball–pocket force", "N"),
        "head": ("Head stress, mean", "MPa"),
        "head_peak": ("Head stress, 99.9 %", "MPa"),
        "unsteady": ("Deviation of the cage's speed", "%"),
    }
    figure, rows = rows_of(columns, len(names))
    for _, data, axes in rows:
        for ax, (name, (title, unit)) in zip(axes, names.items(), strict=True):
            for label, colour in CLEARANCES.items():
                runs = clearance_series(data["clearance"], label)
                band(ax, runs, "ratio", name, colour, label if name == "force" else None)
            ticks = [0.3, 0.5, 1, 2, 3]
            ax.set(title=title, ylabel=unit, xscale="log", xticks=ticks, xticklabels=[f"{tick:g}" for tick in ticks])
            ax.minorticks_off()
        finish(axes, "clearance ratio pocket / guide")
    return figure


def damage(runs, place):
    """Estimates of log10 of the damage of each rivet per hour."""
    rivets = sum(name.startswith(f"{place}_damage_") for name in runs.columns)
    return [runs.estimate(f"{place}_damage_{k}") for k in range(1, rivets + 1)]


def failure_picture(columns):
    """Figs. 17 and 18."""
    figure, rows = rows_of(columns, 3)
    titles = {-90.0: "Clearance −0.09 mm", 40.0: "Interference +0.04 mm"}
    for _, data, axes in rows:
        for ax, (fit, title) in zip(axes[:2], titles.items(), strict=True):
            for place, colour, label, shift in (("head", HEAD, "head", -0.2), ("mid", MIDDLE, "middle", 0.2)):
                estimates = damage(data["fit"].at(fit=fit), place)
                x = np.arange(1, len(estimates) + 1) + shift
                mean, low, high = (
                    10.0 ** np.array([getattr(e, end) for e in estimates]) for end in ("mean", "low", "high")
                )
                ax.bar(x, mean, width=0.38, color=colour, label=label)
                ax.errorbar(x, mean, [mean - low, high - mean], fmt="none", color="black", lw=0.8)
            ax.set(title=title, ylabel="damage per hour", xlabel="rivet", yscale="log")
            ax.set(xticks=range(1, len(estimates) + 1), ylim=(None, ax.get_ylim()[1] * 1e4))
            ax.legend(ncols=2)
        band(axes[2], data["fit"], "fit", "axial_share", FORCE)
        axes[2].set(title="Axial share of the pocket force, RMS", ylabel="%", ylim=(0, None), xlabel="fit [µm]")
    return figure


PICTURES = {
    "preload": (("preload",), "Figs. 10 and 11: preload, largest clearance fit", preload_picture),
    "fit": (("fit",), "Fig. 12: fit of the rivet", fit_picture),
    "speed": (("speed",), "Fig. 13: speed and load", speed_picture),
    "impact": (
        ("impact",),
        "Fig. 14: three impacts in 0.01 s, ratio 5.8 of radial to axial impact, twelve phases",
        impact_picture,
    ),
    "tilt": (("tilt",), "Fig. 15: tilt of the inner ring", tilt_picture),
    "clearance": (("clearance",), "Fig. 16: clearance ratio", clearance_picture),
    "failure": (("fit",), "Figs. 17 and 18: damage rivet by rivet, axial pocket force", failure_picture),
}


def draw(columns, folder):
    """Write the pictures for which all columns {column: {sweep: Runs}} have runs; returns {name: path}."""
    paths = {}
    with plt.rc_context(STYLE | {"figure.dpi": 110}):
        for name, (needed, _, picture) in PICTURES.items():
            if all(set(needed) <= set(data) for data in columns.values()):
                figure = picture(columns)
                paths[name] = Path(folder) / f"{name}.png"
                write_atomically(paths[name], lambda temporary, figure=figure: figure.savefig(temporary))
                plt.close(figure)
    return paths
