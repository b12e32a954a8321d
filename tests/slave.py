"""One instance of an FMU, called through the functions of the FMI 2.0 headers: statuses as they come, log messages
kept.
"""

import re
from functools import cache
from pathlib import Path

import cffi
import fmpy
import numpy as np
from library import preprocess

OK, WARNING, DISCARD, ERROR, FATAL = range(5)
CO_SIMULATION = 1
DO_STEP_STATUS, PENDING_STATUS, LAST_SUCCESSFUL_TIME, TERMINATED = range(4)


@cache
def fmi():
    """cffi with the types and functions of the standard's headers."""
    text = preprocess(sorted((Path(fmpy.__file__).parent / "c-code").glob("fmi2*.h")))
    ffi = cffi.FFI()
    # the logger: cffi has no variadic callbacks, messages come without arguments
    ffi.cdef(re.sub(r",\s*\.\.\.", "", text))
    return ffi


@cache
def describe(folder):
    return fmpy.read_model_description(str(folder))


class Slave:
    """An instance of the FMU unzipped to `folder`; freed with this object."""

    def __init__(self, folder, logging=False, **changes):
        self.ffi = fmi()
        self.component = self.ffi.NULL
        self.description = describe(folder)
        self.vr = {v.name: int(v.valueReference) for v in self.description.modelVariables}
        identifier = self.description.coSimulation.modelIdentifier
        self.lib = self.ffi.dlopen(
            str(folder / "binaries" / fmpy.platform / f"{identifier}{fmpy.sharedLibraryExtension}")
        )
        # found here: the garbage collector may call free() inside cffi's look-up
        self.free_instance = self.lib.fmi2FreeInstance
        self.messages = []  # (status, category, text)
        self.logger = self.ffi.callback("fmi2CallbackLogger", self.log)
        functions = {"logger": self.logger} | changes.pop("functions", {})
        self.functions = self.ffi.new("fmi2CallbackFunctions *", functions)
        arguments = {
            "name": b"bearing",
            "type": CO_SIMULATION,
            "guid": self.description.guid.encode(),
            "resources": b"",
        } | changes
        self.component = self.lib.fmi2Instantiate(*arguments.values(), self.functions, 0, logging)

    def log(self, _, name, status, category, message):
        self.messages.append((status, *(self.ffi.string(text).decode() for text in (category, message))))

    def __del__(self):
        self.free()

    def free(self):
        if self.component:
            self.free_instance(self.component)
        self.component = self.ffi.NULL

    def call(self, function, *arguments):
        """Status of fmi2<function>(component, ...)."""
        return getattr(self.lib, f"fmi2{function}")(self.component, *arguments)

    def check(self, function, *arguments):
        """Call what must succeed."""
        status = self.call(function, *arguments)
        assert status in (OK, WARNING), (function, status, self.messages)

    def initialize(self, start=0.0, stop=None, tolerance=None, **values):
        """From instantiated to the first communication point, with start values by name (dots as __)."""
        self.check("SetupExperiment", tolerance is not None, tolerance or 0.0, start, stop is not None, stop or 0.0)
        for name, value in values.items():
            self.set(name.replace("__", "."), value)
        self.check("EnterInitializationMode")
        self.check("ExitInitializationMode")
        self.time = start
        return self

    def try_set(self, name, value):
        kind = "Integer" if isinstance(value, int) else "Real"
        return self.call(f"Set{kind}", [self.vr[name]], 1, [value])

    def set(self, name, value):
        assert self.try_set(name, value) == OK, self.messages

    def get(self, *names):
        """Values of Real variables as an array."""
        references = np.array([self.vr[name] for name in names], dtype=np.uint32)
        values = np.empty(len(names))
        status = self.call(
            "GetReal",
            self.ffi.from_buffer("unsigned[]", references),
            len(names),
            self.ffi.from_buffer("double[]", values),
        )
        assert status in (OK, WARNING), self.messages
        return values

    def outputs(self):
        """All outputs: two equal runs repeat them bit for bit."""
        return self.get(*(v.name for v in self.description.modelVariables if v.causality == "output"))

    def step(self, h, n=1):
        """n steps of a host that counts t += h."""
        for _ in range(n):
            self.check("DoStep", self.time, h, 1)
            self.time += h
        return self

    def save(self):
        state = self.ffi.new("fmi2FMUstate *")
        self.check("GetFMUstate", state)
        return state

    def bytes(self, state):
        """The saved state serialized."""
        size = self.ffi.new("size_t *")
        self.check("SerializedFMUstateSize", state[0], size)
        buffer = self.ffi.new("char[]", size[0])
        self.check("SerializeFMUstate", state[0], buffer, size[0])
        return bytes(self.ffi.buffer(buffer))

    def try_load(self, data):
        """Status of fmi2DeSerializeFMUstate, and the state."""
        state = self.ffi.new("fmi2FMUstate *")
        return self.call("DeSerializeFMUstate", self.ffi.from_buffer("char[]", data), len(data), state), state

    def restore(self, state, time):
        self.check("SetFMUstate", state[0])
        self.time = time
        return self
