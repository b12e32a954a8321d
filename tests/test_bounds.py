"""What an instance refuses or bounds: bodies that cannot be, motions that contradict their velocity, tolerances,
messages, and large or foreign files.
"""

import time
from functools import cache
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy import fmi2
from fmpy.fmi1 import FMICallException

FMU = Path(__file__).resolve().parents[1] / "fmus" / "RivetedBearing.fmu"
STEP = 1e-4  # [s]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The FMU's files."""
    return fmpy.extract(str(FMU), str(tmp_path_factory.mktemp("fmu")))


@cache
def describe(folder):
    return fmpy.read_model_description(folder)


class Host:
    """An instance through fmpy; `messages` has (status, category, text) of every call of the logger."""

    def __init__(self, folder, logging=False, tolerance=None, **start):
        description = describe(folder)
        identifier = description.coSimulation.modelIdentifier
        self.slave = fmi2.FMU2Slave(
            guid=description.guid, unzipDirectory=folder, modelIdentifier=identifier, instanceName="bearing"
        )
        self.variables = {v.name: v for v in description.modelVariables}
        self.messages = []
        self.memory = fmi2.fmi2CallbackFunctions()
        self.memory.logger = fmi2.fmi2CallbackLoggerTYPE(self.keep)
        self.memory.allocateMemory = fmi2.fmi2CallbackAllocateMemoryTYPE(fmi2.calloc)
        self.memory.freeMemory = fmi2.fmi2CallbackFreeMemoryTYPE(fmi2.free)
        self.instantiate(callbacks=self.memory, loggingOn=logging)
        self.set(**start)
        self.setupExperiment(tolerance=tolerance, startTime=0.0)

    def __getattr__(self, name):
        return getattr(self.slave, name)

    def keep(self, _environment, _instance, status, category, text):
        self.messages.append((status, category.decode(), text.decode()))

    def set(self, **values):
        for name, value in values.items():
            variable = self.variables[name.replace("__", ".")]
            write = self.setReal if variable.type == "Real" else self.setInteger
            write([variable.valueReference], [value])

    def get(self, *names):
        return np.array(self.getReal([self.variables[name].valueReference for name in names]))

    def start(self):
        self.enterInitializationMode()
        self.exitInitializationMode()
        return self

    def texts(self, status):
        return [text for kind, _, text in self.messages if kind == status]


@pytest.fixture
def host(folder):
    """Hosts, freed at the end."""
    made = []

    def make(start=(), **options):
        made.append(Host(folder, **options, **dict(start)))
        return made[-1]

    yield make
    for one in made:
        one.freeInstance()


# ---------------------------------------------------------------------------------------------------------- inertia

TILTING = {"ring.tilt_mode": 2}


@pytest.mark.parametrize(
    ("start", "name"),
    [
        ({"cage.J_t": 1e-10}, "cage.J_p"),  # 3 s a step before
        ({"cage.J_p": 1.0}, "cage.J_p"),
        ({"cage.J_p": 1.0, "cage.J_t": 1.0}, "cage.J_p"),
        ({"cage.J_p": 4e-10, "cage.J_t": 2e-10}, "cage.J_p"),
        ({"cage.J_t": 1.04e-5}, "cage.J_p"),  # 2 % below J_p/2
        ({"cage.m": 0.05, "cage.J_p": 2.2e-5, "cage.J_t": 1.11e-5}, "cage.J_p"),  # of a lighter half
        ({"ring.J_p": 100.0}, "ring.J_p"),
        ({"ring.J_t": 1e-9}, "ring.J_p"),
        (TILTING | {"ring.J_p": 1e-9, "ring.J_t": 1e-9}, "ring.J_p"),
    ],
    ids=str,
)
def test_impossible_inertia_is_refused(host, start, name):
    one = host(start)
    one.enterInitializationMode()
    with pytest.raises(FMICallException):
        one.exitInitializationMode()
    assert len(one.texts(fmi2.fmi2Error)) == 1
    assert one.texts(fmi2.fmi2Error)[0].startswith(f"{name} = ") and "is allowed" in one.texts(fmi2.fmi2Error)[0]


@pytest.mark.parametrize(
    "start",
    [
        {},
        {"cage.m": 10.0},  # moments of inertia left at their start follow the mass
        {"cage.m": 1e-3},
        {"cage.J_p": 2.0e-5},
        {"cage.J_p": 2.13e-5, "cage.J_t": 1.06e-5},  # a thin ring, rounded
        {"cage.J_t": 5e-5},
        {"ring.m": 1000.0},  # a ring that does not tilt has no use for its moments of inertia
        {"ring.J_p": 1e-9},
        TILTING | {"ring.m": 3.0},
        TILTING | {"ring.J_p": 10.0, "ring.J_t": 6.0},  # a disk on the shaft
    ],
    ids=str,
)
def test_possible_inertia_is_accepted(host, start):
    one = host(start).start()
    began = time.perf_counter()
    one.doStep(0.0, STEP)
    assert time.perf_counter() - began < 1.0  # a few ms; J_t = 1e-10 kg m2 took 3 s
    assert not one.texts(fmi2.fmi2Error)
