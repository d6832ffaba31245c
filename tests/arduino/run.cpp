/* Runs a sketch on a computer: what stands in the file IN comes to Serial, that of TAPE to Serial1.
 *
 *      run IN TAPE SECONDS
 *
 * Prints what Serial printed; writes what Serial1 did behind a line "====", and each change of pins 2 to 6 behind another. Each
 * question for the time is a microsecond. Ends when nothing has been printed for so many seconds of that clock.
 */
#include <stdio.h>
#include <stdlib.h>
#include <fstream>
#include <iterator>
#include "Arduino.h"

Stream Serial, Serial1;
unsigned pins[64];
static unsigned long now;
static std::string steps;

unsigned long micros()
{
    return ++now;
}
unsigned long millis()
{
    return now / 1000;
}
void yield()
{
}
void pinMode(uint8_t, uint8_t)
{
}
int digitalRead(uint8_t)
{
    return LOW;
}

void digitalWrite(uint8_t pin, uint8_t value)
{
    if (pins[pin] != value && pin >= 2 && pin <= 6) {
        steps += (char)('0' + pin);
        steps += value ? '+' : '-';
    }
    pins[pin] = value;
}

static void fill(Stream &stream, const char *name)
{
    std::ifstream file(name, std::ios::binary);
    for (std::istreambuf_iterator<char> at(file), end; at != end; ++at) {
        stream.in.push_back((unsigned char)*at);
    }
}

int main(int count, char **words)
{
    if (count < 4) {
        return 2;
    }
    fill(Serial, words[1]);
    fill(Serial1, words[2]);
    unsigned long patience = strtoul(words[3], NULL, 10) * 1000000, quiet_since = 0;
    size_t printed = 0;
    setup();
    while (now - quiet_since < patience) {
        size_t before = Serial.out.size() + Serial1.out.size() + steps.size();
        loop();
        now += 1000;
        quiet_since = before == printed ? quiet_since : now;
        printed = before;
    }
    printf("%s\n====\n%s\n====\n%s\n", Serial.out.c_str(), Serial1.out.c_str(), steps.c_str());
    return 0;
}
