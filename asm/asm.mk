# The ROM images (asm/images.py) are committed: only a change of asm/ needs an assembler.
asm80: asm/node_modules/.bin/asm80
asm/node_modules/.bin/asm80: asm/package.json asm/package-lock.json | $(NODE)
	npm ci --prefix asm --silent --no-audit --no-fund
	touch $@

# (asm/build.py takes z88dk's assembler where there is one)
assembler:
	@$(PYTHON) asm/build.py --has-z88dk || $(MAKE) asm80

rom: assembler
	@$(PYTHON) asm/build.py --sym roms/skg.sym --listing build/skg.lst roms/skg
	@for image in $$($(PYTHON) asm/images.py); do $(PYTHON) asm/build.py --image $$image roms/$$image || exit 1; done

# The standard ROM's listing alone, for who reads it and for the fuzzer.
build/skg.lst: $(wildcard asm/*.asm asm/*/*.asm asm/*.py asm/words.txt) | assembler
	@$(PYTHON) asm/build.py --listing $@ build/listed/skg >build/listed.txt

.PHONY: asm80 assembler rom
