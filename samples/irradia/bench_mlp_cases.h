// The cases of `bench mlp`: a network of one shape, form and precision, evaluated or trained.
#pragma once

#include "engine/gpu/profiler.h"
#include "nrc/learning/config.h"
#include "samples/yardsticks/mlp_problem.h"
#include <memory>

namespace irradia {

class Device;

struct MlpCase {
    MlpShape shape;
    NetworkForm form = NetworkForm::Auto;
    Precision precision = Precision::Float;
    bool isTraining = false;
    uint32_t rowsPerLane = 0; // of an evaluation in the subgroup form; 0 = the network's choice
};

struct MlpTime {
    double wall = 0;   // seconds of executing the graph, submission included
    double passes = 0; // seconds by the device's own clock, 0 where it has none
};

// A case on a device, ready to run.
class MlpRun {
public:
    virtual ~MlpRun() = default;

    virtual MlpTime run() = 0;
    virtual std::vector<Profiler::Row> passes() const = 0;    // a run is a frame
    virtual std::vector<float> results() const { return {}; } // of an evaluation: rows x outputs
};

// Throws Error(BadData) where the shape does not fit the device.
std::unique_ptr<MlpRun> startCase(Device& device, const MlpCase& what, const MlpProblem& problem);

// Floating-point operations of a row; a training step makes each product three times.
double flopsPerRow(const MlpCase& what);

} // namespace irradia
