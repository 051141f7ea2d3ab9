// Time per pass and per frame: GPU timestamps summed by pass name, medians over frames. Of many frames every
// second, fourth, ... is kept, so that what is kept does not grow with their number.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace irradia {

class Profiler {
public:
    struct Row {
        std::string name;
        double p50 = 0; // ms per frame
        double p90 = 0;
        double mean = 0;
        uint64_t runs = 0; // dispatches over all frames
    };

    // Adds one run of a pass to the frame being recorded.
    void record(std::string_view pass, double milliseconds);
    // Closes a frame; `wallMilliseconds` is its wall-clock time.
    void endFrame(double wallMilliseconds);
    void reset();

    uint64_t frames() const { return frames_; }
    std::vector<Row> rows() const;                 // in order of first appearance
    Row wall() const;                              // named "total"
    double lastFrame(std::string_view pass) const; // ms in the last closed frame, 0 if it did not run

private:
    struct Entry {
        std::string name;
        double current = 0; // of the frame being recorded
        double last = 0;    // of the last closed one
        uint64_t runs = 0;
        std::vector<double> frames;
    };
    void thinOut();

    std::vector<Entry> entries_;
    std::vector<double> wall_;
    uint64_t frames_ = 0;
    uint64_t stride_ = 1; // every stride_-th frame is kept
};

} // namespace irradia
