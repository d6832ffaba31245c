# SKG for a Raspberry Pi Pico: build/pico/skg-pico.uf2 (docs/pico.md). Debian: apt-get install gcc-arm-none-eabi
PICO_CC      := arm-none-eabi-gcc
PICO_CFLAGS  := -O2 -std=gnu11 -Wall -Wextra -Werror -mcpu=cortex-m0plus -mthumb -ffreestanding -nostdlib -Iemu \
                -ffunction-sections -fdata-sections -Wl,--gc-sections
PICO_SOURCES := $(wildcard pico/*.c) pico/boot2.S emu/small_board.c emu/i8080_small.c
PICO_ROMS    := roms/skg.bin roms/skg-drive.bin roms/skg-mill.bin

pico: build/pico/skg-pico.uf2

build/pico/skg-pico.elf: $(PICO_SOURCES) $(wildcard pico/*.h emu/i8080*.h emu/small_board.h) pico/pico.ld pico/pico.mk $(PICO_ROMS)
	@mkdir -p $(@D)
	@command -v $(PICO_CC) >/dev/null || { echo "No $(PICO_CC): apt-get install gcc-arm-none-eabi"; exit 1; }
	$(PICO_CC) $(PICO_CFLAGS) -T pico/pico.ld -o $@ $(PICO_SOURCES) -lgcc

build/pico/skg-pico.uf2: build/pico/skg-pico.elf pico/uf2.py
	arm-none-eabi-objcopy -O binary -j .boot2 -j .boot -j .roms -j .image $< build/pico/skg-pico.bin
	@$(PYTHON) pico/uf2.py build/pico/skg-pico.bin $@

pico-tools:
	@command -v $(PICO_CC) >/dev/null || { [ "$$(id -u)" = 0 ] && apt-get update -q && apt-get install -qy gcc-arm-none-eabi; } \
		|| echo "No $(PICO_CC): sudo apt-get install gcc-arm-none-eabi"

pico-modules: pico/node_modules/.package-lock.json
pico/node_modules/.package-lock.json: pico/package.json pico/package-lock.json | $(NODE)
	npm ci --prefix pico --silent --no-audit --no-fund --ignore-scripts
	touch $@

# In rp2040js, some minutes. PICO_ALL=1: all examples (half an hour); PICO_DRIVE="xy-star scale": each pulse of these, too.
test-pico: pico emu pico-modules
	node --test --test-reporter=spec pico/test/*.test.mjs

# Where the compiler is: cycles of the chip for one of the 8080.
bench-pico: pico-modules
	@if command -v $(PICO_CC) >/dev/null; then $(MAKE) -s pico && node pico/test/bench.mjs; else echo "No $(PICO_CC): no bench of the Pico."; fi

.PHONY: pico pico-tools pico-modules test-pico bench-pico
