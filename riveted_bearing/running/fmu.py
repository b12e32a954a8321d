"""The FMU from Python: its variables (Model) and one running instance (Instance)."""

import ctypes
import functools
import hashlib
import json
import shutil
import weakref
import zipfile
from difflib import get_close_matches
from numbers import Integral, Real
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    defaultCallbacks,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2LastSuccessfulTime,
    fmi2ValueReference,
)
from fmpy.logging import addLoggerProxy

from bearing_model.generated.variables import MODEL_IDENTIFIER, RETIRED_ITEMS

from ..base.errors import UserError, shortlist
from ..base.units import suffix, symbol_of, to_si, unit_table

FMU_NAME = "RivetedBearing.fmu"
CAGE_MODES = "extra/riveted-bearing/cage_modes.json"  # fmus/package.py writes it
PACKAGE = Path(__file__).resolve().parents[1]
MOST_UNPACKED = 500e6  # of an FMU [B]: with binaries for all platforms a tenth of it
MOST_FILES = 10_000  # of an FMU
KEPT = ("logStatusError", "logStatusWarning")  # categories of messages
LEVELS = ("ok", "warning", "discard", "error", "fatal", "pending")
LOGS = {}  # component environment -> log of its instance


@fmi2CallbackLoggerTYPE
def keep_message(environment, name, status, category, message):
    """Callback of all FMUs' loggers: fmpy's proxy takes one only, so the environment tells instances apart."""
    if environment in LOGS:
        LOGS[environment].append((LEVELS[status], message.decode(errors="replace").strip()))


def default_fmu():
    """The FMU of the working directory, the checkout, or the package; UserError if there is none."""
    places = [Path.cwd() / FMU_NAME, PACKAGE.parent / "fmus" / FMU_NAME, PACKAGE / FMU_NAME]
    for path in places:
        if path.is_file():
            return path
    raise UserError(f"no FMU yet: `riveted-bearing build` makes one (looked for {', '.join(map(str, places))})")


def near_fmu(path):
    """The FMUs that the folder of a missing one has, the nearest name or all of them; "" if there are none."""
    others = sorted(other.name for other in path.parent.glob("*.fmu"))
    near = get_close_matches(path.name, others, n=1, cutoff=0.5)
    if near:
        return f'; did you mean "{path.parent / near[0]}"?'
    return f"; the folder has {shortlist(others)}" if others else ""


def check_archive(path):
    """UserError if an FMU would unpack to more than one needs, by the sizes that bind Python's unpacking."""
    with zipfile.ZipFile(path) as archive:
        sizes = [member.file_size for member in archive.infolist()]
    if sum(sizes) > MOST_UNPACKED or len(sizes) > MOST_FILES:
        allowed = f"{MOST_FILES:,} files of {1e-6 * MOST_UNPACKED:,.0f} MB"
        raise UserError(
            f"{path}: {len(sizes):,} files of {1e-6 * sum(sizes):,.0f} MB are too much for an FMU; at most {allowed} are allowed"
        )


class Model:
    """An FMU's variables by name, with units, limits and enumerations; UserError if it is none of FMI 2.0 co-simulation."""

    def __init__(self, path=None):
        self.path = Path(path) if path else default_fmu()
        if not self.path.is_file():
            raise UserError(f"{self.path}: no such FMU{near_fmu(self.path)}")
        try:
            check_archive(self.path)
            self.description = read_model_description(str(self.path), validate=False)
        except UserError:
            raise
        except Exception as problem:  # fmpy passes on all errors of its readers of zip and XML
            raise UserError(f"{self.path}: not a readable FMU: {problem}") from None
        if self.description.coSimulation is None or not self.description.fmiVersion.startswith("2."):
            raise UserError(f"{self.path}: not a co-simulation FMU of FMI 2.0")
        if self.description.modelName != MODEL_IDENTIFIER:
            raise UserError(
                f"{self.path}: the FMU of {self.description.modelName}, not of a bearing ({MODEL_IDENTIFIER})"
            )
        identifier = str(self.description.coSimulation.modelIdentifier)
        if not (identifier.isascii() and identifier.isidentifier()):  # names a file in the folder of binaries
            raise UserError(f"{self.path}: modelIdentifier = {identifier!r} is not allowed: a C name is needed")
        self.units = {"1": {"1": (1.0, 0.0)}, None: {"1": (1.0, 0.0)}} | unit_table(self.description.unitDefinitions)
        variables = self.description.modelVariables
        self.parameters = {v.name: v for v in variables if v.causality == "parameter"}
        self.inputs = {v.name: v for v in variables if v.causality == "input"}
        self.outputs = {v.name: v for v in variables if v.causality == "output"}
        self.locals = {v.name: v for v in variables if v.causality == "local"}

    @property
    def Z(self):
        """Number of balls, and of rivets."""
        return sum(name.startswith("ball[") and name.endswith("].Q_i") for name in self.outputs)

    @property
    def bearing(self):
        """The FMU's description of its bearing, without the sentence about all bearings before it."""
        whole = self.description.description or self.description.modelName
        return whole.partition(". ")[2] or whole

    @functools.cached_property
    def content(self):
        """The file's bytes, when they are first asked for."""
        return self.path.read_bytes()

    @functools.cached_property
    def digest(self):
        """SHA-256 of the file."""
        return hashlib.sha256(self.content).hexdigest()

    @functools.cached_property
    def noted(self):
        """What the vendor annotation notes of each value of a bearing file: its attributes by name."""
        with zipfile.ZipFile(self.path) as archive:
            root = ElementTree.fromstring(archive.read("modelDescription.xml"))
        found = root.iterfind("VendorAnnotations/Tool[@name='riveted-bearing']/Origin/Value")
        return {value.get("name"): dict(value.attrib) for value in found}

    @functools.cached_property
    def origin(self):
        """Where start values come from, by name: "yours", "catalogue", "rule", "shipped"; empty for the default FMU."""
        return {name: note.get("origin") for name, note in self.noted.items()}

    @functools.cached_property
    def catalogue(self):
        """Boundary dimensions [m] and load ratings [N] by the names of a bearing file, as far as the FMU has them."""
        return {name: value for name, value in self.numbers.items() if not name.startswith("rivet.")}

    @functools.cached_property
    def rivet(self):
        """Dimensions of the rivet [m] by the names of a bearing file, as far as the FMU has them."""
        return {name: value for name, value in self.numbers.items() if name.startswith("rivet.")}

    @functools.cached_property
    def numbers(self):
        """Values by the names of a bearing file that are no variables of the FMU, SI."""
        return {name: float(note["value"]) for name, note in self.noted.items() if "value" in note}

    @functools.cached_property
    def ranges(self):
        """(lowest, highest) of what the drawing allows of a value, SI, by the names of a bearing file."""
        return {name: (float(note["low"]), float(note["high"])) for name, note in self.noted.items() if "low" in note}

    @functools.cached_property
    def cage_modes(self):
        """Free half's modes in the rivet table: `frequency` [Hz], `modes` of each, `mass` [kg]; None if not listed."""
        with zipfile.ZipFile(self.path) as archive:
            return json.loads(archive.read(CAGE_MODES)) if CAGE_MODES in archive.namelist() else None

    @functools.cached_property
    def folder(self):
        """Folder of the unpacked FMU, for all its instances; removed with the Model."""
        folder = extract(str(self.path))
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        return folder

    def parameter_value(self, value, variable):
        """A parameter's value checked: SI number, integer or item name of its enumeration."""
        if variable.type == "Enumeration":
            if not isinstance(value, str) or value not in codes(variable):
                reasons = RETIRED_ITEMS.get(variable.declaredType.name, {})
                reason = f"{reasons[value][1]}; " if isinstance(value, str) and value in reasons else ""
                raise UserError(f"{reason}allowed: {', '.join(codes(variable))}")
            return value
        if variable.type == "Integer":
            if isinstance(value, bool) or not isinstance(value, Integral):
                raise UserError("not an integer")
            number = int(value)
        else:
            number = to_si(value, self.units[variable.unit])
        self.check_range(number, variable, symbol_of(value), value)
        return number

    def check_range(self, number, variable, symbol=None, written=None):
        """UserError, in the unit `symbol` or else in the one in which people read the variable, if an SI value is
        outside the variable's limits; written: the value as the user wrote it, which may lack its unit.
        """
        low = -np.inf if variable.min is None else float(variable.min)
        high = np.inf if variable.max is None else float(variable.max)
        if not low <= number <= high:
            symbol = symbol if symbol in self.units[variable.unit] else self.display(variable)[0]
            factor, offset = self.units[variable.unit][symbol]
            hint = ""
            if isinstance(written, Real) and symbol != variable.unit and low <= (written - offset) / factor <= high:
                hint = f'; a number without a unit is in {variable.unit}: did you mean "{written}{suffix(symbol)}"?'
            value, low, high = (f"{factor * limit + offset:.6g}" for limit in (number, low, high))
            raise UserError(f"{value}{suffix(symbol)} is out of range, allowed: {low} ... {high}{suffix(symbol)}{hint}")

    def display(self, variable):
        """Symbol, (factor, offset) of the unit in which people read a variable."""
        scales = self.units[variable.unit]
        symbol = variable.displayUnit or variable.unit or "1"
        return symbol, scales[symbol]

    def default(self, variable):
        """Start value of a parameter or input, item name for an enumeration."""
        if variable.type == "Enumeration":
            return item_name(variable, int(variable.start))
        return int(variable.start) if variable.type == "Integer" else float(variable.start)


def codes(variable):
    """Item names of an enumeration with their numbers."""
    return {item.name: int(item.value) for item in variable.declaredType.items}


def item_name(variable, code):
    """Item name of an enumeration's number."""
    return next(name for name, number in codes(variable).items() if number == code)


class Instance:
    """One instance of an FMU, a context manager; its errors and warnings are kept in `log`."""

    def __init__(self, model):
        self.model = model
        self.log = []

    def __enter__(self):
        description = self.model.description
        try:
            self.fmu = FMU2Slave(
                guid=description.guid,
                unzipDirectory=self.model.folder,
                modelIdentifier=description.coSimulation.modelIdentifier,
                instanceName=description.modelName,
            )
            self.fmu.instantiate(callbacks=self.callbacks(), loggingOn=True)
            self.fmu.setDebugLogging(True, KEPT)
        except Exception as problem:
            LOGS.pop(id(self), None)
            raise UserError(
                f"{self.model.path}: cannot be loaded: {'; '.join([str(problem), *(message for _, message in self.log)])}"
            ) from None
        return self

    def __exit__(self, *_):
        self.fmu.freeInstance()
        LOGS.pop(id(self))

    def callbacks(self):
        """Memory and logging functions for the FMU."""
        LOGS[id(self)] = self.log
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = keep_message
        callbacks.allocateMemory = defaultCallbacks.allocateMemory
        callbacks.freeMemory = defaultCallbacks.freeMemory
        addLoggerProxy(ctypes.byref(callbacks))
        callbacks.componentEnvironment = id(self)
        return callbacks

    def complaints(self):
        """The FMU's messages about its failure, oldest first."""
        lines = [message for level, message in self.log if level in ("discard", "error", "fatal")] or [
            message for _, message in self.log[-3:]
        ]
        return "; ".join(lines) or "the FMU gave no reason"

    def initialize(self, scene):
        """Set parameters and inputs, find the quasi-static start; UserError with the FMU's reason."""
        inputs = {name: float(history(0.0)) for name, history in scene.inputs.items()}
        try:
            for name, value in scene.parameters.items():
                self.set_parameter(self.model.parameters[name], value)
            self.fmu.setReal([self.model.inputs[name].valueReference for name in inputs], list(inputs.values()))
            self.fmu.setupExperiment(tolerance=scene.tolerance, startTime=0.0, stopTime=scene.t_end)
            self.fmu.enterInitializationMode()
            self.fmu.exitInitializationMode()
        except FMICallException:
            raise UserError(f"{scene.name}: the FMU refuses to start: {self.complaints()}") from None

    def set_parameter(self, variable, value):
        """Set one parameter given as SI value or item name."""
        if variable.type == "Real":
            self.fmu.setReal([variable.valueReference], [value])
        elif variable.type == "Enumeration":
            self.fmu.setInteger([variable.valueReference], [codes(variable)[value]])
        else:
            self.fmu.setInteger([variable.valueReference], [value])

    def parameters(self):
        """All parameters as the FMU has them: SI value or item name by full name."""
        reals, others = [], []
        for variable in self.model.parameters.values():
            (reals if variable.type == "Real" else others).append(variable)
        numbers = self.fmu.getReal([variable.valueReference for variable in reals])
        items = self.fmu.getInteger([variable.valueReference for variable in others])
        found = {variable.name: number for variable, number in zip(reals, numbers)}
        for variable, code in zip(others, items):
            found[variable.name] = item_name(variable, code) if variable.type == "Enumeration" else code
        return {name: found[name] for name in self.model.parameters}

    def read(self, names):
        """Present values of the named outputs."""
        return dict(zip(names, self.reader(names)().tolist()))

    def reader(self, names):
        """A function that reads the named variables at once into an array that its next call overwrites."""
        variables = self.model.inputs | self.model.outputs | self.model.locals
        references = (fmi2ValueReference * len(names))(*(variables[name].valueReference for name in names))
        buffer = (ctypes.c_double * len(names))()
        values = np.frombuffer(buffer)
        component, get_real = self.fmu.component, self.fmu.fmi2GetReal

        def read():
            get_real(component, references, len(references), buffer)
            return values

        return read

    def last_successful_time(self, otherwise):
        """Time [s] that a discarded step has reached."""
        value = ctypes.c_double(otherwise)
        try:
            self.fmu.fmi2GetRealStatus(self.fmu.component, fmi2LastSuccessfulTime, ctypes.byref(value))
        except FMICallException:
            pass
        return value.value
