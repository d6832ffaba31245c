# The emulator: build/skg80 and, for the Python tools, build/libskg80.so. `make bench-emu` prints the core's speed.
# tools/setup.py, which builds the library without make, reads EMU_CFLAGS, EMU_LIBRARY, EMU_TRANSLATE and TRANSLATED here.
EMU_CFLAGS  := -O2 -std=c11 -D_DEFAULT_SOURCE -D_DARWIN_C_SOURCE -D_XOPEN_SOURCE=700 -Wall -Wextra
EMU_PROGRAM := emu/board.c emu/drive.c emu/drawn.c emu/com.c emu/complain.c emu/image.c emu/options.c emu/terminal.c emu/terminal_posix.c \
               emu/main.c emu/output.c emu/operator.c \
               emu/symbols.c emu/disasm.c emu/calculator.c emu/trace.c emu/breaks.c emu/debug.c emu/commands.c
EMU_LIBRARY := emu/board.c emu/drive.c emu/image.c emu/machine.c emu/translations.c
# The images that are translated into C for the library, and what is compiled of them.
TRANSLATED  := skg skg-nodrift
EMU_ROWS    := $(TRANSLATED:%=build/emu/%.o)
EMU_TRANSLATE := emu/translate.c emu/board.c emu/drive.c emu/image.c
EMU_COMPARE := tests/emu/compare.c tests/emu/plain8080.c
EMU_FUZZ    := tests/emu/fuzz.c emu/com.c $(EMU_LIBRARY)
EMU_BENCH   := tests/emu/bench.c tests/emu/plain8080.c emu/com.c emu/image.c
EMU_HEADERS := $(wildcard emu/*.h) tests/emu/plain8080.h emu/emu.mk
EMU_ASAN    := -g -fsanitize=address,undefined -fno-sanitize-recover=all

emu: build/skg80 build/libskg80.so

# Of the package and of skg80.
VERSION := $(shell sed -n 's/^version = "\(.*\)"$$/\1/p' tools/pyproject.toml)
EMU_PROGRAM_FLAGS := -DSKG80_VERSION='"$(VERSION)"'

# The ROM is built in when there is one.
SKG80_ROM := $(wildcard roms/skg.bin roms/skg.sym)
ifneq ($(SKG80_ROM),)
EMU_ROM := -DSKG80_BUILT_IN_ROM -DSKG80_ROM='"roms/skg.bin"' -DSKG80_SYM='"roms/skg.sym"' emu/rom.S
endif

EMU_CC = @mkdir -p $(@D); $(CC) $(EMU_CFLAGS) $(CFLAGS)

# The core takes gcc a few seconds, so it is compiled once for all programs and the library.
build/emu/i8080.o: emu/i8080.c $(EMU_HEADERS)
	$(EMU_CC) -fPIC -c -o $@ $<

build/skg80: $(EMU_PROGRAM) emu/rom.S $(SKG80_ROM) build/emu/i8080.o tools/pyproject.toml
	$(EMU_CC) $(EMU_PROGRAM_FLAGS) -o $@ $(EMU_PROGRAM) build/emu/i8080.o $(EMU_ROM) -lm

build/libskg80.so: $(EMU_LIBRARY) build/emu/i8080.o $(EMU_ROWS)
	$(EMU_CC) -fPIC -shared -DWITH_TRANSLATIONS -o $@ $(EMU_LIBRARY) build/emu/i8080.o $(EMU_ROWS)

# Translations: the examples show what of a ROM is instructions. (-O2 takes gcc twice as long, for nothing)
build/emu/translate: $(EMU_TRANSLATE) build/emu/i8080.o
	$(EMU_CC) -o $@ $^

build/emu/%.rows: roms/%.bin build/emu/translate $(wildcard examples/*.skg)
	@build/emu/translate $< $(filter %.skg,$^) >$@.new && mv $@.new $@

$(EMU_ROWS): build/emu/%.o: build/emu/%.rows emu/i8080_translated.c $(EMU_HEADERS)
	$(EMU_CC) -O1 -fPIC -I. -DNAME=translation_$(subst -,_,$*) -DROWS='"$<"' -c -o $@ emu/i8080_translated.c

# Tests
build/emu/compare: $(EMU_COMPARE) build/emu/i8080.o
	$(EMU_CC) -o $@ $(EMU_COMPARE) build/emu/i8080.o

build/emu/translated: tests/emu/translated.c $(filter-out emu/machine.c,$(EMU_LIBRARY)) build/emu/i8080.o $(EMU_ROWS)
	$(EMU_CC) -DWITH_TRANSLATIONS -o $@ $^

build/emu/bench: $(EMU_BENCH) build/emu/i8080.o
	$(EMU_CC) -o $@ $(EMU_BENCH) build/emu/i8080.o

# The same under the sanitizers
build/asan/i8080.o: emu/i8080.c $(EMU_HEADERS)
	$(EMU_CC) $(EMU_ASAN) -c -o $@ $<

build/asan/compare: $(EMU_COMPARE) build/asan/i8080.o
	$(EMU_CC) $(EMU_ASAN) -o $@ $(EMU_COMPARE) build/asan/i8080.o

build/asan/fuzz: $(EMU_FUZZ) build/asan/i8080.o
	$(EMU_CC) $(EMU_ASAN) -o $@ $(EMU_FUZZ) build/asan/i8080.o

build/asan/skg80: $(EMU_PROGRAM) emu/rom.S $(SKG80_ROM) build/asan/i8080.o
	$(EMU_CC) $(EMU_PROGRAM_FLAGS) $(EMU_ASAN) -o $@ $(EMU_PROGRAM) build/asan/i8080.o $(EMU_ROM) -lm

build/emu/%.com: tests/emu/%.asm tests/emu/asm8080.py
	@mkdir -p $(@D); $(PYTHON) tests/emu/asm8080.py $< $@

# SIMH's Altair, in which tests run core and ROM. Who may install it gets it; without it these tests are skipped.
altairz80:
	@command -v altairz80 >/dev/null || { [ "$$(id -u)" = 0 ] && apt-get update -q && apt-get install -qy simh; } \
		|| echo "No SIMH, some tests are skipped: sudo apt-get install simh"

# The core's test programs and the ROM with the examples, in SIMH.
simh: venv emu altairz80
	@command -v altairz80 >/dev/null
	$(PY) -m pytest -q -n 2 tests/emu/test_simh.py tests/rom/test_altair.py

bench-emu: venv build/emu/bench build/emu/mix.com
	@build/emu/bench build/emu/mix.com
	@$(PY) tests/emu/rom_speed.py

.PHONY: emu altairz80 simh bench-emu
