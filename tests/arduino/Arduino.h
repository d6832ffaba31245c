/* As much of Arduino as the library and its examples use, for a computer: streams are queues of bytes, time is counted. */
#ifndef ARDUINO_H
#define ARDUINO_H

#include <stddef.h>
#include <stdint.h>
#include <deque>
#include <string>

enum { LOW, HIGH };
enum { INPUT, OUTPUT, INPUT_PULLUP };

class Stream
{
  public:
    std::deque<int> in;
    std::string out;
    void begin(unsigned long)
    {
    }
    explicit operator bool() const
    {
        return true;
    }
    virtual int available()
    {
        return (int)in.size();
    }
    virtual int read()
    {
        int c = in.front();
        in.pop_front();
        return c;
    }
    virtual size_t write(uint8_t c)
    {
        out += (char)c;
        return 1;
    }
    virtual ~Stream()
    {
    }
};

extern Stream Serial, Serial1;
extern unsigned pins[64];

unsigned long micros();
unsigned long millis();
void yield();
void pinMode(uint8_t pin, uint8_t mode);
void digitalWrite(uint8_t pin, uint8_t value);
int digitalRead(uint8_t pin);
void setup();
void loop();

#endif
