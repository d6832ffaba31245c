#!/bin/sh
# Compiles board.wasm, walk.wasm and inside.wasm into the folder named (default: this one), with clang and lld 14, whose bytes are the
# committed ones, or with what CLANG names (a later clang; "python3 -m ziglang cc"): other bytes, the same behaviour.
set -e
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here}
: "${CLANG:=clang-14}"
: "${FLAGS:=--target=wasm32-unknown-unknown -fuse-ld=$(command -v wasm-ld-14 || command -v wasm-ld || echo lld)}"
# With the C library wasi-libc: the debugger's module prints, and is loaded when it is wanted.
: "${WASI_FLAGS:=--target=wasm32-wasi -fuse-ld=$(command -v wasm-ld-14 || command -v wasm-ld || echo lld)}"
cd "$here/../.."
compile() {
    target=$1
    shift
    $CLANG -O2 -std=c11 -Wall -Wextra -Werror -Wl,--strip-all -Wl,-z,stack-size=65536 -o "$target" "$@"
}
alone="$FLAGS -ffreestanding -fno-builtin -nostdlib -nostdlibinc -isystem web/wasm/include -Wl,--no-entry"
compile "$out/board.wasm" $alone web/wasm/page.c web/wasm/memory.c emu/board.c emu/breaks.c emu/drive.c emu/i8080.c
compile "$out/walk.wasm" $alone web/wasm/walk.c tools/skg/native/skgsim.c
compile "$out/inside.wasm" $WASI_FLAGS -mexec-model=reactor -D_XOPEN_SOURCE=700 -D_DEFAULT_SOURCE web/wasm/inside.c \
    emu/calculator.c emu/disasm.c emu/listing.c emu/symbols.c emu/i8080.c
