"""The C core in Python, element by element: the tests' library opened with cffi, its declarations taken from the
headers themselves.

core = Core.load()
model = core.model(parameters={"bearing.P_d": 0.0}, inputs={"shaft.omega": 100.0})
y_dot, D = model.rhs(0.0, y)
model.work.Q_i[0]
"""

import os
import re
import subprocess
import tempfile
from pathlib import Path

import cffi
import numpy as np
import other_bearing
from pycparser import c_ast, c_generator, c_parser

from bearing_model.generated import variables

ROOT = Path(__file__).resolve().parents[1]
SOURCES = ROOT / "fmu_src"
GENERATED = other_bearing.BUILD / "generated" if other_bearing.BUILD else SOURCES / "generated"
LIBRARY = (other_bearing.BUILD or ROOT / "build") / "libbearing_test.so"
INSTRUCTION_SETS = ("generic", "neon", "sse2", "avx2", "avx512")
LANE_TYPES = {"wide", "bits", "words", "vec"}  # depend on the lane width: no place outside the kernels
# What a test of the core runs unless it says otherwise: rigid halves, which take half the time.  Elastic ones are named
# where they matter.
TWO_HALF = {"scene.cage": variables.CageModel.TWO_HALF}
# of the wrapper, of SUNDIALS and with packets: no physics for Python
AROUND_THE_CORE = {
    "float_environment.h",
    "fmi2_calls.h",
    "fmi2_instance.h",
    "race_traction.h",
    "reserved_memory.h",
    "bearing_step.h",
}
SYSTEM_TYPES = "typedef _Bool bool; typedef unsigned long size_t; typedef long int64_t; typedef unsigned long uint64_t; typedef unsigned uint32_t;"


class Core:
    """ffi, lib and models of one library."""

    def __init__(self, ffi, lib):
        self.ffi, self.lib = ffi, lib

    @classmethod
    def load(cls, path=LIBRARY, sources=(SOURCES, GENERATED)):
        """Open the library; OSError if it has not been built."""
        ffi = cffi.FFI()
        ffi.cdef(declarations(sources))
        return cls(ffi, ffi.dlopen(str(path)))

    def new(self, type_name, count=1):
        """Zeroed structs, aligned as the kernels want them."""
        ffi = self.ffi
        return ffi.gc(ffi.cast(f"{type_name} *", self.lib.test_allocate(count * ffi.sizeof(type_name))), self.lib.free)

    def array(self, x):
        """A float array as a C pointer; writes go into the array, which must outlive the pointer."""
        return self.ffi.cast("double *", self.ffi.from_buffer(x))

    def map(self, function, x, *before, outputs=1):
        """function(n, *before, x, y...) of the library over an array; a tuple if there are several outputs."""
        x = np.ascontiguousarray(x, dtype=float)
        y = [np.empty_like(x) for _ in range(outputs)]
        function(len(x), *before, self.array(x), *map(self.array, y))
        return y[0] if outputs == 1 else tuple(y)

    def model(self, parameters=None, inputs=None, isa=None):
        return Model(self, TWO_HALF | (parameters or {}), inputs or {}, isa)

    def set_values(self, struct, table, values):
        """Set members by the names of the variable table; KeyError for an unknown one."""
        for name, value in values.items():
            group, member = table[name].name.replace("[j]", "").replace("[k]", "").replace("[n]", "").split(".")
            setattr(getattr(struct, group), member, value)


VELOCITIES = range(variables.BALL_V_X.start, variables.N_STATES)


def block(body, state):
    """Slice of the state vector: block("cage", "v_y")."""
    return getattr(variables, f"{body}_{state}".upper())


class Model:
    """Parameters, inputs, derived constants and the results of the last evaluation."""

    def __init__(self, core, parameters, inputs, isa):
        self.core = core
        self.p, self.u, self.d, self.ring_load, self.work = map(
            core.new, ("Parameters", "Inputs", "Derived", "RingLoad", "Work")
        )
        core.lib.variables_set_start(self.p, self.u)
        core.set_values(self.p, variables.PARAMETERS, parameters)
        core.lib.variables_mark_given(self.p)
        core.set_values(self.u, variables.INPUTS, inputs)
        core.lib.temperature_apply(self.p, self.u, self.p)
        core.lib.model_derive(self.p, self.d)
        core.lib.work_init(self.d, self.work)
        core.lib.ring_load_update(self.p, self.u, 0.0, self.ring_load)
        self.pointer = core.new("Model")
        self.pointer.p, self.pointer.d, self.pointer.ring_load = self.p, self.d, self.ring_load
        self.modes = core.ffi.NULL
        if core.lib.cage_vibrates(self.p):
            memory = core.lib.test_allocate(core.lib.cage_size(self.p))
            self.modes = core.ffi.gc(core.ffi.cast("ElasticHalf *", memory), core.lib.free)
            core.lib.cage_derive(self.p, self.d, self.modes)
        self.pointer.modes = self.modes
        self.states = variables.N_ALL_STATES if self.modes else variables.N_STATES
        self.isa = isa or core.ffi.string(core.lib.kernels_select().name).decode()

    def kernel(self, name):
        """A function of the kernel files in this model's instruction set."""
        return getattr(self.core.lib, f"{name}_{self.isa}")

    def solve_start(self):
        """State of the quasi-static start at t = 0 and its residual force [N]; the work struct keeps its contacts."""
        y = np.zeros(self.states)
        kernels = self.core.ffi.new("Kernels *", self.core.lib.kernels_select())
        return y, self.core.lib.start_state(kernels, self.pointer, self.work, self.core.array(y))

    def start(self):
        """The state vector of the quasi-static start at t = 0."""
        return self.solve_start()[0]

    def rhs(self, t, y):
        """dy/dt at time t [s]; the work struct keeps all results."""
        y = np.ascontiguousarray(y, dtype=float)
        if y.shape != (self.states,):
            raise ValueError(f"y has shape {y.shape}: allowed is ({self.states},)")
        y_dot = np.empty_like(y)
        self.core.lib.ring_load_update(self.p, self.u, t, self.ring_load)
        self.kernel("rhs")(self.pointer, t, self.core.array(y), self.core.array(y_dot), self.work)
        return y_dot

    def implicit(self, function, gamma, v):
        """implicit_solve or implicit_stiff_part of velocities v (rows of the state vector) at the state of the last evaluation:
        those of balls and ring, and those of rigid halves by their own equations.
        """
        v = np.array(v, dtype=float)
        names = {"implicit_solve": "two_half_solve", "implicit_stiff_part": "halves_stiff_part"}
        halves = self.kernel(names[function])
        self.kernel(function)(self.pointer, self.work, gamma, self.core.array(v))
        halves(self.pointer, self.work, gamma, self.core.array(v))
        return v

    def rates(self):
        """Rates [1/s] by which velocities (implicit.c) and friction states (two_half.c) hold themselves back at
        the state of the last evaluation.
        """
        gamma, D = 1e-12, np.zeros(variables.N_STATES)  # small: A_ii beside its coupling to others; rounding 1e-4 1/s
        stiffness = self.d.k_plate, self.d.k_rivet
        self.d.k_plate = self.d.k_rivet = 0.0
        for i in VELOCITIES:
            unit = np.zeros(variables.N_STATES)
            unit[i] = 1.0
            D[i] = (1.0 / self.implicit("implicit_solve", gamma, unit)[i] - 1.0) / gamma
        self.d.k_plate, self.d.k_rivet = stiffness
        return D

    def verlet_evaluate(self, t, y):
        """VerletState at the state y, without a history."""
        state = self.core.new("VerletState")
        state.y[0 : len(y)] = list(y)
        self.core.lib.ring_load_update(self.p, self.u, t, self.ring_load)
        self.kernel("verlet_evaluate")(self.pointer, t, state, self.work)
        return state

    def verlet(self, t, h, start, weight):
        """One Verlet step of length h from `start` (VerletState) at t; returns the VerletState reached and the error's
        norm in units of 1/weight.
        """
        end = self.core.new("VerletState")
        self.core.lib.ring_load_update(self.p, self.u, t, self.ring_load)
        error = self.kernel("verlet_step")(self.pointer, t, h, self.core.array(weight), start, end, self.work)
        return end, error

    def energy(self, y):
        """Kinetic and elastic energy [J] at the state of the last evaluation."""
        y = np.ascontiguousarray(y, dtype=float)
        return self.core.lib.energy_total(self.pointer, self.core.array(y), self.work)


# ---------------------------------------------------------------------------------------- declarations from the headers


def declarations(sources):
    """All types and functions of the headers in the folders `sources`, as cffi reads them."""
    tree = parse(sources, INSTRUCTION_SETS[0])
    layout = struct_layout(sources, tree)
    generator = c_generator.CGenerator()
    lines = ["void free(void *);"]
    for node in tree:
        if isinstance(node, c_ast.Typedef) and node.name in layout:
            pad(node, *layout[node.name])
        lines.append(generator.visit(node) + ";")
    for isa in INSTRUCTION_SETS[1:]:
        lines += [generator.visit(node) + ";" for node in parse(sources, isa) if (node.name or "").endswith(f"_{isa}")]
    return "\n".join(lines).replace("extern const ", "extern ")  # cffi takes const data for a compile-time constant


def parse(sources, isa):
    """Declarations of all headers and of the tests' own C files, without function bodies and without types that depend
    on the lane width.
    """
    files = [
        *headers(sources),
        Path(__file__).with_name("test_library.c"),
        Path(__file__).with_name("test_elementary.c"),
    ]
    text = preprocess(files, f"-DISA={isa}", *(f"-I{folder}" for folder in sources), before=SYSTEM_TYPES)
    nodes = c_parser.CParser().parse(text).ext
    own = SYSTEM_TYPES.count(";")
    return [
        node for node in nodes[own:] if not isinstance(node, (c_ast.FuncDef, c_ast.StaticAssert)) and declares(node)
    ]


def headers(sources):
    """The core's headers; the variables' are those of the last folder, which may be another bearing's."""
    found = [path for folder in sources for path in sorted(folder.rglob("*.h")) if path.name not in AROUND_THE_CORE]
    return [path for path in found if path.parent.name != "generated" or path.parent == sources[-1]]


def preprocess(files, *options, before=""):
    """The files' own text: macros and #include "..." done, system headers empty, attributes gone."""
    with tempfile.TemporaryDirectory() as folder:
        for name in re.findall(r"#\s*include\s*<(.*)>", "".join(path.read_text() for path in files)):
            (Path(folder) / name).parent.mkdir(parents=True, exist_ok=True)
            (Path(folder) / name).write_text("")
        command = [
            compiler(),
            "-E",
            "-P",
            "-nostdinc",
            "-undef",
            "-D__attribute__(x)=",
            "-D_Alignas(x)=",
            *options,
            f"-I{folder}",
            "-x",
            "c",
            "-",
        ]
        text = before + "".join(f'\n#include "{path}"' for path in files)
        return subprocess.run(command, input=text, stdout=subprocess.PIPE, text=True, check=True).stdout


def declares(node):
    """Whether this is a declaration for Python: not static data, not of a type that depends on the lane width."""
    if "static" in getattr(node, "storage", []) or getattr(node, "name", None) in LANE_TYPES:
        return False
    return not uses_lanes(node)


def uses_lanes(node):
    if isinstance(node, c_ast.IdentifierType) and LANE_TYPES & set(node.names):
        return True
    return any(uses_lanes(child) for _, child in node.children())


def members_of(node):
    """Names of the members if this is typedef struct {...} Name."""
    struct = getattr(getattr(node, "type", None), "type", None)
    if isinstance(node, c_ast.Typedef) and isinstance(struct, c_ast.Struct) and struct.decls:
        return [member.name for member in struct.decls]
    return []


def struct_layout(sources, tree):
    """Name -> (offset and size of each member, size): the compiler's, since cffi does not know over-aligned members."""
    structs = {node.name: members_of(node) for node in tree if members_of(node)}
    prints = "".join(
        f'printf("{name}'
        + " %zu %zu" * len(members)
        + ' %zu\\n"'
        + "".join(f", offsetof({name}, {member}), sizeof((({name} *)0)->{member})" for member in members)
        + f", sizeof({name}));\n"
        for name, members in structs.items()
    )
    includes = "".join(f'#include "{path}"\n' for path in headers(sources))
    # optimised, so that functions in headers that nothing calls need no library
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "layout"
        text = f"#include <stdio.h>\n{includes}int main(void) {{\n{prints}return 0; }}\n"
        subprocess.run(
            [
                compiler(),
                "-std=c17",
                "-O1",
                *(f"-I{folder}" for folder in sources),
                "-x",
                "c",
                "-",
                "-o",
                str(program),
                "-lm",
            ],
            input=text,
            text=True,
            check=True,
        )
        output = subprocess.run([str(program)], capture_output=True, text=True, check=True).stdout
    layout = {}
    for line in output.splitlines():
        name, *numbers = line.split()
        *places, size = map(int, numbers)
        layout[name] = list(zip(places[::2], places[1::2], strict=True)), size
    return layout


def pad(node, places, size):
    """Fill the gaps between the members of a struct, so that cffi's natural layout is the compiler's."""
    struct, members, end = node.type.type, [], 0
    for member, (offset, length) in zip(struct.decls, places, strict=True):
        members += padding(end, offset) + [member]
        end = offset + length
    struct.decls = members + padding(end, size)


def padding(start, end):
    if start == end:
        return []
    name = f"pad_{start}"
    bytes_ = c_ast.TypeDecl(name, [], None, c_ast.IdentifierType(["char"]))
    array = c_ast.ArrayDecl(bytes_, c_ast.Constant("int", str(end - start)), [])
    return [c_ast.Decl(name, [], [], [], [], array, None, None)]


def compiler():
    return os.environ.get("CC", "cc")
