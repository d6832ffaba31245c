# The machine in a web page: web/dist. Needs node; the .wasm are committed, `make web-wasm` compiles them (clang and lld 14, wasi-libc).
WEB_BIN := web/node_modules/.bin

web-modules: web/node_modules/.package-lock.json
web/node_modules/.package-lock.json: web/package.json web/package-lock.json | $(NODE)
	npm ci --prefix web --silent --no-audit --no-fund --ignore-scripts
	touch $@

# A TypeScript file as a node program.
web/build/%.mjs: web/%.ts $(wildcard web/src/*.ts web/src/ui/*.ts web/test/*.ts) web/node_modules/.package-lock.json
	@$(WEB_BIN)/esbuild $< --bundle --platform=node --format=esm --packages=external --target=node20 --log-level=warning \
		--outfile=$@

web: venv web/build/build.mjs
	@node web/build/build.mjs
	@echo "The page is in web/dist: make web-serve shows it, any web server serves it."

# The page of skg ui: committed, since who installs the tools has no node. A test makes it again and compares.
ui-page: web/build/ui.mjs
	@node web/build/ui.mjs

# The pictures of it that stand in the pages. Needs chromium.
ui-pictures: ui-page web/build/test/ui.pictures.mjs
	node web/build/test/ui.pictures.mjs

web-serve: web
	$(PYTHON) -m http.server --bind 127.0.0.1 --directory web/dist 8080

# What the tests of the page want of Debian: who may install it gets it; without it these tests are skipped.
WEB_TOOLS := clang-14 lld-14 wasi-libc libclang-rt-14-dev-wasm32 chromium firefox-esr fonts-wqy-zenhei
web-tools:
	@dpkg -s $(WEB_TOOLS) >/dev/null 2>&1 || { [ "$$(id -u)" = 0 ] && apt-get update -q \
		&& DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends $(WEB_TOOLS); } \
		|| echo "Not all of $(WEB_TOOLS) can be had: some tests of the page are skipped."

web-wasm:
	web/wasm/build.sh

# TypeScript as the formatter writes it, and what its linter finds (web/biome.json).
web-lint: web-modules
	cd web && node_modules/.bin/biome check --error-on-warnings .

web-format: web-modules
	cd web && node_modules/.bin/biome check --write .

# In real browsers: Debian's chromium and firefox-esr, as far as they are there. Screenshots go to web/build/shots.
test-web: web $(patsubst web/%.ts,web/build/%.mjs,$(wildcard web/test/*.browser.ts))
	node --test --test-reporter=spec web/build/test/*.browser.mjs

.PHONY: web ui-page ui-pictures web-modules web-lint web-format web-tools web-serve web-wasm test-web
