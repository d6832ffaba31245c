# The ROM under random typing. `make fuzz` goes on where the tests stop: BYTES to type, SEED another one each time.
FUZZ_OBJECTS := board.o drive.o image.o i8080.o
BYTES        ?= 200000000
SEED         ?= $(shell date +%s)

build/fuzz: $(wildcard tests/fuzz/*.[ch]) $(FUZZ_OBJECTS:%=build/emu/%)
	$(EMU_CC) -o $@ $(filter-out %.h,$^)

build/asan/fuzz-rom: $(wildcard tests/fuzz/*.[ch]) $(FUZZ_OBJECTS:%=build/asan/%)
	$(EMU_CC) $(EMU_ASAN) -o $@ $(filter-out %.h,$^)

fuzz: build/fuzz build/asan/fuzz-rom build/skg.lst
	build/asan/fuzz-rom --lst build/skg.lst --seed $(SEED) --bytes $$(($(BYTES) / 20)) examples/*.skg
	build/fuzz --lst build/skg.lst --seed $(SEED) --bytes $(BYTES) examples/*.skg
	build/fuzz --rom roms/skg-8251.bin --board 8251 --seed $(SEED) --bytes $$(($(BYTES) / 10)) examples/*.skg
	for image in nodrift mill; do \
		build/fuzz --rom roms/skg-$$image.bin --seed $(SEED) --bytes $$(($(BYTES) / 10)) examples/*.skg || exit 1; done
	build/fuzz --rom roms/skg-tty.bin --punch-tty --seed $(SEED) --bytes $$(($(BYTES) / 10)) examples/*.skg

.PHONY: fuzz
