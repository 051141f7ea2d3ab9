// What a buffer of the device holds, as the host knows it.
#pragma once

#include "engine/graph/frame_graph.h"
#include <map>
#include <optional>

namespace irradia {

// A pass that declares a change only counts for the passes declared behind it in the same graph, until that
// graph has been executed; one that never is leaves the buffer's content unknown, to be written again.
template <typename T>
class Held {
public:
    bool holds(const FrameGraph& graph, const T& what) const {
        const auto declared = declared_.find(graph.list());
        return (declared != declared_.end() ? declared->second : executed_) == what;
    }

    // None = nothing that is known. Must outlive the graph's execution.
    void declare(FrameGraph& graph, std::optional<T> what) {
        executed_.reset();
        declared_[graph.list()] = what;
        graph.whenExecuted([this, list = graph.list(), what] {
            executed_ = what;
            declared_.erase(list);
        });
    }

    // The host has changed what the content is made of.
    void forget() { executed_.reset(); }

private:
    std::optional<T> executed_;
    std::map<uint64_t, std::optional<T>> declared_; // in lists of passes that have not been executed
};

} // namespace irradia
