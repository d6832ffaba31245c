# The ROM under random typing. `make fuzz` goes on where the tests stop: BYTES to type, SEED another one each time.
FUZZ_SOURCES := tests/fuzz/fuzz.c tests/fuzz/noise.c emu/board.c emu/drive.c emu/image.c
FUZZ_HEADERS := tests/fuzz/noise.h $(EMU_HEADERS)
BYTES        ?= 200000000
SEED         ?= $(shell date +%s)

build/fuzz: $(FUZZ_SOURCES) $(FUZZ_HEADERS) build/emu/i8080.o
	$(EMU_CC) -o $@ $(FUZZ_SOURCES) build/emu/i8080.o

build/asan/fuzz-rom: $(FUZZ_SOURCES) $(FUZZ_HEADERS) build/asan/i8080.o
	$(EMU_CC) $(EMU_ASAN) -O1 -o $@ $(FUZZ_SOURCES) build/asan/i8080.o

fuzz: build/fuzz build/asan/fuzz-rom build/skg.lst
	build/asan/fuzz-rom --lst build/skg.lst --seed $(SEED) --bytes $$(($(BYTES) / 20)) examples/*.skg
	build/fuzz --lst build/skg.lst --seed $(SEED) --bytes $(BYTES) examples/*.skg
	build/fuzz --rom roms/skg-8251.bin --board 8251 --seed $(SEED) --bytes $$(($(BYTES) / 10)) examples/*.skg
	build/fuzz --rom roms/skg-tty.bin --punch-tty --seed $(SEED) --bytes $$(($(BYTES) / 10)) examples/*.skg

.PHONY: fuzz
