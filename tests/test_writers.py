"""Who writes the results of an evaluation: each member of Work, and of the structs in it that one kind of cage owns, is
written by one file of the C core; sums alone have several.

The sources are read by clang.  A member is written where it is assigned to, and where a pointer to it goes to something
that may write there: a parameter, a variable or a list of pointers without const.
"""

import subprocess
from collections import defaultdict
from pathlib import Path

import pytest

cindex = pytest.importorskip("clang.cindex", reason="libclang reads the sources")

SUNDIALS = ("sundials-include", *(f"sundials-7.1.1/{name}" for name in ("include", "src/sundials", "src/arkode")))
KIND = cindex.CursorKind
ROOT = Path(__file__).resolve().parents[1]
SOURCES = ROOT / "fmu_src"
OWNERS = {"Work", "ElasticWork", "ElasticJoints", "WallTouch", "TwoHalfWork", "CageWork"}
FIRST_VALUES = {"start.c", "derived.c", "instance.c"}
# Files of which a scene chooses one; the second has the members of the first in loops of its own.  A header shares the task of
# the file that includes it.
ONE_TASK = {
    "pocket_squeeze.h": "pocket.c",
    "pocket_forces.h": "pocket.c",
    "pocket_spheres.c": "pocket.c",
    "pocket_films.c": "pocket.c",
    "pocket_films.h": "pocket.c",
    "cage_substeps.c": "cage_elastic.c",
    "land_bent.c": "land_film.c",
}
# Sums to which several elements add, and bodies to which they add forces.
SUMS = set(
    "wall_force F_x F_r F_t M_x M_r M_t dissipated D_x D_r D_t D_omega_x D_omega_r D_omega_t pocket_dissipated squeeze "
    "ring half film cage_dissipated joint_dissipated".split()
)
LIKE_A_NAME = {KIND.UNEXPOSED_EXPR, KIND.ARRAY_SUBSCRIPT_EXPR, KIND.PAREN_EXPR, KIND.MEMBER_REF_EXPR}


def clang_arguments():
    """Options under which clang reads a file of the core, without kernels for a processor: cc's headers, which serve for
    those that clang's library lacks, define the processor's instructions in their own way.
    """
    sundials = [ROOT / "build/_deps" / name for name in SUNDIALS]
    folders = [SOURCES, SOURCES / "generated", *sundials]
    asked = ["cc", "-print-file-name=include"]
    own = subprocess.run(asked, capture_output=True, text=True, check=True).stdout.strip()
    return ["-std=c17", "-U__SSE2__", "-U__ARM_NEON", *(f"-I{folder}" for folder in folders), "-isystem", own]


def is_written(way):
    """Whether the last of the expressions `way`, outermost first, is written by those around it."""
    inner = way[-1]
    for outer in reversed(way[:-1]):
        kind = outer.kind
        if kind == KIND.UNARY_OPERATOR:
            signs = [one.spelling for one in outer.get_tokens()] or ["*"]  # none of one that a macro makes
            if {signs[0], signs[-1]} & {"++", "--"}:
                return True
            if signs[0] not in ("&", "*"):
                return False
        elif kind in (KIND.BINARY_OPERATOR, KIND.COMPOUND_ASSIGNMENT_OPERATOR):
            end = inner.extent.end.offset
            sign = next((one.spelling for one in outer.get_tokens() if one.extent.start.offset >= end), "")
            return sign.endswith("=") and sign not in ("==", "<=", ">=", "!=") and next(outer.get_children()) == inner
        elif kind in LIKE_A_NAME:
            if kind == KIND.ARRAY_SUBSCRIPT_EXPR and next(outer.get_children()) != inner:
                return False  # an index
            if kind == KIND.UNEXPOSED_EXPR and outer.type.get_pointee().is_const_qualified():
                return False
        else:  # an argument, a first value, an item of a list
            pointer = inner.type.get_canonical()
            return pointer.kind == cindex.TypeKind.POINTER and not pointer.get_pointee().is_const_qualified()
        inner = outer
    return False


def written_in(path, arguments):
    """Members of the owners' structs that are written by a source file and the inline functions of the headers it includes:
    {file name: members}.
    """
    unit = cindex.Index.create().parse(str(path), args=arguments)
    errors = [str(one) for one in unit.diagnostics if one.severity >= cindex.Diagnostic.Error]
    assert not errors, errors
    written, way = defaultdict(set), []

    def visit(cursor, file):
        way.append(cursor)
        if cursor.kind == KIND.MEMBER_REF_EXPR and cursor.referenced is not None:
            owner, kind = cursor.referenced.semantic_parent.spelling, cursor.type.get_canonical().spelling
            if owner in OWNERS and kind not in OWNERS and is_written(way):
                written[file].add(f"{owner}.{cursor.spelling}")
        for child in cursor.get_children():
            visit(child, file)
        way.pop()

    for top in unit.cursor.get_children():
        file = Path(top.location.file.name) if top.location.file else SOURCES.parent
        if file == path or SOURCES in file.parents:
            visit(top, file.name)
    return written


def members():
    """Names of the members of the owners' structs, but for those that are such a struct."""
    unit = cindex.Index.create().parse(str(SOURCES / "physics/rhs.c"), args=clang_arguments())
    return {
        f"{top.spelling}.{field.spelling}"
        for top in unit.cursor.get_children()
        if top.kind == KIND.TYPEDEF_DECL and top.spelling in OWNERS
        for field in top.underlying_typedef_type.get_canonical().get_declaration().get_children()
        if field.kind == KIND.FIELD_DECL and field.type.get_canonical().spelling not in OWNERS
    }


@pytest.fixture(scope="module")
def writers():
    """Files that write members, by member."""
    arguments, found = clang_arguments(), defaultdict(set)
    for path in sorted(SOURCES.rglob("*.c")):
        if path.name not in FIRST_VALUES and not {"generated", "host"} & set(path.parts):
            for file, names in written_in(path, arguments).items():
                for name in names:
                    found[name].add(ONE_TASK.get(file, file))
    return found


def test_every_member_is_written(writers):
    names = members()
    assert {"Work.Q_i", "WallTouch.x", "ElasticJoints.N_plate"} <= names
    assert not names - set(writers)


def test_each_member_has_one_writer(writers):
    assert not {name: files for name, files in writers.items() if len(files) > 1 and name.split(".")[1] not in SUMS}


@pytest.mark.parametrize(
    ("line", "written"),
    [
        ("w->Q_i[0] = w->Q_e[0];", {"Work.Q_i"}),
        ("w->land[1].re[0] += 1.0;", {"Work.land"}),
        ("ElasticWork *e = &w->cage.elastic; e->reach[0] = w->n_ix[0];", {"ElasticWork.reach"}),
        ("double *list[] = {w->F_x, w->F_r}; list[0][0] = 0.0;", {"Work.F_x", "Work.F_r"}),
        ("const double *list[] = {w->F_x}; (void)list;", set()),
        ("memcpy(w->u_x, w->u_y, sizeof w->u_z);", {"Work.u_x"}),
        ("const Rotor *half = &w->half[0]; (void)half;", set()),
    ],
)
def test_reading_of_the_sources(tmp_path, line, written):
    path = tmp_path / "one.c"
    path.write_text(f'#include "physics/model.h"\n#include <string.h>\nvoid one(Work *w) {{ {line} }}\n')
    assert written_in(path, clang_arguments()).get("one.c", set()) == written
