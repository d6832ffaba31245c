# The emulator: build/skg80 and, for the Python tools, build/libskg80.so. `make bench-emu` prints the core's speed.
# emu/library.txt and emu/translated.txt are lists that tools/setup.py reads too: it builds the library without make.
EMU_CFLAGS  := -O2 -std=c11 -D_DEFAULT_SOURCE -D_DARWIN_C_SOURCE -D_XOPEN_SOURCE=700 -Wall -Wextra
EMU_PROGRAM := i8080.c board.c drive.c drawn.c com.c complain.c image.c options.c signs.c terminal.c terminal_posix.c \
               main.c output.c outfile.c operator.c symbols.c disasm.c calculator.c listing.c trace.c breaks.c debug.c commands.c
EMU_LIBRARY := $(shell cat emu/library.txt)
TRANSLATED  := $(shell cat emu/translated.txt)
EMU_ASAN    := -g1 -O1 -fsanitize=address,undefined -fno-sanitize-recover=all

emu: build/skg80 build/libskg80.so

# Of the package and of skg80.
VERSION := $(shell sed -n 's/^version = "\(.*\)"$$/\1/p' tools/pyproject.toml)
EMU_PROGRAM_FLAGS := -DSKG80_VERSION='"$(VERSION)"'

# The ROM is built in when there is one.
SKG80_ROM := $(wildcard roms/skg.bin roms/skg.sym)
ifneq ($(SKG80_ROM),)
EMU_PROGRAM_FLAGS += -DSKG80_BUILT_IN_ROM
EMU_ROM := rom.o
endif

# Objects, plain and under the sanitizers; -MMD writes the headers of each into a file beside it. The library's
# objects are those of the programs, so all are position-independent.
EMU_CC       = @mkdir -p $(@D); $(CC) $(EMU_CFLAGS) $(CFLAGS)
EMU_OBJECTS  = $(addprefix $(1)/,$(2:.c=.o))

build/emu/%.o: emu/%.c emu/emu.mk
	$(EMU_CC) $(EMU_PROGRAM_FLAGS) -fPIC -MMD -c -o $@ $<

build/asan/%.o: emu/%.c emu/emu.mk
	$(EMU_CC) $(EMU_PROGRAM_FLAGS) $(EMU_ASAN) -MMD -c -o $@ $<

build/emu/tests/%.o: tests/emu/%.c emu/emu.mk
	$(EMU_CC) -MMD -c -o $@ $<

build/asan/tests/%.o: tests/emu/%.c emu/emu.mk
	$(EMU_CC) $(EMU_ASAN) -MMD -c -o $@ $<

build/emu/rom.o build/asan/rom.o: emu/rom.S $(SKG80_ROM)
	$(EMU_CC) -DSKG80_ROM='"roms/skg.bin"' -DSKG80_SYM='"roms/skg.sym"' -c -o $@ $<

# (a tenth faster than with -O2)
build/emu/i8080.o: EMU_CFLAGS += -O3

build/emu/options.o build/asan/options.o: tools/pyproject.toml

# A header that is gone, and that the lists of an older build name: what included it is made anew.
%.h: ;

-include $(wildcard $(addsuffix *.d,build/emu/ build/emu/tests/ build/asan/ build/asan/tests/))

build/skg80: $(call EMU_OBJECTS,build/emu,$(EMU_PROGRAM) $(EMU_ROM))
	$(EMU_CC) -o $@ $^ -lm

build/asan/skg80: $(call EMU_OBJECTS,build/asan,$(EMU_PROGRAM) $(EMU_ROM))
	$(EMU_CC) $(EMU_ASAN) -o $@ $^ -lm

# The library has the ROMs that run most often as C, too. The examples show what of a ROM is instructions: a new example
# does not make the rows anew, a new ROM does. (-O2 takes gcc twice as long, for nothing)
EMU_ROWS := $(TRANSLATED:%=build/emu/%.rows.o)

build/emu/translate: $(call EMU_OBJECTS,build/emu,translate.c $(EMU_LIBRARY))
	$(EMU_CC) -o $@ $^

build/emu/%.rows: roms/%.bin build/emu/translate
	@build/emu/translate $< examples/*.skg >$@.new && mv $@.new $@

$(EMU_ROWS): build/emu/%.rows.o: build/emu/%.rows emu/i8080_translated.c
	$(EMU_CC) -O1 -fPIC -I. -DNAME=translation_$(subst -,_,$*) -DROWS='"$<"' -MMD -c -o $@ emu/i8080_translated.c

EMU_TRANSLATED := $(filter-out %/translations.o,$(call EMU_OBJECTS,build/emu,$(EMU_LIBRARY))) build/emu/with_translations.o $(EMU_ROWS)
build/emu/with_translations.o: emu/translations.c emu/emu.mk
	$(EMU_CC) -DWITH_TRANSLATIONS -fPIC -MMD -c -o $@ $<

build/libskg80.so: $(EMU_TRANSLATED)
	$(EMU_CC) -shared -o $@ $^

# Tests
build/emu/compare build/asan/compare: build/%/compare: $(addprefix build/%/,tests/compare.o tests/plain8080.o i8080.o i8080_small.o)
	$(EMU_CC) $(if $(findstring asan,$*),$(EMU_ASAN)) -o $@ $^

build/emu/translated: build/emu/tests/translated.o $(EMU_TRANSLATED)
	$(EMU_CC) -o $@ $^

build/emu/bench: $(addprefix build/emu/,tests/bench.o tests/plain8080.o com.o image.o i8080.o i8080_small.o)
	$(EMU_CC) -o $@ $^

build/asan/fuzz: build/asan/tests/fuzz.o $(call EMU_OBJECTS,build/asan,com.c $(EMU_LIBRARY))
	$(EMU_CC) $(EMU_ASAN) -o $@ $^

build/emu/%.com: tests/emu/%.asm tests/emu/asm8080.py
	@mkdir -p $(@D); $(PYTHON) tests/emu/asm8080.py $< $@

# The small core and the ROM for a BBC micro:bit, on which qemu-system-arm runs them in a test.
MICRO_CC     := arm-none-eabi-gcc
MICRO_CFLAGS := -O2 -std=c11 -Wall -Wextra -Werror -mthumb -mcpu=cortex-m0 --specs=nano.specs -nostartfiles \
                -ffunction-sections -fdata-sections -Wl,--gc-sections

build/emu/micro.elf: $(addprefix tests/emu/micro/,main.c microbit.ld) $(wildcard emu/i8080*.[ch] emu/small_board.[ch]) roms/skg.bin emu/emu.mk
	@mkdir -p $(@D); $(MICRO_CC) $(MICRO_CFLAGS) -DROM='"roms/skg.bin"' -T $(filter %.ld,$^) -o $@ tests/emu/micro/main.c emu/small_board.c emu/i8080_small.c

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
