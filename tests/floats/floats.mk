# Cycles and bytes of the firmware's floats.
bench-floats: venv emu
	@PYTHONPATH=tests $(PY) tests/floats/bench.py

.PHONY: bench-floats
