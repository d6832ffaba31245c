# SKG: `make run` cuts an example before your eyes, `make test` checks everything.
PYTHON ?= python3
VENV   := .venv
PY     := $(VENV)/bin/python

all: emu

include emu/emu.mk
include asm/asm.mk

# The virtual environment of the host tools and tests, made anew when the pinned list changes.
venv: $(VENV)/.stamp
$(VENV)/.stamp: tools/pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(PY) -m pip install -q --disable-pip-version-check -e 'tools[test]'
	touch $@

clean:
	rm -rf build

.PHONY: all venv clean
