/** Numbers of what is in skg.rc. */
#define ID_ICON 1
#define ID_WINDOW 2
#define ID_DRAWING 101
#define ID_STATE 102
#define ID_OPEN 103
#define ID_COPY 104
#define ID_QUIT 105
