#!/bin/sh
# Compiles board.wasm and walk.wasm into the folder named (default: this one), with clang and lld 14, whose bytes are the
# committed ones, or with what CLANG names (a later clang; "python3 -m ziglang cc"): other bytes, the same behaviour.
set -e
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here}
: "${CLANG:=clang-14}"
: "${FLAGS:=--target=wasm32-unknown-unknown -fuse-ld=$(command -v wasm-ld-14 || command -v wasm-ld || echo lld)}"
cd "$here/../.."
compile() {
    target=$1
    shift
    $CLANG $FLAGS -O2 -std=c11 -Wall -Wextra -Werror -ffreestanding -fno-builtin -nostdlib -nostdlibinc \
        -isystem web/wasm/include -Wl,--no-entry -Wl,--strip-all -Wl,-z,stack-size=65536 -o "$target" "$@"
}
compile "$out/board.wasm" web/wasm/page.c web/wasm/memory.c emu/board.c emu/breaks.c emu/drive.c emu/i8080.c
compile "$out/walk.wasm" web/wasm/walk.c tools/skg/native/skgsim.c
