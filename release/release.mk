# What people download: dist/. `make release` builds it for all systems, `make release-test` runs it as far as it runs here.
RELEASE_VENV := build/release/venv
RELEASE_PY   := $(RELEASE_VENV)/bin/python

$(RELEASE_VENV)/.stamp: release/requirements.txt
	$(PYTHON) -m venv --clear $(RELEASE_VENV)
	$(RELEASE_PY) -m pip install -q --disable-pip-version-check -r release/requirements.txt
	touch $@

release: $(RELEASE_VENV)/.stamp emu tools venv web-modules pico
	$(RELEASE_PY) release/build.py

# Wine runs what is for Windows, qemu what is for ARM, Debian's chromium the page. Maven brings more versions of Python.
RELEASE_TOOLS := wine wine64 xvfb xdotool qemu-user chromium maven locales
release-tools:
	@dpkg -s $(RELEASE_TOOLS) >/dev/null 2>&1 || { [ "$$(id -u)" = 0 ] && apt-get update -q \
		&& DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends $(RELEASE_TOOLS); } \
		|| echo "Not all of $(RELEASE_TOOLS) can be had: what they run is not tried."

release-test: $(RELEASE_VENV)/.stamp release-tools emu tools venv web-modules
	$(RELEASE_PY) release/check.py

.PHONY: release release-tools release-test
