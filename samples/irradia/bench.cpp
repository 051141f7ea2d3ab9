// irradia bench: the parent of the benchmarks.
#include "commands.h"

namespace irradia {

void addBench(CLI::App& program) {
    CLI::App* bench = program.add_subcommand("bench", "Time kernels and the stages of a frame");
    bench->require_subcommand(1);
    addBenchFrame(*bench);
    addBenchRays(*bench);
    addBenchMlp(*bench);
    addBenchEncodings(*bench);
}

} // namespace irradia
