"""The direction of the C core's includes: from the wrapper down to plain numbers, never up, and never from one physical
element to another.

A new file of fmu_src goes into the group whose users may include it.
"""

import re
from pathlib import Path

import pytest

SOURCES = Path(__file__).resolve().parents[1] / "fmu_src"
GROUPS = {  # from the bottom up
    "numbers": "aligned build_info cpu_clock dual elementary elimination fatigue float_environment isa lanes octet part reserved_memory saved_numbers scalar "
    "statistics variable_table variables vector_ops viscosity",
    "laws and tables": "derived elastic_half elastic_wall frame half_modes half_path hertz joint_follow joint_law model outer_ring "
    "powers ring_fit rivet_joint rivet_rom rivet_splines rotor temperature traction vec",
    "elements": "ball cage_elastic cage_joint drag land_film pocket race_contact ring ring_load",
    "right-hand side": "rhs",
    "what follows from an evaluation": "energy events jacobian outputs rivets",
    "one step": "cage_substeps dispatch implicit kernels start verlet",
    "integrator": "integrator stepping",
    "instance": "bearing check instance outputs_recorded",
    "wrapper": "fmi2_calls fmi2_wrapper",
}
RANK = {name: rank for rank, names in enumerate(GROUPS.values()) for name in names.split()}
FILES = sorted(SOURCES.rglob("*.[ch]"))


def included(path):
    """Names, without ending, of the files of the core that a file includes."""
    names = re.findall(r'^\s*#\s*include\s+"(?:[^"]+/)?([^"/]+)\.[ch]"', path.read_text(), re.MULTILINE)
    return [name for name in names if name != path.stem and not name.startswith("fmi2")]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_no_include_points_up(path):
    assert path.stem in RANK, f"{path.name}: put it into one of the groups of this file"
    above = [name for name in included(path) if RANK[name] > RANK[path.stem]]
    assert not above, f"{path.name} includes {above} of a higher group"


def test_elements_do_not_include_each_other():
    elements = set(GROUPS["elements"].split())
    found = {path.name: elements & set(included(path)) for path in FILES if path.stem in elements}
    assert len(found) >= 2 * 8  # a .c and a .h of each
    assert not any(found.values()), found


def test_no_circles_among_headers():
    graph = {path.stem: included(path) for path in FILES if path.suffix == ".h"}

    def visit(name, way):
        assert name not in way, " -> ".join([*way, name])
        for other in graph[name]:
            visit(other, [*way, name])

    for name in graph:
        visit(name, [])


def test_the_wrapper_sees_the_part_only():
    assert set(included(SOURCES / "host/fmi2_wrapper.c")) == {
        "part",
        "build_info",
        "float_environment",
        "saved_numbers",
    }
    assert included(SOURCES / "instance/part.h") == ["variable_table"]
    assert included(SOURCES / "numbers/variable_table.h") == ["variables"]
