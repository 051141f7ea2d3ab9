// The drawn parts of the generated picture. Lengths are in widths of the picture's shorter side.
#pragma once

#include "samples/fit_image/patterns.h"

namespace irradia {

constexpr float kDialRadius = 0.278f;
constexpr float kFrameWidth = 0.062f;

// An astronomical dial about the origin: rings of letters, ticks and checks, a guilloche, planets and a sun.
void paintDial(Paint& paint, glm::vec2 p);

// A braid between gold rails along the edges, with a star in each corner; p from the upper left corner.
void paintFrame(Paint& paint, glm::vec2 p, glm::vec2 size);

// A sheet with lines of writing and a large red initial; p from its centre.
void paintSheet(Paint& paint, glm::vec2 p, glm::vec2 halfSize);

// Whether nothing behind them is seen there.
bool coversDial(const Paint& paint, glm::vec2 p);
bool coversFrame(const Paint& paint, glm::vec2 p, glm::vec2 size);
bool coversSheet(const Paint& paint, glm::vec2 p, glm::vec2 halfSize);

} // namespace irradia
