/* The programs in ROM that this build has translations of (i8080_translated.c, emu.mk). */
#ifndef TRANSLATIONS_H
#define TRANSLATIONS_H

#include "i8080.h"

/* NULL is behind the last one. */
extern const i8080_translation *const translations[];

#endif
