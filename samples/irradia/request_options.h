// The options of the commands that render, as a session's request.
#pragma once

#include "samples/session/render_session.h"
#include <CLI/CLI.hpp>

namespace irradia {

// Grouped by topic.
void addRequestOptions(CLI::App& command, RenderRequest& request);

// --form, of the kernels (samples/session/kernel_form.h).
void addForm(CLI::App& command, std::string& form, const std::vector<std::string>& names,
             const std::string& help);

// "512x512"
std::string sizeText(glm::uvec2 size);

} // namespace irradia
