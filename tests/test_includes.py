"""The direction of the C core's includes: from the wrapper down to plain numbers, never up, and never from one physical
element to another; the cage behind its door.

A new file of fmu_src goes into the group whose users may include it.
"""

import re
from pathlib import Path

import pytest

SOURCES = Path(__file__).resolve().parents[1] / "fmu_src"
GROUPS = {  # from the bottom up
    "numbers": "aligned build_info cpu_clock dual elementary elimination error_norm fatigue float_environment kernel_names lanes limits octet part "
    "reserved_memory saved_numbers scalar statistics trapezoid variable_table variables vec viscosity",
    "data of the cage": "cage_work half_modes half_path joint_law land_path",
    "laws and tables": "ball_spall elastic_half elastic_wall frame hertz land_bent model outer_ring ring_fit rivet_joint rivet_rom "
    "race_normal race_spin race_surface race_traction rivet_splines rotor temperature traction spin_preload",
    "elements": "ball drag land_film race_contact ring ring_load",
    "both cages": "cage_joint films halves halves_step joint_slip pocket pocket_films pocket_forces pocket_spheres pocket_spheres_setup "
    "pocket_squeeze rigid_approach spheres_squeeze",
    "one cage": "cage_elastic cage_substeps elastic_lands elastic_step joint_open rim_films two_half wall_loads",
    "door of the cage": "cage cage_read cage_setup",
    "constants, powers": "derived powers housing",
    "right-hand side": "rhs",
    "what follows from an evaluation": "breakage energy escape events jacobian loosening outputs",
    "one step": "dispatch implicit kernels start verlet",
    "integrator": "bearing_step integrator stepping",
    "instance": "bearing check instance outputs_recorded",
    "wrapper": "fmi2_calls fmi2_instance fmi2_variables fmi2_states fmi2_derivatives fmi2_steps fmi2_wrapper",
}
RANK = {name: rank for rank, names in enumerate(GROUPS.values()) for name in names.split()}
FILES = sorted(SOURCES.rglob("*.[ch]"))
# Files outside cage/ and what they need of it beside its door: the data that the rivet table consists of, and
# the sources that are compiled again with dual numbers.
INNER = {
    "rivet_rom.h": {"half_modes.h", "half_path.h", "joint_law.h"},
    "derived.c": {"pocket_squeeze.h", "spheres_squeeze.h"},
}
ONE_KIND = {"two_half": "elastic/", "elastic": "two_half/"}


def included(path):
    """Names, without ending, of the files of the core that a file includes."""
    names = re.findall(r'^\s*#\s*include\s+"(?:[^"]+/)?([^"/]+)\.[ch]"', path.read_text(), re.MULTILINE)
    return [name for name in names if name != path.stem and not name.startswith("fmi2")]


def code_of(path):
    """Text of a file without comments and includes."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", path.read_text(), flags=re.DOTALL)
    return re.sub(r"^\s*#\s*include[^\n]*", "", text, flags=re.MULTILINE)


def folder_of(path):
    return path.relative_to(SOURCES).parent.as_posix()


OUTSIDE = [path for path in FILES if not folder_of(path).startswith(("cage", "generated"))]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_no_include_points_up(path):
    assert path.stem in RANK, f"{path.name}: put it into one of the groups of this file"
    above = [name for name in included(path) if RANK[name] > RANK[path.stem]]
    assert not above, f"{path.name} includes {above} of a higher group"


def test_elements_do_not_include_each_other():
    elements = set(GROUPS["elements"].split())
    found = {path.name: elements & set(included(path)) for path in FILES if path.stem in elements}
    assert len(found) == 2 * 6  # a .c and a .h of each
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
    assert {name for path in (SOURCES / "host").glob("fmi2_*.[ch]") for name in included(path)} == {
        "part",
        "build_info",
        "float_environment",
        "saved_numbers",
    }
    assert included(SOURCES / "instance/part.h") == ["variable_table"]
    assert included(SOURCES / "numbers/variable_table.h") == ["variables"]


@pytest.mark.parametrize("path", OUTSIDE, ids=lambda path: path.name)
def test_the_cage_has_one_door(path):
    """Outside cage/ only cage.h of that folder is included; jacobian.c compiles the sources again."""
    files = re.findall(r'#\s*include\s+"cage/(?:[^"]+/)?([^"/]+\.[ch])"', path.read_text())
    if path.name == "jacobian.c":
        files = [name for name in files if name.endswith(".h")]
    assert set(files) - {"cage.h"} <= INNER.get(path.name, set())


@pytest.mark.parametrize(
    "path", [path for path in OUTSIDE if path.name not in ("cage_work.h", "model.h")], ids=lambda path: path.name
)
def test_nothing_outside_names_a_kind_of_cage(path):
    """Neither the kinds of the enumeration nor their functions, types and members; cage_work.h has their data, model.h a pointer."""
    found = re.findall(r"\w*(?:two_half|TwoHalf|TWO_HALF|CAGE_ELASTIC|Elastic)\w*|(?:->|\.)elastic\b", code_of(path))
    assert not found


def test_kinds_of_cages_do_not_know_each_other():
    for kind, other in ONE_KIND.items():
        for path in (SOURCES / "cage" / kind).glob("*.[ch]"):
            text = code_of(path)
            assert f"cage/{other}" not in path.read_text(), path.name
            assert not re.search(rf"(?:->|\.){other[:-1]}\b", text), path.name
