// Requires that an action ends in an Error of one code whose single sentence names something.
#pragma once

#include "engine/error.h"
#include <catch2/catch_test_macros.hpp>
#include <string>

namespace irradia::test {

template <typename Action>
void expectError(ExitCode code, const std::string& named, Action action) {
    try {
        action();
    } catch (const Error& error) {
        INFO(error.what());
        CHECK(error.code() == code);
        CHECK(std::string(error.what()).find(named) != std::string::npos);
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
        return;
    }
    FAIL("no error, expected one that names " << named);
}

} // namespace irradia::test
