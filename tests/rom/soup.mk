# Small-integer soup, firmware against reference, beyond the 20,000 programs of the tests: SEED another one each time.
PROGRAMS ?= 1000000
SEED     ?= $(shell date +%s)

hunt: venv emu
	$(PY) tests/rom/hunt.py --seed $(SEED) --programs $(PROGRAMS)
	$(PY) tests/mill/hunt_grbl.py --seed $(SEED) --programs $$(($(PROGRAMS) / 10))

.PHONY: hunt
