# Small-integer soup, firmware against reference, beyond the programs of the tests: SEED another one each time.
PROGRAMS ?= 1000000
SEED     ?= $(shell date +%s)

hunt: venv asm80 emu tools
	$(PY) -m pytest -q -n 2 --hypothesis-profile hunt --hypothesis-seed $(SEED) $(shell grep -rl '^@given' tests)
	SKG_SEED=$(SEED) SKG_NARROW=$$(($(PROGRAMS) / 10)) SKG_LOOSE=1 $(PY) -m pytest -q -n 2 tests/rom/test_narrow.py
	SKG_SEED=$(SEED) SKG_BLOCKS=$$(($(PROGRAMS) / 10)) $(PY) -m pytest -q -n 2 tests/rom/test_random.py tests/rom/test_fit.py tests/rom/test_mill.py
	SKG_EVERY=1 $(PY) -m pytest -q -n 2 tests/rom/test_altair.py tests/rom/test_processors.py tests/rom/test_boards.py tests/rom/test_lost.py tests/rom/test_mill.py tests/cpm/test_cpm_examples.py
	SKG_SEED=$(SEED) SKG_SESSIONS=$$(($(PROGRAMS) / 10)) SKG_NEAR=$$(($(PROGRAMS) / 20)) $(PY) -m pytest -q -n 2 tests/rom/test_sessions.py tests/rom/test_near_points.py
	SKG_EVERY=1 $(PY) -m pytest -q -n 2 tests/tools/test_cut.py tests/tools/test_job.py tests/tools/test_tabs.py
	SKG_CONTOURS=1000 $(PY) -m pytest -q tests/tools/test_dxf.py -k any_contour
	SKG_STRIDE=499 SKG_MOMENTS=100000 $(PY) -m pytest -q -n 2 tests/fuzz/test_ctrl_c.py
	$(PY) tests/rom/hunt.py --seed $(SEED) --programs $(PROGRAMS)
	$(PY) tests/mill/hunt_grbl.py --seed $(SEED) --programs $$(($(PROGRAMS) / 10))

.PHONY: hunt
