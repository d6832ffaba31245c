# The emulator: build/skg80 and, for the tests, build/libskg80.so.
EMU_CFLAGS  := -O2 -std=c11 -D_DEFAULT_SOURCE -D_XOPEN_SOURCE=700 -Wall -Wextra
EMU_BOARD   := emu/i8080.c emu/board.c
EMU_PROGRAM := $(EMU_BOARD) emu/com.c emu/image.c emu/terminal.c emu/main.c
EMU_LIBRARY := $(EMU_BOARD) emu/machine.c
EMU_HEADERS := $(wildcard emu/*.h) emu/emu.mk

emu: build/skg80 build/libskg80.so

# The ROM is built in when there is one.
SKG80_ROM := $(wildcard roms/skg.bin)
ifneq ($(SKG80_ROM),)
EMU_ROM := -DSKG80_BUILT_IN_ROM -DSKG80_ROM='"$(SKG80_ROM)"' emu/rom.S
endif

build/skg80: $(EMU_PROGRAM) emu/rom.S $(SKG80_ROM) $(EMU_HEADERS)
	@mkdir -p $(@D)
	$(CC) $(EMU_CFLAGS) $(CFLAGS) -o $@ $(EMU_PROGRAM) $(EMU_ROM)

build/libskg80.so: $(EMU_LIBRARY) $(EMU_HEADERS)
	@mkdir -p $(@D)
	$(CC) $(EMU_CFLAGS) $(CFLAGS) -fPIC -shared -o $@ $(EMU_LIBRARY)

.PHONY: emu
