"""The paper's claims (its section 4 and its conclusions, paraphrased) against the runs of the study: figures, verdicts
and the physics behind them.

A claim holds as far as its conditions hold, and conditions depend on the runs only.  Where the paper says "stress",
conditions are checked for the mean and for the 99.9 % quantile of the worst rivet, because the paper does not say which
stress it means.
"""

from dataclasses import dataclass

import numpy as np

from .study import GRIPS, clearance_series, estimate, grip, ratio, rise

PAPER_SECONDS = 1800.0  # for one run of 0.4 s on 40 cores
SPEEDS = (4000.0, 8000.0, 12000.0, 16000.0, 20000.0, 24000.0)


@dataclass(frozen=True)
class Claim:
    """A sentence of the paper: its place, the sentence, the figures of the runs, the conditions that the runs meet, and
    the reason.
    """

    where: str
    said: str
    found: str
    holds: tuple
    why: str

    @property
    def verdict(self):
        """reproduced, partly or not: all, some or none of the conditions are met."""
        return "reproduced" if all(self.holds) else "partly" if any(self.holds) else "**not**"


def all_claims(data):
    """Claims for which there are runs, in the order of the paper, by the picture (of study.PICTURES, or "cost") that
    shows them.
    """
    return {picture: claims(data) for picture, (needed, claims) in CLAIMS.items() if needed in data}


def items(texts):
    """A list below a claim's figures."""
    return "".join(f"\n    - {text}" for text in texts)


def effort_claims(data):
    runs = data["preload"]
    cost = estimate(runs["cpu_time"] / runs["simulated"])
    return [
        Claim(
            "4",
            "0.4 s (120 revolutions) of the bearing take half an hour on forty processors",
            f"{cost} s of one core per simulated second: 0.4 s in {0.4 * cost.mean:.2f} s",
            (0.4 * cost.high < PAPER_SECONDS,),
            f"{PAPER_SECONDS / (0.4 * cost.mean):,.0f} times less time on a fortieth of the cores.",
        )
    ]


def preload_claims(data):
    runs = data["preload"]
    at = {P: runs.at(preload=P) for P in (0, 2, 5, 10, 15, 20, 30, 40, 50, 60)}
    largest = {P: at[P].estimate("dislocation_max") for P in at}
    first, last = rise(at[20], at[0], "dislocation_max"), rise(at[60], at[40], "dislocation_max")
    median = float(np.median(at[40]["dislocation_max"]))
    above = max(at[P]["dislocation_max"].max() for P in at if P > 20)
    # N, from which on the mean stays below 0.01 mm
    held = min((P for P in at if all(largest[more].mean < 10.0 for more in at if more >= P)), default=60)
    rest = {P: at[P]["head_rest"][0] for P in at}
    return [
        Claim(
            "4.1",
            "Stress is directly proportional to preload and fit",
            f"without load: head {rest[20]:.1f} MPa at 20 N, {rest[60]:.1f} at 60 N; "
            f"running, p99.9: {at[20].estimate('head_peak')} and {at[60].estimate('head_peak')} MPa",
            (np.isclose(rest[60], 3.0 * rest[20], rtol=1e-3), ratio(at[60], at[20], "head_peak").low > 2.7),
            "Only the preload's own share is proportional to preload. At speed the cage's centrifugal load pries the joints open and decides the "
            "rivets' tension, "
            "whatever the preload; the loads by the balls come on top. The fit has no effect while there is play, see Fig. 12.",
        ),
        Claim(
            "4.1 (1), Fig. 10",
            "The halves' dislocation falls with preload like a decaying exponential",
            f"largest: {largest[0]} µm at 0 N, {largest[20]} at 20 N, {largest[40]} at 40 N, {largest[60]} at 60 N",
            (rise(at[60], at[0], "dislocation_max").high < 0.0, first.high < last.low),
            "The cage's centrifugal load presses the edges of the pads together with as much as it adds to the rivets' tension, so that joints "
            "without preload "
            "have friction too, and the dislocation hardly depends on preload. Without that load (table below) it falls as the paper says.",
        ),
        Claim(
            "4.1 (1), Fig. 10",
            "When the preload exceeds 20 N, the dislocation is below 0.01 mm",
            f"largest of all seeds and preloads past 20 N: {above:.1f} µm; at 20 N {largest[20]} µm, in one seed {at[20]['dislocation_max'].max():.1f}; "
            "mean of the largest at 0 / 2 / 5 / 10 / 15 N: "
            + " / ".join(f"{largest[P].mean:.1f}" for P in (0, 2, 5, 10, 15))
            + " µm",
            (above < 10.0, largest[20].high < 10.0),
            f"Impacts last 0.1 ms and move the halves by micrometres each. No threshold at 20 N: the mean is below 0.01 mm from {held} N on.",
        ),
        Claim(
            "4.1 (1), Fig. 10",
            "At 40 N the dislocation is 0: the halves do not move against each other",
            f"largest {largest[40]} µm (median {median:.1f}), its range while running {at[40].estimate('slip')} µm",
            (median <= 1.0,),
            "The dislocation is zero to the one decimal of a millimetre that the paper prints, but the halves do not come back: "
            "friction holds them where single impacts have moved them. " + grip_text(data),
        ),
        Claim(
            "4.1 (1), Fig. 11",
            "Stress of head and rod rise with preload",
            f"0 to 60 N, p99.9: head by {rise(at[60], at[0], 'head_peak')}, middle by {rise(at[60], at[0], 'mid_peak')} MPa; "
            f"mean: {rise(at[60], at[0], 'head')}, {rise(at[60], at[0], 'mid')} MPa",
            tuple(rise(at[60], at[0], name).low > 0.0 for name in ("head_peak", "mid_peak", "head", "mid")),
            "At speed equilibrium asks the rivets for more tension than the preload, which then only takes the place of a part of it. A higher "
            "preload keeps the "
            "joints closed for longer, which relieves the shank's bending (middle) and the dynamic range. Without the centrifugal load (table below) "
            "stress rises.",
        ),
        Claim(
            "4.1 (1), Fig. 11",
            "At 60 N the head stress is above 140 MPa",
            f"mean {at[60].estimate('head')}, p99.9 {at[60].estimate('head_peak')} MPa",
            (at[60].estimate("head").low > 140.0,),
            f"The share at rest, {rest[60]:.0f} MPa, is calibrated to this sentence by the fillet's radius; what centrifugal load and balls make of "
            f"it is a result.",
        ),
        Claim(
            "4.1 (1); 5 (1)",
            "A preload of 20 to 40 N is best: no dislocation, and little stress",
            f"dislocation {largest[20]} µm at 20 N; head p99.9 {at[20].estimate('head_peak')} MPa at 20 N, {at[40].estimate('head_peak')} at 40 N, "
            f"{at[60].estimate('head_peak')} at 60 N; "
            f"dynamic range {at[0].estimate('head_range')}, {at[20].estimate('head_range')}, {at[40].estimate('head_range')}, "
            f"{at[60].estimate('head_range')} MPa at 0, 20, 40, 60 N",
            (median <= 1.0, above < 10.0, rise(at[60], at[40], "head_peak").low > 0.0, largest[0].low > 10.0),
            "The centrifugal load decides the total stress at any of these preloads; more preload lowers the dynamic range all the way. "
            "Neither 20 nor 40 N is a threshold here.",
        ),
        Claim(
            "5 (1)",
            "The right preload brings less dislocation and less stress; more preload, more stress, concentrated at the head",
            f"0 to 40 N: dislocation {rise(at[40], at[0], 'dislocation_max')} µm, head p99.9 {rise(at[40], at[0], 'head_peak')} MPa, "
            f"dynamic range {rise(at[40], at[0], 'head_range')} MPa; at 60 N head / middle {ratio_within(at[60], 'head_peak', 'mid_peak')}",
            (
                rise(at[40], at[0], "dislocation_max").high < 0.0,
                rise(at[40], at[0], "head_peak").high < 0.0,
                rise(at[40], at[0], "head_range").high < 0.0,
                ratio_within(at[60], "head_peak", "mid_peak").low > 2.0,
            ),
            "Less dynamic range; dislocation and total stress hardly change, because the centrifugal load decides both.",
        ),
    ]


def ratio_within(runs, above, below):
    """Mean over the seeds of the ratio between two columns of the same runs."""
    return estimate(runs[above] / runs[below])


def grip_text(data):
    """The forces that move the halves and those that hold them, from the sweep beside Fig. 10."""
    if "grip" not in data:
        return ""
    at_40 = "; ".join(
        f"{name}: {np.median(grip(data['grip'], name).at(preload=40)['dislocation_max']):.1f}" for name in GRIPS
    )
    return (
        f"What decides (picture below, medians at 40 N in µm): {at_40}. "
        "The axial load moves the balls some ten micrometres off the middle of their pockets, and the contact patch spans "
        "the split plane only within 5 to 13 degrees (its half length at 10 to 200 N over the pocket's radius): beyond, one half takes an impact alone. "
        "The 99.9 % pocket force then asks of the nearest joint about as much as its friction holds."
    )


def fit_claims(data):
    runs = data["fit"]
    at = {fit: runs.at(fit=fit) for fit in np.unique(runs["fit"])}
    peak, mean = crossing(runs, "head_peak", "mid_peak"), crossing(runs, "head", "mid")
    worst = {fit: max(at[fit].estimate("head_peak").mean, at[fit].estimate("mid_peak").mean) for fit in at}
    inside = [worst[fit] for fit in at if -20.0 <= fit <= 0.0]
    left = rise(at[-90.0], at[-15.0], "head_peak")
    ends = {
        fit: {what: ratio_within(at[fit], f"head{what}", f"mid{what}") for what in ("", "_peak")}
        for fit in (-90.0, 40.0)
    }
    ratios = {fit: f"mean {e['']}, p99.9 {e['_peak']}" for fit, e in ends.items()}
    no_slip = (
        "No joint slips as far as the play where the head stress is flat: the hole is never touched, so its size cannot matter; "
        "and a hole wider by 0.09 mm under the head raises the fillet's stress by 1 % only (`riveted-bearing rivet`, relief_radius 0.295 mm)."
    )
    return [
        Claim(
            "4.1 (2), Fig. 12; 4.2; 5 (2)",
            "From clearance to interference the place of the largest stress moves from the head to the middle",
            f"head / middle at −0.09 mm: {ratios[-90.0]}; at +0.04 mm: {ratios[40.0]}",
            (
                ends[-90.0][""].low > 1.0,
                ends[-90.0]["_peak"].low > 1.0,
                ends[40.0][""].high < 1.0,
                ends[40.0]["_peak"].high < 1.0,
            ),
            "Interference stresses the shank all the time, the balls stress the head.",
        ),
        Claim(
            "4.1 (2); 5 (2)",
            "With large clearance the head's stress is much larger than the middle's",
            f"head / middle at −0.09 mm: {ratios[-90.0]}; head larger by {rise(at[-90.0], at[-15.0], 'head_peak')} MPa (p99.9) than at −0.015 mm",
            (ends[-90.0]["_peak"].low > 2.0, left.low > 0.0),
            f"Head over middle as claimed; too much clearance does not make it worse here. {no_slip}",
        ),
        Claim(
            "4.1 (2); 5 (2)",
            "With large interference the middle's stress is clearly larger than the head's",
            f"head / middle at +0.04 mm: {ratios[40.0]}",
            (ends[40.0][""].high < 0.8, ends[40.0]["_peak"].high < 0.9),
            "The flange's yield limits the interference (j2). The head has a smaller share at rest, but the cage's centrifugal load and the balls pry at it.",
        ),
        Claim(
            "4.1 (2); 5 (2)",
            "Between −0.02 and 0 mm head and middle are almost equal and stress is low",
            f"equal at {mean:+.1f} µm (mean), {peak:+.1f} µm (p99.9); larger of the two, p99.9, {min(inside):.0f} to {max(inside):.0f} MPa inside, "
            f"{worst[-90.0]:.0f} at −0.09 mm, {worst[40.0]:.0f} at +0.04 mm",
            (-20.0 <= mean <= 0.0, -20.0 <= peak <= 0.0, min(inside) < 0.9 * min(worst[-90.0], worst[40.0])),
            "The crossing of the means follows the swell of the rivet (4 µm), which was calibrated to this sentence without the cage's centrifugal "
            "load (then at "
            "−3.1 µm). The load raises the head's stress and so moves the crossing toward interference; the swell is not fitted again. Stress is "
            "about as low at any "
            "larger clearance.",
        ),
        Claim(
            "4.1 (2)",
            "The fit should be kept between −0.02 and 0 mm",
            f"lowest p99.9 at {min(worst, key=worst.get):+.0f} µm: {min(worst.values()):.0f} MPa; "
            f"at 0 {worst[0.0]:.0f} MPa, at −0.09 mm {worst[-90.0]:.0f} MPa",
            (worst[0.0] < 0.9 * worst[40.0], -20.0 <= min(worst, key=worst.get) <= 0.0 and left.low > 0.0),
            f"These runs give a reason to avoid interference; the largest clearance costs {100 * (worst[-90.0] / min(worst.values()) - 1):.0f} %.",
        ),
        Claim(
            "4.1 (2), in brackets",
            "Negative values are interference, positive ones clearance",
            f"p99.9 of head at −0.01 mm {at[-10.0].estimate('head_peak')} MPa, at +0.01 mm {at[10.0].estimate('head_peak')} MPa; "
            f"middle at rest {at[-10.0]['mid_rest'][0]:.0f} and {at[10.0]['mid_rest'][0]:.0f} MPa",
            (at[10.0]["mid_rest"][0] < at[-10.0]["mid_rest"][0],),
            "The sentence contradicts the paper's own definition (rivet minus hole) and its Fig. 12; both make negative the clearance, as here.",
        ),
    ]


def crossing(runs, first, second):
    """Where the mean of a column falls below another's along the fit [um]; nan if it does not."""
    fits, a = runs.curve("fit", first)
    gap = np.array([e.mean for e in a]) - np.array([e.mean for e in runs.curve("fit", second)[1]])
    places = np.flatnonzero((gap[:-1] > 0.0) & (gap[1:] <= 0.0))
    return (
        float(
            fits[places[0]]
            + (fits[places[0] + 1] - fits[places[0]]) * gap[places[0]] / (gap[places[0]] - gap[places[0] + 1])
        )
        if len(places)
        else np.nan
    )


def spread(runs, speed, name):
    """Largest minus smallest mean of the three loads at a speed."""
    at = runs.at(speed=speed)
    means = [at.at(F_r=F_r).estimate(name).mean for F_r in np.unique(at["F_r"])]
    return max(means) - min(means)


def lowest(runs, name):
    """Speed of the smallest mean, and the ratio of the mean at 4,000 r/min to it."""
    speeds, curve = runs.curve("speed", name)
    means = np.array([e.mean for e in curve])
    return speeds[means.argmin()], means[0] / means.min()


def speed_claims(data):
    scenes = {scene: data["speed"].at(scene=scene) for scene in ("R", "F", "demo")}
    loads = (2994, 2246, 1994)
    more = {
        (scene, name): sum(rise(runs.at(speed=n, F_r=2994), runs.at(speed=n, F_r=1994), name).low > 0.0 for n in SPEEDS)
        for scene, runs in scenes.items()
        for name in ("force", "head", "head_peak")
    }
    spreads = {
        (scene, name, n): spread(runs, n, name)
        for scene, runs in scenes.items()
        for name in ("force", "head", "head_peak")
        for n in SPEEDS
    }
    minima = {
        (scene, name, F): lowest(runs.at(F_r=F), name)
        for scene, runs in scenes.items()
        for name in ("force", "head", "head_peak")
        for F in loads
    }
    labels = {"force": "mean force", "head": "mean head stress", "head_peak": "p99.9 head stress"}

    demo_rises = all(minima["demo", name, F][0] == SPEEDS[0] for name in labels for F in loads)

    def turns(scene, name):
        return all(8000.0 <= minima[scene, name, F][0] <= 16000.0 for F in loads)

    def minima_text(scene):
        return items(
            f"{scene}, {label}: lowest at "
            + " / ".join(f"{minima[scene, name, F][0]:,.0f}" for F in loads)
            + " r/min, at 4,000 "
            + " / ".join(f"{minima[scene, name, F][1]:.2f}" for F in loads)
            + " times that"
            for name, label in labels.items()
        )

    def spread_text(scene):
        return items(
            f"{scene}, {label}: "
            + ", ".join(f"{spreads[scene, name, speed]:.1f} at {speed:,.0f}" for speed in (4000.0, 16000.0, 24000.0))
            for name, label in labels.items()
        )

    narrower = {
        key: spreads[*key, 16000.0] <= 0.6 * spreads[*key, 4000.0]
        for key in [(scene, name) for scene in ("R", "F") for name in ("head", "head_peak")]
    }
    jam = (
        "Contact-angle variation round the orbit presses balls to their pockets at low speed (R, F: tilted ring, mixed lubrication), so that the mean "
        "force falls "
        "first; with a straight ring nothing falls. The stress does not follow it down: the cage's centrifugal load, in proportion to the speed "
        "squared, pries at "
        "every rivet, and at 4,000 r/min hardly any of it is left."
    )
    shares = {
        n: [
            scenes["F"].at(speed=n, F_r=2994).estimate(name).mean
            for name in ("head_rest", "head_by_tension", "head_by_moment", "head_peak")
        ]
        for n in (4000.0, 16000.0)
    }
    impacts = (
        "The 99.9 % quantile is made by impacts of 0.1 ms whose force rises with speed, most for the heavy load, and which bend the cage half locally: the "
        "prying moment on the rivet beside the pocket decides. F, heavy load, head: "
        + "; ".join(
            "at {:,.0f} r/min at rest {:.0f}, with the 99.9 % tension {:.0f}, with the 99.9 % moment {:.0f} of {:.0f} MPa".format(
                n, *s
            )
            for n, s in shares.items()
        )
        + "."
    )
    return [
        Claim(
            "4.1 (3), Fig. 13; 5 (3)",
            "Stress rises with load",
            "speeds of six with more under 2994 than under 1994 N, clear of zero"
            + items(
                f"{scene}: " + ", ".join(f"{label} {more[scene, name]}" for name, label in labels.items())
                for scene in scenes
            ),
            tuple(more[scene, name] >= 5 for scene in ("R", "F") for name in ("head", "head_peak")),
            "With the ring held straight (demo) the load matters little below 20,000 r/min: balls outside the load zone make the impacts.",
        ),
        Claim(
            "4.1 (3), Fig. 13",
            "The load matters more at low speed than at high speed",
            "largest difference between the loads [N, MPa]" + "".join(spread_text(scene) for scene in ("R", "F")),
            tuple(
                spreads[scene, name, 24000.0] < spreads[scene, name, 4000.0]
                for scene in ("R", "F")
                for name in ("force", "head", "head_peak")
            ),
            f"In the mean force only, where the press of the balls on the pockets decides. {impacts}",
        ),
        Claim(
            "4.1 (3), Fig. 13",
            "Stress first falls, then rises with speed",
            "for 2994 / 2246 / 1994 N"
            + "".join(minima_text(scene) for scene in ("R", "F"))
            + items(["demo: all lowest at 4,000 r/min"] * demo_rises),
            tuple(turns(scene, name) for scene in ("R", "F") for name in ("force", "head", "head_peak"))
            + tuple(minima[scene, "force", 2994][1] >= 1.5 for scene in ("R", "F")),
            f"{jam} The 99.9 % quantile is made by impacts, as above.",
        ),
        Claim(
            "4.1 (3), Fig. 13",
            "The loads differ only below 16,000 r/min; above, there is practically no difference",
            "difference at 16,000 in parts of that at 4,000 r/min: "
            + ", ".join(
                f"{scene} {labels[name]} {spreads[scene, name, 16000.0] / spreads[scene, name, 4000.0]:.2f}"
                for scene, name in narrower
            ),
            tuple(narrower.values()),
            "The mean forces close up; in the stress joints that the centrifugal load has pried open pass on more of each impact, and the loads move apart.",
        ),
        Claim(
            "4.1 (3); 5 (3)",
            "A good match of load and speed lowers the stress",
            "heavy load, 4,000 r/min against the best speed: "
            + ", ".join(
                f"{scene} mean head stress {minima[scene, 'head', 2994][1]:.2f} times, p99.9 {minima[scene, 'head_peak', 2994][1]:.2f} times"
                for scene in ("R", "F")
            ),
            tuple(minima[scene, name, 2994][1] > 1.05 for scene in ("R", "F") for name in ("head", "head_peak")),
            jam,
        ),
    ]


def impact_claims(data):
    soft, stiff = (data["impact"].at(scene=scene) for scene in ("F", "demo"))
    before = {"F": soft.at(impact=0.0), "demo": stiff.at(impact=0.0)}
    after = {(width, F): soft.at(width=width, impact=F) for width in (1, 3) for F in (700.5, 1401.0, 2802.0)}
    held = {width: stiff.at(width=width, impact=1401.0) for width in (1, 3)}

    def rises(name, F=1401.0):
        return {width: rise(after[width, F], before["F"], name) for width in (1, 3)}

    def text(name, unit, F=1401.0):
        return " and ".join(f"{e} {unit} ({width} ms)" for width, e in rises(name, F).items())

    more = {
        width: estimate(
            (after[width, 1401.0].values("head_peak") - after[width, 1401.0].values("mid_peak"))
            - (before["F"].values("head_peak") - before["F"].values("mid_peak"))
        )
        for width in (1, 3)
    }
    stiff_rise = {width: rise(held[width], before["demo"], "head_peak") for width in held}
    life = {width: rise(after[width, 1401.0], before["F"], "head_damage") for width in (1, 3)}
    return [
        Claim(
            "4.1 (3), Fig. 14; 5 (3)",
            "Impacts raise the stress, the more the stronger they are",
            "head p99.9 rises"
            + items(
                (
                    f"F, half the paper's impacts: by {text('head_peak', 'MPa', 700.5)}",
                    f"F, the paper's: by {text('head_peak', 'MPa')}",
                    f"F, double ones: by {text('head_peak', 'MPa', 2802.0)}",
                    f"demo, the paper's: by {' and '.join(f'{e} MPa ({width} ms)' for width, e in stiff_rise.items())}",
                )
            ),
            tuple(e.low > 0.0 for e in rises("head_peak").values())
            + tuple(rises("head_peak", 2802.0)[w].mean > rises("head_peak", 700.5)[w].mean for w in (1, 3)),
            "The ring must be able to tilt: held straight (demo), impacts change ball loads but hardly the forces on the cage.",
        ),
        Claim(
            "4.1 (3), Fig. 14",
            "Impacts raise above all the stress of the head",
            f"middle p99.9 rises by {text('mid_peak', 'MPa')}; "
            f"the head's rise is larger by {' and '.join(f'{e} MPa ({width} ms)' for width, e in more.items())}",
            tuple(e.low > 0.0 for e in more.values()),
            "Local bending of the cage half pries at the head.",
        ),
        Claim(
            "4.1 (3)",
            "The reason is that impacts raise the total contact force of balls and cage",
            f"F: mean force rises by {text('force', 'N')}, RMS by {text('force_rms', 'N')}, p99.9 by {text('force_peak', 'N')}",
            tuple(e.low > 0.0 for name in ("force", "force_rms") for e in rises(name).values()),
            "The total rises because balls press longer more than because they hit harder: the 99.9 % quantile of the force, pooled over all balls, "
            "changes by a few "
            "newtons either way, while that of the stress, of the worst rivet at each instant, rises.",
        ),
        Claim(
            "4.1 (3)",
            "Impacts dislocate the halves further",
            f"F: largest dislocation rises by {text('dislocation_max', 'µm')}",
            tuple(e.low > 0.0 for e in rises("dislocation_max").values()),
            "Friction is overcome more often.",
        ),
        Claim(
            "4.1 (3)",
            "Impacts cost life of cage and rivets",
            "F: damage rate of the worst head during the impacts "
            f"{' and '.join(f'{10**e.mean:.0f} [{10**e.low:.0f}, {10**e.high:.0f}] times ({width} ms)' for width, e in life.items())} that without",
            tuple(e.low > 0.0 for e in life.values()),
            "Miner's sum goes with a high power of the dynamic range.",
        ),
    ]


def tilt_claims(data):
    runs = data["tilt"]
    at = {tilt: runs.at(tilt=tilt) for tilt in np.unique(runs["tilt"])}
    names = {
        "force": "mean force",
        "head_peak": "p99.9 head stress",
        "head": "mean head stress",
        "head_range": "dynamic range",
        "head_above": "mean head stress above rest",
    }
    signs = {"opposing": -1.0, "aiding": 1.0}

    def times(sign, high, low, name):
        return ratio(at[sign * high], at[sign * low], name)

    def text(high, low, chosen):
        return items(
            f"{high}° in parts of {low:g}°, {word}: "
            + ", ".join(f"{names[name]} {times(sign, high, low, name)}" for name in chosen)
            for word, sign in signs.items()
        )

    flat = {
        (word, name): all(times(sign, tilt, 0.0, name).high <= 1.5 for tilt in (0.1, 0.2))
        for word, sign in signs.items()
        for name in ("head", "head_peak")
    }
    return [
        Claim(
            "4.1 (4), Fig. 15",
            "Below 0.2° of misalignment stress hardly changes",
            text(0.2, 0.0, ("head", "head_peak", "head_range")),
            tuple(flat.values()),
            "The sign decides. Radial and axial load tilt a ring by themselves; under a tilt that opposes theirs stress is flat or falls, under one "
            "that adds "
            "to it the balls hit harder from 0.1° on (p99.9), while the mean rises less.",
        ),
        Claim(
            "4.1 (4), Fig. 15; 5 (3)",
            "Beyond a threshold, 0.4°, stress rises sharply",
            text(0.5, 0.2, ("head", "head_peak", "head_range")) + text(0.4, 0.2, ("head", "head_peak")),
            tuple(times(sign, 0.5, 0.2, name).low > 1.5 for sign in signs.values() for name in ("head", "head_peak"))
            + tuple(times(sign, 0.4, 0.2, "head").high < 1.5 for sign in signs.values()),
            "Each ball's own orbital speed then differs by more than the pocket allows: "
            "balls press on the cage for part of every turn. The mean rises from 0.2 to 0.3° on, without a step at 0.4°; the 99.9 % quantile is not monotone "
            "between, because hits give way to a lasting press.",
        ),
        Claim(
            "4.1 (4), Fig. 15",
            "Beyond the threshold stress is about twenty times that at 0.2°",
            text(0.5, 0.2, ("force", "head_range", "head_above", "head_peak")),
            (
                times(-1.0, 0.5, 0.2, "force").low >= 10.0,
                times(-1.0, 0.5, 0.2, "head_range").low >= 5.0,
                times(-1.0, 0.5, 0.2, "head_above").low >= 10.0,
                times(-1.0, 0.5, 0.2, "head_peak").low >= 10.0,
            ),
            "Under an opposing tilt the mean pocket force grows by more than that. The stress does not follow it: "
            f"at 0.2° {at[-0.2]['head_rest'][0]:.0f} of the mean {at[-0.2].estimate('head').mean:.0f} MPa are the preload's, most of the rest is the cage's "
            "centrifugal load, and neither grows.",
        ),
        Claim(
            "4.1 (4)",
            "Moments and misalignment should be avoided",
            f"head p99.9 {at[0.0].estimate('head_peak')} MPa straight, {at[-0.5].estimate('head_peak')} and {at[0.5].estimate('head_peak')} at −0.5 and +0.5°",
            tuple(rise(at[tilt], at[0.0], "head_peak").low > 0.0 for tilt in (-0.5, 0.5)),
            "A tilt that aids the tilt by the loads costs stress from 0.1° on. At 0.5° the elastic figures are beyond the rivet's yield (590 MPa, assumed).",
        ),
    ]


def clearance_claims(data):
    runs = clearance_series(data["clearance"], "constant sum 0.4 mm")
    names = {
        "force": "mean force",
        "force_rms": "RMS force",
        "head": "mean head stress",
        "head_peak": "p99.9 head stress",
        "head_range": "dynamic range",
    }
    at = {value: runs.at(ratio=value) for value in np.unique(runs["ratio"])}
    places = {name: min(at, key=lambda value: at[value].estimate(name).mean) for name in names}
    ends = {name: [rise(at[end], at[places[name]], name) for end in (min(at), max(at))] for name in names}
    others = {
        label: {
            name: min(np.unique(series["ratio"]), key=lambda value: series.at(ratio=value).estimate(name).mean)
            for name in ("force", "head_peak")
        }
        for label, series in (
            (label, clearance_series(data["clearance"], label)) for label in ("guide 0.2 mm", "pocket 0.2 mm")
        )
    }
    lighter = (
        "Tight pockets and tight guides leave balls and cage less way to gather speed before they hit: RMS force and stress fall with either clearance, the "
        "pocket's more than the guide's, so that at constant sum they are lowest at small ratios."
    )
    return [
        Claim(
            "4.1 (5), Fig. 16",
            "Stress first falls, then rises with the clearance ratio",
            f"constant sum, at the ratios {min(at):g} and {max(at):g} above the lowest [N, MPa]"
            + items(f"{label}: by {ends[name][0]} and {ends[name][1]}" for name, label in names.items()),
            tuple(all(e.low > 0.0 for e in ends[name]) for name in ("force", "force_rms", "head", "head_peak")),
            f"Those with a minimum inside: {', '.join(label for name, label in names.items() if all(e.low > 0.0 for e in ends[name])) or 'none'}. {lighter}",
        ),
        Claim(
            "4.1 (5), Fig. 16; 5 (3)",
            "Stress is lowest near the ratio 1",
            "lowest at a ratio of, constant sum: "
            + ", ".join(f"{label} {places[name]:g}" for name, label in names.items())
            + ". "
            + ". ".join(
                f"{label} held: mean force {places_['force']:g}, p99.9 head stress {places_['head_peak']:g}"
                for label, places_ in others.items()
            ),
            tuple(0.75 <= places[name] <= 1.5 for name in ("force", "force_rms", "head_peak", "head_range")),
            lighter,
        ),
        Claim(
            "4.1 (5)",
            "The reason is that balls and cage move steadily together there, with less force between them",
            f"mean force {at[1.0].estimate('force')} N at 1, {at[min(at)].estimate('force')} at {min(at):g}, {at[max(at)].estimate('force')} at {max(at):g}",
            tuple(rise(at[end], at[1.0], "force").low > 0.0 for end in (min(at), max(at))),
            "A shallow minimum at constant sum: tight guides brake the cage, tight pockets press more often.",
        ),
    ]


def failure_claims(data):
    runs = data["fit"]
    clearance, interference = runs.at(fit=-90.0), runs.at(fit=40.0)
    rivets = sum(name.startswith("head_damage_") for name in runs.columns)

    def count(chosen):
        pairs = (("head", "mid"), ("mid", "head"))
        return [
            sum(rise_of(chosen, f"{a}_damage_{k}", f"{b}_damage_{k}").low > 0.0 for k in range(1, rivets + 1))
            for a, b in pairs
        ]

    def worst(chosen):
        return ", ".join(
            f"{label} {10.0 ** chosen.estimate(f'{place}_damage').mean:.0e}"
            for place, label in (("head", "head"), ("mid", "middle"))
        )

    heads, mids = {"clearance": count(clearance), "interference": count(interference)}.values()
    share = clearance.estimate("axial_share")
    loads = {name: clearance.estimate(name) for name in ("tension", "shear")}
    return [
        Claim(
            "4.2, Fig. 17",
            "With a large clearance heads fail: five heads fell off, four rivets broke in the middle",
            f"more damage in the head for {heads[0]} of {rivets} rivets, in the middle for {heads[1]}; "
            f"worst rivet's per hour (geometric mean): {worst(clearance)}",
            (heads[0] > rivets / 2,),
            "A ranking, not a life: the rivets' S–N curve is assumed.",
        ),
        Claim(
            "4.2, Fig. 18",
            "With interference rivets break in the middle: seven in the middle, two at the head",
            f"more damage in the middle for {mids[1]} of {rivets} rivets, in the head for {mids[0]}; "
            f"worst rivet's per hour (geometric mean): {worst(interference)}",
            (mids[1] > rivets / 2,),
            "The middle has the larger stress (p99.9 {:.0f} against {:.0f} MPa), but the head's swing is {:.1f} times larger, and fatigue follows the swing. "
            "What would weaken the middle is not in the model: fretting at the hole's edge, residual stress of riveting.".format(
                interference.estimate("mid_peak").mean,
                interference.estimate("head_peak").mean,
                ratio_within(interference, "head_range", "mid_range").mean,
            ),
        ),
        Claim(
            "4.2",
            "Worn side beams show that balls load the cage axially too",
            f"axial share of the pocket force, RMS: {share} %",
            (share.low > 5.0,),
            "The balls' axial way under the axial load differs round the orbit.",
        ),
        Claim(
            "4.2",
            "The axial and the circumferential load make axial tension and tangential shear in the rivets",
            f"RMS per joint: tension {loads['tension']} N, shear {loads['shear']} N",
            tuple(e.low > 0.1 for e in loads.values()),
            "Both are there; prying, by the local bending of the half and by its centrifugal load, loads the head more than either.",
        ),
    ]


def rise_of(runs, above, below):
    """Mean over the seeds of the difference between two columns of the same runs."""
    return estimate(runs[above] - runs[below])


CLAIMS = {  # picture: (sweep, claims)
    "cost": ("preload", effort_claims),
    "preload": ("preload", preload_claims),
    "fit": ("fit", fit_claims),
    "speed": ("speed", speed_claims),
    "impact": ("impact", impact_claims),
    "tilt": ("tilt", tilt_claims),
    "clearance": ("clearance", clearance_claims),
    "failure": ("fit", failure_claims),
}
