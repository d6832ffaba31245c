#include "translations.h"

#include <stddef.h>

extern const i8080_translation translation_skg, translation_skg_nodrift;

const i8080_translation *const translations[] = {
#ifdef WITH_TRANSLATIONS
    &translation_skg,
    &translation_skg_nodrift,
#endif
    NULL,
};
