"""The pictures of the pages, made anew from the built FMU: `make pictures`, or

    python docs/site/pictures.py sheet cages      # these alone

Drawings are matplotlib's, pages of the program photographed by a headless Chromium.  A picture is 780 pixels wide, so
that its letters can be read on a telephone at half the size, and has at most 150 kB.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from io import BytesIO
from pathlib import Path
from zipfile import ZipFile

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle, Rectangle
from PIL import Image
from scipy.stats import t as student

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / folder) for folder in ("fmus", "benchmarks", "examples/identify")]

import picture
from rules import LETTERS

import riveted_bearing as rb
from rivet_model.half_shape import pocket_radius
from rivet_model.ribbon_shape import fillet_circle, offset, seam, sphere_radius
from riveted_bearing.bearing.bearing_file import bearing_case
from riveted_bearing.building.rivet import geometry_of
from riveted_bearing.building.rivet_pictures import flange_outline, plot_geometry, rivet_outline
from riveted_bearing.show.plot import cage_orbit
from riveted_bearing.show.spectrum import draw, spectra
from riveted_bearing.show.style import FORCE, HEAD, MIDDLE, MUTED, STYLE
from riveted_bearing.studies.rows import columns_of

OUT = ROOT / "docs" / "pictures"
FMU = ROOT / "fmus" / "RivetedBearing.fmu"
BROWSER = ROOT / "build" / "browser" / "bearing.html"  # of `make browser`
WIDTH, MOST = 780, 150_000  # pixels; bytes
LETTER = {"boxstyle": "circle,pad=0.2", "facecolor": "white", "edgecolor": HEAD, "linewidth": 1.2}
STEEL, BRONZE = "#c9d3dd", "#e6c88f"
BEARING = "6309"  # of the drawings


# ------------------------------------------------------------------------------------------------------------ drawings


def figure(height, **options):
    """A figure of the width of all, with large letters."""
    return plt.subplots(figsize=(WIDTH / 120, height), layout="constrained", **options)


def letter(ax, name, place, start=None):
    """The letter of a dimension, with a line to the point that it is about."""
    line = {"arrowstyle": "-", "color": HEAD, "lw": 1.0}
    ax.annotate(LETTERS.get(name, name), start or place, place, ha="center", va="center", fontsize=13, color=HEAD, zorder=9,
                bbox=LETTER, arrowprops=line if start else None)  # fmt: skip


def dimension(ax, name, start, end):
    """A dimension between two points with its letter in the middle."""
    arrow = {"arrowstyle": "<|-|>", "color": HEAD, "lw": 1.1, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", start, end, arrowprops=arrow, zorder=8)
    letter(ax, name, (0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])))


def cage_section():
    """The machined cage in section through a ball, and its rivet, to scale but for the clearances."""
    case = bearing_case(BEARING)
    g = geometry_of(case)
    mm = {name: 1e3 * value for name, value in case.values.items() if isinstance(value, float)}
    fig, (ball, rivet) = figure(8.8, nrows=2, height_ratios=[1.0, 1.05])
    D, mid, half = mm["bearing.D"], 0.5 * mm["bearing.d_m"], 0.5 * mm["cage.width"]
    low, high, wide = 0.5 * mm["cage.D_i"], 0.5 * mm["cage.D_o"], 0.6  # clearances are drawn as 0.6 mm
    land = high + wide
    end = 1.25 * half
    ball.add_patch(Rectangle((-end, land), 2 * end, 0.25 * D, facecolor=STEEL, edgecolor=FORCE))
    ball.add_patch(Circle((0, mid), 0.5 * D + 0.9, facecolor="white", edgecolor="none"))
    ball.add_patch(Rectangle((-end, mid - 0.75 * D), 2 * end, 0.25 * D + 0.15 * D, facecolor=STEEL, edgecolor=FORCE))
    ball.add_patch(Circle((0, mid), 0.5 * D + 0.15, facecolor="white", edgecolor=FORCE, lw=0.8))
    for side in (-1, 1):
        inner, outer = sorted((side * (0.5 * D + wide), side * half))
        ball.add_patch(
            Rectangle((inner, low), outer - inner, high - low, facecolor=BRONZE, edgecolor=FORCE, hatch="//")
        )
    ball.add_patch(Circle((0, mid), 0.5 * D, facecolor="white", edgecolor=FORCE, zorder=4))
    ball.axhline(mid, color=MUTED, lw=0.8, ls="-.", zorder=5)
    ball.plot([0, 0], [mid - 0.85 * D, land + 0.55 * D], color=MUTED, lw=0.8, ls="-.", zorder=5)
    ball.text(0, mid + 0.12 * D, "ball D", ha="center", fontsize=13, zorder=6)
    ball.text(-1.02 * end, mid + 0.02 * D, "d_m", ha="right", va="center", fontsize=13)
    x, b = mm["cage.land_x"], 0.5 * mm["cage.land_width"]
    ball.plot([x - b, x + b], [high + 0.12, high + 0.12], color=HEAD, lw=4, zorder=6, solid_capstyle="butt")
    dimension(ball, "cage.land_width", (x - b, land + 0.33 * D), (x + b, land + 0.33 * D))
    dimension(ball, "cage.land_x", (0, land + 0.52 * D), (x, land + 0.52 * D))
    for at, foot in ((x - b, 0.33), (x + b, 0.33), (x, 0.52)):
        ball.plot([at, at], [high, land + foot * D], color=HEAD, lw=0.6)
    foot = mid - 0.9 * D
    dimension(ball, "cage.width", (-half, foot), (half, foot))
    for at in (-half, half):
        ball.plot([at, at], [foot, low], color=HEAD, lw=0.6)
    for name, radius in (("cage.D_o", high), ("cage.D_i", low)):
        ball.plot([half, 1.42 * end], [radius] * 2, color=HEAD, lw=0.8)
        letter(ball, name, (1.5 * end, radius))
        ball.text(1.6 * end, radius, "diameter", va="center", fontsize=13, color=HEAD)
    letter(ball, "cage.guide_clearance", (-1.5 * end, land + 0.12 * D), (-0.9 * half, 0.5 * (high + land)))
    ball.text(
        -1.5 * end, land + 0.22 * D, "guide clearance\n(diametral)", ha="center", va="bottom", fontsize=13, color=HEAD
    )
    letter(ball, "cage.pocket_clearance", (-1.5 * end, mid - 0.3 * D), (-0.5 * D - 0.5 * wide, mid - 0.05 * D))
    ball.text(
        -1.5 * end, mid - 0.42 * D, "pocket less ball\n(diametral)", ha="center", va="top", fontsize=13, color=HEAD
    )
    ball.set(xlim=(-2.0 * end, 2.2 * end), ylim=(foot - 0.1 * D, land + 0.62 * D), aspect="equal")

    r = {name: 1e3 * getattr(g, name) for name in ("shank_diameter", "head_diameter", "head_height", "fillet_radius",
         "relief_radius", "relief_depth", "edge_break", "flange_thickness", "patch_radius", "seat_diameter")}  # fmt: skip
    a, top, seat, out = (
        0.5 * r["shank_diameter"],
        r["flange_thickness"] + r["head_height"],
        0.5 * r["seat_diameter"],
        r["patch_radius"],
    )
    gap = 0.06
    for side in (-1, 1):
        for up in (-1, 1):
            s, x = np.array(flange_outline(r)).T
            rivet.fill(side * (s + gap), up * x, facecolor=BRONZE, edgecolor=FORCE, hatch="//", lw=0.8)
            rivet.add_patch(Rectangle((side * seat if side > 0 else -out - gap, r["flange_thickness"] if up > 0 else -1.15 * top), out + gap - seat,
                            1.15 * top - r["flange_thickness"], facecolor=BRONZE, edgecolor=FORCE, hatch="//", lw=0.8))  # fmt: skip
    rivet.fill(*np.array(rivet_outline(r)).T, facecolor=STEEL, edgecolor=FORCE, lw=1.0)
    rivet.axhline(0.0, color=MUTED, lw=0.8, ls="-.")
    rivet.text(0.0, 0.1, "split", ha="center", fontsize=13, color=FORCE)
    t, c = r["flange_thickness"], r["relief_radius"]
    dimension(rivet, "rivet.shank_diameter", (-a, -0.55 * t), (a, -0.55 * t))
    dimension(
        rivet, "rivet.head_diameter", (-0.5 * r["head_diameter"], 1.3 * top), (0.5 * r["head_diameter"], 1.3 * top)
    )
    dimension(rivet, "rivet.seat_diameter", (-seat, -1.3 * top), (seat, -1.3 * top))
    right, far = 1.35 * out, 1.9 * out
    dimension(rivet, "rivet.flange_thickness", (right, 0.0), (right, t))
    dimension(rivet, "rivet.head_height", (far, t), (far, top))
    for height, foot, reach in ((0.0, out, right), (t, out, far), (top, 0.5 * r["head_diameter"], far)):
        rivet.plot([foot, reach], [height] * 2, color=HEAD, lw=0.6)
    for sign in (-1, 1):
        rivet.plot([sign * 0.5 * r["head_diameter"]] * 2, [top, 1.3 * top], color=HEAD, lw=0.6)
        rivet.plot([sign * seat] * 2, [-1.3 * top, -1.15 * top], color=HEAD, lw=0.6)
    left, far = -1.35 * out, -1.9 * out
    dimension(rivet, "rivet.relief_depth", (left, t - r["relief_depth"]), (left, t))
    rivet.plot([left, -a - c], [t - r["relief_depth"]] * 2, color=HEAD, lw=0.6)
    rivet.plot([left, -out], [t] * 2, color=HEAD, lw=0.6)
    for name, place, start, text in (
        (
            "rivet.fillet_radius",
            (far, 1.15 * top),
            (-a - 0.3 * r["fillet_radius"], t - 0.3 * r["fillet_radius"]),
            "fillet radius",
        ),
        (
            "rivet.relief_radius",
            (far, -0.62 * t),
            (-a - 0.5 * c - gap, -t + 0.3 * r["relief_depth"]),
            "relief, radially",
        ),
        ("rivet.edge_break", (far, 0.62 * t), (-a - 0.6 * r["edge_break"] - gap, 0.4 * r["edge_break"]), "chamfer"),
        ("joint.fit", (far, -1.15 * top), (-a - 0.5 * gap, -0.3 * t), "rivet less hole"),
    ):
        letter(rivet, name, place, start)
        rivet.text(place[0], place[1] - 0.3 * a, text, ha="center", va="top", fontsize=13, color=HEAD)
    rivet.set(xlim=(-2.6 * out, 2.6 * out), ylim=(-1.42 * top, 1.42 * top), aspect="equal")
    for ax, title in ((ball, "through a ball"), (rivet, "through a rivet")):
        ax.axis("off")
        ax.set_title(title, fontsize=15)
    return fig


def unrolled(ax, g, ribbon):
    """Two pitches of a cage, unrolled at the pitch circle, to scale [mm]."""
    pitch = 1e3 * np.pi * g.d_m / g.Z
    along = np.linspace(-pitch, pitch, 801)
    local = np.abs((along + pitch / 2) % pitch - pitch / 2)  # from the next pocket's axis
    if ribbon:
        R, f, e, S = (1e3 * value for value in (sphere_radius(g), g.pocket_fillet, offset(g), g.flange_thickness))
        edge, foot = 1e3 * fillet_circle(g), 1e3 * sphere_radius(g) * np.cos(seam(g))
        sphere = np.sqrt(np.maximum(R**2 - local**2, 0.0)) - e
        fillet = f - np.sqrt(np.maximum(f**2 - np.maximum(edge - local, 0.0) ** 2, 0.0))
        inside = np.where(local < foot, sphere, np.where(local < edge, fillet, 0.0))
        slope = np.gradient(inside, along)
        outside = inside + S * np.sqrt(1.0 + slope**2).clip(max=2.5)
    else:
        R = 1e3 * pocket_radius(g)
        inside = np.sqrt(np.maximum(R**2 - local**2, 0.0))
        seat = np.abs(local - pitch / 2) < 500.0 * g.seat_diameter
        outside = np.where(seat, 1e3 * g.flange_thickness, 1e3 * g.cage_half_width)
    for side in (-1, 1):
        ax.fill_between(
            along, side * inside, side * outside, facecolor=STEEL if ribbon else BRONZE, edgecolor=FORCE, lw=0.8
        )
    for ball in (-pitch, 0.0, pitch):
        ax.add_patch(Circle((ball, 0.0), 500.0 * g.ball_diameter, facecolor="#f2f4f6", edgecolor=FORCE, lw=0.8))
    d, h, t = (1e3 * value for value in (g.shank_diameter, g.head_height, g.flange_thickness))
    for x in (-pitch / 2, pitch / 2):
        ax.add_patch(Rectangle((x - d / 2, -t), d, 2 * t, facecolor=HEAD, edgecolor=FORCE, lw=0.8))
        for low in (-t - h, t):
            ax.add_patch(
                Rectangle(
                    (x - 500.0 * g.head_diameter, low),
                    1e3 * g.head_diameter,
                    h,
                    facecolor=HEAD,
                    edgecolor=FORCE,
                    lw=0.8,
                )
            )
    ax.set(xlim=(-pitch, pitch), aspect="equal")
    ax.axis("off")


def cages():
    """Both cages of a bearing, and the stress of the table in the note on both in motion."""
    fig, axes = figure(7.4, nrows=3, height_ratios=[1.0, 0.85, 1.7])
    with tempfile.TemporaryDirectory() as name:
        for ax, shape, ribbon in ((axes[0], "machined", False), (axes[1], "ribbon", True)):
            path = Path(name) / f"{shape}.toml"
            path.write_text(f'designation = "{BEARING}"\n[parameters]\ncage.shape = "{shape}"\n')
            unrolled(ax, geometry_of(bearing_case(path)), ribbon)
            ax.set_title("ribbon, pressed from sheet" if ribbon else "machined, of bronze", fontsize=15, loc="left")
    text = (ROOT / "docs" / "notes" / "cages_in_motion.md").read_text(encoding="utf-8")
    rows = [line.strip("| ").split(" | ") for line in text.splitlines() if re.match(r"\| 0", line)]
    for tilt, line in (("0°", "-"), ("0.2°", "--")):
        own = [row for row in rows if row[0].startswith(tilt + ",")]
        speed = [float(row[0].split(", ")[1].replace(",", "")) for row in own]
        for column, shape, colour in ((3, "ribbon", MIDDLE), (4, "machined", "#b5812c")):
            axes[2].plot(
                speed,
                [float(row[column]) for row in own],
                "o" + line,
                color=colour,
                lw=2,
                label=f"{shape}, tilt {tilt}",
            )
    axes[2].set(yscale="log", xlabel="r/min", yticks=[100, 300, 1000], yticklabels=["100", "300", "1000"])
    axes[2].set_title("99.9 % stress under the rivets' heads, MPa", fontsize=15, loc="left")
    axes[2].legend(fontsize=12)
    axes[2].tick_params(labelsize=13)
    axes[2].xaxis.label.set_fontsize(13)
    return fig


def overview():
    """The bearing, and what comes out of a run: stress of all rivets, the cage's orbit, statistics rivet by rivet."""
    result = rb.run("demo", fmu=FMU, t_end=0.2, outputs=["cage.y", "cage.z", "rivet[*].sigma_head_peak"])
    fig, ((front, orbit), (stress, bars)) = figure(6.2, nrows=2, ncols=2, height_ratios=[1.15, 1.0])
    mm = picture.dimensions(ROOT / "fmus" / "modelDescription.xml")
    picture.bearing(front, mm)
    front.set(aspect="equal")
    front.autoscale_view()
    front.axis("off")
    front.set_title("bearing, nine rivets", fontsize=14, loc="left")
    cage_orbit(orbit, result)
    orbit.set_title("path of the cage, µm", fontsize=14, loc="left")
    orbit.set(xlabel="", ylabel="")
    time = result.data["time"]
    window = (time >= 0.1) & (time <= 0.11)
    rivets = range(1, mm["Z"] + 1)
    for k in rivets:
        stress.plot(1e3 * (time[window] - 0.1), result.data[f"rivet[{k}].sigma_head_peak"][window] / 1e6, lw=1.1)
    stress.set_title("stress of each rivet, MPa", fontsize=14, loc="left")
    stress.set_xlabel("ms", fontsize=13)
    worst = [result.summary[f"stat.rivet_head_p999[{k}]"] / 1e6 for k in rivets]
    bars.bar(list(rivets), worst, color=[HEAD if value == max(worst) else MUTED for value in worst])
    bars.set(xticks=list(rivets), ylim=(0.8 * min(worst), None))
    bars.set_title("99.9 % of each, MPa", fontsize=14, loc="left")
    for ax in (orbit, stress, bars):
        ax.tick_params(labelsize=13)
    for ax in orbit.child_axes:
        ax.tick_params(labelsize=10)
    return fig


def rivet():
    """The rivet of the 6207 with the names of its dimensions."""
    fig = plot_geometry(geometry_of(bearing_case("6207")), "Rivet of the 6207, to scale; mm")
    fig.set_size_inches(9.0, 6.6)
    for text in fig.axes[0].texts:
        text.set_fontsize(15)
    fig.axes[0].set_title(fig.axes[0].get_title(loc="left"), loc="left", fontsize=16)
    fig.axes[0].xaxis.label.set_visible(False)
    return fig


def real_time():
    """Times of communication steps by the host in C."""
    import fmpy

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with ZipFile(FMU) as archive:
            archive.extractall(folder / "unit")
        headers = Path(fmpy.__file__).parent / "c-code"
        source = ROOT / "examples" / "real_time" / "host.c"
        subprocess.run(["cc", "-O2", f"-I{headers}", source, "-ldl", "-lm", "-o", folder / "host"], check=True)
        command = [
            folder / "host",
            folder / "unit",
            "--step",
            "1e-4",
            "--seconds",
            "2",
            "--set",
            "solver.method=3",
            "--set",
            "solver.step=1e-5",
        ]
        said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    loop = said.rsplit("steps, mean", 1)[1]
    rows = np.array(re.findall(r"from +([\d.]+) of a step +(\d+)", loop), dtype=float)
    fig, ax = figure(3.6)
    ax.bar(
        100.0 * rows[:, 0],
        rows[:, 1],
        width=100.0 * rows[:, 0] * (np.sqrt(2.0) - 1.0),
        align="edge",
        color=MIDDLE,
        edgecolor="white",
    )
    ax.axvline(100.0, color=HEAD, lw=1.5, ls="--")
    ax.text(103.0, ax.get_ylim()[1], "late", color=HEAD, fontsize=14, va="top")
    ax.set(
        xscale="log",
        yscale="log",
        xticks=[10, 20, 50, 100, 200],
        xticklabels=["10", "20", "50", "100", "200"],
        xlim=(8, 400),
    )
    ax.minorticks_off()
    ax.set_xlabel("µs that a communication step of 100 µs takes", fontsize=14)
    ax.set_title("steps", fontsize=14, loc="left")
    ax.tick_params(labelsize=13)
    return fig


# --------------------------------------------------------------------------------------------------- pages of the program


def program(*words, folder, columns=100):
    """Call the program in a folder; what it prints, in colours."""
    environment = os.environ | {"COLUMNS": str(columns), "FORCE_COLOR": "1", "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "riveted_bearing", *words]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(words)}: {done.stderr}")
    return done.stdout


def workshop():
    """A new folder with the FMU in it, so that pages name no other folder."""
    folder = Path(tempfile.mkdtemp())
    (folder / FMU.name).symlink_to(FMU)
    return folder


def photograph(page, height, part="body", width=520):
    """A page from a part on, in a narrow window whose letters are large in the picture."""
    from playwright.sync_api import sync_playwright

    chromium = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))))
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        window = browser.new_page(viewport={"width": width, "height": height}, device_scale_factor=WIDTH / width)
        window.goto(page.as_uri())
        window.wait_for_timeout(1500)
        box = window.locator(part).first.bounding_box()
        image = window.screenshot(full_page=True, clip={"x": 0, "y": box["y"], "width": width, "height": height})
        browser.close()
    return Image.open(BytesIO(image))


def report():
    """The motion on the page of a run."""
    folder = workshop()
    program("run", "demo", "--fmu", FMU.name, "--t-end", "0.1 s", "--no-plot", folder=folder)
    program("report", "results/demo.parquet", folder=folder)
    return photograph(folder / "results" / "demo.html", 828, "#motion")


def sheet():
    """The sheet of the mission in docs/life.md."""
    folder = workshop()
    page = (ROOT / "docs" / "life.md").read_text(encoding="utf-8")
    mission = re.search(r"```toml\n(# spindle.toml\n.*?)```", page, re.S)[1]
    (folder / "spindle.toml").write_text(mission, encoding="utf-8")
    program("summary", "spindle.toml", "--fmu", FMU.name, "--target", "10000 h", "--out", "sheet.html", folder=folder)
    return photograph(folder / "sheet.html", 735)


def sweep():
    """A sweep over the preload."""
    folder = workshop()
    (folder / "preload.toml").write_text(
        'repeats = 8\nsimulation.t_end = 0.2\nparameters.scene.cage = "elastic"\n[[vary]]\njoint.preload = ["10 N", "20 N", "40 N", "80 N"]\n'
    )
    program("sweep", "preload.toml", "--fmu", FMU.name, "--workers", "1", folder=folder)
    rows = columns_of(folder / "results" / "preload")
    fig, axes = figure(3.4, ncols=2)
    shown = (
        ("stat.sigma_head_p999", 1e6, "99.9 % head stress, MPa"),
        ("max(cage.dislocation)", 1e-6, "largest dislocation, µm"),
    )
    for ax, (name, unit, title) in zip(axes, shown, strict=True):
        for preload in sorted(set(rows["joint.preload"])):
            values = rows[name][rows["joint.preload"] == preload] / unit
            half = student.ppf(0.975, len(values) - 1) * values.std(ddof=1) / np.sqrt(len(values))
            ax.errorbar(preload, values.mean(), half, fmt="o", color=MIDDLE, ms=7, lw=2, capsize=5)
        ax.set_title(title, fontsize=14, loc="left")
        ax.set_xlabel("preload, N", fontsize=14)
        ax.tick_params(labelsize=13)
    return fig


def spectrum():
    """Both spectra of the scene `spall`."""
    with plt.rc_context({"font.size": 14, "axes.labelsize": 14, "legend.fontsize": 13}):
        fig = plt.figure(figsize=(WIDTH / 120, 6.4), layout="constrained")
        draw(fig, spectra(rb.run("spall", fmu=FMU)))
    fig.axes[0].locator_params(axis="x", nbins=5)
    return fig


def identify():
    """The page of a study whose truth is known."""
    from synthetic import lines, study

    folder = workshop()
    (folder / "rig.toml").write_text("\n".join(lines(study(1))) + "\n", encoding="utf-8")
    program("identify", "rig.toml", "--fmu", FMU.name, "--workers", "1", folder=folder)
    return photograph(folder / "results" / "rig" / "identify.html", 370, "text=Answer", 660)


def browser():
    """The bearing in the browser after a second."""
    if not BROWSER.is_file():
        raise SystemExit(f"{BROWSER.relative_to(ROOT)} is missing: make browser")
    return photograph(BROWSER, 780, "#settings")


def info():
    """The first tables that `info` prints."""
    from rich.console import Console
    from rich.text import Text

    folder = workshop()
    said = program("info", "6308", folder=folder, columns=62)
    console = Console(record=True, width=62, file=open(os.devnull, "w", encoding="utf-8"))
    console.print(Text.from_ansi(said[said.index("Geometry") :]))
    page = folder / "info.html"
    page.write_text(console.export_html(inline_styles=True), encoding="utf-8")
    return photograph(page, 760, width=600)


# --------------------------------------------------------------------------------------------------------------- files

PICTURES = {
    made.__name__: made
    for made in (
        overview,
        report,
        cage_section,
        sheet,
        sweep,
        cages,
        rivet,
        real_time,
        spectrum,
        identify,
        browser,
        info,
    )
}


def write(name):
    """Make one picture, as few colours as it needs."""
    with plt.rc_context(STYLE | {"font.size": 11}):
        made = PICTURES[name]()
        if not isinstance(made, Image.Image):
            file = BytesIO()
            made.savefig(file, dpi=WIDTH / made.get_size_inches()[0])
            plt.close(made)
            made = Image.open(file)
    made = made.convert("RGB")
    if made.width > WIDTH:
        made = made.resize((WIDTH, round(made.height * WIDTH / made.width)), Image.Resampling.LANCZOS)
    path = OUT / f"{name}.png"
    for colours in (256, 128, 64, 32):
        made.quantize(colours, dither=Image.Dither.NONE).save(path, optimize=True)
        if path.stat().st_size <= MOST:
            break
    print(f"{path.relative_to(ROOT)}  {made.width} x {made.height}  {path.stat().st_size / 1000:.0f} kB")


def main(names):
    OUT.mkdir(exist_ok=True)
    for name in names or PICTURES:
        write(name)


if __name__ == "__main__":
    main(sys.argv[1:])
