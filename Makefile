# Everything from one place: `make demo` on a fresh machine, `make test` for the fast tests, `make help` for the rest.

VENV    = .venv
BIN     = $(VENV)/bin
PYTHON  = $(BIN)/python
FMU     = fmus/RivetedBearing.fmu
COPY    = $(CURDIR)/build/sanitize
PYTEST  = $(PYTHON) -m pytest
C_FILES = $(shell find fmu_src -name '*.[ch]') $(wildcard tests/*.[ch] benchmarks/*.[ch] examples/*/*.c docs/site/browser/*.c)
BENCHMARKS = rtf rhs step scenes scaling work_precision
FORM    = --short
# Test files that call the C code themselves: functions of the core, of FMI, programs of cmake/fuzz.cmake.  The command line, reports and sweeps come to
# the same functions and take far longer in an instrumented Python; importers bring libraries of their own.
C_TESTS = $(filter-out tests/test_importers.py,$(shell grep -lE 'def .*\bcore\b|from slave import|said."f' tests/test_*.py))
# Leaks are Python's, deletes of another size than was allocated are the importer Ecos'.
ASAN    = detect_leaks=0:new_delete_type_mismatch=0

# A name of CMakePresets.json follows.
CONFIGURE = $(BIN)/cmake --preset

export PATH := $(CURDIR)/$(BIN):$(PATH)  # cmake finds ninja
export MPLBACKEND = Agg

.PHONY: demo test test-slow bench build browser site pictures dist fmu-all generate lock lint format sanitize sanitize-threads analyze fuzz bare clean help

demo: $(VENV)/full  ## build the FMU, then run the paper's working point: stress, cage and run-time figures
	@echo "make demo: compiles about 120 files (1 to 3 minutes on two cores, once), then simulates 0.4 s"
	@test -f build/build.ninja || $(CONFIGURE) default >build-configure.log || { cat build-configure.log; exit 1; }
	@rm -f build-configure.log
	$(BIN)/cmake --build build --target fmu
	$(BIN)/riveted-bearing run demo

test: build lint  ## the fast tests, the ten slowest of them listed
	$(PYTEST) -n 2 --dist worksteal --durations=10

test-slow: build  ## the tests that take minutes
	@case $$(uname -m) in x86_64) $(BIN)/cmake --build build --target RivetedBearing_by_fours ;; esac
	$(BIN)/cmake --build build --target bearing_solvers bearing_kernels
	$(PYTHON) -c "import gmsh" 2>/dev/null || .ci/environment $(VENV) slow
	$(PYTEST) -n 2 --dist worksteal -m slow

bench: build  ## measure what the README claims and write docs/performance.md, in minutes; in an hour with FORM=
	for name in $(BENCHMARKS); do $(PYTHON) benchmarks/$$name.py $(FORM) || exit 1; done
	$(PYTHON) benchmarks/performance_page.py

build: build/build.ninja  ## the FMU and the tests' library; seconds after an edit
	$(BIN)/cmake --build build

browser: $(VENV)/installed  ## the bearing in a web page, in build/browser/bearing.html: the core as WebAssembly, no network needed
	$(PYTHON) -c "import ziglang" 2>/dev/null || $(BIN)/pip --disable-pip-version-check --quiet install --no-build-isolation --editable ".[cross]"
	zig=$$($(PYTHON) -c "from riveted_bearing.building.compiler import find_zig; print(find_zig())") && $(BIN)/cmake -S . -B build/wasm32 -G Ninja \
		-DCMAKE_TOOLCHAIN_FILE=$(CURDIR)/cmake/zig.cmake -DPLATFORM=wasm32 -DPython_EXECUTABLE=$(CURDIR)/$(PYTHON) -DZIG=$$zig
	$(BIN)/cmake --build build/wasm32 --target browser
	$(PYTHON) docs/site/browser/page.py --core build/wasm32/RivetedBearing.wasm --out build/browser/bearing.html

site: browser  ## the pages of docs/ as a site in build/site: open index.html, no network needed; its search needs a server (python -m http.server)
	$(BIN)/pip --disable-pip-version-check --quiet install --no-build-isolation --editable ".[docs]"
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict --quiet

pictures: build browser  ## the pictures of the pages anew, in minutes; pages of the program by a Chromium of the system
	$(PYTHON) -c "import playwright" 2>/dev/null || .ci/environment $(VENV) slow
	$(PYTHON) docs/site/pictures.py

fmu-all: $(VENV)/installed  ## the FMU with binaries for Linux, Windows and macOS, cross-compiled here
	$(BIN)/pip --disable-pip-version-check --quiet install --no-build-isolation --editable ".[cross]"
	$(BIN)/riveted-bearing build --platforms all

dist: $(VENV)/installed  ## in dist/: a wheel for every platform with the ready FMU, the sources, the versions it was made with, checksums
	@echo "make dist, 1 of 5: packages of the release, among them a cross-compiler of 80 MB"
	$(BIN)/pip --disable-pip-version-check --quiet install --no-build-isolation --editable ".[cross,release]"
	rm -rf dist && mkdir -p build/dist dist
	@echo "make dist, 2 of 5: the core for four platforms, some 500 files: the longest part, 2 to 6 minutes on two cores"
	$(BIN)/riveted-bearing build --platforms all --out build/dist/RivetedBearing.fmu
	@echo "make dist, 3 of 5: the archive of sources"
	$(PYTHON) -m build --no-isolation --sdist >build/dist/sdist.log || { cat build/dist/sdist.log; exit 1; }
	@echo "make dist, 4 of 5: the wheel around the FMU of step 2"
	$(PYTHON) -m build --no-isolation --wheel -Ccmake.define.READY_FMU=$(CURDIR)/build/dist/RivetedBearing.fmu >build/dist/wheel.log || { cat build/dist/wheel.log; exit 1; }
	$(PYTHON) -m wheel tags --remove --python-tag py3 --abi-tag none --platform-tag any dist/*.whl
	cp build/dist/RivetedBearing.fmu dist/
	@echo "make dist, 5 of 5: versions and hashes of all packages, from the index"
	echo "scikit-build-core>=0.11" | $(BIN)/uv --quiet pip compile --generate-hashes --no-header --no-annotate --extra cross --output-file dist/requirements.txt pyproject.toml -
	cd dist && sha256sum * >SHA256SUMS
	@ls -l dist

# One resolution for every Python and system that pyproject.toml allows, by uv.
UV      = $(BIN)/uv --quiet pip compile --upgrade --universal --python-version 3.11 --generate-hashes --no-header --no-annotate
IMPORTERS = import tomllib; print(*tomllib.load(open("pyproject.toml", "rb"))["project"]["optional-dependencies"]["importers"], sep="\n")
lock: $(VENV)/installed  ## newest versions and hashes of the packages that `make demo` and `make test` install, in .ci/*.txt
	$(BIN)/pip --disable-pip-version-check --quiet install --no-build-isolation --editable ".[release]"
	$(UV) --extra test --extra dev --output-file .ci/requirements.txt pyproject.toml
	echo "scikit-build-core>=0.11" | $(UV) --extra build --constraint .ci/requirements.txt --output-file .ci/demo.txt pyproject.toml -
	$(PYTHON) -c '$(IMPORTERS)' | $(UV) --constraint .ci/requirements.txt --output-file .ci/importers.txt -

lint: $(VENV)/installed  ## formatters, linters and the type checker on the files that git knows, changing nothing
	git ls-files -z '*.py' '*.ipynb' | xargs -0 $(BIN)/ruff check --force-exclude
	git ls-files -z '*.py' '*.ipynb' | xargs -0 $(BIN)/ruff format --check --force-exclude
	$(BIN)/mypy --no-error-summary
	$(BIN)/clang-format --dry-run --Werror $(C_FILES)

generate: $(VENV)/installed  ## the files that follow from fmus/variables.toml
	$(PYTHON) fmus/generate.py

format: $(VENV)/installed  ## format and fix what can be fixed
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	$(BIN)/clang-format -i $(C_FILES)

sanitize: $(VENV)/installed  ## the fast tests that call C on a copy compiled with the sanitizers of addresses, undefined behaviour and casts of numbers
	mkdir -p $(COPY) && find $(COPY) -mindepth 1 -maxdepth 1 ! -name build -exec rm -r {} + && git ls-files -co --exclude-standard | tar -c -T - | tar -x -C $(COPY)
	$(BIN)/cmake -S $(COPY) -B $(COPY)/build -G Ninja -DSANITIZE=address,undefined,float-cast-overflow -DFMU=$(COPY)/$(FMU) -DPython_EXECUTABLE=$(CURDIR)/$(PYTHON)
	$(BIN)/cmake --build $(COPY)/build
	cd $(COPY) && PYTHONPATH=$(COPY) PYTHONMALLOC=malloc ASAN_OPTIONS=$(ASAN) LD_PRELOAD="$$(cc -print-file-name=libasan.so) libstdc++.so.6" $(CURDIR)/$(PYTEST) -n 2 -k "not Python" $(C_TESTS)

sanitize-threads: $(VENV)/installed  ## random calls in eight threads with the sanitizer of data races
	$(CONFIGURE) threads
	$(BIN)/cmake --build build/threads --target fuzz_api
	setarch --addr-no-randomize build/threads/fuzz_api 10000 1 8

analyze: build  ## static analysis without findings: the compiler's analyzer and clang-tidy
	$(BIN)/pip --disable-pip-version-check --quiet install clang-tidy
	$(CONFIGURE) analyze
	$(BIN)/cmake --build build/analyze --target RivetedBearing
	$(BIN)/clang-tidy -p build --quiet $(filter %.c,$(shell find fmu_src -name '*.c'))

FUZZ_SECONDS = 120
fuzz: $(VENV)/installed  ## coverage-guided fuzzing of the FMI functions with sanitizers (clang) for FUZZ_SECONDS, from tests/corpus on
	$(CONFIGURE) fuzz
	$(BIN)/cmake --build build/fuzz --target fuzz_api
	$(PYTHON) tests/fuzz_corpus.py unpack tests/corpus/fuzz_api.txt build/corpus
	build/fuzz/fuzz_api build/corpus -max_len=2048 -len_control=0 -timeout=20 -max_total_time=$(FUZZ_SECONDS)

DEBIAN = 12
bare:  ## `make demo` and `make test` on a bare Debian DEBIAN=12 or 13, as root
	.ci/bare $(DEBIAN)

clean:  ## remove what was built; the Python environment and the cached SUNDIALS archive stay
	rm -rf build $(FMU) fmus/Shaft.fmu fmus/Transmission.ssp fmus/Transmission-2.0.ssp

help:  ## this list
	@sed -n 's/^\([a-z-]*\):[^#]*## /  make \1\t/p' $(firstword $(MAKEFILE_LIST)) | expand -t 20

$(VENV)/installed: pyproject.toml .ci/environment .ci/requirements.txt .ci/importers.txt
	.ci/environment $(VENV)
	touch $@

# What `make demo` needs, a part of the line above.
$(VENV)/full: pyproject.toml .ci/environment
	@test -f $(VENV)/installed || .ci/environment $(VENV) demo
	@touch $@

build/build.ninja: $(VENV)/installed
	$(CONFIGURE) default
	touch $@
