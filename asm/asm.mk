# The ROM images are committed: only a change of asm/ needs an assembler.
asm80: asm/node_modules/.bin/asm80
asm/node_modules/.bin/asm80: asm/package.json asm/package-lock.json
	npm ci --prefix asm --silent --no-audit --no-fund
	touch $@

rom: asm80
	@$(PYTHON) asm/build.py --listing build/skg.lst roms/skg
	@$(PYTHON) asm/build.py --variant --set BRD51=1 roms/skg-8251
	@$(PYTHON) asm/build.py --variant --set PTTY=1 roms/skg-tty
	@$(PYTHON) asm/build.py --variant --set NODRIFT=1 roms/skg-nodrift

# The standard ROM's listing alone, for who reads it and for the fuzzer.
build/skg.lst: $(wildcard asm/*.asm) asm/build.py | asm80
	@$(PYTHON) asm/build.py --listing $@ build/listed/skg >build/listed.txt

.PHONY: asm80 rom
