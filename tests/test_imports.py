"""Who imports whom: riveted_bearing -> rivet_model -> the table's reader in bearing_model, and never back.

The arrows are read from the source text, imports inside functions included, so that a lazy import counts as much as one
at the top.
"""

import ast
import graphlib
import subprocess
import sys

import numpy as np
import pytest
from library import ROOT

PACKAGES = ("bearing_model", "rivet_model", "riveted_bearing")
# All that rivet_model may know of bearing_model.
READERS = {
    f"bearing_model.{name}"
    for name in (
        "rivet.rivet_table",
        "rivet.rivet_rom",
        "rivet.rivet_splines",
        "cage.common.joint_law",
        "cage.two_half.half_path",
        "cage.two_half.joint_open",
        "cage.elastic.half_modes",
        "numbers.lanes",
    )
}

# Of riveted_bearing, each of which imports only those before it.
ROOMS = (
    "base",
    "bearing",
    "running",
    "building",
    "show",
    "studies",
    "duty",
    "design",
    "identify",
    "cli",
    "riveted_bearing",
    "__main__",
)


def name_of(path):
    """The module of a file: riveted_bearing/cli/run.py is riveted_bearing.cli.run."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


FILES = {name_of(path): path for package in PACKAGES for path in (ROOT / package).rglob("*.py")}


def imported(name, tree):
    """Full names that a module's import statements ask for, relative ones resolved; `from a import b` gives a.b where
    that is a module, else a.
    """
    package = name if FILES[name].name == "__init__.py" else name.rpartition(".")[0]
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
            base = ".".join([*above, *filter(None, [node.module])])
            yield from (full if (full := f"{base}.{alias.name}") in FILES else base for alias in node.names)


GRAPH = {name: set(imported(name, ast.parse(path.read_text(encoding="utf-8")))) for name, path in FILES.items()}


def package_of(module):
    return module.partition(".")[0]


def arrows(of, to):
    """Imports from modules of one package in modules of another: (importer, imported)."""
    return {
        (name, target)
        for name, targets in GRAPH.items()
        if package_of(name) == of
        for target in targets
        if package_of(target) == to
    }


def test_all_modules_are_read():
    """The numbers of modules and of imports, so that a reader that finds nothing does not pass for good order."""
    assert len(FILES) > 70 and {package_of(name) for name in FILES} == set(PACKAGES)
    assert sum(package_of(target) in PACKAGES for targets in GRAPH.values() for target in targets) > 200
    assert ("rivet_model.reduction", "bearing_model.rivet.rivet_rom") in arrows("rivet_model", "bearing_model")
    assert "riveted_bearing.running.fmu" in GRAPH["riveted_bearing"], "an import inside a function"
    assert "riveted_bearing.studies.rows" in GRAPH["riveted_bearing.studies.sweep"], "a relative import"


@pytest.mark.parametrize(
    ("of", "to"),
    [("bearing_model", "rivet_model"), ("bearing_model", "riveted_bearing"), ("rivet_model", "riveted_bearing")],
)
def test_no_arrow_upwards(of, to):
    assert not arrows(of, to)


def test_rivet_model_knows_the_tables_reader_and_nothing_of_the_dynamics():
    assert {target for _, target in arrows("rivet_model", "bearing_model")} <= READERS
    for reader in READERS:
        assert {target for target in GRAPH[reader] if package_of(target) in PACKAGES} <= READERS


def test_only_riveted_bearing_loads_an_fmu():
    loading = {
        name
        for name, targets in GRAPH.items()
        if any(package_of(target) in ("fmpy", "ctypes", "cffi") for target in targets)
    }
    assert loading and {package_of(name) for name in loading} == {"riveted_bearing"}


def circle(graph):
    """Modules that import each other in a ring, None if there are none."""
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
        return error.args[1]
    return None


def test_no_circle():
    """Neither among modules, nor among packages; a package's __init__ counts as a module."""
    assert circle({name: targets - {name} for name, targets in GRAPH.items()}) is None
    between = {package: {to for to in PACKAGES if to != package and arrows(package, to)} for package in PACKAGES}
    assert circle(between) is None
    assert circle({"a": {"b"}, "b": {"c"}, "c": {"a"}}) is not None


def room_of(module):
    """Folder or file of riveted_bearing in which a module lies; "riveted_bearing" for the interface."""
    return ".".join(module.split(".")[1:2]) or "riveted_bearing"


def test_rooms_import_downwards():
    """Each room imports those before it in ROOMS, and its first words say what lives there."""
    between = {(room_of(name), room_of(target)) for name, target in arrows("riveted_bearing", "riveted_bearing")}
    between = {(room, to) for room, to in between if room != to}
    assert {room for pair in between for room in pair} <= {*ROOMS}
    assert not [pair for pair in between if ROOMS.index(pair[0]) < ROOMS.index(pair[1])]
    assert len(ROOMS) <= 15 and 30 < len(between) <= 65  # 12 and 43
    for room in ROOMS[:-2]:
        words = ast.get_docstring(ast.parse(FILES[f"riveted_bearing.{room}"].read_text(encoding="utf-8")))
        assert words and ("import" in words or room == "cli"), room


def test_what_rooms_take_from_each_other_is_annotated():
    """Arguments and results of every function that another room imports; mypy in `make lint` checks them."""
    doors = set()
    for name, path in FILES.items():
        for node in (
            ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if package_of(name) == "riveted_bearing" else ()
        ):
            if isinstance(node, ast.ImportFrom) and node.level:
                target = next(iter(imported(name, ast.Module([node], []))), "")
                if target in FILES and room_of(target) not in (room_of(name), "cli"):
                    doors |= {(target, alias.name) for alias in node.names}
    bare = []
    for target in {target for target, _ in doors}:
        for node in ast.parse(FILES[target].read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef) and (target, node.name) in doors:
                arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
                if node.returns is None or any(argument.annotation is None for argument in arguments):
                    bare.append(f"{target}.{node.name}")
    assert len(doors) > 200 and not bare


def test_no_file_is_long():
    """A file is read in one go; 447 lines is the longest."""
    long = {name: len(path.read_text(encoding="utf-8").splitlines()) for name, path in FILES.items()}
    assert not {name: n for name, n in long.items() if package_of(name) == "riveted_bearing" and n > 450}


def test_public_names_are_no_modules():
    """An imported module takes the place of a function of its name in the package."""
    import riveted_bearing

    assert not [name for name in riveted_bearing.__all__ if f"riveted_bearing.{name}" in FILES]


@pytest.mark.parametrize("package", PACKAGES)
def test_public_names_exist(package):
    """Each name of __all__, also of the packages that import them when they are asked for; and no other name."""
    module = __import__(package)
    for name in module.__all__:
        assert getattr(module, name) is not None
    assert set(module.__all__) <= set(dir(module))
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = module.nothing


def loaded(code):
    """Modules that are there after some code in a fresh Python."""
    done = subprocess.run(
        [sys.executable, "-c", f"import sys\n{code}\nprint(*sys.modules)"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    return set(done.stdout.split())


def test_physics_runs_without_the_application():
    physics = [name for name in FILES if package_of(name) in ("bearing_model", "rivet_model")]
    modules = loaded("\n".join(f"import {name}" for name in physics))
    assert set(physics) <= modules
    assert not {"fmpy", "typer", "matplotlib", "riveted_bearing"} & modules


def test_rivet_model_runs_without_the_dynamics():
    modules = loaded("import rivet_model.build, rivet_model.embed")
    packages = {name for name, path in FILES.items() if path.name == "__init__.py"}
    assert {name for name in modules if name.startswith("bearing_model.")} - packages == READERS


def test_embedding_a_table_needs_numpy_only():
    """Builds of the wheel have neither SciPy nor scikit-fem."""
    assert not {"scipy", "skfem"} & loaded("import rivet_model.embed")


def test_interface_is_imported_quickly():
    """The interface and the help of the command line come without what takes long: 0.17 s of processor time for it."""
    help_of_all = "import riveted_bearing.cli as c\nfor name in c.COMMANDS: __import__(f'riveted_bearing.cli.{name}')"
    assert not {"numpy", "fmpy", "scipy", "matplotlib", "pyarrow", "dask"} & loaded(help_of_all)


def test_interface_reads_as_one():
    """Each function says with types what it takes and gives, and in words what it does; results show themselves in one
    line.
    """
    import inspect

    import riveted_bearing as rb

    functions = [getattr(rb, name) for name in rb.__all__ if inspect.isfunction(getattr(rb, name))]
    assert {function.__name__ for function in functions} == {"run", "info", "build", "read_result", "write_result"}
    for function in functions:
        signature = inspect.signature(function)
        assert inspect.getdoc(function) and signature.return_annotation is not signature.empty, function
        assert all(parameter.annotation is not parameter.empty for parameter in signature.parameters.values()), function
    outputs = {f"ball[{j}].Q_i": np.arange(1000.0) for j in range(400)}
    result = rb.Result(
        {"time": 1e-4 * np.arange(1000.0)} | outputs,
        dict.fromkeys(outputs, "N"),
        {},
        about={"scene": "demo", "stopped": ""},
    )
    assert "demo" in repr(result) and "401 channels" in repr(result) and "0.0999 s" in repr(result)
    assert len(repr(result)) < 1000
    assert "6207" in repr(rb.info()) and len(repr(rb.info())) < 1000
