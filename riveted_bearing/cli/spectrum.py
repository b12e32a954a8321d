"""riveted-bearing spectrum: spectrum and envelope spectrum of a run."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from .printing import print_paths, table
from .terminal import command, console


@command
def spectrum(
    result: Annotated[Path, typer.Argument(help="result file of `run`")],
    channel: Annotated[
        str | None,
        typer.Option(
            help="output to analyse; default: housing.a_y, housing.F_y, ring.a_y or ring.y, the first that moves"
        ),
    ] = None,
    band: Annotated[
        tuple[float, float] | None,
        typer.Option(
            help="band of the envelope in Hz, of a run-up in orders; default: largest spectral kurtosis",
            metavar="LOW HIGH",
        ),
    ] = None,
    out: Annotated[Path | None, typer.Option(help="folder for the files; default: beside the result")] = None,
):
    """Spectrum and envelope spectrum of a run, with the lines of cage, balls and races: table, CSV and picture."""
    from ..base.files import make_folder
    from ..running.effects import in_words
    from ..running.results import read_result
    from ..show.spectrum import idle_settings, plot_spectra, spectra, squared, write_spectra

    run = read_result(result)
    found = spectra(run, channel, band)
    folder = out or result.parent
    make_folder(folder)
    low, high = (f"{end:.4g}" if found.orders else f"{end:,.0f}" for end in found.band)
    console.print(
        f"{found.channel} [{found.unit}]: band of the envelope {low} to {high} {found.axis_unit}, "
        f"resolution {found.resolution:.3g} {found.axis_unit}; amplitudes are those of the squared envelope",
        markup=False,
    )
    places, amplitude = f"[{found.axis_unit}]", f"amplitude [{squared(found.unit)}]"
    heads = "line", f"expected {places}", f"found {places}", amplitude, "times the median", "stands out"
    rows = []
    for line in found.lines:
        times = line.amplitude / line.background if line.background > 0.0 else 0.0
        values = f"{line.expected:,.4g}", f"{line.found:,.4g}", f"{line.amplitude:.3g}", f"{times:.1f}"
        rows.append((line.name, *values, "yes" if line.stands_out else "no"))
    console.print(table(heads, rows))
    names, until = idle_settings(run, found)
    if names:
        console.print(escape(in_words(names, until)))
    print_paths(
        ("written", write_spectra(found, folder / f"{result.stem}_spectrum.csv")),
        ("written", plot_spectra(found, folder / f"{result.stem}_spectrum.png")),
    )
