# The emulator: build/skg80 and, for the tests, build/libskg80.so.
EMU_CFLAGS := -O2 -std=c11 -D_DEFAULT_SOURCE -D_XOPEN_SOURCE=700 -Wall -Wextra
EMU_CORE   := emu/i8080.c emu/board.c
EMU_HEADERS := $(wildcard emu/*.h)

emu: build/libskg80.so

build/libskg80.so: $(EMU_CORE) emu/machine.c $(EMU_HEADERS) emu/emu.mk
	@mkdir -p $(@D)
	$(CC) $(EMU_CFLAGS) $(CFLAGS) -fPIC -shared -o $@ $(EMU_CORE) emu/machine.c

.PHONY: emu
