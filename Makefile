# SKG: `make run` cuts an example before your eyes, `make test` checks everything.
#
#   make          the emulator, build/skg80: needs gcc alone
#   make rom      roms/skg.bin .hex .sym and the other boards' images, build/skg.lst, from asm/: needs Python and node
#   make t T=tests/rom/test_build.py     one test; make lint: the Python sources' style
#   make bench    the emulator's speed, cycles of the floats, cycles a block over the examples
#   make fuzz     half an hour of random typing at the ROM (BYTES=200000000); make simh: the examples in SIMH's Altair
#   make hunt     a million random programs, firmware against reference (PROGRAMS=1000000)
PYTHON ?= python3
VENV   := .venv
PY     := $(VENV)/bin/python
PART   ?= examples/xy-fig1-loop.skg

all: emu

include emu/emu.mk
include asm/asm.mk
include tools/tools.mk
include tests/fuzz/fuzz.mk
include tests/rom/soup.mk
-include tests/floats/floats.mk

# The virtual environment of the host tools and tests, made anew when the pinned list changes. The tools are installed as
# a user has them, but editable: their modules, the ROM images and the libraries in C are those of this tree.
venv: $(VENV)/.stamp
$(VENV)/.stamp: tools/pyproject.toml tools/setup.py | emu tools
	$(PYTHON) -m venv $(VENV)
	$(PY) -m pip install -q --disable-pip-version-check -e 'tools[test]'
	touch $@

# The program, then the teletype's paper with the blocks as they are punched, then what it took.
run: build/skg80
	@echo "The program $(PART):"
	@echo
	@cat $(PART)
	@echo
	@echo "The teletype's paper:"
	@build/skg80 --stats --punch build/run.3b $(PART)
	@echo
	@echo "The tape is in build/run.3b."

test: venv asm80 emu tools
	$(PY) -m pytest -q -n 2 tests
	@$(MAKE) -s lint

# One test, or some: T=tests/rom/test_build.py, T="-k wrench".
t: venv asm80 emu tools
	$(PY) -m pytest -q $(if $(findstring tests,$(T)),,tests) $(T)

lint: venv
	$(VENV)/bin/ruff check --config tools/pyproject.toml tools asm tests

bench: bench-emu $(if $(wildcard tests/floats/floats.mk),bench-floats) bench-rom

bench-rom: venv emu
	@$(PY) tests/rom/bench.py

clean:
	rm -rf build

.PHONY: all venv run test t lint bench bench-rom clean
