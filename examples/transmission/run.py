"""Simulates a system of FMUs that an SSP describes, with its parameter sets: all start from values exchanged in
initialization mode, then step together.

    python examples/transmission/run.py [fmus/Transmission.ssp] [--stop 0.05] [--step 1e-4] [--picture transmission.png]

fmpy's own simulate_ssp starts every connected input from 0: here a bearing at rest and without load for one step.
"""

import argparse
import tempfile
import zipfile
from pathlib import Path

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.ssp.ssd import get_connections, read_ssd
from lxml import etree

SYSTEM = Path(__file__).resolve().parents[2] / "fmus" / "Transmission.ssp"
BASE_UNIT = ("kg", "m", "s", "A", "K", "mol", "cd", "rad", "factor", "offset")


class Component:
    """One FMU of the system, unpacked beside its file and instantiated."""

    def __init__(self, name, path):
        description = read_model_description(str(path))
        self.variables = {v.name: v for v in description.modelVariables}
        self.units = {
            unit.name: definition({key: getattr(unit.baseUnit, key) for key in BASE_UNIT})
            for unit in description.unitDefinitions
            if unit.baseUnit is not None
        }
        identifier = description.coSimulation.modelIdentifier
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=extract(str(path), str(path.with_name(name))),
            modelIdentifier=identifier,
            instanceName=name,
        )
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)

    def converted(self, name, parameter, units):
        """The value of a parameter in the unit of its variable; units: definitions of the parameter set."""
        own = self.variables[name].unit
        if parameter.type != "Real" or parameter.unit in (None, own):
            return parameter.value
        here, there = units.get(parameter.unit, self.units.get(parameter.unit)), self.units.get(own)
        if here is None or there is None or here[0] != there[0]:
            reason = "has no definition" if here is None else f"is not one of {name} [{own or '1'}]"
            raise ValueError(f"{name} = {parameter.value} {parameter.unit}: the unit {reason}")
        return (here[1] * float(parameter.value) + here[2] - there[2]) / there[1]

    def unit(self, name):
        """Name and definition of a variable's unit."""
        own = self.variables[name].unit or "1"
        return own, self.units.get(own)

    def set(self, name, value):
        variable = self.variables[name]
        if variable.type == "Real":
            self.fmu.setReal([variable.valueReference], [float(value)])
        else:
            self.fmu.setInteger([variable.valueReference], [self.whole(name, value)])

    def whole(self, name, value):
        """The number of an integer or an item of an enumeration, which may be named; ValueError for fractions."""
        items = getattr(self.variables[name].declaredType, "items", None) or ()
        numbers = {item.name: item.value for item in items}
        try:
            number = float(numbers.get(value, value))
        except ValueError:
            number = 0.5
        if not number.is_integer():
            allowed = ", ".join(["whole numbers", *numbers])
            raise ValueError(f"{name} = {value}: {allowed} are allowed")
        return int(number)

    def get(self, name):
        return self.fmu.getReal([self.variables[name].valueReference])[0]


def load(path, folder):
    """The system of an SSP unpacked to a folder: its description, its components by name, and the start values of its
    parameter sets in the units of the FMUs.
    """
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder)
    system = read_ssd(str(path)).system
    description = etree.parse(str(folder / "SystemStructure.ssd"))
    if (one := next(description.iter("{*}LinearTransformation", "{*}BooleanMappingTransformation"), None)) is not None:
        raise ValueError(f"{path}: {etree.QName(one).localname} of a connection: transformations are not read")
    parts = {element.name: Component(element.name, folder / element.source) for element in system.elements}
    owners = [("", system), *((f"{element.name}.", element) for element in system.elements)]
    bindings = [(prefix, binding) for prefix, owner in owners for binding in owner.parameterBindings]
    start = {}
    for prefix, binding in bindings:
        if binding.parameterMapping:
            raise ValueError(f"{path}: {binding.source or 'parameter set'}: parameter mappings are not read")
        units = units_of(folder / (binding.source or "SystemStructure.ssd"))
        for parameter in (one for values in binding.parameterValues for one in values.parameters):
            name = f"{prefix}{binding.prefix or ''}{parameter.name}"
            component, variable = name.split(".", 1)
            start[name] = parts[component].converted(variable, parameter, units)
    return system, parts, start


def conversion(parts, wire):
    """Factor and offset from the unit of an output to that of the input that it is connected with, as SSP wants; numbers
    without a unit, 1, go to any input as they are.
    """
    source, output, to, name = wire
    (here, of_output), (there, of_input) = parts[source].unit(output), parts[to].unit(name)
    if here == there or "1" in (here, there):
        return 1.0, 0.0
    if of_output is None or of_input is None or of_output[0] != of_input[0]:
        raise ValueError(f"{source}.{output} [{here}] is connected with {to}.{name} [{there}]")
    return of_output[1] / of_input[1], (of_output[2] - of_input[2]) / of_input[1]


def units_of(path):
    """{name: (exponents, factor, offset)} of the units that an XML file of an SSP defines."""
    definitions = (unit for unit in etree.parse(str(path)).iter("{*}Unit"))
    return {unit.get("name"): definition(unit.find("{*}BaseUnit").attrib) for unit in definitions}


def definition(base):
    """Exponents, factor and offset of a BaseUnit: value in SI = factor * value + offset."""
    exponents = tuple(int(base.get(name, 0)) for name in ("kg", "m", "s", "A", "K", "mol", "cd", "rad"))
    return exponents, float(base.get("factor", 1.0)), float(base.get("offset", 0.0))


def simulate(path=SYSTEM, stop=0.05, step=1e-4, changes=None, without=()):
    """Outputs at the communication points: {"component.connector": array}, and "time".

    path: SSP with FMI 2.0 co-simulation FMUs and a parameter set for each; stop, step [s]; changes:
    {"component.variable": start value} beyond the parameter sets; without: connections left open, by the names of their
    ends.  KeyError for an unknown name, fmpy's FMICallException if an FMU refuses.
    """
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:  # Windows may hold on to a binary
        system, parts, start = load(path, Path(folder))
        for name, value in (start | (changes or {})).items():
            component, variable = name.split(".", 1)
            parts[component].set(variable, value)
        wires = [
            (a.parent.name, a.name, b.parent.name, b.name)
            for a, b in get_connections(system)
            if f"{b.parent.name}.{b.name}" not in without
        ]
        shown = [(e.name, c.name) for e in system.elements for c in e.connectors if c.kind == "output"]
        rows = march(parts, wires, shown, round(stop / step), step)
    columns = np.array(rows).T
    return {"time": step * np.arange(len(rows))} | {
        f"{component}.{name}": column for (component, name), column in zip(shown, columns, strict=True)
    }


def march(parts, wires, shown, steps, step):
    """Rows of the outputs `shown` at the start and after each step."""
    wires = [(*wire, *conversion(parts, wire)) for wire in wires]

    def exchange():
        """All outputs are read before the first input is set: no component is ahead of another."""
        for value, (_, _, to, name, factor, offset) in [
            (parts[source].get(output), wire) for wire in wires for source, output in [wire[:2]]
        ]:
            parts[to].set(name, factor * value + offset)

    for part in parts.values():
        part.fmu.enterInitializationMode()
    for _ in parts:  # as often as a value may have to travel on
        exchange()
    for part in parts.values():
        part.fmu.exitInitializationMode()
    rows = [[parts[component].get(name) for component, name in shown]]
    for k in range(steps):
        for part in parts.values():
            part.fmu.doStep(currentCommunicationPoint=k * step, communicationStepSize=step)
        exchange()
        rows.append([parts[component].get(name) for component, name in shown])
    for part in parts.values():
        part.fmu.terminate()
        part.fmu.freeInstance()
    return rows


def plot(result, path):
    """Speed, torques, load and reaction, and rivet stress over time, as a picture."""
    import matplotlib.pyplot as plt

    ms = 1e3 * result["time"]
    figure, axes = plt.subplots(2, 2, figsize=(5.2, 4.6), sharex=True, layout="constrained")
    (speed, force), (torque, stress) = axes
    speed.plot(ms, result["shaft.shaft.omega"] * 30 / np.pi)
    speed.set_title("speed [r/min]")
    speed.ticklabel_format(useOffset=False)
    force.plot(ms, np.hypot(result["bearing.housing.F_y"], result["bearing.housing.F_z"]), label="reaction, A")
    force.plot(ms, np.hypot(result["shaft.shaft.F_y"], result["shaft.shaft.F_z"]), label="load")
    force.set_title("radial force [N]")
    force.legend(loc="upper center", bbox_to_anchor=(0.5, -0.02), ncols=2, frameon=False, columnspacing=1.0)
    torque.plot(ms, result["bearing.bearing.friction_torque"], label="bearing A")
    torque.plot(ms, result["shaft.support.M"], label="bearing B")
    torque.set_title("friction torque [N m]")
    torque.legend()
    stress.plot(ms, result["bearing.rivet.sigma_head_max"] / 1e6)
    stress.set_title("head stress [MPa]")
    for axis in axes[1]:
        axis.set_xlabel("time [ms]")
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description="Simulate the transmission.")
    parser.add_argument("system", type=Path, nargs="?", default=SYSTEM)
    parser.add_argument("--stop", type=float, default=0.05, help="[s]")
    parser.add_argument("--step", type=float, default=1e-4, help="communication step [s]")
    parser.add_argument("--picture", type=Path, help="PNG to write")
    options = parser.parse_args()
    result = simulate(options.system, options.stop, options.step)
    late = result["time"] >= 0.5 * options.stop
    print(f"second half of {options.stop:g} s:")
    for name, column in result.items():
        if name != "time":
            print(
                f"  {name:32} mean {column[late].mean():14.6g}   {column[late].min():14.6g} ... {column[late].max():.6g}"
            )
    if options.picture:
        plot(result, options.picture)


if __name__ == "__main__":
    main()
