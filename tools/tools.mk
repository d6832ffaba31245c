# The 3B simulator's inner loop, a shared library that tools/skg/tape/controller.py loads.
TOOLS_CFLAGS ?= -O3 -g -std=c11 -Wall -Wextra -Wpedantic

tools: build/libskgsim.so

build/libskgsim.so: tools/skg/native/skgsim.c tools/skg/native/skgsim.h
	@mkdir -p build
	$(CC) $(TOOLS_CFLAGS) -shared -fPIC -fvisibility=default -o $@ $<

.PHONY: tools
