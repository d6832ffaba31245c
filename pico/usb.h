/* Two serial lines over USB (CDC-ACM), on the RP2040's own controller, polled: the teletype, and the punch with the reader
 *
 * A line is open while the host's program holds DTR, as terminal programs do. A character is sent when its line is open;
 * what the host sends waits in a queue, and when that is full USB itself holds the host.
 */
#ifndef PICO_USB_H
#define PICO_USB_H

#include <stdbool.h>
#include <stdint.h>

typedef enum { USB_TELETYPE, USB_PUNCH, USB_LINES } usb_line;

enum { USB_NONE = -1 };

/* Connects. */
void usb_start(void);

/* Answers the host and moves characters: at least every 50 ms. */
void usb_poll(void);

/* The next character from the host, taken or only looked at; USB_NONE: there is none. */
int usb_take(usb_line line);
int usb_peek(usb_line line);

/* The teletype's next ctrl-C, ctrl-S or ctrl-Q, which pass all other keys; USB_NONE: there is none. A ctrl-C drops what came
 * before it. */
int usb_take_at_once(void);

/* Drops what has come and was not taken. */
void usb_drop(usb_line line);

/* True while a program holds the line open. A host that sleeps, or is gone, does not tell: see usb_awake. */
bool usb_open(usb_line line);
bool usb_awake(void);

/* Room for a character; usb_put drops the oldest where there is none, and says so on the line with "...". */
bool usb_room(usb_line line);
void usb_put(usb_line line, uint8_t c);

/* True once for each break on the teletype's line. */
bool usb_break(void);

#endif
