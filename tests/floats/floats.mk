# Cycles and bytes of the firmware's floats.
bench-floats: venv emu
	@$(PY) tests/floats/bench.py

.PHONY: bench-floats
