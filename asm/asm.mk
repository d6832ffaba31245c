# The ROM images are committed: only a change of asm/ needs an assembler.
asm80: node_modules/.bin/asm80
node_modules/.bin/asm80: package.json package-lock.json
	npm ci --silent --no-audit --no-fund
	touch $@

rom: asm80
	@$(PYTHON) asm/build.py roms/skg

.PHONY: asm80 rom
