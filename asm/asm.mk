# The ROM images (asm/images.py) are committed: only a change of asm/ needs an assembler.
asm80: asm/node_modules/.bin/asm80
asm/node_modules/.bin/asm80: asm/package.json asm/package-lock.json | $(NODE)
	npm ci --prefix asm --silent --no-audit --no-fund
	touch $@

# (asm/build.py takes z88dk's assembler where there is one)
assembler:
	@$(PYTHON) asm/build.py --has-z88dk || $(MAKE) asm80

rom: assembler
	@$(PYTHON) asm/build.py --all --sym roms/skg.sym --listing build/skg.lst roms

# The standard ROM's listing alone, for who reads it and for the fuzzer.
build/skg.lst: $(wildcard asm/*.asm asm/*/*.asm asm/*.py asm/words.txt) | assembler
	@$(PYTHON) asm/build.py --listing $@ build/listed/skg >build/listed.txt

.PHONY: asm80 assembler rom
